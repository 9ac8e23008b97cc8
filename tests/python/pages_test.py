"""docs/python-reference.md is what the module says of itself."""

import os
import pathlib
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["BRISANCE_SOURCE_DIR"])


class ReferencePage(unittest.TestCase):
    def test_it_is_the_generated_one(self):
        program = SOURCE / "apps/python/pages/python_reference.py"
        told = subprocess.run([sys.executable, program], capture_output=True, text=True, check=True)
        page = (SOURCE / "docs/python-reference.md").read_text()
        self.assertEqual(page, told.stdout, "./dev docs writes it anew")
        self.assertNotRegex(page, r"`  \n  \n", "a name without a docstring")


if __name__ == "__main__":
    unittest.main()
