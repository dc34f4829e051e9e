"""The kernel's threads are bound to cores while nothing else runs, and only then; the caller's own thread never is."""

import os
import subprocess
import sys

import pytest

CODE = """
import os, subprocess, sys, time
import numpy as np
from hlr import _kernel

def work():
    time.sleep(0.002)
    side = np.linspace(0.0, 1.0, 60)
    x, y = np.meshgrid(side, side)
    points = np.stack([x.ravel(), y.ravel(), (x * y).ravel()], axis=1)
    i = np.arange(59)[:, None] * 60 + np.arange(59)
    triangles = np.concatenate([np.stack([i, i + 1, i + 60], 2), np.stack([i + 1, i + 61, i + 60], 2)]).reshape(-1, 3)
    _kernel.edge_table(triangles.astype(np.int32), len(points))

def masks():
    return [os.sched_getaffinity(int(task)) for task in os.listdir("/proc/self/task")]

whole = os.sched_getaffinity(0)
before = len(masks())
work()
of_all_cores = len(masks()) - before == len(whole) and 2 <= len(whole) <= 4
alone = []
for _ in range(100):
    work()
    if any(len(mask) == 1 for mask in masks()):
        break
    time.sleep(0.002)  # the kernel's own threads look for work a little longer
    alone.append(open("/proc/loadavg").read().split()[3].startswith("1/"))
else:
    assert not (of_all_cores and sum(alone) > 50), "nothing else runs, and no thread is bound"
assert os.sched_getaffinity(0) == whole
assert all(mask == whole or len(mask) == 1 for mask in masks()), masks()
busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
try:
    end = time.monotonic() + 20
    while any(mask != whole for mask in masks()):
        assert time.monotonic() < end, masks()
        work()
finally:
    busy.kill()
print("free")
"""


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="cores of threads can be read on Linux alone")
def test_threads_are_free_while_other_programs_run():
    done = subprocess.run([sys.executable, "-P", "-c", CODE], capture_output=True, text=True, check=False)
    assert done.stdout == "free\n", done.stderr
