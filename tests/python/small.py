"""Small scenes and meshes for the tests of the Python module, and the program beside it."""

import os
import subprocess

import numpy as np

SOURCE = os.environ["BRISANCE_SOURCE_DIR"]
PROGRAM = os.environ["BRISANCE_BINARY"]


def small_tables(frames=3):
    """A charge before a pane, in 16 x 16 x 16 cells, as tables of a scene."""
    return {
        "scene": {"frames": frames, "seed": 7},
        "gas": {"cells": [16, 16, 16], "size": [1.0, 1.0, 1.0], "buoyancy": 0.01},
        "explosion": {"charges": [{"position": [0.5, 0.5, 0.35], "radius": 0.1, "particles": 300, "ignited": 10}]},
        "bodies": [
            {
                "name": "pane",
                "shape": {"type": "pane", "width": 0.3, "height": 0.4, "thickness": 0.005, "points": 30},
                "position": [0.5, 0.5, 0.65],
                "fracture": {"pieces": 6},
            }
        ],
        "camera": {"position": [0.5, 0.6, 3.0], "look_at": [0.5, 0.5, 0.5]},
        "render": {"width": 48, "height": 36},
    }


SMALL_TOML = """
[scene]
frames = 3
seed = 7
[gas]
cells = [16, 16, 16]
size = [1.0, 1.0, 1.0]
buoyancy = 0.01
[explosion]
charges = [{ position = [0.5, 0.5, 0.35], radius = 0.1, particles = 300, ignited = 10 }]
[[bodies]]
name = "pane"
shape = { type = "pane", width = 0.3, height = 0.4, thickness = 0.005, points = 30 }
position = [0.5, 0.5, 0.65]
fracture = { pieces = 6 }
[camera]
position = [0.5, 0.6, 3.0]
look_at = [0.5, 0.5, 0.5]
[render]
width = 48
height = 36
"""


def cube():
    """The unit cube about the origin: vertices (8, 3) and triangles (12, 3)."""
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float) - 0.5
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    return vertices, np.array(triangles)


def program(*arguments):
    """Runs the program: exit code, and what it says on standard error without its progress."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.strip()
