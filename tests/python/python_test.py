"""The Python module, as its users meet it."""

import gc
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest

import brisance
import numpy as np
from small import SMALL_TOML, SOURCE, cube, program, small_tables


def address(array):
    return array.__array_interface__["data"][0]


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path


class Readme(Scratch):
    def test_its_ten_lines_run(self):
        text = pathlib.Path(SOURCE, "README.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertEqual(len(blocks), 1)
        self.assertLessEqual(len(blocks[0].splitlines()), 10)
        for folder in ("scenes", "assets"):
            (self.folder / folder).symlink_to(pathlib.Path(SOURCE, folder))
        script = self.file("example.py", blocks[0])
        out = subprocess.run([sys.executable, script], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertRegex(out.stdout, r"frame \d+: \d+ K")
        pictures = list(self.folder.glob("*.png"))
        self.assertEqual(len(pictures), 1)
        self.assertEqual(pictures[0].read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


class Scenes(Scratch):
    def test_tables_and_file_are_the_same_scene(self):
        file = brisance.Scene.load(self.file("small.toml", SMALL_TOML))
        self.assertEqual(brisance.Scene(small_tables()).toml(), file.toml())

    def test_arrays_tuples_and_numbers_of_numpy_are_taken(self):
        tables = small_tables()
        tables["gas"]["cells"] = np.array([16, 16, 16])
        tables["gas"]["size"] = (1.0, np.float64(1), 1)
        tables["scene"]["frames"] = np.int32(3)
        self.assertEqual(brisance.Scene(tables).toml(), brisance.Scene(small_tables()).toml())

    def test_overrides_are_those_of_the_program(self):
        scene = brisance.Scene(small_tables(), ["scene.frames=5"]).with_overrides(["render.width=20"])
        self.assertEqual((scene.frames, scene.picture_size), (5, (20, 36)))

    def test_what_no_scene_can_hold_is_refused_by_its_key(self):
        tables = small_tables()
        tables["gas"]["cells"] = [16, None, 16]
        with self.assertRaisesRegex(brisance.SceneError, r"scene: gas\.cells\.1: must be a number.*NoneType"):
            brisance.Scene(tables)
        endless = {}
        endless["scene"] = endless
        with self.assertRaisesRegex(brisance.SceneError, "must nest less deeply"):
            brisance.Scene(endless)


class Errors(Scratch):
    """The text of an exception is the line that the program prints, its exit_code the program's."""

    def expect_same(self, kind, raiser, *arguments):
        with self.assertRaises(kind) as caught:
            raiser()
        self.assertIsInstance(caught.exception, brisance.Error)
        code, line = program(*arguments)
        # the program may go on to say what becomes of its run
        self.assertEqual(str(caught.exception), line.split("; there is no checkpoint")[0])
        self.assertEqual(caught.exception.exit_code, code)

    def test_of_a_scene(self):
        for wrong in ("buoyancy = -1", "bouyancy = 1", "force = [1, 2]", "density = 'x'", "faces = 3", "what ="):
            path = self.file("wrong.toml", SMALL_TOML.replace("buoyancy = 0.01", wrong))
            self.expect_same(brisance.SceneError, lambda: brisance.Scene.load(path), "check", path)
        missing = self.folder / "missing.toml"
        self.expect_same(brisance.SceneError, lambda: brisance.Scene.load(missing), "check", missing)

    def test_of_tables_but_for_the_place(self):
        tables = small_tables()
        tables["gas"]["buoyancy"] = -1
        path = self.file("wrong.toml", SMALL_TOML.replace("buoyancy = 0.01", "buoyancy = -1"))
        with self.assertRaises(brisance.SceneError) as caught:
            brisance.Scene(tables)
        _, line = program("check", path)
        self.assertEqual(str(caught.exception), re.sub(r"^.*?wrong\.toml:\d+", "scene", line))

    def test_of_a_damaged_file(self):
        mesh = self.file("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n")
        self.expect_same(brisance.DamagedFileError, lambda: brisance.Mesh.load(mesh), "info", mesh)

    def test_of_too_little_room(self):
        path = self.file("vast.toml", SMALL_TOML.replace("[16, 16, 16]", "[4096, 4096, 4096]"))
        self.expect_same(brisance.NoRoomError, lambda: brisance.Scene.load(path), "check", path)

    def test_of_an_unstable_simulation(self):
        path = self.file("fast.toml", SMALL_TOML.replace("[gas]", "[gas]\nmax_substeps = 1\ncourant = 0.01"))
        world = brisance.World(brisance.Scene.load(path))
        self.expect_same(brisance.UnstableError, world.run, "simulate", path, "-o", self.folder / "run", "--quiet")

    def test_of_no_run(self):
        with self.assertRaisesRegex(brisance.SceneError, "nowhere"):
            brisance.Run(self.folder / "nowhere")


class Arrays(unittest.TestCase):
    def setUp(self):
        self.world = brisance.World(brisance.Scene(small_tables()))

    def all_views(self):
        gas, bodies, particles = self.world.gas, self.world.bodies, self.world.particles
        return [
            *(getattr(gas, name) for name in "temperature soot flame pressure divergence heat_rate u v w".split()),
            *(getattr(bodies, n) for n in "position orientation linear_velocity angular_velocity inverse_mass".split()),
            *(getattr(particles, n) for n in "id position velocity mass temperature kind ignited".split()),
        ]

    def test_no_byte_is_copied(self):
        first, again = self.all_views(), self.all_views()
        for a, b in zip(first, again):
            self.assertGreater(a.size, 0)
            self.assertEqual(address(a), address(b))
            self.assertFalse(a.flags.owndata)
            self.assertFalse(a.flags.writeable)
        self.assertEqual(len({address(a) for a in first}), len(first))

    def test_a_view_keeps_its_moment_and_the_next_shows_the_next(self):
        before = [(view, view.copy(), address(view)) for view in self.all_views()]
        self.world.step()
        for view, copy, place in before:
            self.assertEqual(address(view), place)
            np.testing.assert_array_equal(view, copy)
        changed = [not np.array_equal(a, b[1]) for a, b in zip(self.all_views(), before)]
        self.assertTrue(changed[0], "temperature")
        self.assertTrue(changed[6], "u")

    def test_who_looks_changes_nothing(self):
        unseen = brisance.World(brisance.Scene(small_tables()))
        for _ in range(2):
            views = self.all_views()
            self.world.step()
            unseen.step()
            del views
        looked_at, self.world = self.all_views(), unseen
        for a, b in zip(looked_at, self.all_views()):
            np.testing.assert_array_equal(a, b)

    def test_a_view_outlives_its_world(self):
        view = self.world.gas.temperature
        copy = view.copy()
        del self.world
        gc.collect()
        np.testing.assert_array_equal(view, copy)

    def test_shapes_axes_and_units(self):
        gas, bodies, particles = self.world.gas, self.world.bodies, self.world.particles
        self.assertEqual(gas.temperature.shape, (16, 16, 16))
        self.assertEqual((gas.u.shape, gas.v.shape, gas.w.shape), ((17, 16, 16), (16, 17, 16), (16, 16, 17)))
        self.assertEqual(gas.temperature.strides, (4, 64, 1024))
        self.assertEqual((gas.cells, gas.cell_size, gas.corner), ((16, 16, 16), 1 / 16, (0, 0, 0)))
        self.assertEqual(len(bodies), 6)
        self.assertEqual((bodies.position.shape, bodies.orientation.shape), ((6, 3), (6, 4)))
        self.assertEqual(bodies.names[0], "pane.001")
        np.testing.assert_array_equal(bodies.orientation, np.tile([1.0, 0, 0, 0], (6, 1)))
        self.assertEqual(particles.position.shape, (len(particles), 3))
        self.assertLess(np.linalg.norm(particles.position - [0.5, 0.5, 0.35], axis=1).max(), 0.1001)
        self.world.run()
        temperature = self.world.gas.temperature
        hot = (np.array(np.unravel_index(temperature.argmax(), temperature.shape)) + 0.5) / 16
        self.assertLess(np.linalg.norm(hot - [0.5, 0.5, 0.35]), 0.3)  # where the charge burns: axes are x, y, z


class Stepping(unittest.TestCase):
    def test_the_callback_sees_every_frame_and_may_stop(self):
        world = brisance.World(brisance.Scene(small_tables(frames=4)))
        seen = []
        world.run(lambda w: seen.append(w.frame))
        self.assertEqual(seen, [2, 3, 4])
        self.assertGreater(world.report["substeps"], 0)
        other = brisance.World(brisance.Scene(small_tables(frames=4)))
        other.run(lambda w: w.frame < 3)
        self.assertEqual(other.frame, 3)

    def test_what_a_callback_raises_arrives(self):
        world = brisance.World(brisance.Scene(small_tables()))
        with self.assertRaises(ZeroDivisionError):
            world.run(lambda w: 1 / 0)
        world.run()
        self.assertEqual(world.frame, 3)

    def test_other_threads_run_meanwhile_and_must_wait_for_the_world(self):
        world = brisance.World(brisance.Scene(small_tables(), ["gas.cells=[48, 48, 48]", "gas.courant=0.1"]))
        counts, refused, done = [0], [], threading.Event()

        def count():
            while not done.is_set():
                counts[0] += 1
                try:
                    world.gas.temperature
                except brisance.Error as error:
                    refused.append(str(error))

        other = threading.Thread(target=count)
        other.start()
        before = counts[0]
        world.step()
        during = counts[0] - before
        done.set()
        other.join()
        self.assertGreater(during, 100)
        self.assertIn("world: another thread works in it; look at it between two steps", refused)


class Interrupting(unittest.TestCase):
    """Ctrl-C, as a terminal sends it."""

    def interrupted(self, make, work):
        """What a program says that is interrupted in its work."""
        script = textwrap.dedent(
            """
            import sys, numpy as np, brisance
            from small import ball, small_tables
            def world(*overrides):
                return brisance.World(brisance.Scene(small_tables(), list(overrides)))
            {}
            print("begun", flush=True)
            try:
                {}
                print("came to its end")
            except KeyboardInterrupt:
                print("interrupted")
            """
        ).format(make, work)
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "begun\n")
            time.sleep(0.3)
            child.send_signal(signal.SIGINT)
            return child.stdout.read().split("\n")[0]

    def test_a_step_of_very_many_sub_steps(self):
        make = 'w = world("gas.max_substeps=1000000", "gas.courant=0.01", "scene.fps=1", "gas.cells=[64, 64, 64]")'
        self.assertEqual(self.interrupted(make, "w.step()"), "interrupted")

    def test_a_step_within_a_sub_step(self):
        # Nothing looks between sub-steps: where this ends is within one of a fine gas.
        make = 'w = world("gas.cells=[160, 160, 160]", "scene.frames=9999")'
        self.assertEqual(self.interrupted(make, "w.run()"), "interrupted")

    def test_the_making_of_a_world(self):
        self.assertEqual(self.interrupted("", "while True: world('gas.cells=[160, 160, 160]')"), "interrupted")

    def test_a_picture(self):
        make = 'w = world("render.samples=64", "render.width=2000", "render.height=2000")'
        self.assertEqual(self.interrupted(make, "w.render()"), "interrupted")

    def test_a_fracture(self):
        # 1.4 million triangles: minutes of work.
        make = "b = brisance.Mesh(*ball(600))"
        self.assertEqual(self.interrupted(make, "brisance.fracture(b, pieces=2000, method='curvature')"), "interrupted")

    def test_a_world_that_was_cut_is_what_it_was(self):
        """Wherever it is cut: the number of frames that go by before is all that load changes."""
        overrides = ["gas.cells=[40, 40, 40]", "gas.courant=0.1", "gas.max_substeps=100000"]
        world, undisturbed = (brisance.World(brisance.Scene(small_tables(), overrides)) for _ in range(2))
        alarm = signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(InterruptedError("alarm")))
        cuts = 0
        try:
            for delay in np.linspace(0.02, 0.2, 8):
                signal.setitimer(signal.ITIMER_REAL, delay)
                with self.assertRaises(InterruptedError):
                    while True:
                        before = (world.frame, world.time, world.gas.temperature)
                        world.step()
                if world.frame == before[0]:  # else it came to its end with the signal
                    cuts += 1
                    self.assertEqual(world.time, before[1])
                    np.testing.assert_array_equal(world.gas.temperature, before[2])
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, alarm)
        self.assertGreater(cuts, 0)
        world.step()
        while undisturbed.frame < world.frame:
            undisturbed.step()
        np.testing.assert_array_equal(world.gas.temperature, undisturbed.gas.temperature)
        np.testing.assert_array_equal(world.gas.u, undisturbed.gas.u)
        np.testing.assert_array_equal(world.particles.position, undisturbed.particles.position)
        np.testing.assert_array_equal(world.bodies.position, undisturbed.bodies.position)


