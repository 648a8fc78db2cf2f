# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package by CMake: the module, the two shared libraries beside it, and the data.

A build tree that is there already is used when PLOTSCAN_BUILD names it.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
VERSION = re.search(r"project\(plotscan VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


class BuildByCMake(build_ext):
    """Fills the package's folder with what the components of `cmake --install` hold."""

    def build_extension(self, extension):
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        tree = self.build_tree()
        with tempfile.TemporaryDirectory() as scratch:
            prefix = Path(scratch)
            for component in ("python", "library", "data"):
                subprocess.run(["cmake", "--install", tree, "--prefix", prefix, "--component", component],
                               check=True, stdout=subprocess.DEVNULL)  # fmt: skip
            (installed,) = prefix.glob("lib/**/plotscan/__init__.py")
            shutil.copytree(installed.parent, package, dirs_exist_ok=True)
            for library in prefix.glob("lib/**/libplotscan_*.so.*"):
                # The name that the linker asks for, as a file: wheels hold no links.
                if library.is_symlink():
                    shutil.copy(library, package / library.name)
            shutil.copytree(prefix / "share", package / "share", dirs_exist_ok=True)

    def build_tree(self):
        given = os.environ.get("PLOTSCAN_BUILD")
        tree = Path(given) if given else Path(self.build_temp).resolve()
        if not given:
            subprocess.run(["cmake", "-S", SOURCE, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DBUILD_TESTING=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)  # fmt: skip
        subprocess.run(["cmake", "--build", tree, "--target", "plotscan_python"], check=True)
        return tree


setup(
    version=VERSION,
    packages=["plotscan"],
    package_dir={"plotscan": "python/plotscan"},
    ext_modules=[Extension("plotscan._plotscan", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
