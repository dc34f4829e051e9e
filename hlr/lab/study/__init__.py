"""Measures what accuracy costs, compared with OpenCASCADE, a z-buffer, and predicates in floating point.

Each point is measured in a process of its own (`child`). All programs draw the same view at the same scale, and all
drawings are compared with the same true lines (`judge`).

>>> from hlr.lab.study import Scope, study
>>> found = study("part.step", scope=Scope(accuracies=(0.5, 0.05), rivals=False))
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hlr.lab.study.job import Point
    from hlr.lab.study.sweep import Scope, Study, study

__all__ = ["Point", "Scope", "Study", "study"]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        # A child process measures its own memory: it loads no more than it uses.
        if name in __all__:
            from hlr.lab.study import sweep

            return getattr(sweep, name)
        raise AttributeError(f"module 'hlr.lab.study' has no attribute {name!r}")
