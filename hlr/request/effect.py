"""Effects: steps that a drawing or a picture may need. Each is decided from facts, with its reason and its cost.

An effect is one row of a table (`hlr.request.drawing_effects`, `hlr.request.picture_effects`). Before a costly step a
stage states the facts and asks the planner. An effect that is off is not done at all, and its counters stay zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any, NamedTuple

from hlr.common.printable import printable
from hlr.common.values import LateRecords

ASKED, SCENE = "asked", "scene"
"""What calls for an effect: the request, or the model and its view."""

PLAN = "the plan itself"
"""Name of the last decision: the time that finding out the facts took."""


class Facts(NamedTuple):
    """What the stages have found out. Each effect reads the few facts that its stage fills in.

    kind           of the source (`hlr.source.model.Source.kind`)
    cut            number of parts that the plane of a section cuts
    parts, groups  numbers of parts, and of groups: surfaces that the visibility pass treats as one
    curved, planar numbers of curved and of planar faces
    faces          the model has faces with equations: a B-rep
    touching       number of parts that are meshed as finely as those that may touch others
    through        number of parts whose surfaces pass through themselves
    failed         number of faces that the kernel could not mesh
    repeated       two triangles of a part have the same corners, or two of its points the same place
    borders        number of border edges of meshes: sides that only one triangle has
    meeting        number of groups whose boxes meet those of others
    folded         number of groups that are not one convex body, and may pass through themselves
    culled         number of groups that are closed and oriented outward
    convex         the whole model is one convex body
    unsound        number of groups that may pass through themselves
    sphere         the whole model is one sphere, and lines are all that is asked of its mesh
    perspective    the view is in perspective
    pictorial      the view is in perspective, or oblique to the model's axes
    crossed        number of planes of the view volume that the model crosses
    bent           number of edges and outlines that may be curved
    edges          number of edges that may be drawn
    opacity        the least opacity of a part, 0 to 1
    depth, pixel   of a picture: the smallest difference in depth it resolves, and a pixel's width; millimetres
    """

    kind: str = ""
    cut: int = 0
    parts: int = 0
    groups: int = 0
    curved: int = 0
    planar: int = 0
    faces: bool = True
    touching: int = 0
    through: int = 0
    failed: int = 0
    repeated: bool = False
    borders: int = 0
    meeting: int = 0
    folded: int = 0
    culled: int = 0
    convex: bool = False
    unsound: int = 0
    sphere: bool = False
    perspective: bool = False
    pictorial: bool = False
    crossed: int = 0
    bent: int = 0
    edges: int = 0
    opacity: float = 1.0
    depth: float = 0.0
    pixel: float = 1.0


Answer = tuple[bool, str]
"""Whether an effect is needed, and why or why not."""

Needed = Callable[[Facts, Any], Answer]
"""(facts, options) -> the answer."""


@dataclass(frozen=True, slots=True)
class Effect:
    """A row of the table. counters: those of the drawing's counters that tell its cost; zero where it is off."""

    name: str
    origin: str
    needed: Needed
    counters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision about one effect, and, after the run, its cost.

    name     the effect, such as "outlines"
    on       whether it was needed
    origin   "asked" (by the request) or "scene"
    reason   why or why not, in words
    seconds  that it took; None where the effect is no step of its own that could be timed
    counts   how much was found or done, by the names of the drawing's counters

    >>> import hlr
    >>> plan = hlr.draw("part.step").plan
    >>> next(decision.reason for decision in plan if decision.name == "perspective divide")
    'a parallel view: nothing is magnified'
    """

    name: str
    on: bool
    origin: str
    reason: str
    seconds: float | None = field(default=None, compare=False)
    counts: Mapping[str, int] = field(default_factory=dict, hash=False)

    def as_dict(self) -> dict[str, Any]:
        """For JSON; without the seconds, which differ from run to run."""
        return {
            "effect": self.name,
            "on": self.on,
            "origin": self.origin,
            "reason": self.reason,
            "counts": {name: int(value) for name, value in self.counts.items()},
        }


_FORCED: ContextVar[bool] = ContextVar("hlr_everything_on", default=False)


@contextmanager
def everything_on() -> Iterator[None]:
    """Within this block every effect that the scene decides is on: to test and to measure what leaving out saves."""
    before = _FORCED.set(True)
    try:
        yield
    finally:
        _FORCED.reset(before)


class _Deciding:
    """A block of `Planner.deciding`. A class, because a generator takes four times as long, and there are many."""

    __slots__ = ("_begin", "_planner")

    def __init__(self, planner: Planner) -> None:
        self._planner = planner

    def __enter__(self) -> None:
        self._begin = perf_counter()

    def __exit__(self, *_: object) -> None:
        self._planner.took += perf_counter() - self._begin


_NOTHING = Facts()


class Planner:
    """Decides the effects of one table on demand, and keeps each decision with its cost."""

    def __init__(self, table: Sequence[Effect], options: Any, force: bool | None = None) -> None:
        """options: the request. force: every effect that the scene decides is on; None: as `everything_on` says."""
        self._rows = {effect.name: effect for effect in table}
        self._options = options
        self._force = _FORCED.get() if force is None else force
        self._answers: dict[str, Answer] = {}
        self._stated: dict[str, Facts] = {}
        self._seconds: dict[str, float] = {}
        self._counts: dict[str, Mapping[str, int]] = {}
        self.took = 0.0

    @property
    def forced(self) -> bool:
        """Whether everything that the scene decides is on."""
        return self._force

    def on(self, name: str, facts: Facts = _NOTHING) -> bool:
        """Decide whether the effect is needed, by these facts; the last decision counts.

        What the effect has cost so far stays: a model may be meshed twice.
        """
        self._stated.pop(name, None)
        answer = self._answers[name] = self._answer(name, facts)
        return answer[0]

    def state(self, facts: Facts, *names: str) -> None:
        """State the facts for effects that no step waits for: they are decided when somebody reads the decisions."""
        for name in names:
            self._stated[name] = facts

    def _answer(self, name: str, facts: Facts) -> Answer:
        effect = self._rows[name]
        answer = effect.needed(facts, self._options)
        if self._force and not answer[0] and effect.origin == SCENE:
            return True, f"forced; else off: {answer[1]}"
        return answer

    def deciding(self) -> _Deciding:
        """A block whose time is that of finding out what to decide."""
        return _Deciding(self)

    def spent(self, name: str, seconds: float | None = None, **counts: int) -> None:
        """Add to the cost of an effect."""
        if seconds is not None:
            self._seconds[name] = self._seconds.get(name, 0.0) + seconds
        before = self._counts.get(name)
        if before:
            counts = {**before, **{key: before.get(key, 0) + value for key, value in counts.items()}}
        self._counts[name] = counts

    @contextmanager
    def timed(self, name: str) -> Iterator[None]:
        """Time what is done for an effect."""
        begin = perf_counter()
        try:
            yield
        finally:
            self.spent(name, perf_counter() - begin)

    def revised(self, name: str, on: bool, reason: str) -> None:
        """Change a decision that proved wrong while the work was done."""
        self._stated.pop(name, None)
        self._answers[name] = on, reason

    def fork(self) -> Planner:
        """A planner for one view, which begins with the decisions made for all views."""
        other = Planner((), self._options, self._force)
        other._rows, other.took = self._rows, self.took
        other._answers, other._stated = self._answers.copy(), self._stated.copy()
        other._seconds, other._counts = self._seconds.copy(), self._counts.copy()
        return other

    def cost(self, name: str) -> Mapping[str, int]:
        """The cost of an effect so far, by counter; empty where nothing was counted."""
        return self._counts.get(name, {})

    def decisions(self, counters: Mapping[str, int] | None = None) -> tuple[Decision, ...]:
        """All that was decided, in the order of the table; counters: of the finished drawing."""
        found = counters or {}
        answers = self._answers | {name: self._answer(name, facts) for name, facts in self._stated.items()}
        out = []
        for name, effect in self._rows.items():
            if name in answers:
                on, reason = answers[name]
                counted = self.cost(name)
                counts = {c: int(found.get(c, counted.get(c, 0))) for c in effect.counters}
                out.append(Decision(name, on, effect.origin, reason, self._seconds.get(name) if on else None, counts))
        out.append(Decision(PLAN, True, ASKED, "to know all this", self.took))
        return tuple(out)


class Decisions(LateRecords[Decision]):
    """The decisions of a planner that has finished. counters: those of the finished drawing."""

    __slots__ = ("_counters", "_planner")

    def __init__(self, planner: Planner, counters: Mapping[str, int]) -> None:
        super().__init__()
        self._planner, self._counters = planner, counters

    def made(self) -> tuple[Decision, ...]:
        """All of them as records."""
        return self._planner.decisions(self._counters)


def explained(decisions: Sequence[Decision]) -> str:
    """The decisions as a text table: effect, on or off, who asked, time, counts, reason."""
    rows = [("effect", "", "by", "time", "counts", "why")]
    for d in decisions:
        time = "" if d.seconds is None else f"{1000.0 * d.seconds:.1f} ms"
        counts = ", ".join(f"{value} {name.replace('_', ' ')}" for name, value in d.counts.items() if value)
        rows.append((d.name, "on" if d.on else "off", d.origin, time, counts, printable(d.reason)))
    used = [k for k in range(6) if any(row[k] for row in rows[1:])]
    widths = {k: max(len(row[k]) for row in rows) for k in used}
    lines = []
    for row in rows:
        cells = [row[k].rjust(widths[k]) if k == 3 else row[k].ljust(widths[k]) for k in used]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)
