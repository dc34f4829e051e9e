"""A job, one source to be drawn in some views, and its outcome: plain data that can be sent to another process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

OF_PARTS = ("only", "hide", "uncut")
"""Options that are patterns of parts."""

View = str | tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Job:
    """One source in some views, with one set of options.

    root             the folder that all paths start from, absolute
    source           path of the source, seen from the root, with / between folders
    views, formats   each drawing is written in each format
    files            paths of the files, seen from the folder of outputs: drawings by formats
    options          fields of `hlr.Options`
    depends          paths of files that the source depends on besides, seen from the root
    time_limit_s     seconds after which the job is given up
    memory_limit_mb  megabytes of memory above which the job is given up
    rule             where the manifest asks for it: keys that lead to its table
    arrange          the method by which all views are arranged on one page; empty: each view is a drawing
    printed          of such a page: template (its path, seen from the root), texts and room, those that are given
    is_shared        whether its options are for other sources as well, which may have parts that this one has not
    """

    root: str
    source: str
    views: tuple[View, ...]
    formats: tuple[str, ...]
    files: tuple[tuple[str, ...], ...]
    options: Mapping[str, Any] = field(default_factory=dict)
    depends: tuple[str, ...] = ()
    time_limit_s: float = 600.0
    memory_limit_mb: float = 4000.0
    rule: tuple[str | int, ...] = ()
    arrange: str = ""
    printed: Mapping[str, Any] = field(default_factory=dict)
    is_shared: bool = False

    @property
    def title(self) -> str:
        """What the job is called in messages: the source, and the parameters of a script."""
        return " ".join((self.source, *(f"{name}={value}" for name, value in self.parameters.items())))

    @property
    def drawings(self) -> tuple[View, ...]:
        """What each drawing shows: a view, or all of them, arranged by a method."""
        if self.arrange:
            return (self.arrange,)
        # Pairs of a view and a place; in a table each view is cut once.
        section, whole = self.options.get("section"), self.options.get("whole", ())
        if isinstance(section, list | tuple) or whole:
            from hlr.batch.request import names_of_drawings

            return names_of_drawings(section, self.views, whole)
        return self.views

    @property
    def parameters(self) -> Mapping[str, Any]:
        """Values for the parameters of a script."""
        return self.options.get("parameters") or {}


@dataclass(frozen=True, slots=True)
class Failure:
    """Why nothing was drawn: the kind of the error, and one sentence."""

    kind: str
    message: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a job.

    failure         None: it was drawn
    drawings        facts of each drawing, as they stand in the report
    contents        of each file: drawings by formats
    depends         files that the source pulled in: paths seen from the root, or absolute outside it
    missed          files that are not there, and that it would pull in if they were: paths of the same kind
    printed         the end of what a script has printed that fails
    seconds         by the clock
    peak_memory_mb  the most memory that the job took; 0: unknown
    """

    failure: Failure | None = None
    drawings: tuple[dict[str, Any], ...] = ()
    contents: tuple[tuple[bytes, ...], ...] = ()
    depends: tuple[str, ...] = ()
    seconds: float = 0.0
    peak_memory_mb: float = 0.0
    missed: tuple[str, ...] = ()
    printed: str = ""

    @property
    def warned(self) -> bool:
        """Whether a note of a drawing is a warning."""
        return any(note["warning"] for drawing in self.drawings for note in drawing["notes"])


def failed(kind: str, message: str, seconds: float = 0.0) -> Outcome:
    """The outcome of a job that drew nothing."""
    return Outcome(Failure(kind, message), seconds=seconds)