class Meshes(Scratch):
    def test_an_array_is_broken_into_solids_that_fill_it(self):
        vertices, triangles = cube()
        for kind in (np.float64, np.float32):
            mesh = brisance.Mesh(vertices.astype(kind), triangles.astype(np.int32))
            broken = brisance.fracture(mesh, pieces=8, method="voronoi", solid=True)
            self.assertEqual(len(broken.pieces), 8)
            self.assertAlmostEqual(sum(piece.volume for piece in broken.pieces), 1, 9)
            self.assertEqual(broken.bonds.shape, (len(broken.bond_areas), 2))
            for piece in broken.pieces:
                self.assertLess(np.abs(piece.mesh.vertices + piece.place).max(), 0.5 + 1e-9)

    def test_labels_of_a_cut_along_the_triangles(self):
        broken = brisance.fracture(brisance.Mesh(*cube()), pieces=3)
        self.assertEqual(sorted(set(broken.piece_of_triangle)), [0, 1, 2])

    def test_it_stands_in_a_scene_and_is_seen(self):
        tables = small_tables()
        del tables["explosion"]
        shape = {"type": "mesh", "file": brisance.Mesh(*cube()), "scale": 0.5}
        tables["bodies"] = [{"name": "cube", "shape": shape, "position": [0.5, 0.5, 0.5], "mass": 1.0,
                             "fracture": {"pieces": 5, "method": "voronoi", "solid": True}}]
        scene = brisance.Scene(tables)
        world = brisance.World(scene)
        self.assertEqual(len(world.bodies), 5)
        picture = world.render(alpha=True)
        self.assertEqual((picture.shape, picture.dtype), ((36, 48, 4), np.float32))
        self.assertEqual(picture[18, 24, 3], 1)  # the cube before the camera
        self.assertEqual(picture[0, 0, 3], 0)  # nothing in the corner
        self.assertGreater(picture[18, 24, :3].max(), 0)
        np.testing.assert_array_equal(picture[..., :3], world.render())
        with self.assertRaisesRegex(brisance.SceneError, "Mesh.save"):
            scene.toml()

    def test_arrays_that_are_no_mesh_are_refused(self):
        vertices, triangles = cube()
        for bad_vertices, bad_triangles, text in (
            (vertices, triangles + 8, r"mesh: triangles: row 0: must be numbers of vertices from 0 to 7, got 8"),
            (vertices[:, :2], triangles, r"mesh: vertices: must be an array of shape \(n, 3\), got \(8, 2\)"),
            (vertices * np.nan, triangles, r"mesh: vertices: row 0: must be finite"),
            (vertices, triangles * 0.5, r"mesh: triangles: must be whole numbers"),
            (vertices, triangles[:0], r"mesh: triangles: must be at least one"),
        ):
            with self.assertRaisesRegex(brisance.SceneError, text):
                brisance.Mesh(bad_vertices, bad_triangles)
        with self.assertRaisesRegex(brisance.SceneError, r"bodies\.mesh\.fracture\.peices: unknown key; did you mean"):
            brisance.fracture(brisance.Mesh(vertices, triangles), peices=3)

    def test_a_saved_mesh_is_the_same(self):
        mesh = brisance.Mesh(*cube())
        mesh.save(self.folder / "cube.obj")
        np.testing.assert_array_equal(brisance.Mesh.load(self.folder / "cube.obj").vertices, mesh.vertices)


