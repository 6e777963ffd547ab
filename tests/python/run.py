# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of the Python package: run.py BUILD SOURCE. Exit code 77: a package of Debian is missing."""
import os
import pathlib
import sys


def main(build, source):
    try:
        import h5py, numpy, pytest  # noqa: E401, F401
    except ImportError as error:
        print(f"skipped: {error} (packages python3-h5py, python3-numpy, python3-pytest)")
        return 77
    os.environ.update(PYTHONPATH=str(build / "python"), SEAGLINT=str(build / "seaglint"), EXAMPLES=str(source / "tools/bindings/examples"), PYTHONDONTWRITEBYTECODE="1")
    sys.path.insert(0, str(build / "python"))
    return pytest.main(["-q", "-p", "no:cacheprovider", "-W", "error::seaglint.SeaglintWarning", str(source / "tests/python")])


if __name__ == "__main__":  # workers that are spawned import this file
    sys.exit(main(*(pathlib.Path(p).resolve() for p in sys.argv[1:3])))
