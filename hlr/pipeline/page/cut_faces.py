"""The faces that a section has cut: where they lie on the page, and what fills them, as SVG."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hlr.linework.cut_faces import CutFace, cut_faces, nearness
from hlr.linework.hatch_strokes import inside, strokes_within

if TYPE_CHECKING:
    from hlr.common.types import Floats
    from hlr.pipeline.page.placed_view import PlacedView
    from hlr.source.freecad.hatch import Hatch

TURN = 0.2
"""Radians: how much a chord may turn."""


def cut_faces_of(placed: PlacedView) -> list[CutFace]:
    """The faces that the last cut of a section has made."""
    cut = placed.view.cuts[-1]
    normal = np.array(cut.normal) / float(np.linalg.norm(cut.normal))
    near = nearness(placed.source.bounds())
    parts = placed.source.mesh(placed.drawing.accuracy.deflection, TURN).parts
    return list(cut_faces(parts, np.array(cut.origin), normal, near))


def filling(placed: PlacedView, faces: list[CutFace], height: float) -> str | None:
    """What fills the cut faces of a section, as SVG; None: its hatch has too many strokes. height: of the page."""
    asked = placed.view.cut_faces
    on_page = [[placed.on_page(border) for border in face.borders] for face in faces]
    if asked.hatch is not None:
        return _hatched(placed, asked.hatch, on_page, height)
    if not asked.color:
        return ""
    steps = "".join(_closed(loop, height) for loops in on_page for loop in loops)
    return f'<path fill="{asked.color}" fill-rule="evenodd" stroke="none" d="{steps}"/>\n' if steps else ""


def _hatched(placed: PlacedView, hatch: Hatch, faces: list[list[Floats]], height: float) -> str | None:
    steps = []
    place = np.array(placed.view.place)
    for loops in faces:
        # A pattern turns with its view.
        own = [(loop - place) @ placed.matrix for loop in loops]
        sides = np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in own])
        corners = sides.reshape(-1, 2)
        strokes = strokes_within(hatch.pattern, corners.min(axis=0), corners.max(axis=0))
        if strokes is None:
            return None
        for a, b in (inside(strokes, sides) @ placed.matrix.T + place).tolist():
            steps.append(f"M{_n(a[0])} {_n(height - a[1])}L{_n(b[0])} {_n(height - b[1])}")
    drawn = f'<path fill="none" stroke="{hatch.color}" stroke-width="{_n(hatch.width)}" d="{"".join(steps)}"/>\n'
    return drawn if steps else ""


def _closed(loop: Floats, height: float) -> str:
    return "M" + "L".join(f"{_n(x)} {_n(height - y)}" for x, y in loop.tolist()) + "Z"


def _n(value: float) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"
