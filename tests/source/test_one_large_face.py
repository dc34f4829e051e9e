"""One face of very many triangles: it can be interrupted amid its mesh, and says how far it is."""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap

import pytest

from hlr import _kernel
from hlr.source.cad.prototypes import binary_dump
from support.brep_shapes import terrain

MINUTE = 1e-5
"""Chord error, millimetres, of tens of millions of triangles: many seconds of work on any machine."""


@pytest.fixture(scope="module")
def dump():
    return binary_dump([terrain(40).wrapped])


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals as in POSIX")
@pytest.mark.parametrize("seconds", [0.1, 0.5, 1.5])
def test_an_interrupt_ends_the_work_within_the_face(dump, seconds, tmp_path):
    # In a process of its own: an interrupt that comes when the work has ended would end the suite.
    (tmp_path / "face.bin").write_bytes(dump)
    program = f"""
        import signal, threading, time
        from hlr import _kernel
        signal.signal(signal.SIGINT, signal.default_int_handler)
        model = _kernel.BrepModel(open("face.bin", "rb").read())
        main, sent = threading.main_thread().ident, []
        def interrupt():
            sent.append(time.monotonic())
            signal.pthread_kill(main, signal.SIGINT)
        threading.Timer({seconds}, interrupt).start()
        try:
            model.mesh({MINUTE}, 0.35)
            print("finished")
        except KeyboardInterrupt:
            print(time.monotonic() - sent[0])
    """
    command = [sys.executable, "-P", "-c", textwrap.dedent(program)]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=200, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    # 0.02 to 0.1 s; a busy machine takes its time.
    assert float(done.stdout) < 1.0


def test_progress_moves_within_the_face(dump):
    told: list[float] = []
    _kernel.BrepModel(dump).mesh(1e-3, 0.35, told.append)
    assert told == sorted(told)
    assert sum(0.0 < share < 1.0 for share in set(told)) >= 2
