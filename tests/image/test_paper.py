"""The page of a drawing: sheet, standard scale, and the place of the drawing on it."""

from __future__ import annotations

import io
from fractions import Fraction

import numpy as np
import pypdfium2
import pytest

import hlr
from hlr.drawing.scale import ratio
from hlr.tables.sheets import MARGIN, papers, standard_scale
from support.models import box, parts

SLACK = 0.1
"""Millimetres that a drawing may be larger than the room on its page."""
STANDARD = sorted({Fraction(n) * Fraction(10) ** k for n in (1, 2, 5) for k in range(-9, 9)})
VIEWS = ["front", "iso", (3, -1, 2)]
SIZES = [
    (0.01, 0.01, 0.01), (1, 2, 3), (37, 37, 37), (1e3, 2e3, 3e3), (1e5, 1e5, 1e5),
    (1000, 1, 1), (1, 1, 1000), (0.3, 0.001, 0.002), (500, 400, 0.1), (0.1, 300, 200),
    (277, 10, 190), (190, 10, 277), (277.2, 10, 190), (95, 10, 138.5),
]  # fmt: skip


def expect_on_page(drawing: hlr.Drawing, sides: tuple[float, float] = (210.0, 297.0)) -> None:
    """The drawing lies in the middle of its page, inside the margins, and at the next standard scale it would not."""
    page, drawn = drawing.page, drawing.bounds
    assert page is not None and sorted((page.width, page.height)) == sorted(sides)
    left, bottom = page.left + drawn.x0, page.bottom + drawn.y0
    assert min(left, bottom) >= MARGIN - SLACK
    assert (page.width - left - drawn.width, page.height - bottom - drawn.height) == pytest.approx((left, bottom))
    (step,) = [i for i, scale in enumerate(STANDARD) if drawing.scale == pytest.approx(float(scale), rel=1e-12)]
    growth = float(STANDARD[step + 1] / STANDARD[step])
    wide, high = growth * drawn.width, growth * drawn.height
    for across, along in (sides, sides[::-1]):
        assert wide > across - 2.0 * MARGIN or high > along - 2.0 * MARGIN


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_any_size_of_box_lies_on_a4_at_the_largest_standard_scale(size: tuple[float, float, float]) -> None:
    # All details: of a thin box lines are crowded, which is said.
    for drawing in hlr.draw_views(box(size), VIEWS, hlr.Options(details=True)):
        expect_on_page(drawing)
        assert not drawing.notes


@pytest.mark.parametrize("size", SIZES[:5], ids=str)
def test_so_it_does_in_perspective(size: tuple[float, float, float]) -> None:
    (drawing,) = hlr.draw_views(box(size), ["iso"], hlr.Options(perspective=hlr.Perspective()))
    expect_on_page(drawing)
    eye = hlr.Perspective(eye=(3 * size[0], -4 * size[1], 5 * size[2]), target=(0.0, 0.0, 0.0))
    expect_on_page(hlr.draw(box(size), perspective=eye, up=(0.1, 0.0, 1.0)))


@pytest.mark.slow
def test_a_sphere_gets_the_scale_of_its_outline_and_not_of_its_box() -> None:
    import cadquery as cq

    sphere = cq.Workplane().sphere(90)
    drawing = hlr.draw(sphere, "iso")
    expect_on_page(drawing)
    assert drawing.scale == 1.0 and drawing.bounds.width == pytest.approx(180.0, abs=0.05)
    # Meshed for the box, which fits at 1:2 only, it would be half as fine.
    assert drawing.counters["triangles"] == hlr.draw(sphere, "iso", scale=1.0).counters["triangles"]


@pytest.mark.parametrize(
    ("size", "page"),
    [
        ((277, 10, 190), (297.0, 210.0)), ((190, 10, 277), (210.0, 297.0)),
        ((50, 10, 50), (297.0, 210.0)), ((180, 10, 190), (210.0, 297.0)), ((190, 10, 180), (297.0, 210.0)),
    ],
)  # fmt: skip
def test_the_sheet_lies_the_way_that_allows_the_larger_scale_or_the_more_even_margins(
    size: tuple[float, float, float], page: tuple[float, float]
) -> None:
    drawing = hlr.draw(box(size), "front")
    assert drawing.page is not None and (drawing.page.width, drawing.page.height) == page


