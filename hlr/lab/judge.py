"""The interface of the judges, which measure how far a drawing is from the truth.

A judge is made once, from its reference, and then judges drawing by drawing. It makes none of the drawings it judges,
and a verdict does not depend on other drawings.

study.judge.LineJudge        compares polylines of any program with the lines of the finest drawing
measure.classes.ModelJudge   compares our drawings with OpenCASCADE's curves and surfaces, rays, and a finer drawing

The referee of `tests/peers` is a third judge. It shares no code with hlr, on purpose.
"""

from __future__ import annotations

from typing import Protocol, TypeVar, runtime_checkable

Drawn_contra = TypeVar("Drawn_contra", contravariant=True)
Found_co = TypeVar("Found_co", covariant=True)


@runtime_checkable
class Judge(Protocol[Drawn_contra, Found_co]):
    """Measures how far drawings are from one reference."""

    def judge(self, drawn: Drawn_contra, /) -> Found_co:
        """The errors of one drawing; lengths in millimetres on paper."""
