"""Checks that every request, however odd, ends in a drawing or in an HlrError of one sentence.

For requests that are clearly right or clearly wrong, `verdict` and `is_a_model` give the expected answer without
running the program. For those in between they give None.
"""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

import numpy as np

import hlr


def drawn_or_refused(source: Any, view: Any = "iso", *, longest: int = 300, **options: Any) -> bool:
    """True if it was drawn, False if it was refused in at most `longest` characters; other errors are raised."""
    try:
        drawing = hlr.draw(source, view, **options)
    except hlr.HlrError as error:
        text = str(error)
        assert text
        assert "\n" not in text
        assert "Traceback" not in text
        assert len(text) < longest
        return False
    for line in drawing.lines:
        assert np.isfinite(line.points).all()
        assert np.isfinite(line.points3).all()
        assert len(line.points) >= 2
    return True


NAMES = ("front", "back", "left", "right", "top", "bottom", "iso")


def checked(source: Any, view: Any = "iso", *, right: bool | None = None, longest: int = 300, **options: Any) -> bool:
    """`drawn_or_refused`, with a check that the answer is `right`, unless that is None."""
    drawn = drawn_or_refused(source, view, longest=longest, **options)
    assert right in (None, drawn), f"{'drawn' if drawn else 'refused'}: {view!r}, {options!r}"
    return drawn


def verdict(view: Any = "iso", **options: Any) -> bool | None:
    """Whether a sound model of some tens of millimetres can be drawn so; None where that is a matter of degree."""
    answers = [_view(view, options.get("up")), *(_JUDGES[name](value) for name, value in options.items())]
    if options.get("fit") is not None and options.get("scale", 1.0) != 1.0:
        answers.append(False)
    if options.get("strict"):
        answers.append(None)
    if False in answers:
        return False
    return None if None in answers else True


def is_a_model(points: Any, faces: Any) -> bool | None:
    """Whether arrays hold a triangle that is large enough to be drawn; None where that is a matter of degree."""
    points, faces = np.asarray(points, float), np.asarray(faces)
    if not (np.abs(points) <= 1e3).all():
        return None
    a, b, c = (points[faces[:, k]] for k in range(3))
    return True if (np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1.0).any() else None


def _real(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _vector(value: Any, length: int = 3) -> bool:
    return isinstance(value, (tuple, list)) and len(value) == length and all(_real(v) for v in value)


def _between(low: float, high: float, least: float, most: float, none: bool) -> Any:
    """A check of a number: right from low to high; wrong at or below `least`, above `most`, or if it is no number."""

    def judge(value: Any) -> bool | None:
        if value is None:
            return none
        if not _real(value) or not math.isfinite(value) or value < least or value > most:
            return False
        return True if low <= value <= high else None

    return judge


def _flag(value: Any) -> bool | None:
    if isinstance(value, bool):
        return True
    return None if isinstance(value, (Real, np.ndarray)) else False


def _view(view: Any, up: Any) -> bool | None:
    if isinstance(view, str):
        if view not in NAMES:
            return None if view.strip().lower() in NAMES else False
        return True if up is None else _apart(up)
    if not _vector(view) or not all(map(math.isfinite, view)) or not any(view):
        return False if not isinstance(view, np.ndarray) else None
    sound = 1e-3 < math.hypot(*view) < 1e3
    # Along z a view needs another "up", which it finds by itself.
    return True if sound and up is None else None


def _up(value: Any) -> bool | None:
    if value is None:
        return True
    if isinstance(value, np.ndarray):
        return None
    return None if _vector(value) and all(map(math.isfinite, value)) and any(value) else False


def _apart(up: Any) -> bool | None:
    """Whether a direction stands well off all axes and diagonals that named views look along."""
    if not _vector(up) or not all(map(math.isfinite, up)):
        return False
    size = math.hypot(*up)
    if not 1e-3 < size < 1e3:
        return None
    unit = np.array(up) / size
    along = [*np.eye(3), *(np.array([x, y, z]) / math.sqrt(3.0) for x in (1, -1) for y in (1, -1) for z in (1, -1))]
    return True if max(abs(float(unit @ a)) for a in along) < 0.99 else None


def _fit(value: Any) -> bool | None:
    if value is None:
        return True
    if isinstance(value, np.ndarray):
        return None
    if not _vector(value, 2) or not all(math.isfinite(v) and v > 0.0 for v in value):
        return False
    return True if all(1.0 <= v <= 1e4 for v in value) else None


def _window(value: Any) -> bool | None:
    if value is None:
        return True
    if isinstance(value, np.ndarray):
        return None
    if not _vector(value, 4) or not all(math.isfinite(v) for v in value):
        return False
    if value[2] <= value[0] or value[3] <= value[1]:
        return False
    return True if max(map(abs, value)) <= 1e6 and value[2] - value[0] > 1 and value[3] - value[1] > 1 else None


def _threads(value: Any) -> bool | None:
    if not isinstance(value, int) or isinstance(value, bool):
        return None if isinstance(value, np.integer) else False
    return 0 <= value <= 1024


def _perspective(value: Any) -> bool | None:
    if value is None:
        return True
    if not isinstance(value, hlr.Perspective):
        return False
    fov = value.fov
    if fov is not None and (not _real(fov) or not 0.01 <= fov <= 170.0):
        return False
    for point in (value.eye, value.target):
        if point is not None and (not _vector(point) or not all(map(math.isfinite, point))):
            return False
    return True if value.eye is None and value.target is None and (fov is None or 1.0 <= fov <= 100.0) else None


_JUDGES: dict[str, Any] = {
    **dict.fromkeys(("seam", "intersections", "fill", "circles", "strict"), _flag),
    # What is left to the kind of view may be None.
    **dict.fromkeys(("hidden", "smooth"), lambda value: True if value is None else _flag(value)),
    "scale": _between(1e-3, 1e3, 1e-9, 1e9, False),
    "accuracy": _between(1e-4, 10.0, 5e-324, math.inf, True),
    "crease": _between(0.0, 180.0, 0.0, 180.0, False),
    "within": _between(1.0, 100.0, 5e-324, math.inf, True),
    "fit": _fit,
    "window": _window,
    "up": _up,
    "threads": _threads,
    "perspective": _perspective,
}
JUDGED = frozenset(_JUDGES)
"""The options that `verdict` knows."""
