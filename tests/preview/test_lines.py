"""The drawing's own lines on top: the same camera, the same scale, hidden exactly."""

import cadquery as cq
import numpy as np
import pytest

import hlr


@pytest.mark.parametrize("perspective", [None, hlr.Perspective(), hlr.Perspective(eye=(60, -80, 50), fov=30)])
def test_outlines_lie_on_the_border_of_what_is_covered(perspective):
    part = cq.Workplane().circle(10).extrude(6).union(cq.Workplane("XY", origin=(0, 0, 6)).sphere(6))
    options = {"size": (300, 240), "perspective": perspective, "background": "transparent"}
    bare = hlr.preview(part, **options).pixels[:, :, 3] > 127
    inked = hlr.preview(part, edges=True, **options).pixels
    border = np.zeros_like(bare)
    border[1:-1, 1:-1] = bare[1:-1, 1:-1] & ~(bare[:-2, 1:-1] & bare[2:, 1:-1] & bare[1:-1, :-2] & bare[1:-1, 2:])
    # Lines are two pixels wide, half on either side.
    dark = inked[:, :, :3].max(axis=2) < 95
    assert border.sum() > 200
    assert dark[border].mean() > 0.99


def test_hidden_lines_are_not_drawn():
    block = cq.Workplane().box(20, 20, 20).faces("<Y").workplane().hole(6, 5)
    pixels = hlr.preview(block, view="back", size=(200, 200), edges=True).pixels
    inner = pixels[30:170, 30:170]
    assert (inner == inner[0, 0]).all()
    front = hlr.preview(block, view="front", size=(200, 200), edges=True).pixels[30:170, 30:170]
    assert (front[:, :, 0] < 40).sum() > 100


def test_lines_are_as_wide_as_iso_says():
    block, options = cq.Workplane().box(20, 20, 20), {"size": (400, 400), "background": "transparent"}
    bare, inked = (hlr.preview(block, view="front", edges=e, **options).pixels[200, :60, 3] / 255.0 for e in (0, 1))
    # Half a millimetre at four pixels a millimetre: of two pixels one lies beyond the border.
    assert (inked - bare).sum() == pytest.approx(1.0, abs=0.05)
