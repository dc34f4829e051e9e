"""Which cell of an arranged page a view has: by where it looks, whatever it is called. Its first section has it too."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.request.directions import NAMED, axes, directed
from hlr.request.options import View
from hlr.request.shown_views import ShownView
from hlr.tables.projection_methods import Cell, ProjectionMethod

ALIKE = 1e-9
"""Of unit vectors: views whose axes differ by less are the same."""


def own_cells(views: Sequence[View], method: ProjectionMethod) -> list[Cell | None]:
    """The cell that the method has for each view; None for those that lie in any free one."""
    known = {_axes(name): cell for name, cell in method.cells.items() if name in NAMED}
    return [next((cell for own, cell in known.items() if _same(own, _axes(view))), None) for view in views]


def cells_of(shown: Sequence[ShownView], method: ProjectionMethod) -> tuple[list[Cell | None], dict[int, Cell]]:
    """The same of what is drawn of views, and beside which cells the further sections of a view best lie."""
    cells = own_cells([each.view for each in shown], method)
    beside: dict[int, Cell] = {}
    for i, (each, cell) in enumerate(zip(shown, cells, strict=True)):
        if each.is_further and cell is not None:
            beside[i], cells[i] = cell, None
    return cells, beside


def _axes(view: View) -> tuple[float, ...]:
    """What points right and up on paper."""
    _, direction, up = directed(view)
    right, upward = axes(direction, up)
    return (*right, *upward)


def _same(one: Sequence[float], other: Sequence[float]) -> bool:
    return all(abs(a - b) < ALIKE for a, b in zip(one, other, strict=True))
