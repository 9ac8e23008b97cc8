# Run by blender_chain.sh inside Blender: a film like scenes/window.toml by Blender alone. The set is that of the scene,
# the pane is broken by Cell Fracture, thrown by Bullet, the gas is Mantaflow's, the pictures are those of Cycles.
# Prints the seconds of each stage. usage: ... -- CELLS FRAMES PIECES WIDTH SAMPLES ASSETS OUT
import contextlib
import math
import os
import random
import subprocess
import sys
import time

import bpy
import mathutils

cells, frames, pieces, width, samples = map(int, sys.argv[sys.argv.index("--") + 1:][:5])
assets, out = map(os.path.abspath, sys.argv[sys.argv.index("--") + 6:][:2])
time_scale = 0.32
burst, blown = 6, 10  # frames between which the pane is thrown
fuelled = 11  # the last frame in which fuel comes
charge = (0, 2.2, -0.5)
pane_size, pane_place = (1.44, 1.92, 0.008), (0, 2.2, 0.52)
began = time.time()


def z_up(x, y, z):
    return mathutils.Vector((x, -z, y))


@contextlib.contextmanager
def stage(name):
    start = time.time()
    yield
    print(f"\nCHAIN {name} {time.time() - start:.3f}", flush=True)


def select(things):
    for item in scene.objects:
        item.select_set(item in things)
    bpy.context.view_layer.objects.active = things[0]


def keyed(owner, name, values):
    for frame, value in values:
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)


# ---- what things look like


def material(name, make, output="Surface"):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(make(tree), end.inputs[output])
    return made


