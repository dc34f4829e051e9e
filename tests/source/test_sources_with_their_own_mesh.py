"""A source may stand for another one and change its mesh: all drawings are of that mesh, filled ones too."""

from __future__ import annotations

from dataclasses import replace
from functools import wraps

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.source import open_source
from hlr.source.cad.brep_source import BrepSource
from hlr.source.model import mesh_finely
from support.at_size import AT_SIZE

LIFT = np.array((0.0, 0.0, 50.0))


def lifted(meshed):
    """The same parts as meshes, 50 mm higher."""
    parts = [replace(part, points=part.points + LIFT) for part in meshed.parts]
    return replace(meshed, parts=parts)


class Standing:
    """Forwards to another source whatever it does not have itself."""

    def __init__(self, source):
        self._source = source

    def __getattr__(self, name):
        return getattr(self._source, name)


class Lifted(Standing):
    def mesh(self, *how):
        return lifted(self._source.mesh(*how))

    def bounds(self):
        return self._source.bounds() + LIFT


class Lifting(Lifted):
    """As the protocol has it, with the argument that it need not have."""

    def mesh(self, deflection, angle, progress=None, *, finer=()):
        return lifted(self._source.mesh(deflection, angle, progress, finer=finer))


class Decorated(Lifted):
    """It has the name and the signature of another method, and takes less."""

    @wraps(BrepSource.mesh)
    def mesh(self, deflection, angle, progress=None):
        return lifted(self._source.mesh(deflection, angle, progress))


class Inherited(BrepSource):
    def mesh(self, *how):
        return lifted(super().mesh(*how))


def block():
    return open_source(cq.Workplane().box(10, 10, 10))


def inherited():
    source = block()
    return Inherited(source.name, source.kind, source.parts, source.prototypes)


def finely(source):
    """How many faces of each part are meshed finely where all are to be."""
    return mesh_finely(source, 0.1, 0.5, None, source.names()).touching.tolist()


@pytest.mark.parametrize(
    "make", [lambda: Lifted(block()), lambda: Lifting(block()), lambda: Decorated(block()), inherited]
)
@pytest.mark.parametrize("fill", [False, True])
def test_its_own_mesh_is_drawn(make, fill):
    drawing = hlr.draw(make(), "front", fill=fill, **AT_SIZE)
    heights = np.concatenate([line.points3[:, 2] for line in drawing.lines])
    assert (heights.min(), heights.max()) == pytest.approx((45, 55))


def test_a_source_that_only_forwards_is_meshed_finely_where_that_is_needed():
    for source in (block(), Standing(block()), Lifting(block())):
        assert finely(source) == [6]
        assert mesh_finely(source, 0.1, 0.5, None, ()).touching.tolist() == [0]
    for source in (Lifted(block()), inherited(), Decorated(block())):
        assert finely(source) == [0]
