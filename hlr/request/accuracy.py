"""Every tolerance follows from one accuracy: millimetres on paper.

Each source of error gets a share of the accuracy. The shares of an emitted line add up to less than one (`SHARES`):

    line                           shares                                                              sum
    polyline                       0.625 tessellation + 0.25 vertices left out + 0.1 digits            0.975
    edge of a B-rep                0.05 curve fitting + 0.2 arcs in SVG + 0.1 digits                   0.35
    outline of a B-rep             0.125 chords + 0.05 curve fitting + 0.2 arcs in SVG + 0.1 digits    0.475
    intersection line of B-reps    0.0125 cubics + 0.05 curve fitting + 0.2 arcs in SVG + 0.1 digits   0.3625
    contour of a mesh              0.5 vertices moved + 0.3 curve fitting + 0.1 digits                 0.9
    circle of a mesh               0.75 vertices off the circle + 0.2 arcs in SVG, digits included     0.95
    change of visibility, across   0.625 tessellation + 0.1 digits                                     0.725
    change of visibility, along    0.75 short pieces left out + 0.1 digits                             0.85

The tessellation takes 0.5, or 0.625 where the scale turns out larger than was foreseen (`REMESH`). Along its line a
change of visibility is off by that over the sine of the angle at which the covering edge crosses, which comes on top.
A stitched border of a mesh is one of the two borders that the file gives, 0.2 apart at most (`STITCH`), and of parts
that repeat one another, 0.125 apart at most (`REPEATED`), the first is drawn. Faces that
OpenCASCADE had to mesh may be off by more; the drawing names them in a note.

The kernel's grid adds nothing: a drawing is at least 2^30 of its steps wide; a step is a quarter of the finest accuracy
that is accepted for meshes, a hundredth of that for B-reps. In perspective the tessellation is finer as much as its
nearest point is magnified, up to fifty times (`MOST_MAGNIFIED`); nearer to the eye than a fiftieth of the target's
distance the accuracy is not kept: errors grow there as the distance shrinks.

No other module of Python defines a number of this kind. Shares that the kernel alone uses are in
`hlr/kernel/accuracy/src/lib.rs`. The first words of each text name the length that the number is a multiple of:

    accuracy      what a drawing promises, millimetres on paper
    deflection    chord error asked of the mesher, model units: half of the accuracy
    contact       depth within which two surfaces touch, model units
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from hlr.common.numbers import typed, typed_below, typed_value
from hlr.errors import OptionError

# Which accuracy is used.

DEFAULT_ACCURACY = 0.05
"""Millimetres: a tenth of the wide ISO 128 line. No eye sees it on paper."""

SMALL_DRAWING = 2000.0
"""Of the accuracy: where none is asked for, the diagonal of a small drawing is at least this long."""

SMALL_GEOMETRY = 2.5e-4
"""Of the model's diagonal: the accuracy of lines that become geometry again, where that is less than the default."""

PIXEL_ACCURACY = 0.1
"""Of a pixel: the accuracy of pictures that other programs state in pixels."""

FINEST_BREP = 1e-7
FINEST_MESH = 4e-9
"""Of the drawing's diagonal: the finest accuracy. Finer tessellations do not fit into memory; finer meshes do not fit
the integer grid."""

# The mesher.

TESSELLATION = 0.5
"""Of the accuracy, in the model: the deflection."""

REMESH = 0.8
"""Of the deflection that was meshed with: where a view turns out to need less, all views are meshed again."""

ANGLE = 0.5
"""Radians between neighbouring chords: 13 for a full circle, however small it is on paper."""

SPHERE_MESH = 256.0
"""Times: how much coarser the mesh of a sphere is of which only the outline is drawn. The outline is traced on the
surface, where each chord of the mesh is halved up to six times: its own chord error is 4096 times smaller."""

ALONE = 0.86
"""Of the deflection: chord error of a face of one solid that comes near no other part. With more, outlines that touch
others are seen beside them for longer than the accuracy."""

TOUCHING = 0.5
"""Of the deflection: chord error of a face that may touch another part. Two surfaces, one inside the other, are then
no further apart than one deflection."""

STITCH = 0.4
"""Of the deflection: how far a corner of a mesh may move when borders are stitched. A fifth of the accuracy."""

MOST_MAGNIFIED = 50.0
"""Times: how much finer the tessellation is at most for what is near the eye. Finer ones would not end."""

# Where surfaces touch.

MESH_CONTACT = 1.0 / 8000.0
"""Of the model's diagonal: the contact depth of meshes, whose own deflection is not known."""

CONTACT = 5.0
"""Of the deflection: the contact depth of curved surfaces. Two tessellations may be off by one each, obliquely seen."""

