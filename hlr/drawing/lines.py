"""The lines of a drawing: held by the kernel, made into records on first use."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.values import LateRecords
from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.line import Bounds, Line, Points
from hlr.tables.line_classes import LINE_CLASSES, names

POLYLINE, STRAIGHT, ARC, QUADRATIC, CUBIC = range(5)
"""Forms of lines, as the kernel names them."""


class Lines(LateRecords[Line]):
    """Lines that the kernel holds, as a sequence of records."""

    __slots__ = ("held",)

    def __init__(self, held: _kernel.Lines) -> None:
        super().__init__()
        self.held = held

    def made(self) -> tuple[Line, ...]:
        """All of them as records."""
        return tuple(_records(**self.held.columns()))

    def __len__(self) -> int:
        return len(self.held)


def held(lines: Sequence[Line]) -> _kernel.Lines:
    """The same lines as the kernel holds them."""
    if isinstance(lines, Lines):
        return lines.held
    curves = [_numbers(line.curve) for line in lines]
    return _kernel.Lines(
        np.array([LINE_CLASSES[line.kind].number for line in lines], np.uint8),
        np.array([line.visible for line in lines], bool),
        np.array(
            [[_tie(n) for n in (line.part, line.edge, line.face, line.other)] for line in lines], np.int32
        ).reshape(-1, 4),
        _starts([line.points for line in lines]),
        _together([line.points for line in lines], 2),
        _together([line.points3 for line in lines], 3),
        np.array([form for form, _ in curves], np.uint8),
        _starts([numbers for _, numbers in curves]),
        np.concatenate([np.zeros(0), *(numbers for _, numbers in curves)]),
    )


def divided(lines: Sequence[Line], sets: npt.NDArray[np.int64], count: int) -> list[_kernel.Lines]:
    """The lines of each of `count` sets, in their order; sets (parts,): the set of each part."""
    whole = held(lines)
    if count == 1:
        return [whole]
    columns = whole.columns()
    own = sets[columns["ties"][:, 0]] if len(whole) else np.zeros(0, np.int64)
    return _divided(columns, own, count)


def shifted_together(views: Sequence[tuple[Sequence[Line], Points, int]], apart: str) -> tuple[Lines, Lines]:
    """The lines of several views on one page: those of other kinds than `apart`, and those of that kind.

    views: lines, by how many mm (2,) they are shifted, and what is added to the numbers of their parts
    """
    each = [_shifted(*view) for view in views]
    whole = {name: np.concatenate([columns[name] for columns in each]) for name in each[0]}
    for name in ("offsets", "data_offsets"):
        lengths = np.concatenate([np.diff(columns[name]) for columns in each])
        whole[name] = np.concatenate([[0], np.cumsum(lengths)])
    own = (whole["kind"] == LINE_CLASSES[apart].number).astype(np.int64)
    others, those = _divided(whole, own, 2)
    return Lines(others), Lines(those)


def _shifted(lines: Sequence[Line], shift: Points, first_part: int) -> dict[str, Any]:
    columns = dict(held(lines).columns())
    ties, form, lengths = columns["ties"], columns["form"], np.diff(columns["data_offsets"])
    known = np.array([True, False, False, True]) & (ties >= 0)
    columns["ties"] = (ties + first_part * known).astype(np.int32)
    columns["points"] = columns["points"] + shift
    # Of an arc the centre moves, of Bezier curves all points.
    moving = np.where(form == ARC, 2, np.where(form > ARC, lengths, 0))
    place = np.arange(len(columns["data"])) - np.repeat(columns["data_offsets"][:-1], lengths)
    columns["data"] = columns["data"] + np.where(place < np.repeat(moving, lengths), shift[place % 2], 0.0)
    columns["form"] = np.where(form == STRAIGHT, POLYLINE, form).astype(np.uint8)
    return columns


def _divided(columns: dict[str, Any], own: npt.NDArray[np.int64], count: int) -> list[_kernel.Lines]:
    """The lines of each of `count` sets, in their order; own: the set of each line."""
    order = np.argsort(own, kind="stable")
    ends = np.searchsorted(own[order], np.arange(count + 1))
    for name in ("kind", "visible", "ties", "form"):
        columns[name] = columns[name][order]
    for name, ragged in (("offsets", ("points", "points3")), ("data_offsets", ("data",))):
        offsets = columns[name].astype(np.int64)
        lengths = np.diff(offsets)[order]
        columns[name] = np.concatenate([[0], np.cumsum(lengths)])
        rows = np.arange(columns[name][-1]) + np.repeat(offsets[:-1][order] - columns[name][:-1], lengths)
        for array in ragged:
            columns[array] = columns[array][rows]
    return [_cut(columns, first, last) for first, last in pairwise(ends.tolist())]


def _cut(columns: dict[str, Any], first: int, last: int) -> _kernel.Lines:
    """The lines from `first` up to `last`."""
    out = {name: columns[name][first:last] for name in ("kind", "visible", "ties", "form")}
    for name, ragged in (("offsets", ("points", "points3")), ("data_offsets", ("data",))):
        offsets = columns[name][first : last + 1]
        out[name] = (offsets - offsets[0]).astype(np.int32)
        out |= {array: columns[array][offsets[0] : offsets[-1]] for array in ragged}
    return _kernel.Lines(**out)


def bounds_of(lines: Sequence[Line]) -> Bounds:
    """Around all lines; all zero where there are none."""
    return Bounds(*(held(lines).bounds() or (0.0, 0.0, 0.0, 0.0)))


def _tie(number: int | None) -> int:
    return -1 if number is None else number


def _numbers(curve: Curve | None) -> tuple[int, Any]:
    """The form of a line, and the numbers of its curve."""
    if curve is None:
        return POLYLINE, np.zeros(0)
    if isinstance(curve, Arc):
        return ARC, np.concatenate([curve.centre, curve.axes.ravel(), curve.angles])
    return QUADRATIC if curve.degree == 2 else CUBIC, curve.points.ravel()


def _starts(arrays: list[Any]) -> Any:
    return np.cumsum([0, *map(len, arrays)], dtype=np.int32)


def _together(arrays: list[Any], width: int) -> Any:
    return np.ascontiguousarray(np.concatenate([np.zeros((0, width)), *arrays]), np.float64)


def _records(  # noqa: PLR0913 - one for each array of the kernel
    *,
    kind: Any,
    visible: Any,
    ties: Any,
    offsets: Any,
    points: Any,
    points3: Any,
    form: Any,
    data_offsets: Any,
    data: Any,
) -> Iterator[Line]:
    for array in (points, points3, data):
        array.flags.writeable = False
    at, of, classes = offsets.tolist(), data_offsets.tolist(), names()
    columns = zip(kind.tolist(), visible.tolist(), ties.tolist(), form.tolist(), strict=True)
    for i, (what, seen, (part, edge, face, other), shape) in enumerate(columns):
        first, last = at[i], at[i + 1]
        yield Line(
            classes[what],
            seen,
            part,
            edge if edge >= 0 else None,
            face if face >= 0 else None,
            points[first:last],
            points3[first:last],
            other if other >= 0 else None,
            curve_of(shape, data[of[i] : of[i + 1]]) if shape > STRAIGHT else None,
        )


def curve_of(form: int, numbers: Any) -> Curve:
    """The curve of a line of this form, above STRAIGHT, from its numbers."""
    if form == ARC:
        return Arc(numbers[:2], numbers[2:6].reshape(2, 2), numbers[6:8])
    return Bezier(2 if form == QUADRATIC else 3, numbers.reshape(-1, 2))
