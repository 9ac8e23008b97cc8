"""Films made by a farm: the same pixels as of one machine, and what fails is made up for."""

import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

import slurm_cluster

PROGRAM = os.environ["BRISANCE_BINARY"]
FRAMES = 6
SCENE = f"""
[scene]
frames = {FRAMES}
seed = 7
[gas]
cells = [16, 16, 16]
size = [1.0, 1.0, 1.0]
buoyancy = 0.01
[explosion]
charges = [{{ position = [0.5, 0.5, 0.35], radius = 0.1, particles = 300, ignited = 10 }}]
[[bodies]]
name = "pane"
shape = {{ type = "pane", width = 0.3, height = 0.4, thickness = 0.005, points = 30 }}
position = [0.5, 0.5, 0.65]
fracture = {{ pieces = 6 }}
[camera]
position = [0.5, 0.6, 2.0]
look_at = [0.5, 0.5, 0.5]
[render]
width = 96
height = 72
samples = 4
"""


def brisance(*arguments, environment=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                          env=environment or os.environ)


def killed(run, frames, seconds):
    """Kills the process that draws these frames of a run, as soon as it is there; whether one was."""
    wanted = ["render", str(run), "--frames", frames]
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for entry in pathlib.Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0") if entry.name.isdigit() else []
            except OSError:
                continue
            if words and words[0] == os.path.realpath(PROGRAM) and all(word in words for word in wanted):
                os.kill(int(entry.name), signal.SIGKILL)
                return True
        time.sleep(0.002)
    return False


