"""The same drawing every time: with any number of threads, again, and in another process.

IDENTICAL  the bytes of SVG, PDF and JSON (but for the timings), with all counters; and the kernel's own counters.
MAY MOVE   nothing.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import models
from properties.assemblies import KINDS, Piece, assemblies, assembly, examples, views
from properties.frozen import draw
from properties.identity import everything

from hlr import Perspective
from support.programs import environment

ACCURACY = 0.01
THREADS = (1, 2, 4)
CAMERA = Perspective(eye=(130.0, -220.0, 90.0), target=(5.0, 5.0, 5.0))


def expect_one(drawings):
    drawings = list(drawings)
    assert len({everything(drawing) for drawing in drawings}) == 1
    assert len({tuple(sorted(drawing.counters.items())) for drawing in drawings}) == 1


@pytest.mark.slow
@examples(15)
@given(assemblies(), st.booleans(), views, st.sampled_from([None, CAMERA]))
def test_threads_and_an_assembly(pieces, brep, view, camera):
    model = assembly(pieces, brep)
    expect_one(
        draw(model, view, ACCURACY, threads=n, smooth=True, seam=True, perspective=camera) for n in (*THREADS, 1)
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", models.EVERY)
@pytest.mark.parametrize("view", ["front", "iso"])
def test_threads_and_a_model(name, view):
    model = models.model(name)
    expect_one(draw(model, view, models.accuracy(model), threads=n, smooth=True) for n in (*THREADS, 4))


def crowd(count=200, seed=1):
    """Pieces of all kinds in a block, most of them crossing others: enough for many bands."""
    rng = np.random.default_rng(seed)
    low, size = rng.integers(0, 30, (count, 3)), rng.integers(1, 6, (count, 3))
    axis, degrees = rng.integers(1, 4, (count, 3)), rng.choice([0, 0, 30, 45], count)
    return assembly(
        [Piece(KINDS[i % len(KINDS)], *map(tuple, (low[i], size[i], axis[i])), int(degrees[i])) for i in range(count)]
    )


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", (3, -2, 1)])
def test_threads_and_a_crowd(view):
    model = crowd()
    drawings = [draw(model, view, 0.02, threads=n) for n in (*THREADS, 4)]
    assert drawings[0].counters["bands"] > 8
    expect_one(drawings)


def drawn_here():
    """One line per drawing: name, hash, counters."""
    for name in models.EVERY:
        model = models.model(name)
        drawing = draw(model, "iso", models.accuracy(model), smooth=True)
        yield f"{name} {hashlib.sha256(everything(drawing)).hexdigest()} {sorted(drawing.counters.items())}"
    drawing = draw(crowd(60), "iso", ACCURACY)
    yield f"crowd {hashlib.sha256(everything(drawing)).hexdigest()} {sorted(drawing.counters.items())}"


PROGRAM = """
from properties.test_repetition import drawn_here
print(*drawn_here(), sep="\\n")
"""


@pytest.mark.slow
def test_another_process_meshes_and_draws_the_same():
    """Also where sets and dictionaries run in another order, and the machine seems to have another number of cores."""
    command = [sys.executable, "-P", "-c", PROGRAM]
    other = environment(PYTHONHASHSEED="2", RAYON_NUM_THREADS="3")
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=other)
    assert done.stdout.splitlines() == list(drawn_here())


def test_an_order_that_depends_on_chance_would_be_noticed():
    """The comparison can fail: one line more, or one counter."""
    model = assembly([Piece("box", (0, 0, 0), (4, 3, 2)), Piece("cylinder", (2, 2, 1), (3, 3, 3))])
    one, other = draw(model, "iso", ACCURACY), draw(model, "iso", ACCURACY)
    expect_one([one, other])
    for wrong in (draw(model, "iso", ACCURACY, hidden=False), draw(model, "iso", ACCURACY, smooth=True, seam=True)):
        with pytest.raises(AssertionError):
            expect_one([one, wrong])
