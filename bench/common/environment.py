# SPDX-License-Identifier: BSD-3-Clause
"""Virtual environments below build/, each made when it is needed and when its list has changed."""

import os
import pathlib
import subprocess
import sys
import venv

COMMON = pathlib.Path(__file__).resolve().parent
RECORD = "installed.txt"


def ensure(folder, requirements):
    """Installs `requirements`, the lines of a requirements.txt, unless this very list is there.

    Returns the environment's Python.
    """
    python = folder / "bin/python"
    record = folder / RECORD
    if record.is_file() and record.read_text() == requirements:
        return python
    print(f"making {folder}", flush=True)
    venv.create(folder, with_pip=True, clear=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    wanted = requirements.split()
    if subprocess.run([*pip, *wanted]).returncode != 0:
        sys.exit(f"{folder}: {' '.join(wanted)} cannot be installed, check the connection to PyPI")
    record.write_text(requirements)
    return python


def start(scripts, folder, main="main.py"):
    """Becomes `main` of the folder `scripts`, in an environment with its requirements.txt.

    What lies beside this file can be imported there.
    """
    python = ensure(folder, (scripts / "requirements.txt").read_text())
    packages = next(folder.glob("lib/python*/site-packages"))
    (packages / "bench_common.pth").write_text(f"{COMMON}\n")
    os.execv(python, [str(python), str(scripts / main), *sys.argv[1:]])
