#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# `pip install .` into a virtual environment (of /usr/bin/python3, or of the Python given), then the package far from
# the sources: an echo, a sample, the names of scenarios. NumPy, setuptools come from the Python's own packages.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
python=${1:-/usr/bin/python3}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$python" -m venv --system-site-packages "$place/env"
mkdir "$place/source"
tar -C "$root" --exclude=./build --exclude=./.git -cf - . | tar -C "$place/source" -xf -
"$place/env/bin/pip" install --quiet --no-deps --no-build-isolation "$place/source"
rm -rf "$place/source"
cd "$place"
"$place/env/bin/python" - <<'PYTHON'
import os
import sys

import numpy
import seaglint

assert seaglint.data_folder() == os.path.join(os.path.dirname(seaglint.__file__), "share/seaglint"), seaglint.data_folder()
echo = seaglint.rcs("assets/icosahedral_reflector.glb", 10e9, [0, 30])
assert echo.shape == (1, 1, 2, 2, 2) and numpy.abs(echo[..., 0, 0]).min() > 0
assert numpy.isfinite(seaglint.sample("points.yaml", 0).map).all()
print("seaglint", seaglint.__version__, "for Python", sys.version.split()[0])
PYTHON
