"""Lets CMake build the package `brisance` where setuptools wants it; all else stands in pyproject.toml."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """The whole package is one target: the extension and what lies beside it."""

    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        options = [
            "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_CXX_FLAGS_RELEASE=-O3",  # as the preset `release`: the same code, which ccache may have
            "-DBRISANCE_TESTS=OFF",
            f"-DPython_EXECUTABLE={sys.executable}",
        ]
        if shutil.which("ninja"):
            options.append("-GNinja")
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, *options], check=True)
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "brisance_python", "-j", jobs], check=True)
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        shutil.copytree(build / "python" / "brisance", package, dirs_exist_ok=True)


VERSION = re.search(r"project\(brisance VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]

setup(
    version=VERSION,
    packages=[],
    ext_modules=[Extension("brisance._brisance", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)
