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


def ball(rings):
    """A closed ball of about 4 rings^2 triangles: vertices and triangles."""
    around = 2 * rings
    polar, turn = np.meshgrid(np.pi * np.arange(1, rings) / rings, np.pi * np.arange(around) / rings, indexing="ij")
    wide = np.sin(polar)
    points = np.stack([wide * np.cos(turn), np.cos(polar), wide * np.sin(turn)], axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(rings - 1, around)
    after = np.roll(number, -1, axis=1)
    bands = [np.stack([number[:-1], after[:-1], number[1:]], -1), np.stack([after[:-1], after[1:], number[1:]], -1)]
    north, south = len(points), len(points) + 1
    caps = [
        np.stack([np.full(around, north), after[0], number[0]], -1),
        np.stack([np.full(around, south), number[-1], after[-1]], -1),
    ]
    triangles = np.concatenate([part.reshape(-1, 3) for part in bands + caps])
    return np.concatenate([points, [[0, 1, 0], [0, -1, 0]]]), triangles


def program(*arguments):
    """Runs the program: exit code, and what it says on standard error without its progress."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.strip()
