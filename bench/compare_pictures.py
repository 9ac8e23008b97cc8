# Run by cycles.sh inside Blender: of pairs of OpenEXR pictures that differ by their seeds alone, the noise of one
# (RMSE), the mean, and the noise over the mean; then each first picture as PNG.
# usage: ... -- A1.exr A2.exr B1.exr B2.exr ...
import sys

import bpy
import numpy

numpy.bool = bool
files = sys.argv[sys.argv.index("--") + 1:]


def pixels(file):
    image = bpy.data.images.load(file)
    image.colorspace_settings.name = "Linear"
    values = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


for first, second in zip(files[::2], files[1::2]):
    a, b = pixels(first), pixels(second)
    noise = float(numpy.sqrt(((a - b)[..., :3] ** 2).mean() / 2))
    mean = float(((a + b)[..., :3] / 2).mean())
    # Light beyond white is cut, since no display shows how far beyond it is.
    shown = float(numpy.sqrt(((a.clip(0, 1) - b.clip(0, 1))[..., :3] ** 2).mean() / 2))
    print(f"NOISE {first} {noise:.5f} {mean:.5f} {shown:.5f}", flush=True)
    picture = bpy.data.images.new("picture", a.shape[1], a.shape[0])
    a[..., :3] = numpy.where(a[..., :3] < 0.0031308, 12.92 * a[..., :3], 1.055 * a[..., :3].clip(0, 1) ** (1 / 2.4) - 0.055)
    a[..., 3] = 1
    picture.pixels.foreach_set(a.clip(0, 1).ravel())
    picture.filepath_raw, picture.file_format = first.replace(".exr", ".png"), "PNG"
    picture.save()
