"""Memory of frames, methods and processes: the tenth of the worked examples."""

import subprocess
import sys

import pytest

from hlr.lab.methods import METHODS, SCREEN, frame_memory, method_memory, peak_memory, render

RECTANGLE = [(0, 0, 1), (4, 0, 1), (4, 4, 1), (0, 4, 1)]
MIB = 1 << 20


def test_10_memory_of_a_frame():
    assert frame_memory(1024, 1280, colour=4, depth=4, doubled=True) == 20 * MIB
    assert frame_memory(1024, 1024, colour=0, depth=4) == 4 * MIB
    assert frame_memory(1024, 1, colour=0, depth=4) == 4 << 10


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1024, 1024), (3840, 2160)])
@pytest.mark.parametrize("method", METHODS)
def test_10_methods_hold_what_is_stated(method, size):
    # One rectangle: what the scene adds is little, but for the heads of an edge table, 4 bytes a row.
    held = render([RECTANGLE], SCREEN, size, method).statistics.memory
    assert method_memory(method, size) <= held <= method_memory(method, size) + 8 * size[1] + 8192


TAKEN = """
import sys
from hlr.lab.methods import SCREEN, render
scene = [[(0, 0, 1), (4, 0, 1), (4, 4, 1)]]
render(scene, SCREEN, (8, 8), sys.argv[1])
# Of this program alone: ru_maxrss begins with what the one that started it had.
most = lambda: int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0]) * 1024
before = most()
render(scene, SCREEN, (int(sys.argv[2]),) * 2, sys.argv[1])
print(most() - before)
"""


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux tells the most that a program had")
@pytest.mark.parametrize("method", ["z-buffer", "scan-line z-buffer", "warnock"])
def test_10_a_process_takes_what_is_stated(method):
    def taken(side):
        command = [sys.executable, "-P", "-c", TAKEN, method, str(side)]
        return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)

    stated = {side: peak_memory(method, (side, side)) for side in (1024, 3072)}
    small, large = taken(1024), taken(3072)
    assert large - small == pytest.approx(stated[3072] - stated[1024], rel=0.1)
