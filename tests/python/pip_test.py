"""pip install ., with Debian's pip and setuptools and no index of packages. It builds the module: minutes."""

import os
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import unittest

SOURCE = pathlib.Path(os.environ["BRISANCE_SOURCE_DIR"])


@unittest.skipUnless(os.environ.get("BRISANCE_LONG_TESTS"), "minutes: BRISANCE_LONG_TESTS is not set")
class PipInstall(unittest.TestCase):
    def test_the_installed_module_steps_a_world(self):
        with tempfile.TemporaryDirectory(prefix="brisance_pip.") as prefix:
            options = ["--no-build-isolation", "--no-deps", "--no-index", "--prefix", prefix]
            told = subprocess.run([sys.executable, "-m", "pip", "install", *options, SOURCE], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(told.returncode, 0, told.stdout[-4000:] + told.stderr[-4000:])
            package, = pathlib.Path(prefix).glob("**/brisance/__init__.py")
            program = textwrap.dedent("""
                import brisance
                world = brisance.World(brisance.Scene({
                    "gas": {"resolution": 8}, "camera": {"position": [0, 1, 4], "look_at": [0, 0, 0]}}))
                world.step()
                print(brisance.__file__, world.frame)
                """)
            ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=prefix,
                                 env={**os.environ, "PYTHONPATH": str(package.parent.parent)})
            self.assertEqual(ran.stdout, f"{package} 2\n")


if __name__ == "__main__":
    unittest.main()
