"""Which comparisons fail: the exit code of `hlr compare`, by `--fail-on`."""

from __future__ import annotations

from typing import Literal

from hlr.compare.comparison import Comparison
from hlr.compare.difference import told

FailOn = Literal["any", "ours", "never"]
"""Any difference; only one in which hlr's own drawing of the model is wrong; none."""


def fails(found: Comparison, on: FailOn) -> bool:
    """Whether a comparison fails.

    With "ours" that is where rays on the model contradict hlr's drawing, where its page lacks a view of the other, and
    where the drawings differ and nothing of it was judged: then nothing speaks for hlr's drawing.
    """
    if on == "never" or found.same:
        return False
    return on == "any" or found.wrong_mm > 0.0 or bool(_lacking(found)) or not _judged(found)


def who_is_wrong(found: Comparison) -> str:
    """One line on hlr's own drawing, for "ours"; empty: the drawings are the same."""
    if found.same:
        return ""
    lacking = _lacking(found)
    if found.wrong_mm > 0.0:
        text = f"hlr's own drawing is wrong in {told(found.wrong_mm)} mm"
    elif lacking:
        text = f"hlr's own drawing lacks {', '.join(lacking)}"
    elif not _judged(found):
        return "nothing of it was judged, so nothing says that hlr's own drawing is right"
    else:
        text = "hlr's own drawing is nowhere found to be wrong"
    unknown = found.unjudged_mm
    return text + (f"; undecided or not judged: {told(unknown)} mm" if unknown > 0.0 else "")


def _judged(found: Comparison) -> bool:
    """Whether rays were asked about some of what differs."""
    return any(each.verdict and not found.looks_same(each) for each in found.differences)


def _lacking(found: Comparison) -> list[str]:
    """Views of the other page that hlr's page has not."""
    return [view.name for view in found.views if not (view.before if found.model_side == "first" else view.after)]