class Pictures(Scratch):
    def test_world_run_and_program_agree(self):
        path, run = self.file("small.toml", SMALL_TOML), self.folder / "run"
        self.assertEqual(program("simulate", path, "-o", run, "--quiet")[0], 0)
        self.assertEqual(program("render", run, "--frames", "3", "--quiet")[0], 0)
        world = brisance.World(brisance.Scene.load(path))
        world.run()
        held = brisance.Run(run)
        self.assertEqual(held.last_frame, 3)
        frame = held.frame(3)
        self.assertEqual((frame.index, world.frame), (3, 3))
        np.testing.assert_array_equal([body.position for body in frame.bodies], world.bodies.position)
        self.assertEqual([body.name for body in frame.bodies], world.bodies.names)
        captured = world.capture()
        np.testing.assert_array_equal(frame.particle_position, captured.particle_position)
        np.testing.assert_array_equal(frame.temperature, captured.temperature)
        self.assertEqual(frame.velocity.shape, (16, 16, 16, 3))
        expected = (run / "images" / "frame.0003.png").read_bytes()
        for picture in (world.render(), brisance.render(held.scene, frame)):
            brisance.save(self.folder / "ours.png", picture, held.scene.exposure_stops)
            self.assertEqual((self.folder / "ours.png").read_bytes(), expected)

    def test_developed_light_is_bytes_for_a_screen(self):
        light = np.zeros((2, 3, 3), np.float32)
        light[0, 0] = 1000
        screen = brisance.develop(light)
        self.assertEqual((screen.shape, screen.dtype), ((2, 3, 3), np.uint8))
        self.assertEqual((screen[0, 0].tolist(), screen[1, 2].tolist()), ([255, 255, 255], [0, 0, 0]))
        brisance.save(self.folder / "a.png", screen)
        brisance.save(self.folder / "b.png", light)
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        with self.assertRaisesRegex(brisance.SceneError, "must end in .png or .exr"):
            brisance.save(self.folder / "a.tiff", screen)


