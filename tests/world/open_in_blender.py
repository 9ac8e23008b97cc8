"""Opens an exported film in Blender, says what it finds there, and renders one frame.

blender --background --factory-startup --python open_in_blender.py -- GLB GAS_FOLDER FPS FRAMES THRESHOLD OUT.json OUT.png
"""

import glob
import json
import os
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian 12: the glTF importer of Blender 3.4 wants the name that NumPy 1.24 gave up

glb, gas, fps, frames, threshold, report, picture = sys.argv[sys.argv.index("--") + 1 :]
frames = [int(frame) for frame in frames.split(",")]


def import_bodies():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = int(fps)  # before the import: seconds become frames of the scene there
    bpy.ops.import_scene.gltf(filepath=glb)
    return scene, [thing for thing in scene.objects if thing.type == "MESH"]


def import_gas():
    """The first file names the sequence; frame 0 of the scene is frame 1 of the run, for bodies and gas alike."""
    files = sorted(glob.glob(os.path.join(gas, "*.vdb")))
    volume = bpy.data.volumes.new("gas")
    volume.filepath = files[0]
    volume.is_sequence = True
    volume.frame_duration = len(files)
    volume.frame_start = 0
    thing = bpy.data.objects.new("gas", volume)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def surface_of(thing, grid):
    """A mesh of where the grid's values pass the threshold, made by Blender's own modifier."""
    mesh = bpy.data.objects.new("surface", bpy.data.meshes.new("surface"))
    bpy.context.scene.collection.objects.link(mesh)
    modifier = mesh.modifiers.new("surface", "VOLUME_TO_MESH")
    modifier.object = thing
    modifier.grid_name = grid
    modifier.threshold = float(threshold)
    return mesh


def bounds(points):
    points = list(points)
    if not points:
        return None
    return [[min(p[axis] for p in points) for axis in range(3)], [max(p[axis] for p in points) for axis in range(3)]]


def look(scene, bodies, volume, surface, frame):
    scene.frame_set(frame - 1)
    graph = bpy.context.evaluated_depsgraph_get()
    grids = volume.data.grids
    grids.load()
    seen = surface.evaluated_get(graph).data
    return {
        "file": os.path.basename(grids.frame_filepath),
        "error": grids.error_message,
        "grids": {grid.name: grid.data_type for grid in grids},
        "bodies": {body.name: list(body.matrix_world.translation) for body in bodies},
        "corners": {body.name: [list(body.matrix_world @ v.co) for v in body.data.vertices] for body in bodies},
        "surface": bounds(v.co for v in seen.vertices),
    }


def smoke():
    """Blender multiplies the node's temperature by the grid's, which is in kelvin: 1 leaves it as it is."""
    material = bpy.data.materials.new("smoke")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    gas = nodes.new("ShaderNodeVolumePrincipled")
    gas.inputs["Density"].default_value = 40
    gas.inputs["Temperature"].default_value = 1
    gas.inputs["Blackbody Intensity"].default_value = 1
    out = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(gas.outputs["Volume"], out.inputs["Volume"])
    return material


def render(scene, bodies, volume):
    volume.data.materials.append(smoke())
    corners = [body.matrix_world @ Vector(corner) for body in bodies for corner in body.bound_box]
    low, high = (Vector(corner) for corner in bounds(corners))
    middle, reach = (low + high) / 2, max((high - low).length, 1.0)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + Vector((0.35, -1.2, 0.25)) * reach  # the run's +z, its street side, is -y here
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 4
    sun.rotation_euler = (0.8, 0.3, 0)
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.3, 0.45, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 240, 180, 100
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


scene, bodies = import_bodies()
volume = import_gas()
surface = surface_of(volume, "temperature")
seen = {frame: look(scene, bodies, volume, surface, frame) for frame in frames}
with open(report, "w") as out:
    json.dump({"version": bpy.app.version_string, "frames": seen}, out)
surface.hide_render = True
render(scene, bodies, volume)
