"""Fracture, burn, simulate and draw explosions: scenes, worlds, frames and pictures.

SI units, y up, right-handed. Arrays are NumPy's; those called views share memory with the program and cannot be written.
Trouble is raised as Error or one of its kinds, with the text that the program `brisance` prints.
"""

from brisance._brisance import *
from brisance._brisance import __version__

__all__ = [
    "Bodies", "DamagedFileError", "Error", "Fracture", "Frame", "FrameBody", "Gas", "Mesh", "NoRoomError", "Particles",
    "Piece", "Run", "Scene", "SceneError", "UnstableError", "World", "__version__", "develop", "fracture",
    "limit_threads", "render", "save",
]

for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name
