"""An installed FreeCAD, run without its user interface."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

COMMAND = next((found for name in ("freecadcmd", "FreeCADCmd") if (found := shutil.which(name))), None)

needs_freecad = pytest.mark.skipif(COMMAND is None, reason="needs FreeCAD: freecadcmd is not installed")


def run(script: Path, **environment: str) -> str:
    """Run a script inside FreeCAD; returns what it printed."""
    # FreeCAD brings a Python of its own, which an environment of this one would mislead.
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("VIRTUAL_ENV", "PYTHON"))}
    command = [str(COMMAND), str(script)]
    done = subprocess.run(
        command, env={**inherited, **environment}, capture_output=True, text=True, timeout=120, check=False
    )
    return done.stdout + done.stderr


def python_of_freecad(folder: Path) -> str:
    """The version of the Python that FreeCAD runs."""
    script = folder / "version.py"
    script.write_text("import sys\nprint('python', *sys.version_info[:2])\n")
    said = run(script)
    return next((line for line in said.splitlines() if line.startswith("python ")), said)