def painted(colour=(1, 1, 1), picture=None, emission=0):
    def make(tree):
        node = tree.nodes.new("ShaderNodeEmission" if emission else "ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = (*colour, 1)
        if emission:
            node.inputs["Strength"].default_value = emission
        if picture:
            texture = tree.nodes.new("ShaderNodeTexImage")
            texture.image = bpy.data.images.load(os.path.join(assets, picture))
            tree.links.new(texture.outputs["Color"], node.inputs["Color"])
        return node.outputs[0]
    return make


def glass(tree):
    node = tree.nodes.new("ShaderNodeBsdfGlass")
    node.inputs["IOR"].default_value, node.inputs["Roughness"].default_value = 1.5, 0
    return node.outputs[0]


def times(tree, attribute, factor):
    read, product = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeMath")
    read.attribute_name = attribute
    product.operation = "MULTIPLY"
    product.inputs[1].default_value = factor
    tree.links.new(read.outputs["Fac"], product.inputs[0])
    return product.outputs[0]


def fire(tree):
    volume, heat = tree.nodes.new("ShaderNodeVolumePrincipled"), tree.nodes.new("ShaderNodeBlackbody")
    volume.inputs["Color"].default_value = (0.3, 0.27, 0.24, 1)
    volume.inputs["Density"].default_value = 6
    volume.inputs["Density Attribute"].default_value = "density"
    volume.inputs["Temperature Attribute"].default_value = ""
    tree.links.new(times(tree, "temperature", 1000), heat.inputs["Temperature"])
    tree.links.new(heat.outputs[0], volume.inputs["Emission Color"])
    tree.links.new(times(tree, "flame", 2.5), volume.inputs["Emission Strength"])
    return volume.outputs[0]


# ---- the set of scenes/window.toml: name, size, middle, look, texture repeats over the longest faces


def set_of_the_scene(looks):
    return [thing(*parts, looks) for parts in (
        ("wall_left", (5.76, 9, 0.3), (-3.6, 3.34, 0.45), "brick", 1 / 2.88),
        ("wall_right", (5.76, 9, 0.3), (3.6, 3.34, 0.45), "brick", 1 / 2.88),
        ("wall_below", (1.44, 2.4, 0.3), (0, 0.04, 0.45), "brick", 1 / 2.88),
        ("wall_above", (1.44, 4.68, 0.3), (0, 5.5, 0.45), "brick", 1 / 2.88),
        ("sill", (1.72, 0.1, 0.42), (0, 1.19, 0.51), "stone", 1),
        ("lintel", (1.92, 0.24, 0.34), (0, 3.28, 0.45), "stone", 1),
        ("room_back", (6.4, 6.4, 0.1), (0, 2.6, -3), "plaster", 0.5),
        ("room_left", (0.1, 6.4, 3.4), (-3.2, 2.6, -1.3), "plaster", 0.5),
        ("room_right", (0.1, 6.4, 3.4), (3.2, 2.6, -1.3), "plaster", 0.5),
        ("room_ceiling", (6.4, 0.1, 3.4), (0, 5.8, -1.3), "plaster", 0.5),
        ("ground", (24, 0.1, 24), (0, -0.05, 6), "pavement", 1))]


def thing(name, size, middle, look, repeats, looks):
    """A box whose texture repeats so often per metre."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=z_up(*middle))
    box = bpy.context.object
    box.name = name
    mesh = box.data
    mesh.transform(mathutils.Matrix.Diagonal((size[0], size[2], size[1], 1)))
    if look:
        mesh.materials.append(looks[look])
    for face in mesh.polygons:
        flat = [axis for axis in range(3) if abs(face.normal[axis]) < 0.5]
        for corner in face.loop_indices:
            place = mesh.vertices[mesh.loops[corner].vertex_index].co
            mesh.uv_layers.active.data[corner].uv = [(place[axis] + size[(0, 2, 1)[axis]] / 2) * repeats for axis in flat]
    return box


# ---- pieces


def break_pane(pane):
    random.seed(1)
    known = set(bpy.data.objects)
    bpy.ops.preferences.addon_enable(module="object_fracture_cell")
    rows = math.ceil(math.sqrt(pieces))
    spots = [(pane_size[0] * ((n % rows + random.random()) / rows - 0.5), 0,
              pane_size[1] * ((n // rows + random.random()) / rows - 0.5)) for n in range(pieces)]
    mesh = bpy.data.meshes.new("spots")
    mesh.from_pydata(spots, [], [])
    child = bpy.data.objects.new("spots", mesh)
    scene.collection.objects.link(child)
    child.location, child.parent, child.hide_render = pane.location, pane, True
    child.matrix_parent_inverse = pane.matrix_world.inverted()
    bpy.context.view_layer.update()
    select([pane])
    bpy.ops.object.add_fracture_cell_objects(
        source={"VERT_CHILD"}, source_limit=pieces, source_noise=0, recursion=0, use_smooth_faces=False,
        use_sharp_edges=False, use_sharp_edges_apply=False, use_data_match=True, use_island_split=False, margin=1e-4,
        use_remove_original=False, collection_name="pieces")
    for item in (pane, child):
        keyed(item, "hide_render", ((burst - 1, item is child), (burst, True)))
    broken = [item for item in bpy.data.objects if item not in known and item.type == "MESH" and item is not child]
    for piece in broken:
        keyed(piece, "hide_render", ((burst - 1, True), (burst, False)))
    return broken


def throw(broken, scenery):
    bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    world.time_scale, world.substeps_per_frame = time_scale, 10
    world.point_cache.frame_end = frames
    select(broken)
    bpy.ops.rigidbody.objects_add(type="ACTIVE")
    mass = 1600 * math.prod(pane_size) / len(broken)
    for piece in broken:
        body = piece.rigid_body
        body.mass, body.friction, body.restitution = mass, 0.6, 0.25
        body.collision_shape, body.use_margin, body.collision_margin = "CONVEX_HULL", True, 0
        keyed(body, "kinematic", ((1, True), (burst, False)))
    select(scenery)
    bpy.ops.rigidbody.objects_add(type="PASSIVE")
    for item in scenery:
        item.rigid_body.collision_shape, item.rigid_body.friction = "BOX", 0.6
    bpy.ops.object.effector_add(type="FORCE", location=z_up(*charge) + mathutils.Vector((0.06, 0, -0.04)))
    field = bpy.context.object.field
    field.falloff_type, field.falloff_power, field.use_min_distance, field.distance_min = "SPHERE", 1, True, 0.3
    keyed(field, "strength", ((1, 0), (burst - 1, 0), (burst, 16700), (blown, 16700), (blown + 1, 0)))
    bpy.ops.ptcache.bake({"scene": scene, "point_cache": world.point_cache}, bake=True)
    scene.frame_set(blown + 4)
    first = [piece.matrix_world.translation.copy() for piece in broken]
    scene.frame_set(blown + 5)
    speeds = [(piece.matrix_world.translation - at).length * 24 / time_scale for piece, at in zip(broken, first)]
    print(f"CHAIN pieces {len(broken)}\nCHAIN metres_per_second {sum(speeds) / len(speeds):.2f}")
    scene.frame_set(1)


# ---- gas


def bake_gas(pane, walls):
    side = 6.4
    bpy.ops.mesh.primitive_cube_add(size=side, location=z_up(0, side / 2, 0.3))
    box = bpy.context.object
    modifier = box.modifiers.new("gas", "FLUID")
    modifier.fluid_type = "DOMAIN"
    domain = modifier.domain_settings
    domain.domain_type, domain.resolution_max = "GAS", cells
    domain.use_adaptive_domain = domain.use_noise = domain.use_dissolve_smoke = False
    domain.use_collision_border_bottom = True
    domain.vorticity, domain.time_scale = 0.2, time_scale
    domain.burning_rate, domain.flame_smoke, domain.flame_max_temp = 0.9, 1, 2.2
    domain.effector_weights.force = 0
    domain.cache_directory, domain.cache_type = os.path.join(out, "cache"), "ALL"
    domain.cache_frame_start, domain.cache_frame_end = 1, frames
    box.data.materials.append(material("fire", fire, "Volume"))
    for item in (*walls, pane):
        item.modifiers.new("gas", "FLUID").fluid_type = "EFFECTOR"
    keyed(pane.modifiers["gas"].effector_settings, "use_effector", ((1, True), (burst, False)))
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.48, location=z_up(*charge))
    ball = bpy.context.object
    ball.hide_render = True
    modifier = ball.modifiers.new("charge", "FLUID")
    modifier.fluid_type = "FLOW"
    flow = modifier.flow_settings
    flow.flow_type, flow.flow_behavior = "BOTH", "INFLOW"
    flow.fuel_amount, flow.temperature, flow.density = 2, 2.5, 0.6
    flow.use_initial_velocity, flow.velocity_normal = True, 6
    flow.velocity_coord = z_up(0, 0.5, 8)
    keyed(flow, "use_inflow", ((1, True), (fuelled, False)))
    select([box])
    for _ in range(3):  # the first updates of a new domain raise
        with contextlib.suppress(SystemError):
            bpy.context.view_layer.update()
    bpy.ops.fluid.bake_all()


# ---- light, camera, pictures


def light():
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.color, sun.angle = math.pi, (0.65, 0.5, 0.36), math.radians(0.53)
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = z_up(0.7, -0.6, -0.9).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.16, 0.19, 0.26, 1)


def look():
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(38)
    eye = bpy.data.objects.new("camera", camera)
    eye.location = z_up(1.3, 2.2, 7.3)
    eye.rotation_euler = (z_up(0, 1.7, 0.6) - eye.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(eye)
    scene.camera = eye


def draw():
    scene.render.engine = "CYCLES"
    cycles, render = scene.cycles, scene.render
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 12
    cycles.diffuse_bounces, cycles.volume_bounces = 2, 0
    render.resolution_x = render.resolution_y = width
    render.resolution_percentage = 100
    scene.view_settings.view_transform = "Filmic"
    render.filepath = os.path.join(out, "frame.")
    bpy.ops.render.render(animation=True)


def encode():
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", "24", "-i", os.path.join(out, "frame.%04d.png"),
                    "-c:v", "libx264", "-crf", "16", "-pix_fmt", "yuv420p", os.path.join(out, "film.mp4")], check=True)


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.frame_start, scene.frame_end, scene.render.fps = 1, frames, 24
scene.gravity = (0, 0, -9.81)
os.makedirs(out, exist_ok=True)
looks = {"brick": material("brick", painted(picture="brick.png")), "glass": material("glass", glass),
         "plaster": material("plaster", painted(picture="plaster.png")),
         "stone": material("stone", painted((0.45, 0.42, 0.38))),
         "pavement": material("pavement", painted((0.16, 0.16, 0.17)))}
with stage("set"):
    scenery = set_of_the_scene(looks)
    pane = thing("pane", pane_size, pane_place, "glass", 1, looks)
    bpy.ops.mesh.primitive_plane_add(size=1, location=z_up(0, 4.5, 11), rotation=(math.pi / 2, 0, 0))
    street = bpy.context.object
    street.scale = (18, 12, 1)
    street.visible_shadow = False
    street.data.materials.append(material("street", painted(picture="street.png", emission=2.4)))
    light()
    look()
with stage("fracture"):
    broken = break_pane(pane)
with stage("bodies"):
    throw(broken, scenery)
with stage("gas"):
    bake_gas(pane, scenery[:4])
with stage("render"):
    draw()
with stage("encode"):
    encode()
print(f"CHAIN total {time.time() - began:.3f}")