class Farm(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.scene = self.folder / "film.toml"
        self.scene.write_text(SCENE)
        self.run_ = self.folder / "a run"

    def expect_pixels_of_one_machine(self, frames=FRAMES):
        alone = self.folder / "alone"
        self.assertEqual(brisance("run", self.scene, "-o", alone, "--quiet").returncode, 0)
        for frame in range(1, frames + 1):
            name = f"images/frame.{frame:04}.png"
            self.assertEqual((self.run_ / name).read_bytes(), (alone / name).read_bytes(), name)
        self.assertTrue((self.run_ / "film.mp4").exists())
        self.assertEqual(brisance("verify", self.run_).returncode, 0)


class Local(Farm):
    def farm(self, *arguments):
        return brisance("farm", self.run_, "--engine", "local", *arguments)

    def test_a_film_has_the_pixels_of_one_machine(self):
        done = self.farm("--scene", self.scene, "--chunk", "2", "--at-once", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.split()[::2][:1], ["simulate"])
        self.expect_pixels_of_one_machine()
        again = self.farm()
        self.assertEqual((again.returncode, again.stdout.strip()), (0, f"{self.run_}: nothing is missing"))

    def test_a_task_that_was_killed_is_made_up_for(self):
        farm = subprocess.Popen([PROGRAM, "farm", self.run_, "--engine", "local", "--scene", self.scene, "--chunk", "2"],
                                stdout=subprocess.DEVNULL)
        self.assertTrue(killed(self.run_, "3-4", 60))
        self.assertEqual(farm.wait(), 0)
        self.assertRegex((self.run_ / "farm" / "check.1.log").read_text(), r"missing pictures: .*submitted again, round 2")
        self.expect_pixels_of_one_machine()

    def test_what_cannot_be_made_is_given_up_and_named(self):
        self.assertEqual(brisance("simulate", self.scene, "-o", self.run_, "--quiet").returncode, 0)
        broken = self.run_ / "particles" / "particles.0005.ply"
        broken.write_bytes(broken.read_bytes()[:-1] + b"?")
        done = self.farm("--chunk", "3", "--rounds", "2")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, f"{self.run_}: missing pictures: 5-6; {self.run_}/farm has the logs\n")
        self.assertIn("given up after 2 rounds", (self.run_ / "farm" / "check.2.log").read_text())
        self.assertIn("particles.0005.ply", (self.run_ / "farm" / "render.2.log").read_text())
        self.assertFalse((self.run_ / "film.mp4").exists())

    def test_a_dry_run_writes_nothing(self):
        done = self.farm("--scene", self.scene, "--chunk", "4", "--dry-run")
        self.assertEqual(done.returncode, 0)
        self.assertFalse(self.run_.exists())
        self.assertEqual([line.split()[1] for line in done.stdout.splitlines()],
                         ["simulate", "render", "render", "farm", "encode"])
        self.assertIn(f"'{self.run_}'", done.stdout)

    def test_mistakes_are_told_in_one_line(self):
        for arguments, text in (
            (["farm", self.run_], "--engine"),
            (["farm", self.run_, "--engine", "pbs"], "--engine"),
            (["farm", self.run_, "--engine", "local"], "holds no scene.toml"),
            (["farm", self.run_, "--engine", "local", "--scene", self.folder / "none.toml"], "no such file"),
        ):
            done = brisance(*arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(text, done.stderr)


class Together(Farm):
    def test_processes_that_draw_in_one_run_at_once_lose_nothing(self):
        self.assertEqual(brisance("simulate", self.scene, "-o", self.run_, "--quiet").returncode, 0)
        parts = [("1-2",), ("3-4",), ("5-6",), ("1-6", "--skip-existing")]
        drawing = [subprocess.Popen([PROGRAM, "render", self.run_, "--quiet", "--frames", *part],
                                    stdout=subprocess.DEVNULL) for part in parts]
        self.assertEqual([process.wait() for process in drawing], [0] * len(parts))
        self.assertEqual(brisance("encode", self.run_, "--quiet").returncode, 0)
        self.expect_pixels_of_one_machine()
        record = (self.run_ / "run.json").read_text()
        self.assertIn(f'"pictures": {FRAMES}', record)

    def test_who_draws_keeps_out_who_changes_the_rest(self):
        self.assertEqual(brisance("simulate", self.scene, "-o", self.run_, "--quiet").returncode, 0)
        drawing = subprocess.Popen([PROGRAM, "render", self.run_, "--samples", "16", "--quiet"],
                                   stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        while not (self.run_ / "images" / "frame.0001.png").exists():
            self.assertIsNone(drawing.poll())
            time.sleep(0.005)
        for arguments in (["simulate", self.scene, "-o", self.run_, "--resume"], ["encode", self.run_]):
            done = brisance(*arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn("another process is working in this run", done.stderr)
        drawing.terminate()
        drawing.wait()


class Slurm(Farm):
    """A real one."""

    def setUp(self):
        super().setUp()
        if slurm_cluster.missing_programs():
            self.skipTest("not installed: " + " ".join(slurm_cluster.missing_programs()))
        self.cluster = slurm_cluster.Cluster(self.enterContext(tempfile.TemporaryDirectory()))
        self.addCleanup(self.cluster.stop)
        if not self.cluster.start():
            self.skipTest("Slurm does not start here")

    def test_a_film_with_a_task_killed_has_the_pixels_of_one_machine(self):
        done = brisance("farm", self.run_, "--engine", "slurm", "--scene", self.scene, "--chunk", "2", "--cores", "1",
                        "--partition", "main", environment=self.cluster.environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"simulate +\d+\nrender +\d+, 3 tasks\ncheck +\d+\nencode +\d+\n")
        self.assertTrue(killed(self.run_, "3-4", 60))
        film = self.run_ / "film.mp4"
        ended = self.cluster.wait_until(
            lambda: film.exists() and not self.cluster.ask("squeue", "--noheader"), 90)
        self.assertTrue(ended, self.logs() + self.cluster.ask("squeue"))
        self.assertRegex((self.run_ / "farm" / "check.1.log").read_text(), r"missing pictures: (3-)?4; submitted again")
        self.assertTrue((self.run_ / "farm" / "render.2.sh").exists())
        self.assertFalse((self.run_ / "farm" / "encode.1.log").exists())  # was given up for the second round's
        self.expect_pixels_of_one_machine()

    @unittest.skipUnless(os.environ.get("BRISANCE_LONG_TESTS"), "takes minutes: BRISANCE_LONG_TESTS=1")
    def test_the_window_film_with_a_task_killed_has_the_pixels_of_one_machine(self):
        self.scene = pathlib.Path(__file__).parents[2] / "scenes" / "window.toml"
        frames = int(re.search(r"^frames = (\d+)$", self.scene.read_text(), re.MULTILINE)[1])
        done = brisance("farm", self.run_, "--engine", "slurm", "--scene", self.scene, "--chunk", "10",
                        "--partition", "main", environment=self.cluster.environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(killed(self.run_, "31-40", 1200))
        film = self.run_ / "film.mp4"
        ended = self.cluster.wait_until(
            lambda: film.exists() and not self.cluster.ask("squeue", "--noheader"), 1800)
        self.assertTrue(ended, self.logs() + self.cluster.ask("squeue"))
        self.assertRegex((self.run_ / "farm" / "check.1.log").read_text(), r"missing pictures: .*; submitted again")
        self.expect_pixels_of_one_machine(frames)

    def logs(self):
        return "".join(f"{log.name}: {log.read_text()}\n" for log in sorted((self.run_ / "farm").glob("*.log")))


if __name__ == "__main__":
    unittest.main()
