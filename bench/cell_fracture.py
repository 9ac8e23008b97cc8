# Run by cell_fracture.sh inside Blender: breaks an OBJ with the Cell Fracture add-on, prints pieces, how many of them
# are not closed, and the seconds that breaking took.
import random
import sys
import time

import bmesh
import bpy

path, pieces = sys.argv[sys.argv.index("--") + 1:][:2]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="object_fracture_cell")
bpy.ops.wm.obj_import(filepath=path)
body = next(item for item in bpy.context.scene.objects if item.type == "MESH")
bpy.context.view_layer.objects.active = body
body.select_set(True)
random.seed(1)
start = time.time()
bpy.ops.object.add_fracture_cell_objects(
    source={"VERT_OWN"}, source_limit=int(pieces), source_noise=0.3, recursion=0, use_smooth_faces=False,
    use_sharp_edges=False, use_sharp_edges_apply=False, use_data_match=False, use_island_split=False, margin=0.0,
    use_remove_original=False, collection_name="pieces")
seconds = time.time() - start


def is_open(item):
    mesh = bmesh.new()
    mesh.from_mesh(item.data)
    result = any(len(edge.link_faces) != 2 for edge in mesh.edges)
    mesh.free()
    return result


broken = [item for item in bpy.data.objects if item.type == "MESH" and item is not body]
print("CELL_FRACTURE", len(broken), sum(map(is_open, broken)), f"{seconds:.4f}")
