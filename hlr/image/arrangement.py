"""Where several views lie on one page: in the cells of a grid, as large as the largest standard scale allows.

::

            column 0   1
        row 1   top    iso          third-angle: each view on the side that it is seen from
            0   front  right
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from types import MappingProxyType

from hlr.common.numbers import typed
from hlr.errors import OptionError
from hlr.tables.projection_methods import Cell, ProjectionMethod
from hlr.tables.sheets import MARGIN, SLACK, Paper, standard_scale

LEAST_GAP, MOST_GAP = 10.0, 40.0
"""Millimetres between views: at least, and at most where the page has more room than they need."""

TRIED = 2
"""Views of which all places are tried; each further one takes the best that is left."""

Size = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Room:
    """A page, and the rectangle on it in which views may lie: x, y its lower left corner, millimetres."""

    paper: Paper
    x: float
    y: float
    width: float
    height: float

    def around(self, rooms: Sequence[Room]) -> tuple[float, float, float, float]:
        """The one of some rooms in which this lies: its lower left and its upper right corner."""
        x, y = self.x + 0.5 * self.width, self.y + 0.5 * self.height
        corners = [(room.x, room.y, room.x + room.width, room.y + room.height) for room in rooms]
        return next((each for each in corners if each[0] <= x <= each[2] and each[1] <= y <= each[3]), corners[0])


def inside_margins(paper: Paper) -> Room:
    """All of a page but its margins."""
    return Room(paper, MARGIN, MARGIN, *paper.room)


@dataclass(frozen=True, slots=True)
class Arrangement:
    """A scale (paper : model), the room on a page, the cell of each view, and the least gap between views in mm."""

    scale: float
    room: Room
    cells: tuple[Cell, ...]
    gap: float = LEAST_GAP

    def places(self, sizes: Sequence[Size]) -> list[tuple[float, float]]:
        """The middle of each view's cell, millimetres from the page's lower left corner; sizes: at 1:1."""
        columns, rows = _spans(sizes, self.cells)
        x = _middles(columns, self.scale, self.room.x, self.room.width, self.gap)
        y = _middles(rows, self.scale, self.room.y, self.room.height, self.gap)
        return [(x[column], y[row]) for column, row in self.cells]

    def needs(self, sizes: Sequence[Size]) -> Size:
        """Width and height of all views at their scale, with the least gaps between them, millimetres."""
        width, height = (
            self.scale * sum(span.values()) + self.gap * (len(span) - 1) for span in _spans(sizes, self.cells)
        )
        return width, height


def check_views(names: Sequence[str], own: Sequence[Cell | None], method: ProjectionMethod) -> None:
    """Raise OptionError for a view that is given twice, and for too many views.

    names: of the views; own: the cell that the method has for each, None for those that lie in any free one
    """
    twice = next((name for name in names if names.count(name) > 1), None)
    taken = [cell for cell in own if cell is not None]
    if twice is None:
        twice = next((name for name, cell in zip(names, own, strict=True) if cell and taken.count(cell) > 1), None)
    if twice is not None:
        raise OptionError(f"the view {twice} is given twice: a page shows it once")
    if own.count(None) > len([cell for cell in method.free if cell not in taken]):
        raise OptionError(f"{len(names)} views are too many for one page: give fewer")


def arranged(
    own: Sequence[Cell | None],
    sizes: Sequence[Size],
    method: ProjectionMethod,
    rooms: Sequence[Room],
    scale: float | None,
    gap: float = LEAST_GAP,
    beside: Mapping[int, Cell] = MappingProxyType({}),
) -> Arrangement:
    """The arrangement of views that allows the largest scale; where several rooms do, that in the first of them.

    own: the cell that the method has for each view, None for those that lie in any free one; sizes: width and height of
    each at 1:1, millimetres; scale: None: the largest standard one; gap: the least between views, millimetres.
    beside: of views without a cell of their own, those that best lie in line with one

    Raises OptionError for a page without room for the views.
    """
    best: tuple[tuple[float, int], Arrangement] | None = None
    for room in rooms:
        for cells in _choices(own, sizes, method, room, gap, beside):
            most = _most(sizes, cells, room, gap)
            chosen = scale if scale is not None else standard_scale(most) if most > 0.0 else 0.0
            # With a scale that is given, the one that has more to spare.
            rank = (most if scale is not None else chosen), 0
            if beside:
                rank = min(most, chosen), sum(_are_in_line(cells[i], cell) for i, cell in beside.items())
            if chosen > 0.0 and (best is None or rank > best[0]):
                best = rank, Arrangement(chosen, room, cells, gap)
    if best is None:
        room = max(rooms, key=lambda each: each.width * each.height)
        page = f"a page of {room.paper.width:g} x {room.paper.height:g} mm"
        apart = f"{len(own)} views with {gap:g} mm between them"
        if room == inside_margins(room.paper):
            raise OptionError(f"{page} has no room for {apart}: give a larger page, or fewer views")
        size = " x ".join(typed(side, 4) for side in (room.width, room.height))
        raise OptionError(
            f"the room of {size} mm on {page} is too small for {apart}: give a larger one, or fewer views"
        )
    return best[1]


def _choices(
    own: Sequence[Cell | None],
    sizes: Sequence[Size],
    method: ProjectionMethod,
    room: Room,
    gap: float,
    beside: Mapping[int, Cell],
) -> Iterator[tuple[Cell, ...]]:
    """Cells of all views: each way to place the first free ones, the better places first; the best for all others."""
    taken = [cell for cell in own if cell is not None]
    free = [i for i, cell in enumerate(own) if cell is None]
    places = {
        i: [cell for cell in (*_in_line(beside.get(i), len(own)), *method.free) if cell not in taken] for i in free
    }
    for first in product(*(dict.fromkeys(places[i]) for i in free[:TRIED])):
        if len(set(first)) < len(first):
            continue
        cells = dict(zip(free, first, strict=False)) | {i: cell for i, cell in enumerate(own) if cell is not None}
        for i in free[TRIED:]:
            left = [cell for cell in places[i] if cell not in cells.values()]
            scales = [_scale([*cells, i], [*cells.values(), cell], sizes, room, gap) for cell in left]
            cells[i] = left[scales.index(max(scales))]
        yield tuple(cells[i] for i in range(len(own)))


def _in_line(cell: Cell | None, count: int) -> list[Cell]:
    """So many cells beyond one, away from the front view: in its row, or in its column above or below the front.

    Behind them those on its two other sides.
    """
    if cell is None:
        return []
    across, up = cell
    step = (0, 1 if up > 0 else -1) if up else (-1 if across < 0 else 1, 0)
    beyond = [(across + k * step[0], up + k * step[1]) for k in range(1, count + 1)]
    return [*beyond, *((across + k * step[1], up + k * step[0]) for k in (-1, 1))]


def _are_in_line(one: Cell, other: Cell) -> bool:
    return one[0] == other[0] or one[1] == other[1]


def _scale(views: Sequence[int], cells: Sequence[Cell], sizes: Sequence[Size], room: Room, gap: float) -> float:
    most = _most([sizes[i] for i in views], cells, room, gap)
    return standard_scale(most) if most > 0.0 else 0.0


def _most(sizes: Sequence[Size], cells: Sequence[Cell], room: Room, gap: float) -> float:
    """The largest scale at which the views fit; 0 where the gaps alone are too wide."""
    scales = []
    for span, side in zip(_spans(sizes, cells), (room.width, room.height), strict=True):
        left, total = side + SLACK - gap * (len(span) - 1), sum(span.values())
        if left <= SLACK:
            return 0.0
        if total > 0.0:
            scales.append(left / total)
    return min(scales, default=1.0)


def _spans(sizes: Sequence[Size], cells: Sequence[Cell]) -> tuple[dict[int, float], dict[int, float]]:
    """The width of each column and the height of each row at 1:1, from left to right and from below."""
    columns: dict[int, float] = {}
    rows: dict[int, float] = {}
    for (width, height), (column, row) in zip(sizes, cells, strict=True):
        columns[column] = max(columns.get(column, 0.0), width)
        rows[row] = max(rows.get(row, 0.0), height)
    return dict(sorted(columns.items())), dict(sorted(rows.items()))


def _middles(span: dict[int, float], scale: float, begin: float, side: float, least: float) -> dict[int, float]:
    """Where the middle of each column or row lies, with even gaps, all of them in the middle of a side of the room."""
    total = scale * sum(span.values())
    gap = min(max((side - total) / (len(span) + 1), least), max(least, MOST_GAP))
    at = begin + 0.5 * (side - total - gap * (len(span) - 1))
    found = {}
    for number, size in span.items():
        found[number] = at + 0.5 * scale * size
        at += scale * size + gap
    return found
