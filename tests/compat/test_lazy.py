"""Whoever imports a drop-in loads its neighbour only by calling it."""

import subprocess
import sys

import pytest


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cadquery", "build123d", "freecad"])
def test_importing_a_drop_in_loads_no_neighbour(name):
    program = f"import sys, hlr.compat.{name}; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    loaded = {module.partition(".")[0] for module in done.stdout.split()}
    assert "hlr" in loaded
    assert not loaded & {"OCP", "cadquery", "build123d", "trimesh", "pydyf"}


def test_hlr_itself_loads_no_drop_in():
    program = "import sys, hlr; hlr.draw; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    assert not [module for module in done.stdout.split() if module.startswith("hlr.compat")]
