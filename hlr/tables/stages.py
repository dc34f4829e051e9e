"""What is said of work that took too long: which of its stages took the time, and what makes that one faster.

A stage is a row. It is called as the progress that is reported.
"""

from __future__ import annotations

from dataclasses import dataclass

from hlr.common.numbers import typed
from hlr.tables.readers import Reader

READS = ("", "source")
"""Stages before anything is meshed: their time and memory have nothing to do with accuracy."""


@dataclass(frozen=True, slots=True)
class Stage:
    """A row.

    doing    in words, before "took"
    instead  what makes it faster, where that is not less accuracy
    """

    doing: str
    instead: str = ""


STAGES = {
    "": Stage("starting"),
    "source": Stage("reading it"),
    "tessellate": Stage("meshing it"),
    "section": Stage("cutting it"),
    "scene": Stage("finding its edges"),
    "visibility": Stage("finding what hides its lines"),
    "linework": Stage("drawing and writing its lines"),
    "measure": Stage("measuring the accuracy that was reached (--report)"),
    "compare": Stage("comparing the lines"),
    "FreeCAD": Stage("FreeCAD's own drawing", "take its coarse view (--coarse)"),
}

_OTHER = Stage("the work")


def given_up(
    name: str, reader: Reader | None, limit_s: float, longest: tuple[str, float], limit: str, coarser: str
) -> str:
    """The sentence on work that took too long.

    name, reader  of the source
    longest       the stage that took the longest, and its seconds
    limit         the option that sets the limit
    coarser       what else helps where accuracy takes the time, such as "ask for a larger --accuracy"; empty: nothing
    """
    stage, seconds = longest
    row = STAGES.get(stage, _OTHER)
    finer = stage in STAGES and stage not in READS
    took, advice = f"{row.doing} took {_told(seconds)} of that", row.instead or (coarser if finer else "")
    if stage == "source" and reader is not None and reader.kind == "script":
        took, advice = f"the script itself ran for {_told(seconds)} of that", "make the script faster"
    return f"{name} took longer than {limit_s:g} s and was given up; {took}: raise {limit}" + (
        f", or {advice}" if advice else ""
    )


def _told(seconds: float) -> str:
    if seconds < 0.95:
        return f"{typed(seconds, 1)} s"
    return f"{seconds:.0f} s" if seconds >= 9.95 else f"{seconds:.1f} s"
