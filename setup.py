# SPDX-License-Identifier: BSD-3-Clause
"""The compiled module of the Python package by CMake, for the Python that runs this; settings in pyproject.toml."""
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
PACKAGE = "tools/bindings/seaglint"
DATA = {"assets": "assets", "scenarios": "scenarios", "tests/reference/rcs": "reference/rcs"}


class CMakeBuild(build_ext):
    """Builds the module and the network's library, and puts them beside the package's sources, with the data."""

    def build_extension(self, extension):
        tree = pathlib.Path(self.build_temp).resolve()
        subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", tree, "--target", "seaglint_python", "seaglint_layers"], check=True)
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        package.mkdir(parents=True, exist_ok=True)
        for library in [*(tree / "python/seaglint").glob("_core*.so"), tree / "libseaglint_layers.so"]:
            shutil.copy2(library, package)
        for source, target in DATA.items():
            shutil.copytree(ROOT / source, package / "share/seaglint" / target, dirs_exist_ok=True, ignore=shutil.ignore_patterns("pictures"))


setup(version=re.search(r"project\(seaglint VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1),
      packages=["seaglint"], package_dir={"seaglint": PACKAGE}, package_data={"seaglint": ["py.typed", "*.pyi"]},
      ext_modules=[Extension("seaglint._core", [])], cmdclass={"build_ext": CMakeBuild})