CONTACT_PLANAR = 2.5
"""Of the deflection: the contact depth of planar parts. Files round little, but parts are placed on one another with
gaps and overlaps that are nothing on paper. Ten times the kernel's `FLUSH`, the depth a wall may sink into a face
without a line of its own: so its edge is seen there from all but the most oblique directions."""

REPEATED = 0.25
"""Of the deflection: parts with equal meshes count as one where no point is farther from its copy than this, an eighth
of the accuracy. Planar faces no deeper in one another than that count as touching (the kernel's `FLUSH`)."""

CONTACT_SPARE = 1.01
"""Of the contact depth: boxes of parts are grown by this much to find the parts that come near one another."""

ROUNDING = 0.04
"""Of the deflection: what lies in a plane is off by what its file rounds."""

# Outlines.

OUTLINE_CHORD = 0.2
"""Of the deflection: chord error of the polyline of an outline."""

OUTLINE_LIFT = 2.5
"""Of the deflection: the most an outline is moved off its surface before visibility is decided. Facets are off by 0.5
to 0.86, those of OpenCASCADE's mesher by two, the outline's chords by a fifth."""

OUTLINE_SPARE = 0.3
"""Of the deflection: how far an outline is moved where no facet stands out beyond it. Its own chords are off by 0.2."""

OWN_LIFT = 1.5
"""Of the deflection: how far off its own face a line is compared with that face's triangles. They are off by one."""

MOST_LIFT = 3.0
"""Of the deflection: lines are moved off their surfaces by less than this."""

# Lines.

THIN = 0.25
"""Of the accuracy: vertices of a polyline this close to their line are left out, on paper and in the model."""

SHORT = 1.0
"""Of the accuracy: no figure shorter than this is drawn on its own."""

FLIP = 0.75
"""Of the accuracy: a visible or hidden piece shorter than this takes the state of its line beside it. That moves a
change by the length of the piece, whose own two ends are displaced by a little already."""

STUB = 10.0
"""Of the accuracy: a doubtful piece shorter than this beside a hidden one is hidden."""

SAME = 0.5
"""Of the accuracy: lines of one visibility this close coincide."""

UNDER = 3.0
INK = 0.25
"""UNDER of the accuracy, but no more than INK millimetres: a hidden line this close to a visible one lies under its
ink. INK is half a wide ISO 128 line."""

CIRCLE_FIT = 0.75
"""Of the accuracy: how far vertices of a mesh may lie off the circle that is drawn through them."""

CURVE_BULGE = 0.2
"""Of the accuracy: how far a drawn curve may reach beyond the true one, and so beyond the sheet it has to fit."""

CURVE_CHORD = 0.2
"""Of the accuracy: how far the points along a circle may be off it between them."""

CLOSED = 0.01
"""Of the accuracy, in the model: a curve whose ends are this close is closed."""

DIGITS = 0.1
"""Of the accuracy: how far rounding may move a point in SVG and PDF. JSON holds the numbers as they are."""

FILL_STEP = 1.0
"""Of the accuracy: spacing of the grid on which the faces of a filled drawing are looked up."""

# The kernel's shares that the sums below need. `kernel/accuracy` defines them; a test compares both.

CURVE_FIT = 0.05
"""Of the accuracy: how far a fitted curve may be from the true one."""

INTERSECTION_FIT = 0.02
"""Of the deflection: how far the cubic pieces of an intersection line may be from it."""

ARC_FIT = 0.2
"""Of the accuracy: how far an SVG arc may be from the true one, its ends rounded."""

CONTOUR_MOVE = 0.5
"""Of the accuracy: how far a vertex of a mesh's contour may move when the contour is smoothed."""

CONTOUR_FIT = 0.3
"""Of the accuracy: how far curves may be from the moved contour."""

SHARES: Mapping[str, Mapping[str, float]] = {
    "polyline": {"tessellation": TESSELLATION / REMESH, "vertices left out": THIN, "digits": DIGITS},
    "edge of a B-rep": {"curve fitting": CURVE_FIT, "arcs in SVG": ARC_FIT, "digits": DIGITS},
    "outline of a B-rep": {
        "chords": OUTLINE_CHORD * TESSELLATION / REMESH,
        "curve fitting": CURVE_FIT,
        "arcs in SVG": ARC_FIT,
        "digits": DIGITS,
    },
    "intersection line of B-reps": {
        "cubics": INTERSECTION_FIT * TESSELLATION / REMESH,
        "curve fitting": CURVE_FIT,
        "arcs in SVG": ARC_FIT,
        "digits": DIGITS,
    },
    "contour of a mesh": {"vertices moved": CONTOUR_MOVE, "curve fitting": CONTOUR_FIT, "digits": DIGITS},
    "circle of a mesh": {"vertices off the circle": CIRCLE_FIT, "arcs in SVG, digits included": ARC_FIT},
    "change of visibility, across": {"tessellation": TESSELLATION / REMESH, "digits": DIGITS},
    "change of visibility, along": {"short pieces left out": FLIP, "digits": DIGITS},
}
"""Of the accuracy: what each source of error may take of a line, per class of line. None of the sums exceeds one."""

