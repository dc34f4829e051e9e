"""Every tolerance, derived from one accuracy: millimetres on paper.

The accuracy is shared out so that the parts of an emitted line's error add up to less than it.

    line                         what it is off by, in accuracies
    polyline                     0.5 tessellation + 0.25 vertices left out + 0.1 digits
    edge or outline of a B-rep   0.1 curve fitting (kernel, fit::FIT) + 0.2 arcs in SVG (curves::arcs) + 0.1 digits
    contour of a mesh            0.5 smoothing (kernel, fit::smooth) + 0.1 digits
    change of visibility         0.5 tessellation, across the line; along it that over the sine of the angle at which
                                 what covers it crosses; and pieces that are too short to be drawn: 0.75

The kernel's grid adds nothing to them: a drawing is at least 2^30 of its steps wide; a step is a quarter of the finest
accuracy that is accepted for meshes, a hundredth of that for B-reps. In perspective the tessellation is finer as much
as its nearest point is magnified, up to fifty times (`hlr.image.placement`); nearer to the eye than a fiftieth of the
target's distance the accuracy is not kept: errors grow there as the distance shrinks.
"""

from __future__ import annotations

from dataclasses import dataclass

from hlr.errors import OptionError

DEFAULT_ACCURACY = 0.05
"""A tenth of the wide ISO 128 line: no eye sees it on paper."""

SMALL_DRAWING = 2000.0
"""Without a wish of the caller's, a small drawing is at least this many accuracies in diagonal."""

ANGLE = 0.5
"""Radians between neighbouring tessellation chords: 13 for a full circle, however small it is on paper."""

MESH_CONTACT = 1.0 / 8000.0
"""Of the model's diagonal. A mesh was tessellated by someone else, at a deflection it does not tell: within this depth
its pieces count as touching."""

CONTACT = 5.0
"""In deflections: the tessellations of two touching curved surfaces may be off by one each, obliquely seen."""

CONTACT_PLANAR = 2.5
"""In deflections: planar faces are off only by what their files round, but parts are put down on one another with gaps
and overlaps that are nothing on paper. Ten times what a wall may sink into a face without a line of its own: so its
edge is still seen there from all but the most oblique directions."""

ROUNDING = 0.04
"""In deflections: what lies in a plane is off by what its file rounds."""

FLIP = 0.75
"""Of the accuracy: a piece that is left out between two others moves a change by its length, and its own two ends are
displaced by a little already."""

DIGITS = 0.1
"""Of the accuracy: what rounding may move a point by in SVG and PDF. JSON holds the numbers as they are."""

CURVE_BULGE = 0.2
"""Of the accuracy: how far a curve may be fitted off the true one, and so reach beyond what is to fit on the sheet."""

CURVE_CHORD = 0.2
"""Of the accuracy: how far the points along a circle may be off it between them."""

CLOSED = 0.01
"""Of the accuracy, in the model: a curve whose ends are this close is closed."""

OUTLINE_CHORD = 0.2
"""In deflections: how far the polyline of an outline may stay off the curve."""

OUTLINE_LIFT = 2.5
"""In deflections: facets are off by a half, those of OpenCASCADE's mesher by two, the outline's chords by a little."""

OUTLINE_SPARE = 0.3
"""In deflections: what an outline is moved by where no facet stands out beyond it. Its own chords may be off by 0.2."""

OWN_LIFT = 1.5
"""In deflections: how far off its own face a line is compared with the triangles of that face. They are off by one."""

UNDER = 3.0
INK = 0.25
"""A hidden line this many accuracies from a visible one lies under its ink, if that is as wide: half a wide ISO 128
line, in millimetres."""

FINEST_BREP = 1e-7
FINEST_MESH = 4e-9
"""Of the drawing's diagonal. Finer tessellations do not fit into memory; finer meshes do not fit the integer grid."""


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Lengths on paper (millimetres) and in the model (model units).

    accuracy       what is promised, on paper
    deflection     chord error of the tessellation, in the model
    angle          turning per chord, radians
    contact        depth within which two curved things count as touching, in the model
    contact_planar the same for planar parts
    rounding       the same for lines that lie on surfaces, and for open sheets
    short          no figure shorter than this is drawn on its own, on paper
    flip           a visible or hidden piece shorter than this takes the state of what its line does beside it, on paper
    stub           a doubtful piece shorter than this beside a hidden one is the contact tolerance's own, on paper
    width          lines of one visibility this close coincide, on paper
    under          a hidden line this close to a visible one lies under its ink, on paper
    thin_paper     vertices this close to their line are left out, on paper
    thin_model     the same in the model
    """

    accuracy: float
    deflection: float
    angle: float
    contact: float
    contact_planar: float
    rounding: float
    short: float
    flip: float
    stub: float
    width: float
    under: float
    thin_paper: float
    thin_model: float


def choose(asked: float | None, diagonal: float) -> float:
    """The accuracy used for a drawing of this diagonal, both in millimetres on paper."""
    if asked is not None:
        return asked
    return min(DEFAULT_ACCURACY, diagonal / SMALL_DRAWING) if diagonal > 0.0 else DEFAULT_ACCURACY


def under(accuracy: float) -> float:
    """How close to a visible line a hidden one is not drawn, millimetres on paper."""
    return max(accuracy, min(UNDER * accuracy, INK))


def derive(accuracy: float, per_model: float, diagonal: float, *, brep: bool) -> Tolerances:
    """Tolerances for an accuracy on paper, `per_model` millimetres on paper per model unit.

    diagonal: of the drawing on paper, to refuse what cannot be kept.

    Raises OptionError where the accuracy is not positive, as coarse as the drawing, or beyond what can be computed.
    """
    if not accuracy > 0.0 or accuracy == float("inf"):
        raise OptionError(f"accuracy {accuracy:g} mm cannot be kept: give a positive length, such as 0.05")
    if diagonal > 0.0 and accuracy > diagonal / 4.0:
        raise OptionError(
            f"accuracy {accuracy:g} mm is too coarse for a drawing of {diagonal:.3g} mm: "
            f"give at most {diagonal / 4.0:.3g}, or a larger scale"
        )
    finest = diagonal * (FINEST_BREP if brep else FINEST_MESH)
    if accuracy < finest:
        raise OptionError(
            f"accuracy {accuracy:g} mm is too fine for a drawing of {diagonal:.3g} mm: give at least {finest:.1g}"
        )
    model = accuracy / per_model
    deflection = 0.5 * model
    return Tolerances(
        accuracy=accuracy,
        deflection=deflection,
        angle=ANGLE,
        contact=CONTACT * deflection,
        contact_planar=CONTACT_PLANAR * deflection,
        rounding=ROUNDING * deflection,
        short=accuracy,
        flip=FLIP * accuracy,
        stub=10.0 * accuracy,
        width=0.5 * accuracy,
        under=under(accuracy),
        thin_paper=0.25 * accuracy,
        thin_model=0.25 * model,
    )