class Memory(unittest.TestCase):
    def test_a_thousand_worlds_leave_nothing_behind(self):
        tables = small_tables()
        vertices, triangles = cube()

        def cycle():
            tables["bodies"][0]["shape"] = {"type": "mesh", "file": brisance.Mesh(vertices, triangles), "scale": 0.2}
            tables["bodies"][0]["mass"] = 1.0
            world = brisance.World(brisance.Scene(tables))
            views = [world.gas.temperature, world.particles.position, world.bodies.position]
            if cycle.number % 20 == 0:
                world.step()
                world.render(width=16, height=12)
            cycle.number += 1
            return sum(view.nbytes for view in views)

        cycle.number = 0
        for _ in range(200):
            held = cycle()
        before = resident()
        for _ in range(1000):
            cycle()
        self.assertGreater(held, 16384)
        # A world of 16^3 cells has some 0.5 MB: 500 MB were they kept. The threads that work leave some room unused.
        self.assertLess(resident() - before, 32 << 20)


def resident():
    """[bytes]"""
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


class Stubs(unittest.TestCase):
    def test_they_say_what_the_module_has(self):
        if subprocess.run([sys.executable, "-c", "import mypy.stubtest"], capture_output=True, check=False).returncode:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            allowed = pathlib.Path(__file__).with_name("stubtest.allow")
            done = subprocess.run(
                [sys.executable, "-m", "mypy.stubtest", "brisance", "--allowlist", allowed],
                cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_every_name_has_its_docstring(self):
        for name in brisance.__all__:
            thing = getattr(brisance, name)
            if name != "__version__":
                self.assertTrue(thing.__doc__, name)


if __name__ == "__main__":
    unittest.main()
