"""How the views of a part are arranged on a page (ISO 5456-2, ASME Y14.3). A new method is a new row."""

from __future__ import annotations

from dataclasses import dataclass

from hlr.tables.entry import Table

Cell = tuple[int, int]
"""Column and row of the grid in which views lie; the front view is at 0, 0, columns count to the right, rows up."""


@dataclass(frozen=True, slots=True)
class ProjectionMethod:
    """One method.

    cells    where the views along the axes lie
    usual    the views of a page for which none are asked
    free     cells for other views, such as pictorial ones, the best first
    """

    name: str
    cells: dict[str, Cell]
    usual: tuple[str, ...]
    free: tuple[Cell, ...]


PROJECTION_METHODS = Table(
    (row.name, row)
    for row in (
        # A view lies where the object would be tipped over to: what is seen from the left is drawn on the right.
        ProjectionMethod(
            "first-angle",
            {"front": (0, 0), "top": (0, -1), "bottom": (0, 1), "left": (1, 0), "right": (-1, 0), "back": (2, 0)},
            ("front", "top", "left", "iso"),
            (
                (1, -1),
                (1, 1),
                (-1, -1),
                (-1, 1),
                (2, -1),
                (2, 1),
                (1, 0),
                (2, 0),
                (0, -1),
                (0, 1),
                (3, -1),
                (3, 1),
                (3, 0),
            ),
        ),
        # A view lies on the side that it is seen from.
        ProjectionMethod(
            "third-angle",
            {"front": (0, 0), "top": (0, 1), "bottom": (0, -1), "left": (-1, 0), "right": (1, 0), "back": (2, 0)},
            ("front", "top", "right", "iso"),
            (
                (1, 1),
                (1, -1),
                (-1, 1),
                (-1, -1),
                (2, 1),
                (2, -1),
                (1, 0),
                (2, 0),
                (0, 1),
                (0, -1),
                (3, 1),
                (3, -1),
                (3, 0),
            ),
        ),
    )
)
"""All methods by name."""
