"""docs/tutorial.md: every command in it is run, in its order, with the files that it says to save."""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["BRISANCE_BINARY"])
BUILD = PROGRAM.parent.parent
SOURCE = pathlib.Path(os.environ["BRISANCE_SOURCE_DIR"])
TEXT = (SOURCE / "docs/tutorial.md").read_text()
BLOCK = re.compile(r"^```(\w*)(?: title=\"(.+?)\")?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
INSTALLING = "Get it"  # downloads packages and builds: a matter of minutes


def blocks():
    """(heading, language, file, text) of every block."""
    for section in TEXT.split("\n## ")[1:]:
        heading, rest = section.split("\n", 1)
        for language, file, text in BLOCK.findall(rest):
            yield heading, language, file, text


# The player serves until Ctrl-C, which comes after three seconds.
PRELUDE = f"""set -euo pipefail
brisance() {{
  if [[ $1 != view ]]; then command brisance "$@"; return; fi
  local code=0
  timeout --preserve-status --signal=INT 3 brisance "$@" || code=$?
  [[ $code == 130 ]]
}}
python3() {{ {shlex.quote(sys.executable)} "$@"; }}
"""


class Tutorial(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="brisance_tutorial.")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def follow(self, chosen, environment):
        script = PRELUDE
        for heading, language, file, text in blocks():
            if not chosen(heading):
                continue
            if file:
                (self.folder / file).write_text(text)
            elif language == "sh":
                script += text
        return subprocess.run(["bash", "-c", script], cwd=self.folder, env={**os.environ, **environment},
                              capture_output=True, text=True, check=False)

    def test_every_block_is_a_command_or_a_file_to_save(self):
        for heading, language, file, text in blocks():
            self.assertTrue(language == "sh" or file, f"{heading}: {text}")
            if language == "sh":
                for line in text.splitlines():
                    self.assertRegex(line, r"^(brisance |PYTHONPATH=|git |cd |\./dev )", heading)

    def test_it_can_be_followed(self):
        if not (BUILD / "share/brisance/player.html").exists():
            self.skipTest("no player was built: it needs Node.js and npm")
        checkout = self.folder / "checkout"
        (checkout / "build").mkdir(parents=True)
        (checkout / "build/release").symlink_to(BUILD)
        told = self.follow(lambda heading: heading != INSTALLING,
                           {"PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "BRISANCE": str(checkout)})
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        self.assertRegex(told.stdout, r"http://127\.0\.0\.1:\d+/")
        self.assertRegex(told.stdout, r"frame 12: \d+ K, fastest piece \d+\.\d m/s")
        for file in ("runs/plate/film.mp4", "runs/more-pieces/images/frame.0012.png", "pieces.png", "more-pieces.png",
                     "runs/more-fire/images/frame.0012.png", "plate.glb", "plate-gas", "plate.html",
                     "runs/farmed/film.mp4", "watched.png"):
            self.assertTrue((self.folder / file).exists(), file)
        self.assertFalse((self.folder / "runs/on-slurm").exists())
        self.assertEqual(len(list((self.folder / "runs/plate/images").glob("*.png"))), 24)

    @unittest.skipUnless(os.environ.get("BRISANCE_LONG_TESTS"), "minutes: BRISANCE_LONG_TESTS is not set")
    def test_a_clone_can_be_set_up_and_makes_the_demo(self):
        told = self.follow(lambda heading: heading == INSTALLING,
                           {"ADDRESS": str(SOURCE), "PREFIX": str(self.folder / "prefix")})
        self.assertEqual(told.returncode, 0, told.stdout[-4000:] + told.stderr[-4000:])
        self.assertTrue((self.folder / "brisance/runs/window/film.mp4").exists())
        self.assertTrue((self.folder / "prefix/bin/brisance").exists())


if __name__ == "__main__":
    unittest.main()
