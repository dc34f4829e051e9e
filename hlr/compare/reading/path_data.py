"""The path data of SVG: from text to straight lines, cubic curves and arcs."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from hlr.compare.lines.sketch import Pair, Sketch
from hlr.compare.reading.affine import Y_UP, Affine

_TOKEN = re.compile(r"[MLHVCSQTAZmlhvcsqtaz]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_ALLOWED = re.compile(r"[MLHVCSQTAZmlhvcsqtaz0-9eE+\-.,\s]*")
_NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


def add_path(sketch: Sketch, text: str, to_paper: Affine = Y_UP) -> None:
    """Add what a path draws to the line that was begun. Raises ValueError for what is no path data."""
    if _ALLOWED.fullmatch(text) is None:
        raise ValueError("it has a letter that no path has")
    pen = _Pen(sketch, to_paper)
    for command, numbers in _commands(text):
        pen.draw(command, numbers)
    pen.lift()


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """Each command with as many numbers as it takes; a letter that is left out is repeated."""
    tokens = _TOKEN.findall(text)
    at, command = 0, ""
    while at < len(tokens):
        if tokens[at].isalpha():
            command, at = tokens[at], at + 1
        elif not command or command in "Zz":
            raise ValueError("a number stands without its command")
        count = _NUMBERS[command.upper()]
        try:
            numbers = [float(each) for each in tokens[at : at + count]]
        except ValueError:
            numbers = []
        if len(numbers) < count:
            raise ValueError(f"the command {command} has too few numbers")
        at += count
        yield command, numbers
        command = {"M": "L", "m": "l"}.get(command, command)


class _Pen:
    """Follows a path. Straight lines in a row become one polyline."""

    def __init__(self, sketch: Sketch, to_paper: Affine) -> None:
        self._sketch = sketch
        self._to_paper = to_paper
        self._here: Pair = (0.0, 0.0)
        self._first: Pair = (0.0, 0.0)
        self._row: list[Pair] = []
        self._control: tuple[str, Pair] | None = None

    def draw(self, command: str, n: list[float]) -> None:
        name, control = command.upper(), self._control
        x, y = self._here
        p, q = (0.0, 0.0) if command.isupper() else (x, y)
        self._control = None
        if name in "MLHVZ":
            self._straight(name, n, p, q)
            return
        pairs = [(n[k] + p, n[k + 1] + q) for k in range(0, len(n) - 1, 2)] if name != "A" else []
        self.lift()
        if name == "A":
            self._arc(n, (n[5] + p, n[6] + q))
            return
        if name in "ST":
            of = "CS" if name == "S" else "QT"
            mirrored = control is not None and control[0] in of
            c = control[1] if control is not None and mirrored else self._here
            pairs.insert(0, (2.0 * x - c[0], 2.0 * y - c[1]))
        self._control = (name, pairs[-2])
        if name in "QT":
            (a, b), end = pairs[0], pairs[1]
            first = (x + (a - x) * 2.0 / 3.0, y + (b - y) * 2.0 / 3.0)
            second = (end[0] + (a - end[0]) * 2.0 / 3.0, end[1] + (b - end[1]) * 2.0 / 3.0)
            pairs = [first, second, end]
        self._sketch.cubic(*map(self._to_paper.point, (self._here, *pairs)))
        self._here = pairs[-1]

    def lift(self) -> None:
        """End the polyline that is being drawn."""
        if len(self._row) > 1:
            self._sketch.polyline([self._to_paper.point(each) for each in self._row])
        self._row = []

    def _straight(self, name: str, n: list[float], p: float, q: float) -> None:
        x, y = self._here
        if name == "M":
            self.lift()
            self._here = self._first = (n[0] + p, n[1] + q)
            return
        if not self._row:
            self._row = [self._here]
        if name == "Z":
            self._here = self._first
        else:
            self._here = (x if name == "V" else n[0] + p, y if name == "H" else n[-1] + q)
        self._row.append(self._here)

    def _arc(self, n: list[float], end: Pair) -> None:
        """The arc from here to `end`, by the rules of SVG: radii that are too small grow."""
        (x0, y0), (x1, y1) = self._here, end
        rx, ry, turn, large, rising = abs(n[0]), abs(n[1]), math.radians(n[2]), n[3] != 0.0, n[4] != 0.0
        self._here = end
        if rx == 0.0 or ry == 0.0 or (x0, y0) == end:
            self._sketch.polyline([self._to_paper.point((x0, y0)), self._to_paper.point(end)])
            return
        c, s = math.cos(turn), math.sin(turn)
        hx, hy = 0.5 * (x0 - x1), 0.5 * (y0 - y1)
        u, v = (c * hx + s * hy) / rx, (-s * hx + c * hy) / ry
        size = u * u + v * v
        grow = math.sqrt(size) if size > 1.0 else 1.0
        rx, ry, u, v, size = rx * grow, ry * grow, u / grow, v / grow, min(size, 1.0)
        off = math.sqrt(max(1.0 / size - 1.0, 0.0)) * (-1.0 if large == rising else 1.0) if size > 0.0 else 0.0
        a, b = off * v, -off * u
        first = math.atan2(v - b, u - a)
        sweep = (math.atan2(-v - b, -u - a) - first) % math.tau
        if not rising:
            sweep -= math.tau
        cx = c * rx * a - s * ry * b + 0.5 * (x0 + x1)
        cy = s * rx * a + c * ry * b + 0.5 * (y0 + y1)
        axes = self._to_paper.way((c * rx, s * rx)), self._to_paper.way((-s * ry, c * ry))
        self._sketch.arc(self._to_paper.point((cx, cy)), axes, (first, first + sweep))
