"""What a viewer of the paper sees, by two depth images: of the referee's own mesh, and of the drawing's triangles.

A line that the first image requires and the drawing lacks may be the fault of any stage. A missing line that the second
image requires is the fault of visibility or linework. Where the two images differ, faces were lost in meshing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from support.referee.broken import Break, broken
from support.referee.depth import PIXELS, Depths, Hits, Sheet
from support.referee.exchange import Exchange
from support.referee.judge import RayCaster
from support.referee.lost import Lost, lost
from support.referee.missing import Missing, missing
from support.referee.reference import Reference


@dataclass(frozen=True)
class Seen:
    """One drawing compared with the depth images of its sheet; None: the drawing's triangles are not known."""

    sheet: Sheet
    image: Hits
    gaps: Missing
    breaks: list[Break] = field(default_factory=list)
    own_gaps: Missing | None = None
    lost: Lost | None = None

    def why(self) -> Iterator[str]:
        """Where on paper lines are missing, and faces lost, worst first."""
        for gaps, by in ((self.gaps, ""), (self.own_gaps, " (by its own triangles)")):
            for run in gaps.faults if gaps else ():
                yield f"no visible line for {run.length:.2f} mm at ({run.at[0]:.2f}, {run.at[1]:.2f}) on paper{by}"
        for each in self.breaks:
            yield f"a line is broken for {each.length:.2f} mm at ({each.at[0]:.2f}, {each.at[1]:.2f}) on paper"
        for area, (x, y) in self.lost.areas if self.lost else ():
            yield f"faces differ over {area:.1f} square mm at ({x:.2f}, {y:.2f}) on paper"


def look(drawing: Exchange, caster: RayCaster, own: Reference | None = None, pixels: int = PIXELS) -> Seen:
    """Cast the depth images and compare."""
    sheet = Sheet.of(drawing, caster.corners, pixels)
    depths = Depths(drawing, caster)
    image = depths.at(sheet.centres)
    gaps = missing(drawing, depths, sheet, image)
    breaks = broken(drawing, depths)
    if own is None:
        return Seen(sheet, image, gaps, breaks)
    own_depths = Depths(drawing, RayCaster(own))
    own_image = own_depths.at(sheet.centres)
    own_gaps = missing(drawing, own_depths, sheet, own_image)
    return Seen(sheet, image, gaps, breaks, own_gaps, lost(sheet, image, own_image))
