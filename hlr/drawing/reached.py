"""The measured errors of a drawing: a figure per class of error, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from hlr.common.types import Floats

CLASSES = ("edges", "outlines", "meshes", "intersections", "changes", "grazing", "lost")
"""Classes of error that have a single figure; the names are fields of `Reached`."""

USUAL = 0.99
"""Share of what was measured that is at most `Errors.usual`."""


@dataclass(frozen=True, slots=True)
class Errors:
    """One class of error: millimetres on paper.

    worst   the largest; None: not measured, and `why` says the reason
    usual   99 of 100 are at most this
    count   how many were measured: points of curves, changes, lines
    why     there is none; None: there is
    where   where the largest is, for people
    """

    worst: float | None
    usual: float | None = None
    count: int = 0
    why: str | None = None
    where: str | None = None


@dataclass(frozen=True, slots=True)
class Labels:
    """Lines judged by rays.

    share    of the length judged, 0 to 1, that is drawn visible where all rays are blocked, or hidden where none is
    longest  the longest such stretch, millimetres on paper
    judged   length judged, millimetres on paper
    why      nothing was judged; None: something was
    where    where the longest stretch is, for people
    """

    share: float | None
    longest: float | None = None
    judged: float = 0.0
    why: str | None = None
    where: str | None = None


def errors(values: Floats, where: Sequence[str] | None = None) -> Errors:
    """Errors of one class, from (n,) single ones in millimetres; `where` names the place of each."""
    if len(values) == 0:
        return Errors(None, why="the drawing has none")
    worst = int(np.argmax(values))
    return Errors(
        worst=float(values[worst]),
        usual=float(np.quantile(values, USUAL, method="higher")),
        count=len(values),
        where=None if where is None else where[worst],
    )


@dataclass(frozen=True, slots=True)
class Reached:
    """The measured errors of a drawing. Lengths are millimetres on paper.

    accuracy       what the drawing promised
    edges          written curves of model edges, to the edges' true curves
    outlines       written outlines, to where the true surface is seen edge-on
    meshes         written lines of meshes, to the mesh's own edges
    intersections  written lines in which surfaces meet, to where finer tessellations of both cross
    changes        visibility changes, along their line, to those of the finer drawing
    grazing        those changes that the geometry makes ill-conditioned: only `bound` is promised
    bound          longest stretch of a line on which a shift by less than the accuracy would change visibility
    lost           longest stretch of a line of the finer drawing that is not drawn
    short          shortest figure drawn on its own
    labels         visible and hidden, judged by rays
    seconds        that measuring took
    """

    accuracy: float
    edges: Errors
    outlines: Errors
    meshes: Errors
    intersections: Errors
    changes: Errors
    grazing: Errors
    bound: float | None
    lost: Errors
    short: Errors
    labels: Labels
    seconds: float = field(default=0.0, compare=False)

    @property
    def worst(self) -> float:
        """The largest of all errors that the accuracy promises to bound; 0 where none was measured."""
        classes = (self.edges, self.outlines, self.meshes, self.intersections, self.changes, self.lost)
        found = [e.worst for e in classes if e.worst is not None]
        return max([*found, *([] if self.labels.longest is None else [self.labels.longest])], default=0.0)

    def kept(self, promise: float | None = None) -> bool:
        """Whether nothing that was measured exceeds a promise in millimetres; None: the drawing's own accuracy."""
        promise = self.accuracy if promise is None else promise
        return self.worst <= promise and (self.short.worst is None or self.short.worst >= self.accuracy)

    def figures(self) -> dict[str, float]:
        """The worst of each class that was measured, the longest mislabelled stretch, the shortest figure."""
        found = {name: getattr(self, name).worst for name in CLASSES}
        found |= {"bound": self.bound, "mislabelled": self.labels.longest, "shortest": self.short.worst}
        return {name: value for name, value in found.items() if value is not None}

    def as_dict(self) -> dict[str, Any]:
        """For JSON: what was not measured is null, with the reason beside it. Without `seconds`, which differ."""
        fields = asdict(self)
        del fields["seconds"], fields["accuracy"]
        for name, value in fields.items():
            if isinstance(value, dict):
                fields[name] = {k: v for k, v in value.items() if v is not None or k in ("worst", "share")}
        return fields
