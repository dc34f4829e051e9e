"""A source may stand for another one and change its mesh: all drawings are of that mesh, filled ones too."""

from __future__ import annotations

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.source import open_source
from hlr.source.cad.brep_source import BrepSource
from hlr.source.model import finer_mesh_of
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


class Inherited(BrepSource):
    def mesh(self, *how):
        return lifted(super().mesh(*how))


def block():
    return open_source(cq.Workplane().box(10, 10, 10))


def inherited():
    source = block()
    return Inherited(source.name, source.kind, source.parts, source.prototypes)


@pytest.mark.parametrize("make", [lambda: Lifted(block()), inherited])
@pytest.mark.parametrize("fill", [False, True])
def test_its_own_mesh_is_drawn(make, fill):
    drawing = hlr.draw(make(), "front", fill=fill, **AT_SIZE)
    heights = np.concatenate([line.points3[:, 2] for line in drawing.lines])
    assert (heights.min(), heights.max()) == pytest.approx((45, 55))


def test_a_source_that_only_forwards_is_meshed_finely_where_that_is_needed():
    assert finer_mesh_of(Standing(block())) is not None
    assert finer_mesh_of(block()) is not None
    assert finer_mesh_of(Lifted(block())) is None and finer_mesh_of(inherited()) is None
