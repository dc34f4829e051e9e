"""Records of what to measure and of what was measured: they pass between the study and its processes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from hlr.request.options import View

ACCURACIES = (2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
"""Millimetres on paper."""

PIXELS = (512, 1024, 2048, 4096, 8192)
"""Along the longer side of the depth buffer."""

PREDICATES = (0.5, 0.05, 0.005)
"""Accuracies at which the kinds of arithmetic are compared."""

HLR, POLY, EXACT, ZBUFFER = "hlr", "OCCT PolyAlgo", "OCCT exact", "z-buffer"
WHO = (HLR, POLY, EXACT, ZBUFFER)

STAGES = ("source", "tessellate", "scene", "plan", "visibility", "linework", "write")
"""Of every contestant, where it has them: read, triangulate, prepare, decide, hide, gather the lines, write an SVG."""

TIMED = STAGES[1:-1]
"""What a contestant is charged with: from the shape in memory to the lines in memory."""


@dataclass(frozen=True, slots=True)
class Job:
    """One measurement.

    work      one of `WHO`, or "look" (how large it is), "truth" (the lines that all are judged by), "judge",
              "arithmetic", "reached"
    source    path of the model
    view      a name, or a direction from the object toward the viewer
    setting   accuracy in millimetres, or pixels of the depth buffer
    scale     paper : model; None: as large as fits
    fit       (width, height) millimetres
    folder    where lines are kept for the judge; name: under which
    runs      how often a contestant draws, if that is quick
    limit     seconds of processor time for all
    only, hide, var, annotations   which parts, as of a drawing (`hlr.Options`)
    """

    work: str
    source: str
    view: View = "iso"
    setting: float = 0.0
    scale: float | None = None
    fit: tuple[float, float] | None = None
    folder: str = ""
    name: str = ""
    runs: int = 1
    limit: float = 60.0
    only: Sequence[str] = ()
    hide: Sequence[str] = ()
    var: str | None = None
    annotations: bool = False

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


@dataclass(slots=True)
class Cost:
    """What one stage took: seconds by the clock and of all processors, and the most memory in MB while it ran."""

    wall: float = 0.0
    cpu: float = 0.0
    memory: float = 0.0


@dataclass(slots=True)
class Point:
    """One contestant at one setting.

    accuracy  millimetres on paper that were asked for: of a depth buffer a pixel; None: there is nothing to ask for
    failure   why there are no figures, in a sentence; None: there are
    stages    by name, medians over `runs`
    errors    what the judge found, by name; millimetres on paper, shares as fractions
    reached   what `hlr.lab.measure` found, of our own drawings
    """

    who: str
    setting: float
    accuracy: float | None = None
    failure: str | None = None
    runs: int = 0
    stages: dict[str, Cost] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    errors: dict[str, float] = field(default_factory=dict)
    reached: dict[str, Any] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """From the shape in memory to the lines in memory, by the clock."""
        return sum(self.stages[s].wall for s in TIMED if s in self.stages)

    @property
    def processor(self) -> float:
        """The same of all processors together: other programs on the machine hardly disturb it."""
        return sum(self.stages[s].cpu for s in TIMED if s in self.stages)

    @property
    def memory(self) -> float:
        """MB at most, after reading."""
        return max((self.stages[s].memory for s in TIMED if s in self.stages), default=0.0)

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def point_of(data: dict[str, Any]) -> Point:
    """The record that `as_dict` gave."""
    return Point(**{**data, "stages": {name: Cost(**cost) for name, cost in data["stages"].items()}})


def label(who: str, setting: float) -> str:
    """A contestant at a setting, for people."""
    if who == EXACT:
        return who
    return f"{who} at {setting:.0f} pixels" if who == ZBUFFER else f"{who} at {setting:g} mm"
