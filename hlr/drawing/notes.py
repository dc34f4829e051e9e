"""Notes: warnings and remarks on a drawing. Each has a code for programs and a sentence for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from hlr.tables.entry import listed

NoteCode = Literal[
    "part-left-out",
    "references-missing",
    "triangles-left-out",
    "wires-left-out",
    "free-edges-left-out",
    "annotation-left-out",
    "colors-left-out",
    "hidden-objects-left-out",
    "page-items-left-out",
    "not-meshed",
    "faces-mended",
    "loops-crossed",
    "loops-turned",
    "faces-folded",
    "surfaces-torn",
    "faces-too-coarse",
    "faces-off-edges",
    "defects",
    "more-defects",
    "open-surfaces",
    "paper-size",
    "page-too-small",
    "room-unknown",
    "nothing-in-view",
    "section-not-cut",
    "section-not-hatched",
    "section-not-marked",
    "section-marks-close",
    "parts-repeated",
    "over-time",
    "script-shape",
    "stray-parts",
    "style-unused",
    "pattern-unused",
    "glass-hides",
    "depth-coarse",
    "cut-short",
    "thin-lines",
    "crowded",
    "details-left-out",
]
"""All codes there are; `CODES` says what each means."""

CODES: dict[NoteCode, str] = {
    "part-left-out": "a part holds nothing that could be drawn",
    "references-missing": "files that a STEP file refers to are not there; parts of the model are in them",
    "triangles-left-out": "triangles of a mesh are degenerate, or their corners are no numbers or do not exist",
    "wires-left-out": "a file has parts that are edges without faces, beside others with faces: they may be wanted",
    "free-edges-left-out": "a part of a file has edges without faces beside it: construction lines, axes, sketches",
    "annotation-left-out": "faces that a STEP file hides, or calls supplemental geometry, were left out as annotation",
    "colors-left-out": "colours of a FreeCAD object are damaged, and it is drawn without them",
    "hidden-objects-left-out": "objects that a FreeCAD document hides were left out",
    "page-items-left-out": "something on a page of a FreeCAD document, or of a template, is not drawn",
    "not-meshed": "faces or a whole part could not be triangulated, or not all of a face",
    "faces-mended": "outlines of faces are broken in the model: OpenCASCADE meshed them, if need be mended",
    "loops-crossed": "outlines or holes of faces cross or touch in the model; what they run around is drawn",
    "loops-turned": "outlines or holes of faces run the wrong way round in the model; they are drawn as they are meant",
    "faces-folded": "faces lie on one another beside an edge: one may have been read as the rest of its surface",
    "surfaces-torn": "surfaces of faces fold over themselves or jump in the model; they are drawn as they are",
    "faces-too-coarse": "faces take too much work to mesh them as finely as needed; their meshes are coarser",
    "faces-off-edges": "faces lie off their own edges in the model, by more than half of the accuracy",
    "defects": "a part is drawn as it is, though it is open, doubled, turned inside out or the like",
    "more-defects": "more parts have defects than are named",
    "open-surfaces": "a part of a CAD model holds faces and no solid, and is open, as surface models are",
    "paper-size": "at the scale that was asked for, the drawing is very small or very large",
    "page-too-small": "at the scale that was asked for, the drawing is larger than its page inside the margins",
    "room-unknown": "the template of a page does not say where views may lie: they may lie on its title block",
    "nothing-in-view": "there is not a line in the drawing",
    "section-not-cut": "a part cannot be cut, and a section therefore shows it whole",
    "section-not-hatched": "the plane of a section cuts no part, or parts that are not closed",
    "section-not-marked": "no view of a page sees the plane of a section from its edge, so that none shows where it is",
    "section-marks-close": "cutting lines of sections are so close together that their marks have no room side by side",
    "parts-repeated": "equal parts lie in one place",
    "over-time": "reading and the coarsest drawing took longer than the time that was given",
    "script-shape": "which of its shapes a script has shown, or is taken to have meant",
    "stray-parts": "a few parts far from the rest make the drawing several times as large",
    "style-unused": "a style has a rule for parts that the model does not have",
    "pattern-unused": "options of a batch that several sources share name parts that the model does not have",
    "glass-hides": "transparent parts hide what is behind them: `see_through` was not asked for",
    "depth-coarse": "depths of a preview tie that lie a pixel apart or more: the model is very deep",
    "cut-short": "the file ends too early: some of the model may be missing",
    "thin-lines": "lines are close together and drawn with thinner pens",
    "crowded": "lines are closer together than twice their width even with the thinnest pens",
    "details-left-out": "lines that the pen cannot show were left out: too small, or between others that are too close",
}
"""What each code means. A code keeps its meaning; new ones may be added."""

REMARKS: frozenset[NoteCode] = frozenset(
    {
        "annotation-left-out",
        "crowded",
        "details-left-out",
        "faces-mended",
        "faces-off-edges",
        "free-edges-left-out",
        "glass-hides",
        "hidden-objects-left-out",
        "loops-turned",
        "open-surfaces",
        "paper-size",
        "parts-repeated",
        "pattern-unused",
        "room-unknown",
        "script-shape",
        "section-marks-close",
        "section-not-hatched",
        "section-not-marked",
        "stray-parts",
        "style-unused",
        "thin-lines",
    }
)
"""Codes of remarks: the drawing is what was asked for. `strict` does not make errors of them."""

OF_BORDERS: frozenset[NoteCode] = frozenset({"defects", "more-defects", "open-surfaces"})
"""Codes of notes that count border edges: of a model that was cut they say something else than of the model."""

NAME_THEIR_VIEW: frozenset[NoteCode] = frozenset({*OF_BORDERS, "section-not-cut", "section-not-hatched"})
"""Codes of notes that are of the model, or else name the section that they are of."""


@dataclass(frozen=True, slots=True)
class Note:
    """A warning or a remark.

    code  what kind it is, for programs: one of `CODES`
    text  one sentence that says what happened, for people; also `str(note)`

    >>> import hlr
    >>> (note,) = hlr.draw(([(0, 0, 0), (30, 0, 0), (0, 20, 0)], [(0, 1, 2)])).notes
    >>> note.code, note.is_warning, str(note)
    ('defects', True, 'Part "part" is drawn as it is: open: 3 border edges.')
    """

    code: NoteCode
    text: str

    @property
    def is_warning(self) -> bool:
        """Whether the drawing may not be what was meant: an error where `strict` asks for it."""
        return self.code not in REMARKS

    def __str__(self) -> str:
        return self.text

    def as_dict(self) -> dict[str, str]:
        """For JSON."""
        return {"code": self.code, "text": self.text}


Noted = Callable[[Sequence[Note]], None]
"""Called with notes as soon as they are known."""


def of_each_view(names: Sequence[str], notes: Sequence[Sequence[Note]]) -> list[Note]:
    """The notes of several views, each once.

    A note that not all views have begins with the names of those that have it, unless it names a section itself or is
    of the model, which is another in a section.
    """
    found: dict[Note, list[str]] = {}
    for name, own in zip(names, notes, strict=True):
        for note in dict.fromkeys(own):
            found.setdefault(note, []).append(name)
    out = []
    for note, views in found.items():
        of_some = len(views) < len(names) and note.code not in NAME_THEIR_VIEW
        which = f"view{'s' if len(views) > 1 else ''} {listed(views, 'and')}: " if of_some else ""
        out.append(replace(note, text=which + note.text))
    return out
