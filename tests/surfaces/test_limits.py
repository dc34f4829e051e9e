"""Every method has a limit of time and memory, and what the kernel refuses or gets wrong is an HlrError."""

import signal
import subprocess
import sys
import textwrap
import time
import types

import numpy as np
import pytest

from hlr import _kernel
from hlr.errors import HlrError, KernelError, OptionError
from hlr.lab.methods import METHODS, SCREEN, BspTree, NotFinishedError, Polygons, painters_list, render
from hlr.lab.methods.limits import MEMORY_LIMIT, TIME_LIMIT, Limits, limits


def soup(count, size=500.0, seed=1):
    """Triangles all through one another: BSP trees and depth sort cut them into heaps of pieces."""
    return list(np.random.default_rng(seed).uniform(0.0, size, (count, 3, 3)))


def test_the_limits_that_nobody_gave():
    found = limits()
    assert found.seconds == TIME_LIMIT == 60.0 and found.bytes <= MEMORY_LIMIT
    left = Limits(5.0, 1.0, started=time.monotonic() - 3.0).kernel()
    assert 1.5 < left[0] < 2.5
    for wrong in ({"time_limit": 0.0}, {"time_limit": -1.0}, {"memory_limit": 0}, {"memory_limit": float("nan")}):
        with pytest.raises(OptionError):
            render([], SCREEN, (4, 4), **wrong)


@pytest.mark.parametrize("method", METHODS)
def test_time_ends_every_method(method):
    variant = "flat" if method == "ray casting" else None
    with pytest.raises(NotFinishedError) as late:
        render(soup(3000), SCREEN, (1024, 1024), method, variant=variant, time_limit=1e-3)
    assert "within 0.001 seconds" in str(late.value) and "time_limit" in str(late.value)


@pytest.mark.parametrize("method", METHODS)
def test_memory_ends_every_method(method):
    scene = soup(4000)
    with pytest.raises(NotFinishedError) as full:
        render(scene, SCREEN, (600, 600), method, memory_limit=2**20)
    assert "more than 1 MiB of memory" in str(full.value)


def test_a_growing_tree_is_stopped():
    with pytest.raises(NotFinishedError) as full:
        BspTree(soup(3000), memory_limit=32 * 2**20)
    assert "memory" in str(full.value)
    with pytest.raises(NotFinishedError):
        painters_list(soup(3000), SCREEN, (64, 64), "depth sort", time_limit=1e-3)


def test_triangulating_is_stopped():
    # A warped outline of many corners: quadratic work before anything is drawn.
    angle = np.linspace(0.0, 2.0 * np.pi, 60_000, endpoint=False)
    ring = np.stack([300 + 200 * np.cos(angle), 300 + 200 * np.sin(angle), 9.0 * np.sin(5 * angle)], axis=1)
    started = time.monotonic()
    with pytest.raises(NotFinishedError):
        render([ring], SCREEN, (600, 600), time_limit=0.5)
    assert time.monotonic() - started < 20.0


@pytest.mark.slow
def test_memory_does_not_abort_the_process():
    program = """
        import resource, numpy as np
        from hlr.lab.methods import SCREEN, NotFinishedError, render
        soup = list(np.random.default_rng(1).uniform(0.0, 500.0, (20_000, 3, 3)))
        render(soup[:9], SCREEN, (8, 8), "bsp")
        pages = int(open("/proc/self/statm").read().split()[0])
        resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + 400 * 2**20,) * 2)
        try:
            render(soup, SCREEN, (512, 512), "bsp", time_limit=100.0)
        except NotFinishedError as error:
            print("refused:", error)
    """
    if sys.platform != "linux":
        pytest.skip("asks Linux for its memory")
    command = [sys.executable, "-P", "-c", textwrap.dedent(program)]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("refused: bsp needs more than")


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals as in POSIX")
@pytest.mark.parametrize(
    "work",
    [
        'render(triangles, SCREEN, (512, 512), "bsp")',
        "BspTree(triangles)",
        'render(triangles, SCREEN, (512, 512), "ray casting", variant="flat")',
    ],
)
def test_interrupts_end_the_work(work):
    # In a process of its own: an interrupt that comes when the work has ended would end the suite.
    program = f"""
        import signal, threading, time
        import numpy as np
        from hlr.lab.methods import SCREEN, BspTree, render
        signal.signal(signal.SIGINT, signal.default_int_handler)
        triangles = list(np.random.default_rng(1).uniform(0.0, 500.0, (9000, 3, 3)))
        main, sent = threading.main_thread().ident, []
        def interrupt():
            sent.append(time.monotonic())
            signal.pthread_kill(main, signal.SIGINT)
        threading.Timer(0.3, interrupt).start()
        try:
            {work}
            print("finished")
        except KeyboardInterrupt:
            print(time.monotonic() - sent[0])
    """
    command = [sys.executable, "-P", "-c", textwrap.dedent(program)]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 10.0


@pytest.mark.parametrize("on_worker", [False, True])
def test_a_panic_is_an_error(on_worker, capfd):
    with pytest.raises(KernelError) as found:
        _kernel.provoke_fault(on_worker)
    assert isinstance(found.value, HlrError)
    assert "guard.rs" in str(found.value) and "index out of bounds" in str(found.value)
    assert "report" in str(found.value) and "\n" not in str(found.value)
    assert capfd.readouterr() == ("", "")
    # The fault is told once.
    assert _kernel.take_fault() is None


def test_everything_that_the_kernel_exports_is_guarded():
    exported = {name: value for name, value in vars(_kernel).items() if callable(value) and not name.startswith("__")}
    assert len(exported) > 15
    for name, value in exported.items():
        if isinstance(value, type):
            for method, own in vars(value).items():
                if callable(own) and not method.startswith("__"):
                    assert isinstance(own, types.FunctionType) and hasattr(own, "__wrapped__"), f"{name}.{method}"
        elif name != "take_fault":
            assert isinstance(value, types.FunctionType) and hasattr(value, "__wrapped__"), name


def test_polygons_that_are_not_well_formed():
    ints = lambda *values: np.array(values, np.int32)  # noqa: E731
    points = np.array([(0.0, 0, 0), (4, 0, 0), (4, 4, 0)])
    good = dict(points=points, corners=ints(0, 1, 2), loops=ints(0, 3), polygons=ints(0, 1), cull=np.zeros(1, bool))
    assert (render(Polygons(**good), SCREEN, (4, 4)).ids == 0).any()
    nan = points.copy()
    nan[1, 1] = np.nan
    for change in (
        {"points": nan},
        {"points": points[:, :2]},
        {"corners": ints(0, 1, 3)},
        {"corners": ints(0, -1, 2)},
        {"loops": ints(0, 2)},
        {"loops": ints(1, 3)},
        {"polygons": ints(0, 1, 2)},
        {"polygons": ints()},
        {"cull": np.zeros(3, bool)},
        {"points": np.array([["a", "b", "c"]])},
    ):
        for work in (lambda p: render(p, SCREEN, (4, 4)), lambda p: painters_list(p, SCREEN, (4, 4)), BspTree):
            with pytest.raises(OptionError) as refused:
                work(Polygons(**{**good, **change}))
            assert "\n" not in str(refused.value)
    for values in (np.full((3, 3), np.nan), [[1, 2, np.inf]] * 3, "abc"):
        with pytest.raises(OptionError):
            render(Polygons(**good), SCREEN, (4, 4), values=values)
