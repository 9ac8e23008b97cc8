"""Opens an OpenEXR file of layers in Blender's compositor and says what it finds there.

blender --background --factory-startup --python open_layers_in_blender.py -- LAYERS.exr BODY FOLDER

Into FOLDER: seen.json with the names of the layers, and of each its values as the compositor gave them on: NAME.raw,
32-bit floats, four for each pixel, rows from the top. `matte` is what the Cryptomatte node picks by the body's name.
"""

import json
import os
import sys

import bpy
import numpy

layers, body, folder = sys.argv[sys.argv.index("--") + 1 :]


def compositor():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.use_nodes = True
    scene.node_tree.nodes.clear()
    return scene, scene.node_tree.nodes, scene.node_tree.links


def writer(nodes):
    node = nodes.new("CompositorNodeOutputFile")
    node.base_path = os.path.join(folder, "values")
    node.format.file_format = "OPEN_EXR"
    node.format.color_depth = "32"
    node.format.color_mode = "RGBA"
    node.format.exr_codec = "NONE"
    node.file_slots.clear()
    return node


def picker(nodes, picture):
    node = nodes.new("CompositorNodeCryptomatteV2")
    node.source = "IMAGE"
    node.image = picture
    node.matte_id = body
    return node


def composite():
    """Each layer goes through the compositor into a file of its own."""
    scene, nodes, links = compositor()
    picture = bpy.data.images.load(layers)
    reader = nodes.new("CompositorNodeImage")
    reader.image = picture
    outputs = {output.name: output for output in reader.outputs}
    matte = picker(nodes, picture)
    out = writer(nodes)
    for name, output in {**outputs, "matte": matte.outputs["Matte"]}.items():
        out.file_slots.new(name + ".")
        links.new(output, out.inputs[-1])
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))  # none is needed, but asked for
    scene.collection.objects.link(camera)
    scene.camera = camera
    bpy.ops.render.render()
    return {
        "type": picture.type,
        "layers": {name: output.type for name, output in outputs.items()},
        "cryptomatte": matte.layer_name,
        "picked": [entry.name for entry in matte.entries],
    }


def values(file):
    image = bpy.data.images.load(file)
    pixels = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(pixels)
    return list(image.size), pixels.reshape(image.size[1], image.size[0], 4)[::-1]


seen = composite()
seen["sizes"] = {}
for file in sorted(os.listdir(os.path.join(folder, "values"))):
    name = file.split(".")[0]
    seen["sizes"][name], pixels = values(os.path.join(folder, "values", file))
    pixels.tofile(os.path.join(folder, name + ".raw"))
with open(os.path.join(folder, "seen.json"), "w") as out:
    json.dump(seen, out)
