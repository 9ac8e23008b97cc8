# Run by cycles.sh inside Blender: the bodies of a glTF and the gas of a VDB file as Cycles draws them, with the lights
# and the camera of scenes/window.toml. Prints the seconds of each picture; writes OpenEXR, scene-linear.
# usage: ... -- BODIES.glb GAS.vdb FRAME WIDTH HEIGHT SAMPLES BOUNCES SEEDS OUT
import math
import sys
import time

import bpy
import mathutils
import numpy

numpy.bool = bool  # Debian 12: the glTF importer of Blender 3.4 wants the name that NumPy 1.24 gave up
bodies, gas, frame, width, height, samples, bounces, seeds, out = sys.argv[sys.argv.index("--") + 1:]


def zUp(x, y, z):
    return mathutils.Vector((x, -z, y))


def shader(material, output, make):
    material.use_nodes = True
    tree = material.node_tree
    old = [node.image for node in tree.nodes if node.type == "TEX_IMAGE"]
    tree.nodes.clear()
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(make(tree, old[0] if old else None), end.inputs[output])


def painted(colour, emission=0):
    def make(tree, image):
        node = tree.nodes.new("ShaderNodeEmission" if emission else "ShaderNodeBsdfDiffuse")
        if emission:
            node.inputs["Strength"].default_value = emission
        node.inputs["Color"].default_value = (*colour, 1)
        if image:
            texture = tree.nodes.new("ShaderNodeTexImage")
            texture.image = image
            tree.links.new(texture.outputs["Color"], node.inputs["Color"])
        return node.outputs[0]
    return make


def glass(tree, _):
    """Light of the sun goes straight through, as in Brisance: no path would find it beyond."""
    bent = tree.nodes.new("ShaderNodeBsdfGlass")
    bent.inputs["IOR"].default_value = 1.5
    bent.inputs["Roughness"].default_value = 0
    straight = tree.nodes.new("ShaderNodeBsdfTransparent")
    straight.inputs["Color"].default_value = (0.96, 0.96, 0.96, 1)
    path, mix = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(path.outputs["Is Shadow Ray"], mix.inputs[0])
    tree.links.new(bent.outputs[0], mix.inputs[1])
    tree.links.new(straight.outputs[0], mix.inputs[2])
    return mix.outputs[0]


def fire(tree, _):
    absorbs, shines = tree.nodes.new("ShaderNodeVolumeAbsorption"), tree.nodes.new("ShaderNodeEmission")
    density, glow = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeAttribute")
    density.attribute_name, glow.attribute_name = "density", "glow"
    both = tree.nodes.new("ShaderNodeAddShader")
    absorbs.inputs["Color"].default_value = (0, 0, 0, 1)
    tree.links.new(density.outputs["Fac"], absorbs.inputs["Density"])
    tree.links.new(glow.outputs["Color"], shines.inputs["Color"])
    tree.links.new(absorbs.outputs[0], both.inputs[0])
    tree.links.new(shines.outputs[0], both.inputs[1])
    return both.outputs[0]


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 24
bpy.ops.import_scene.gltf(filepath=bodies)
scene.frame_set(int(frame))
looks = {"glass": glass, "brick": painted((1, 1, 1)), "plaster": painted((1, 1, 1)),
         "stone": painted((0.45, 0.42, 0.38)), "pavement": painted((0.16, 0.16, 0.17)),
         "street": painted((1, 1, 1), 2.4)}
for material in bpy.data.materials:
    if material.name in looks:
        shader(material, "Surface", looks[material.name])
for thing in scene.objects:
    if thing.type == "MESH" and thing.name.startswith("street"):
        thing.visible_shadow = False

volume = bpy.data.volumes.new("gas")
volume.filepath = gas
thing = bpy.data.objects.new("gas", volume)
scene.collection.objects.link(thing)
burning = bpy.data.materials.new("fire")
shader(burning, "Volume", fire)
volume.materials.append(burning)

sun = bpy.data.lights.new("sun", "SUN")
sun.energy, sun.color, sun.angle = math.pi, (0.65, 0.5, 0.36), math.radians(0.53)
lamp = bpy.data.objects.new("sun", sun)
lamp.rotation_euler = zUp(0.7, -0.6, -0.9).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(lamp)
world = bpy.data.worlds.new("sky")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0.10, 0.13, 0.20, 1)

camera = bpy.data.cameras.new("camera")
camera.sensor_fit, camera.angle = "VERTICAL", math.radians(38)
eye = bpy.data.objects.new("camera", camera)
eye.location = zUp(1.3, 2.2, 7.3)
eye.rotation_euler = (zUp(0, 1.7, 0.6) - eye.location).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(eye)
scene.camera = eye

scene.render.engine = "CYCLES"
cycles, render = scene.cycles, scene.render
cycles.device, cycles.samples = "CPU", int(samples)
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = int(bounces)
cycles.transparent_max_bounces, cycles.volume_bounces = 64, 0
cycles.sample_clamp_indirect = cycles.blur_glossy = 0
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1
render.resolution_x, render.resolution_y, render.resolution_percentage = int(width), int(height), 100
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
render.threads_mode = "AUTO"
render.use_persistent_data = False
for seed in range(int(seeds)):
    cycles.seed = seed
    render.filepath = f"{out}_{seed}.exr"
    start = time.time()
    bpy.ops.render.render(write_still=True)
    print(f"CYCLES {time.time() - start:.3f}", flush=True)
