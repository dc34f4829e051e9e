"""The drawing's own lines on top: the same camera, the same scale, hidden exactly."""

import cadquery as cq
import numpy as np
import pytest

import hlr


@pytest.mark.slow
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


def boxed(opacity):
    """A red cube in a box of glass."""
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(8, 8, 8), name="cube", color=cq.Color(0.8, 0.1, 0.1, 1.0))
    assembly.add(cq.Workplane().box(20, 20, 20), name="case", color=cq.Color(0.6, 0.7, 0.9, opacity))
    return assembly


@pytest.mark.slow
def test_lines_behind_glass_are_seen_through_it_and_lighter():
    """The cube's square from the front, and of the case's own far side nothing that its near side does not show."""

    def darker(opacity):
        options = {"view": "front", "size": (240, 240)}
        bare, inked = (hlr.preview(boxed(opacity), edges=e, **options).pixels[:, :, 0].astype(int) for e in (0, 1))
        return (bare - inked)[40:200, 40:200]

    assert (darker(1.0) == 0).all()
    through = darker(0.3)
    # The border of the cube: 4 x 88 pixels long, two wide.
    assert 500 < (through > 20).sum() < 1200
    # Not as dark as what nothing lies before.
    whole = hlr.preview(boxed(0.3), view="front", size=(240, 240), edges=True).pixels[:, :, 0]
    assert whole[120, :40].min() < 20 < whole[40:200, 40:200].min()


def test_opaque_parts_hide_lines_behind_glass():
    """The cube's far edges are hidden by the cube, the case's far edges before nothing are not."""
    from hlr.request.picture_effects import PreviewOptions

    picture = hlr.preview(boxed(0.3), view="iso", size=(240, 240), edges=True)
    assert {d.name: d.on for d in picture.plan}["lines behind glass"]
    far = hlr.preview(boxed(0.3), view="iso", size=(240, 240)).pixels.astype(int)[:, :, 0] - picture.pixels[:, :, 0]
    # Downward from the middle runs the near edge, upward from the cube the far one.
    assert far[50:70, 118:123].max() > 20
    solid = hlr.preview(boxed(1.0), view="iso", size=(240, 240), edges=True)
    assert not {d.name: d.on for d in solid.plan}["lines behind glass"]
    assert PreviewOptions().look == "shaded"


def test_a_wireframe_has_all_lines_and_no_faces():
    block, options = cq.Workplane().box(20, 20, 20), {"view": "iso", "size": (300, 300), "background": "transparent"}
    shaded = hlr.preview(block, edges=True, **options).pixels
    wires = hlr.preview(block, look="wireframe", **options).pixels
    assert (wires[:, :, :3][wires[:, :, 3] > 0] == 0).all()
    # The three far edges meet in the middle, under the near corner: where the top is, one runs straight up.
    column = wires[60:100, 148:153, 3].max(axis=1)
    assert (column > 200).all() and shaded[60:100, 148:153, :3].min() > 60
    plan = {d.name: d.on for d in hlr.preview(block, look="wireframe", **options).plan}
    assert plan["lines"] and not plan["faces"] and not plan["depth cueing"]


def test_depth_cued_lines_are_paler_with_distance():
    frame = cq.Workplane().box(20, 60, 20)
    pixels = hlr.preview(frame, look="depth-cued", view=(0.4, -1, 0.3), size=(300, 300), background="white").pixels
    ink = 255 - pixels[:, :, 0].astype(int)
    assert ink.max() == 255
    used = np.unique(ink[ink > 0])
    assert len(used) > 20 and ink[ink > 40].min() < 80
    dark = hlr.preview(frame, look="depth-cued", view=(0.4, -1, 0.3), size=(300, 300), background="black").pixels
    assert dark[:, :, 0].max() == 255 and dark[0, 0, 0] == 0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"look": "pretty"}, "no look is called 'pretty': use shaded, wireframe, depth-cued"),
        ({"look": "wireframe", "shadows": True}, "a wireframe look has no faces, so no shadows"),
    ],
)
def test_looks_that_cannot_be_had_are_refused(options, sentence):
    with pytest.raises(hlr.OptionError, match=sentence):
        hlr.preview(cq.Workplane().box(1, 1, 1), **options)


@pytest.mark.parametrize("background", ["black", "#223344", "navy", "white", "lime", "transparent"])
@pytest.mark.parametrize("look", ["wireframe", "depth-cued"])
def test_lines_without_faces_differ_from_their_background(look, background):
    """They were black on black in a wireframe; in the other look they were white on bright green."""
    block = cq.Workplane().box(20, 20, 20)
    pixels = hlr.preview(block, view="iso", size=(200, 200), look=look, background=background).pixels
    ink = 255 if background in ("black", "#223344", "navy") else 0
    assert (np.abs(pixels[:, :, :3].astype(int) - ink).max(axis=2) < 40)[pixels[:, :, 3] > 200].sum() > 100