@pytest.mark.parametrize("name", ["A0", "a3", "letter", "tabloid", "A3-portrait", "300x200", (300, 200)])
def test_other_pages(name: str | tuple[float, float]) -> None:
    drawing = hlr.draw(box((40, 30, 20)), page=name)
    page, ways = drawing.page, papers(name)
    assert page is not None and (page.name, page.width, page.height) in [(w.name, w.width, w.height) for w in ways]
    if len(ways) == 2:
        expect_on_page(drawing, (ways[0].width, ways[0].height))


def test_the_files_are_as_large_as_the_page() -> None:
    drawing = hlr.draw(box((40, 30, 20)), page="letter-landscape")
    assert drawing.page is not None
    svg = drawing.to_svg()
    assert 'width="279.4mm" height="215.9mm"' in svg
    corner = f'viewBox="{-drawing.page.left:.3f}'.rstrip("0")
    assert corner in svg
    size = pypdfium2.PdfDocument(drawing.to_pdf())[0].get_size()
    assert size == pytest.approx((279.4 * 72 / 25.4, 215.9 * 72 / 25.4), abs=1e-3)
    again = hlr.load(io.BytesIO(drawing.to_json().encode()))
    assert again == drawing and again.page == drawing.page and again.to_svg() == svg


def test_a_sheet_has_its_exact_size_in_a_coarse_drawing() -> None:
    assert 'width="279.4mm"' in hlr.draw(box((40, 30, 20)), page="letter-landscape", accuracy=20.0).to_svg()


def test_a_scale_on_a_page_that_is_too_small_is_drawn_with_a_warning() -> None:
    drawing = hlr.draw(box((400, 10, 200)), "front", page="A4", scale=1.0)
    assert drawing.bounds.width == pytest.approx(400) and drawing.page is not None and drawing.page.width == 297.0
    (note,) = drawing.notes
    assert note.code == "page-too-small" and note.is_warning
    assert str(note) == (
        "the drawing, 400 x 200 mm at 1:1, is too large for its page A4: give the scale 1:2, or the page A3"
    )
    assert not hlr.draw(box((400, 10, 200)), "front", page="A3", scale=1.0).notes
    with pytest.raises(hlr.StrictError, match="too large for its page"):
        hlr.draw(box((400, 10, 200)), "front", page="A4", scale=1.0, strict=True)
    (note,) = hlr.draw(box((4000, 10, 200)), "front", page="A4", scale=1.0).notes[-1:]
    assert str(note).endswith("give the scale 1:20")


def test_a_sheet_can_be_filled_at_an_odd_scale() -> None:
    drawing = hlr.draw(box((40, 10, 20)), "front", fit="A4")
    assert drawing.page is not None and (drawing.page.width, drawing.page.left) == (297.0, pytest.approx(10.0))
    assert drawing.bounds.width == pytest.approx(277.0) and drawing.scale == pytest.approx(6.925)
    upright = hlr.draw(box((40, 10, 20)), "front", fit="A4-portrait")
    assert upright.page is not None and upright.page.width == 210.0
    assert upright.bounds.width == pytest.approx(190.0)


def test_a_window_is_as_large_as_it_is_and_has_the_scale_of_the_whole() -> None:
    whole = hlr.draw(box((40, 30, 20)))
    window = hlr.draw(box((40, 30, 20)), window=(0, 0, 50, 60))
    assert window.scale == whole.scale and window.page is None and 'width="61mm" height="71mm"' in window.to_svg()


def test_each_view_is_placed_for_itself() -> None:
    model = box((1000, 20, 30))
    together = hlr.draw_views(model, ["front", "right", "iso"])
    assert len({drawing.scale for drawing in together}) > 1
    for drawing, view in zip(together, ["front", "right", "iso"], strict=True):
        alone = hlr.draw(model, view)
        assert (alone.scale, alone.page, alone.accuracy) == (drawing.scale, drawing.page, drawing.accuracy)


