# Run by mantaflow.sh inside Blender: bakes a burst of burning gas in an open box with Mantaflow, cache and all. Prints
# the seconds of the bake, and the share of them that Mantaflow itself counts for reading and writing its cache.
import contextlib
import os
import re
import sys
import tempfile
import time

import bpy

resolution, frames, folder, time_scale = sys.argv[sys.argv.index("--") + 1:][:4]
side, burst = 4.0, 4  # [m] of the box, frames in which fuel comes

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, int(frames)

bpy.ops.mesh.primitive_cube_add(size=side, location=(0, 0, side / 2))
box = bpy.context.object
modifier = box.modifiers.new("box", "FLUID")
modifier.fluid_type = "DOMAIN"
domain = modifier.domain_settings
domain.domain_type = "GAS"
domain.resolution_max = int(resolution)
domain.use_adaptive_domain = False
domain.use_noise = False
domain.use_dissolve_smoke = False
domain.vorticity = 0.5
domain.time_scale = float(time_scale)
domain.cache_directory = folder
domain.cache_type = "ALL"
domain.cache_frame_start, domain.cache_frame_end = 1, int(frames)
domain.openvdb_cache_compress_type = "BLOSC"

bpy.ops.mesh.primitive_uv_sphere_add(radius=0.48, location=(0, 0, 1.4))
modifier = bpy.context.object.modifiers.new("charge", "FLUID")
modifier.fluid_type = "FLOW"
charge = modifier.flow_settings
charge.flow_type, charge.flow_behavior = "BOTH", "INFLOW"
charge.fuel_amount, charge.temperature = 2, 2
charge.use_initial_velocity, charge.velocity_normal = True, 3
for frame, given in ((1, True), (1 + burst, False)):
    charge.use_inflow = given
    charge.keyframe_insert("use_inflow", frame=frame)

for item in bpy.context.selected_objects:
    item.select_set(False)
bpy.context.view_layer.objects.active = box
box.select_set(True)
for _ in range(3):  # the first updates of a new domain raise
    with contextlib.suppress(SystemError):
        bpy.context.view_layer.update()

start = time.time()
bpy.ops.fluid.bake_all()
seconds = time.time() - start


def own_timings():
    """Mantaflow prints its mean seconds per step by function from C++: past Python's own output."""
    import manta
    sys.stdout.flush()
    with tempfile.TemporaryFile() as file:
        kept = os.dup(1)
        os.dup2(file.fileno(), 1)
        manta.Timings().display()
        sys.stdout.flush()
        os.dup2(kept, 1)
        file.seek(0)
        return file.read().decode()


shares = re.findall(r"\[ *([0-9.]+)%\] (?:save|load)\b", own_timings())
cache = sum(map(float, shares)) / 100
written = [name for name in os.listdir(os.path.join(folder, "data")) if name.startswith("fluid_data")]
print("\nMANTAFLOW", len(written), f"{seconds:.3f}", f"{cache:.4f}")
