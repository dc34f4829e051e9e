"""One face of very many triangles: it can be interrupted amid its mesh, and says how far it is."""

from __future__ import annotations

import signal
import threading
import time

import pytest
from hard.test_terrain import terrain

from hlr import _kernel
from hlr.source.roots import dumped

MINUTE = 1e-4
"""Chord error, millimetres, of millions of triangles."""


@pytest.fixture(scope="module")
def model():
    return _kernel.BrepModel(dumped([terrain(40).wrapped]))


@pytest.fixture
def interruptible():
    """A suite that is started in the background of a shell inherits that interrupts are ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals as in POSIX")
@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("seconds", [0.1, 0.5, 1.5])
def test_an_interrupt_ends_the_work_within_the_face(model, seconds):
    main, sent = threading.main_thread().ident, []

    def interrupt():
        sent.append(time.monotonic())
        signal.pthread_kill(main, signal.SIGINT)

    threading.Timer(seconds, interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        model.mesh(MINUTE, 0.35)
    # 0.02 to 0.1 s; a busy machine takes its time.
    assert time.monotonic() - sent[0] < 1.0


def test_progress_moves_within_the_face(model):
    told: list[float] = []
    model.mesh(1e-3, 0.35, told.append)
    assert told == sorted(told)
    assert sum(0.0 < share < 1.0 for share in set(told)) >= 2
