"""What every judge of drawings looks like.

A judge is made once, from what it takes for the truth, and is then asked drawing by drawing. It draws nothing that it
judges, and a verdict depends on no other drawing.

study.judge.LineJudge        holds polylines of any program against the lines of the finest drawing
measure.classes.ModelJudge   holds our drawings against OpenCASCADE's curves and surfaces, rays, and a finer drawing

The referee of `tests/peers` is a third, which shares no code with hlr on purpose.
"""

from __future__ import annotations

from typing import Protocol, TypeVar, runtime_checkable

Drawn_contra = TypeVar("Drawn_contra", contravariant=True)
Found_co = TypeVar("Found_co", covariant=True)


@runtime_checkable
class Judge(Protocol[Drawn_contra, Found_co]):
    """Says how far drawings are from one truth."""

    def judge(self, drawn: Drawn_contra, /) -> Found_co:
        """What is wrong with one drawing; lengths in millimetres on paper."""
