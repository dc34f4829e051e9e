"""How far a finished drawing is from the truth, class of error by class of error, in millimetres on paper.

>>> from hlr.lab.measure import measured
>>> reached = measured("part.step", drawing)
>>> reached.worst, reached.kept(0.05)

A drawing is measured against references that the pipeline does not use: OpenCASCADE's own curves and surfaces, rays,
and a finer drawing. `README.md` beside this file says how each class is measured and what was found.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hlr.drawing.reached import Errors, Labels, Reached
    from hlr.lab.measure.classes import measured

__all__ = ["Errors", "Labels", "Reached", "measured"]

_HOME = {"Errors": "reached", "Labels": "reached", "Reached": "reached", "measured": "classes"}


def __getattr__(name: str) -> Any:
    if name in _HOME:
        from importlib import import_module

        return getattr(import_module(f"hlr.lab.measure.{_HOME[name]}"), name)
    raise AttributeError(f"module 'hlr.lab.measure' has no attribute '{name}'")
