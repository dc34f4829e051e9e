"""Which view of a model a drawing shows: each is drawn coarsely, and its picture laid on that of the drawing.

The pictures are small, and hold how much line there is in each cell and which way it runs, visible and hidden apart.
All shifts of one over the other are tried at once by Fourier transform. What is turned or mirrored is tried as well.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from hlr.compare.lines.motion import Motion
from hlr.compare.lines.pieces import Floats, Pieces
from hlr.compare.lines.strays import without_strays
from hlr.compare.matching.register import points_of
from hlr.compare.matching.scales import different, voted_scales
from hlr.compare.reading.sides import Side, side_of
from hlr.pipeline.draw import draw_views
from hlr.request.directions import NAMED
from hlr.request.options import Options, View
from hlr.source.model import Source

if TYPE_CHECKING:
    from hlr.common.types import Progress

_COARSE = 1.0 / 1000.0
"""Of the model's diagonal: how exactly views are drawn that are only tried."""

_CELLS = 120
"""Of the picture of a drawing, along its diagonal."""

_SIDE = 256
"""Of the square in which pictures are shifted; more than twice as much."""

_SAME_BOX = 0.05
"""Of the size: views that are wider or higher by more are not laid on it, unless none fits better."""

_MOVED = 0.02
"""What a mirrored view or a turned one has to be better than one that lies as it is drawn, each; of 1."""


_BETTER = 0.005
"""Of 1: what comes later in the list has to be that much better."""


@dataclass(frozen=True, slots=True)
class Fit:
    """A view, and the scale at which a drawing shows it: millimetres on paper of one in the model."""

    view: View
    scale: float


def found_view(
    source: Source, options: Options, other: Side, views: Sequence[View], progress: Progress | None = None
) -> Fit:
    """Of these views, or of all that have a name, the one that fits the other side best, and its scale there."""
    named: list[View] = [name for name in NAMED if name != "iso-se"]
    tried = list(views) or named
    size = float(np.linalg.norm(np.ptp(source.bounds(), axis=0))) * source.frame.unit
    known = other.about.scale
    coarse = _COARSE * size * (known or 1.0)
    rough = replace(options, scale=known or 1.0, accuracy=max(coarse, options.accuracy or 0.0), details=False)
    drawn = [without_strays(side_of(drawing, coarse).pieces) for drawing in draw_views(source, tried, rough, progress)]
    shown = without_strays(other.pieces)
    apart = bool((shown.visible >= 0).all())
    fixed = _Picture.of(shown, float(np.hypot(*shown.extent)) / _CELLS, apart)
    laid = [
        each
        for view, pieces in zip(tried, drawn, strict=True)
        for each in _laid(Fit(view, known or 1.0), pieces, shown, known)
    ]
    most_unlike = max(_SAME_BOX, 2.0 * min(each.unlike for each in laid))
    best, most = Fit(tried[0], known or 1.0), -1.0
    for each in laid:
        if each.unlike > most_unlike:
            continue
        share = fixed.likeness(_Picture.of(each.pieces, fixed.cell, apart)) - _MOVED * each.motions
        if share > most + _BETTER:
            best, most = each.fit, share
    return best


@dataclass(frozen=True, slots=True)
class _Laid:
    """A view as it may lie. unlike: how much its rectangle differs; motions: whether mirrored, and whether turned."""

    fit: Fit
    pieces: Pieces
    unlike: float
    motions: int


def _laid(fit: Fit, pieces: Pieces, shown: Pieces, known: float | None) -> Iterator[_Laid]:
    """A view in all ways to lay it down, at the scales that are likely where none is known."""
    voted, factors = [], [1.0]
    if known is None:
        voted = voted_scales(pieces, shown)
        one, other = (float(np.hypot(*each.extent)) for each in (pieces, shown))
        factors = different([*voted, other / max(one, 1e-12)])
    for factor, mirrored, turn in itertools.product(factors, (False, True), (0, 90, 180, 270)):
        moved = pieces.mapped(Motion(mirrored, turn, factor).matrix)
        # Rectangles say nothing where one drawing has lines that the other has not: a scale that lines say counts.
        unlike = 0.0 if factor in voted else _unlike(moved, shown)
        yield _Laid(Fit(fit.view, fit.scale * factor), moved, unlike, mirrored + bool(turn))


def _unlike(one: Pieces, other: Pieces) -> float:
    """How much the rectangles around two drawings differ; 0.1: one is a tenth wider or higher."""
    if not len(one) or not len(other):
        return np.inf
    a, b = one.extent, other.extent
    return float(np.abs(a - b).max() / max(float(b.max()), 1e-12))


@dataclass(frozen=True, slots=True, eq=False)
class _Picture:
    """Transformed pictures of the visible and of the hidden lines, or of all of them; norm: of what they show."""

    layers: tuple[npt.NDArray[Any], ...]
    norm: float
    cell: float

    @staticmethod
    def of(pieces: Pieces, cell: float, apart: bool) -> _Picture:
        """Draw lines into square cells, `cell` millimetres wide."""
        sorts = [pieces.visible == 1, pieces.visible != 1] if apart else [np.ones(len(pieces), bool)]
        low = points_of(pieces).min(axis=0) if len(pieces) else np.zeros(2)
        layers = [_drawn(pieces.take(which), low, cell) for which in sorts]
        norm = float(np.sqrt(sum((abs(layer) ** 2).sum() for layer in layers)))
        return _Picture(tuple(np.fft.fft2(layer) for layer in layers), norm, cell)

    def likeness(self, other: _Picture) -> float:
        """0 to 1, where they are most alike."""
        both = sum(a * np.conj(b) for a, b in zip(self.layers, other.layers, strict=True))
        return float(np.fft.ifft2(both).real.max()) / max(self.norm * other.norm, 1e-12)


def _drawn(pieces: Pieces, low: Floats, cell: float) -> npt.NDArray[Any]:
    """(n, n) complex numbers: the double angle of what runs through a cell, 1 long however often it is drawn."""
    way, amount = np.zeros((_SIDE, _SIDE), complex), np.zeros((_SIDE, _SIDE))
    if not len(pieces) or cell <= 0.0:
        return way
    fine = pieces.divided(0.5 * cell)
    at = (0.5 * (fine.start + fine.end) - low) / cell
    near, lengths = np.floor(at).astype(np.int64), fine.lengths / cell
    step = fine.end - fine.start
    turned = (step[:, 0] + 1j * step[:, 1]) ** 2 / np.maximum(fine.lengths**2, 1e-300) * lengths
    # Each is shared by the four cells around it, so that a shift by less than a cell changes little.
    for x, y in itertools.product((0, 1), (0, 1)):
        share = np.prod(np.where((x, y), at - near, 1.0 - (at - near)), axis=1)
        here = ((near[:, 0] + x) % _SIDE, (near[:, 1] + y) % _SIDE)
        np.add.at(way, here, turned * share)
        np.add.at(amount, here, lengths * share)
    return np.asarray(way / np.maximum(amount, 1.0))
