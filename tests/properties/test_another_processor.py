"""On a processor without fused multiplication a sine differs in its last bit, and no drawing does.

IDENTICAL  every byte of the SVG. Numbers are rounded once, to a grid that is far coarser than such differences; from
           there on they are integers.

The C library has its functions twice, with and without fused multiplication, and NumPy its loops; environment variables
say which may be used.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

DATA = Path(__file__).parents[1] / "data"
MODELS = (
    "brep/rounded.brep",
    "freecad/torus_sphere.brep",
    "as1-oc-214.stp",
    "M6-1x12-countersunk-screw.step",
    "nist_ctc_01_asme1_ap242-e1.stp",
    "cube_gears.3mf",
    "soup.stl",
)

OLDER = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F",
    "NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL AVX2 FMA3",
}
"""What an x86 processor of 2010 lacks."""

PROGRAM = """
import hashlib, math, sys, warnings
import hlr
warnings.simplefilter("ignore")
print("sines", hashlib.sha256(repr([math.sin(0.001 * i) for i in range(100000)]).encode()).hexdigest())
for name in sys.argv[1:]:
    for view in ("iso", (3, -1, 2)):
        for lens in (None, hlr.Perspective()):
            drawing = hlr.draw(name, view, hidden=True, perspective=lens)
            assert len(drawing.lines) > 0, name
            written = drawing.to_svg().encode()
            print(name, view, lens is None, hashlib.sha256(written).hexdigest())
"""


def drawn(tmp_path, **variables):
    """What the program prints, line by line."""
    command = [sys.executable, "-P", "-W", "ignore", "-c", PROGRAM, *(str(DATA / name) for name in MODELS)]
    environment = os.environ | {"HLR_CACHE": "off"} | variables
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, text=True, timeout=300, check=True
    )
    return done.stdout.splitlines()


@pytest.mark.slow
def test_the_same_bytes(tmp_path):
    here, there = drawn(tmp_path), drawn(tmp_path, **OLDER)
    if here[0] == there[0]:
        pytest.skip("this processor and its C library have one way to compute a sine")
    assert len(here) == 1 + 4 * len(MODELS)
    assert here[1:] == there[1:]
