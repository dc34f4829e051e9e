"""The scale of a view, and the sheet of paper it lies on.

Of the ways a sheet may lie, the one that allows the larger scale is taken; where both allow the same, the one that
leaves the more even margins; where these are alike as well, landscape.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from hlr.common.numbers import typed
from hlr.drawing.notes import Note
from hlr.drawing.scale import ratio
from hlr.request.options import Options
from hlr.tables.sheets import SHEETS, SLACK, USUAL, Paper, papers, standard_scale

ALIKE = 1e-9
"""Of a scale: two that differ by less are the same but for rounding."""

Size = tuple[float, float]


@dataclass(frozen=True, slots=True)
class OnPaper:
    """A scale (paper : model), and the sheet; None: the page is as large as the drawing."""

    scale: float
    paper: Paper | None


def settled(options: Options) -> bool:
    """Whether the request alone tells the scale, and no sheet has to be laid one way or the other."""
    return options.scale is not None and options.page is None


def at_scale(options: Options, scale: float) -> Options:
    """The options with this scale (paper : model), on the sheets that they ask for without one."""
    sheet = options.fit if isinstance(options.fit, str) else options.page
    usual = USUAL if options.scale is None and options.fit is None else None
    return replace(options, scale=scale, fit=None, page=sheet or usual)


def sheets(options: Options) -> tuple[Paper, ...]:
    """The sheets that a view may lie on; none where the page is to be as large as the drawing."""
    if options.page is not None:
        return papers(options.page)
    if isinstance(options.fit, str):
        return papers(options.fit)
    return papers(USUAL) if options.scale is None and options.fit is None else ()


def on_paper(size: Size, options: Options) -> OnPaper:
    """The scale and the sheet of a view. size: its width and height at 1:1, millimetres."""
    best: tuple[OnPaper, float, float] | None = None
    for paper in sheets(options):
        scale = _scale(size, options, paper)
        fits = min(scale, _most(size, _loose(paper)))
        spare = [side - scale * own for side, own in zip((paper.width, paper.height), size, strict=True)]
        uneven = abs(spare[0] - spare[1])
        if best is None or _better(fits, uneven, best[1], best[2]):
            best = OnPaper(scale, paper), fits, uneven
    return OnPaper(_scale(size, options, None), None) if best is None else best[0]


def _better(fits: float, uneven: float, best: float, least: float) -> bool:
    if abs(fits - best) > ALIKE * best:
        return fits > best
    return uneven < least - SLACK


def _scale(size: Size, options: Options, paper: Paper | None) -> float:
    """The scale that was asked for, or that fills what is to be filled, or the largest standard one."""
    if options.scale is not None:
        return float(options.scale)  # `checked` made a number of it
    if options.fit is not None and not isinstance(options.fit, str):
        return _most(size, options.fit)
    assert paper is not None
    return _most(size, paper.room) if options.fit is not None else standard_scale(_most(size, _loose(paper)))


def _loose(paper: Paper) -> Size:
    width, height = paper.room
    return width + SLACK, height + SLACK


def _most(size: Size, room: Size) -> float:
    """The largest scale at which this size fits into the room."""
    return min((most / own for own, most in zip(size, room, strict=True) if own > 0.0), default=1.0)


def misfit(size: Size, scale: float, paper: Paper) -> Note | None:
    """A warning where a drawing is larger than the room on its sheet. size: as drawn at this scale, millimetres."""
    most = _most(size, _loose(paper))
    if most >= 1.0 - ALIKE:
        return None
    fits = [sheet for sheet in SHEETS.values() if any(_most(size, _loose(p)) >= 1.0 for p in papers(sheet.name))]
    page = f", or the page {min(fits, key=lambda sheet: sheet.wide).name}" if fits else ""
    width, height = (typed(own, 4) for own in size)
    text = (
        f"the drawing, {width} x {height} mm at {ratio(scale)}, is too large for its page {paper.name}: "
        f"give the scale {ratio(standard_scale(scale * most))}{page}"
    )
    return Note("page-too-small", text)