@pytest.mark.parametrize("power", [-2, 1, 3])
def test_a_model_ten_times_as_large_has_the_same_lines_at_a_tenth_of_the_scale(power: int) -> None:
    size = np.array((48.0, 32.0, 20.0))
    models = [
        parts(box(tuple(size * f)), box((7 * f, 50 * f, 9 * f), (4 * f, 2 * f, 11 * f))) for f in (1.0, 10.0**power)
    ]
    for view in VIEWS:
        one, other = (hlr.draw(model, view) for model in models)
        assert other.scale == pytest.approx(one.scale / 10.0**power, rel=1e-12)
        assert [(x.kind, x.visible, x.part) for x in one.lines] == [(x.kind, x.visible, x.part) for x in other.lines]
        for a, b in zip(one.lines, other.lines, strict=True):
            assert np.allclose(a.points, b.points, atol=one.accuracy.used)
        assert (one.page.left, one.page.bottom) == pytest.approx((other.page.left, other.page.bottom))


@pytest.mark.parametrize(
    ("scale", "words"),
    [(1.0, "1:1"), (0.5, "1:2"), (0.2, "1:5"), (5.0, "5:1"), (1e-6, "1:1000000"), (2e5, "200000:1"), (0.4, "1:2.5"),
     (1 / 3, "1:3"), (3 / 7, "1:2.33333"), (1.25, "1.25:1")],
)  # fmt: skip
def test_scales_are_written_as_people_write_them(scale: float, words: str) -> None:
    assert ratio(scale) == words


def test_the_largest_standard_scale_is_found() -> None:
    for most in np.geomspace(1e-8, 1e8, 99):
        assert standard_scale(most) == pytest.approx(float(max(s for s in STANDARD if s <= most)), rel=1e-12)
    for exact in STANDARD[5:-5]:
        assert standard_scale(float(exact)) == float(exact)


# Hidden lines and tangent edges


def decided(plan: object) -> dict[str, tuple[bool, str]]:
    return {d.name: (d.on, d.reason) for d in plan if d.name in ("hidden lines", "smooth edges")}  # type: ignore[attr-defined]


@pytest.mark.parametrize("view", ["front", "iso", "bottom", (0, 0, 1), (0, -2, 0), (1, 0, 1)])
@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
def test_the_kind_of_view_decides_on_hidden_lines_and_tangent_edges(view: hlr.View, perspective: object) -> None:
    options = hlr.Options(perspective=perspective)  # type: ignore[arg-type]
    (drawing,), (planned,) = (make(box((9, 8, 7)), [view], options) for make in (hlr.draw_views, hlr.plan_views))
    assert decided(drawing.plan) == decided(planned.decisions)
    if perspective is None and view not in ("iso", (1, 0, 1)):
        why = "a view along an axis"
        assert decided(drawing.plan) == {"hidden lines": (True, why), "smooth edges": (False, why)}
    else:
        why = "a pictorial view"
        hidden = (False, f"{why}: what nothing shows of goes no further")
        assert decided(drawing.plan) == {"hidden lines": hidden, "smooth edges": (True, why)}
        assert not drawing.hidden


def test_what_is_asked_for_counts_in_every_view() -> None:
    for drawing in hlr.draw_views(box((9, 8, 7)), ["front", "iso"], hlr.Options(hidden=True, smooth=True)):
        assert decided(drawing.plan) == {"hidden lines": (True, "asked for"), "smooth edges": (True, "asked for")}
    for drawing in hlr.draw_views(box((9, 8, 7)), ["front", "iso"], hlr.Options(hidden=False, smooth=False)):
        assert [on for on, _ in decided(drawing.plan).values()] == [False, False]


@pytest.mark.slow
def test_the_preview_shows_the_tangent_edges_of_the_drawing() -> None:
    import cadquery as cq

    rounded = cq.Workplane().box(40, 30, 20).edges("|Z").fillet(8)
    for view, smooth in (("iso", True), ("front", False)):
        unasked, same, other = (
            hlr.preview(rounded, view, edges=True, size=(160, 120), antialias=False, smooth=s).pixels
            for s in (None, smooth, not smooth)
        )
        assert (unasked == same).all() and (unasked != other).any()