# How finely the lab looks at a drawing when it measures errors.

MEASURED_CHORD = 0.02
"""Of the accuracy: chord error of the polylines that stand for written curves."""

MEASURED_EDGE_CHORD = 0.1
"""Of the accuracy: chord error of the polylines that stand for the true curves of edges."""

MEASURED_FINENESS = 4.0
"""Times: how much finer the drawing is that changes of visibility and lost lines are compared with."""

MEASURED_SAMPLE = 0.25
"""Of the accuracy: spacing of samples along a stretch whose length is measured."""

MEASURED_SAME = 0.25
"""Of the accuracy: lines of two drawings this close are the same line."""

MEASURED_REACH = 1000.0
"""Of the accuracy: where no line of the other drawing is this close, none is searched for farther away."""

MEASURED_RETRY = 0.25
"""Of the accuracy: where an outline's error is larger, other places on the surface are tried, and folds along edges."""

MEASURED_STEP = 10.0
"""Of the accuracy: the longest step of that search on a surface. What is farther away is another outline."""

MEASURED_EDGE_ON = 0.01
"""Of the deflection: a triangle whose image is no higher than this is seen edge-on."""

MEASURED_CONTACT = 0.1
"""Of the contact depth: a sample's own surface may be this near in front of it."""


@dataclass(frozen=True, slots=True)
class Tolerances:
    """The lengths that follow from one accuracy: on paper in millimetres, in the model in model units.

    accuracy       what is promised, on paper
    deflection     chord error of the tessellation, in the model
    angle          turning per chord, radians
    contact        depth within which two curved surfaces touch, in the model
    contact_planar the same for planar parts
    rounding       the same for lines that lie on surfaces, and for open sheets
    short          no figure shorter than this is drawn on its own, on paper
    flip           a visible or hidden piece shorter than this takes the state of what its line does beside it, on paper
    stub           a doubtful piece shorter than this beside a hidden one is hidden, on paper; a longer one is so where
                   the line goes through a surface
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
    """The accuracy asked for, or the default for a drawing of this diagonal. All in millimetres on paper."""
    if asked is not None:
        return asked
    return min(DEFAULT_ACCURACY, diagonal / SMALL_DRAWING) if diagonal > 0.0 else DEFAULT_ACCURACY


def under(accuracy: float) -> float:
    """A hidden line closer than this to a visible one is not drawn: millimetres on paper, as the accuracy."""
    return max(accuracy, min(UNDER * accuracy, INK))


def derive(accuracy: float, per_model: float, diagonal: float, *, brep: bool) -> Tolerances:
    """All tolerances of a drawing.

    accuracy: millimetres on paper. per_model: millimetres on paper per model unit. diagonal: of the drawing,
    millimetres on paper. brep: the model has faces with equations, not triangles alone.

    Raises OptionError where the accuracy is not positive, as coarse as the drawing, or finer than can be computed.
    """
    if not accuracy > 0.0 or accuracy == float("inf"):
        raise OptionError(f"accuracy {typed_value(accuracy)} mm cannot be kept: give a positive length, such as 0.05")
    if diagonal > 0.0 and accuracy > diagonal / 4.0:
        raise OptionError(
            f"accuracy {typed_value(accuracy)} mm is too coarse for a drawing of {typed(diagonal, 3, 15)} mm: "
            f"give at most {typed_below(diagonal / 4.0, 3)}, or a larger scale"
        )
    finest = diagonal * (FINEST_BREP if brep else FINEST_MESH)
    if accuracy < finest:
        digit = 10.0 ** math.floor(math.log10(finest))
        given = math.ceil(finest / digit) * digit  # rounded up: the number that is named has to be accepted
        raise OptionError(
            f"accuracy {typed_value(accuracy)} mm is too fine for a drawing of {typed(diagonal, 3, 15)} mm: "
            f"give at least {typed(given, 1, 15)}, or a smaller scale"
        )
    model = accuracy / per_model
    deflection = TESSELLATION * model
    return Tolerances(
        accuracy=accuracy,
        deflection=deflection,
        angle=ANGLE,
        contact=CONTACT * deflection,
        contact_planar=CONTACT_PLANAR * deflection,
        rounding=ROUNDING * deflection,
        short=SHORT * accuracy,
        flip=FLIP * accuracy,
        stub=STUB * accuracy,
        width=SAME * accuracy,
        under=under(accuracy),
        thin_paper=THIN * accuracy,
        thin_model=THIN * model,
    )
