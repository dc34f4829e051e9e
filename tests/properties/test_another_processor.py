"""On a processor without fused multiplication no number of a drawing differs, down to the last bit.

IDENTICAL  every number of the JSON but times, and every byte of the SVG, the DXF and the PNG.

The C library has its functions twice, with and without fused multiplication; NumPy and its linear algebra have their
loops for each generation of processors. Environment variables say which may be used. The kernel has functions of its
own, in `hlr_exact::elementary`: those of the C library have other last bits, which a rounding to a grid hides in most
drawings, but not in all.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from numpy._core._multiarray_umath import __cpu_baseline__, __cpu_dispatch__

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
    "NPY_DISABLE_CPU_FEATURES": " ".join(set(__cpu_dispatch__) - set(__cpu_baseline__)),
    "OPENBLAS_CORETYPE": "Nehalem",
}
"""What an x86 processor of 2010 lacks."""

PROGRAM = """
import hashlib, json, math, sys, warnings
import hlr
warnings.simplefilter("ignore")
print("sines", hashlib.sha256(repr([math.sin(0.001 * i) for i in range(100000)]).encode()).hexdigest())
for name in sys.argv[1:]:
    for view in ("iso", (3, -1, 2)):
        for lens in (None, hlr.Perspective()):
            drawing = hlr.draw(name, view, hidden=True, perspective=lens)
            assert len(drawing.lines) > 0, name
            numbers = json.loads(drawing.to_json())
            del numbers["timings"]
            written = [json.dumps(numbers).encode(), drawing.to_svg().encode(), drawing.to_dxf(), drawing.to_png()]
            print(name, view, lens is None, *(hashlib.sha256(each).hexdigest() for each in written))
"""


def drawing(tmp_path, **variables):
    """The program, started."""
    command = [sys.executable, "-P", "-W", "ignore", "-c", PROGRAM, *(str(DATA / name) for name in MODELS)]
    environment = os.environ | {"HLR_CACHE": "off"} | variables
    return subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, text=True)


def drawn(process):
    """What the program has printed, line by line."""
    printed, _ = process.communicate(timeout=300)
    assert process.returncode == 0
    return printed.splitlines()


@pytest.mark.slow
def test_the_same_bytes(tmp_path):
    # Both at once: the longest of all tests is often the last one to run, with a core to spare.
    with drawing(tmp_path) as one, drawing(tmp_path, **OLDER) as other:
        try:
            here, there = drawn(one), drawn(other)
        finally:
            one.kill()
            other.kill()
    if here[0] == there[0]:
        pytest.skip("this processor and its C library have one way to compute a sine")
    assert len(here) == 1 + 4 * len(MODELS)
    assert here[1:] == there[1:]
