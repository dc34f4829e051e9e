"""CadQuery's own tests pass with hlr's functions in the place of CadQuery's.

HLR_CADQUERY names a folder with CadQuery's source, of the version that is installed: a checkout, or what
`pip download --no-deps --no-binary :all: cadquery` fetches, unpacked. It takes some minutes.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = os.environ.get("HLR_CADQUERY")
FILES = ("tests/test_cadquery.py", "tests/test_exporters.py")


def suite(drop_in):
    """Tests that fail, and how many drawings were made."""
    env = {**os.environ, "HLR_DROP_IN": str(int(drop_in)), "PYTHONPATH": str(Path(__file__).parents[1])}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "compat.cadquery_drop_in", "-p", "no:cacheprovider"]
    command += ["-o", "addopts=", "-rf", "--tb=no", *FILES]
    done = subprocess.run(command, capture_output=True, text=True, cwd=SOURCE, env=env, check=False)
    assert re.search(r"\d+ passed", done.stdout), done.stdout[-2000:] + done.stderr
    made = re.search(r"^drawings: (\d+)$", done.stdout, re.MULTILINE)
    return set(re.findall(r"^FAILED (\S+)", done.stdout, re.MULTILINE)), int(made[1])


@pytest.mark.skipif(SOURCE is None, reason="HLR_CADQUERY does not name a folder with CadQuery's source")
def test_what_passes_with_cadquerys_functions_passes_with_ours():
    failed, made = suite(drop_in=True)
    anyhow = suite(drop_in=False)[0] if failed else set()
    assert made >= 60 and not failed - anyhow
