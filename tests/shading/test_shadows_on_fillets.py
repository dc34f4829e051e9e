"""No specks where a shadow meets a fillet: a pixel in shade stands beside others in shade, on whatever lit face."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr

MODELS = {
    "box": cq.Workplane().box(40, 30, 20).edges().fillet(4),
    "pocket": cq.Workplane()
    .box(60, 40, 20)
    .faces(">Z")
    .workplane()
    .rect(40, 20)
    .cutBlind(-10)
    .edges("|Z")
    .fillet(4)
    .faces(">Z")
    .edges()
    .fillet(1.5),
    "boss": cq.Workplane().box(60, 60, 8).faces(">Z").workplane().circle(12).extrude(20).edges("%CIRCLE").fillet(2),
}

VIEWS = ["iso", "top", (0.3, -0.2, 1), (-1, -0.4, 0.3)]
"""The light goes with the viewer."""

AROUND = 5
"""Pixels along a side of the square in which a speck stands alone."""


def specks(model: object, view: object) -> int:
    """Dark pixels of which at most three lie together in a square that is else lit, all of it on one face."""
    dark, lit = (hlr.preview(model, view, size=(480, 360), ids=True, shadows=shadows) for shadows in (True, False))
    light = [p.pixels[..., :3].astype(float).sum(axis=2) for p in (dark, lit)]
    share = light[0] / np.maximum(light[1], 1.0)
    shares = np.lib.stride_tricks.sliding_window_view(share, (AROUND, AROUND)).reshape(*_inner(share), -1)
    faces = np.lib.stride_tricks.sliding_window_view(dark.ids, (AROUND, AROUND)).reshape(*_inner(share), -1)
    alike = (faces == faces[..., :1]).all(axis=2) & (faces[..., 0] >= 0)
    alone = np.sort(shares, axis=2)[..., 3] > 0.97
    return int((alike & alone & (shares[..., AROUND**2 // 2] < 0.94)).sum())


def _inner(picture: np.ndarray) -> tuple[int, int]:
    return picture.shape[0] - AROUND + 1, picture.shape[1] - AROUND + 1


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS, ids=str)
@pytest.mark.parametrize("name", MODELS)
def test_no_pixel_is_alone_in_the_shade(name: str, view: object) -> None:
    assert specks(MODELS[name], view) == 0
