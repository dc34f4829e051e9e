"""How the kernel runs its work: where it is called if it is small, else on threads that are kept."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from hlr import _kernel
from hlr.common.threads import at_most


def lengths(count: int) -> float:
    """Points of a straight line, by a kernel function that runs in parallel; their sum."""
    line = np.array([0.0, 0, 0, 1, 0, 0, 0, 0, 0])
    curves = _kernel.Curves(np.array([1], np.uint8), np.zeros((1, 2)), np.array([0, 9], np.int32), line)
    found = _kernel.curve_points(curves, np.zeros(count, np.int32), np.arange(count) * 1.0)
    return float(found[:, 0, 0].sum())


SMALL, LARGE = 10, 100_000


def expected(count: int) -> float:
    return count * (count - 1) / 2


@pytest.mark.skipif(sys.platform == "win32", reason="no fork there")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_fork_of_a_process_that_has_drawn_can_draw() -> None:
    assert lengths(LARGE) == expected(LARGE)
    child = os.fork()
    if child == 0:
        # A child that waits for threads it does not have would wait for ever.
        os._exit(0 if (lengths(SMALL), lengths(LARGE)) == (expected(SMALL), expected(LARGE)) else 1)
    done = threading.Event()
    timer = threading.Timer(60.0, lambda: None if done.is_set() else os.kill(child, 9))
    timer.start()
    _, status = os.waitpid(child, 0)
    done.set()
    timer.cancel()
    assert status == 0


def test_threads_of_python_may_all_call() -> None:
    found: list[float] = []
    threads = [threading.Thread(target=lambda: found.extend((lengths(SMALL), lengths(LARGE)))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert sorted(found) == [expected(SMALL)] * 8 + [expected(LARGE)] * 8


COUNTED = """
import os

import cadquery as cq

import hlr

def threads():
    return set(os.listdir("/proc/self/task"))

def drawn(**options):
    before = threads()
    drawing = hlr.draw(shape, hidden=True, **options)
    drawing.save(os.devnull, format="svg")
    return len(threads() - before)

points = [(8.0 * x, 8.0 * y) for x in range(8) for y in range(8)]
shape = cq.Workplane().box(80, 80, 6).faces(">Z").workplane().pushPoints(points).hole(3).edges("%CIRCLE").chamfer(0.3)
hlr.draw(cq.Workplane().box(1, 1, 1))
print(drawn(threads=3), drawn(threads=1), drawn(threads=3), drawn(), len(os.sched_getaffinity(0)))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="threads are counted in /proc")
def test_a_drawing_starts_no_more_threads_than_it_was_given(tmp_path: Path) -> None:
    # Elsewhere, so that hlr is what is installed.
    done = subprocess.run([sys.executable, "-c", COUNTED], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    three, one, again, all_of_them, cores = map(int, done.stdout.split())
    assert (three, one, again) == (3, 1, 0)
    assert all_of_them >= cores


def test_a_limit_ends_where_it_should() -> None:
    with at_most(3):
        with pytest.raises(ValueError, match="inside"), at_most(1):
            raise ValueError("inside")
        with at_most(0):
            assert _kernel.limit_threads(3) == 3
    assert _kernel.limit_threads(0) == 0
