"""project_ex gives the ten compounds that OpenCASCADE's own projection gives."""

import pytest

from hlr.compat.freecad import project_ex
from hlr.errors import HlrError, OptionError, SourceError, ViewError

pytest.importorskip("cadquery")

from compat import originals
from compat.models import MODELS, plate

GENERAL = [(1.0, -1.0, 1.0), (0.3, 0.2, 1.0), (-1.0, -2.0, -0.5)]


def whole(model):
    """A model as one shape, which is all that the original takes."""
    import cadquery as cq

    return cq.Compound.makeCompound(model.vals()).wrapped


@pytest.mark.slow
@pytest.mark.parametrize("direction", GENERAL)
@pytest.mark.parametrize("name", MODELS)
def test_the_same_lines_in_the_same_place(name, direction):
    shape = whole(MODELS[name]())
    ours, theirs = project_ex(shape, direction), originals.project_ex(shape, direction)
    assert len(ours) == 10
    assert originals.box(ours[:5]) == pytest.approx(originals.box(theirs[:5]), abs=0.01)
    longest = sum(map(originals.length, theirs))
    for i, (own, other) in enumerate(zip(ours, theirs, strict=True)):
        assert not own.IsNull()
        # Where lines touch one another within the accuracy, one of them is drawn.
        under = 0.03 if i >= 5 else 0.01
        if i == 6:  # hidden tangent edges that lie under lines of another kind
            assert originals.length(own) <= originals.length(other) + 0.001 * longest
        else:
            assert originals.length(own) == pytest.approx(originals.length(other), rel=0.001, abs=under * longest)


def test_front_lies_as_in_freecad():
    # OpenCASCADE takes an up of its own: looking along y, z points left.
    ours = project_ex(plate(), (0, -1, 0))
    assert originals.box(ours[:5]) == pytest.approx((-10, -20, 0, 10, 20, 0), abs=1e-6)


def test_what_coincides_is_told_once():
    visible, hidden = (sum(map(originals.length, half)) for half in _halves(project_ex(box(), (0, -1, 0))))
    assert (visible, hidden) == pytest.approx((60.0, 0.0))
    theirs = [sum(map(originals.length, half)) for half in _halves(originals.project_ex(box().wrapped, (0, -1, 0)))]
    assert theirs == pytest.approx([60.0, 60.0])


def box():
    import cadquery as cq

    return cq.Solid.makeBox(10, 5, 20)


def _halves(compounds):
    return compounds[:5], compounds[5:]


def halves():
    """A cylinder in two halves, as many exporters write it; OpenCASCADE knows that the edges between only divide it."""
    import cadquery as cq
    from OCP.BRepLib import BRepLib

    half = cq.Solid.makeCylinder(8, 20, angleDegrees=180)
    shape = half.fuse(half.rotate((0, 0, 0), (0, 0, 1), 180))
    BRepLib.EncodeRegularity_s(shape.wrapped, 1e-6)
    return shape


def test_edges_that_only_divide_a_surface_are_sewn():
    from hlr.compat.cadquery import getSVG

    direction = (1, -2, 1)
    ours, theirs = project_ex(halves(), direction), originals.project_ex(halves().wrapped, direction)
    for i in (1, 2, 6, 7):
        assert originals.length(ours[i]) == pytest.approx(originals.length(theirs[i]), abs=0.5), originals.NAMES[i]
    assert originals.length(ours[2]) > 10
    # They are neither seams nor tangent edges to CadQuery.
    assert "smooth" not in getSVG(halves()) and "seam" not in getSVG(halves())


@pytest.mark.parametrize("seam", [True, False])
def test_tangent_edges_of_equal_curvature_are_seams(seam):
    """Here the shape says that its one tangent edge is of curvature continuity, as OpenCASCADE records it."""
    import cadquery as cq
    from OCP.BRep import BRep_Builder
    from OCP.GeomAbs import GeomAbs_C2

    from hlr.compat.viewport import draw_viewport, viewport_along

    path = cq.Workplane().spline([(0, 0), (2, 1), (4, 0)], tangents=[(1, 0), (1, 0)]).lineTo(8, 0)
    solid = path.lineTo(8, -3).lineTo(0, -3).close().extrude(4).val()
    flat = next(face for face in solid.Faces() if face.geomType() == "PLANE" and face.normalAt().y > 0.99)
    top = next(face for face in solid.Faces() if face.geomType() != "PLANE")
    (edge,) = (e for e in top.Edges() if any(e.isSame(other) for other in flat.Edges()))
    before = draw_viewport(solid.wrapped, viewport_along((1, 1, 1), "direction"), seam=seam)
    BRep_Builder().Continuity(edge.wrapped, top.wrapped, flat.wrapped, GeomAbs_C2)
    after = draw_viewport(solid.wrapped, viewport_along((1, 1, 1), "direction"), seam=seam)
    assert [len(each.lines(["smooth"], True)) for each in (before, after)] == [1, 0]
    assert [len(each.lines(["seam"], True)) for each in (before, after)] == [0, int(seam)]


def test_shapes_of_all_neighbours():
    build123d = pytest.importorskip("build123d")
    expected = sum(map(originals.length, project_ex(box(), (1, 2, 3))))
    for shape in (box().wrapped, build123d.Solid(box().wrapped)):
        assert sum(map(originals.length, project_ex(shape, (1, 2, 3)))) == pytest.approx(expected)
    # A FreeCAD.Vector is iterable, and longer ones look the same way.
    assert sum(map(originals.length, project_ex(box(), iter((2, 4, 6))))) == pytest.approx(expected)


def test_the_default_is_the_top():
    assert originals.box(project_ex(box())[:5]) == pytest.approx((0, 0, 0, 10, 5, 0), abs=1e-6)


@pytest.mark.parametrize(
    "shape, direction, error, words",
    [
        (None, (0, 0, 0), ViewError, "direction is zero"),
        (None, (0, 1), OptionError, "direction needs three finite numbers"),
        (None, "front", OptionError, "direction needs three finite numbers"),
        (None, (0, float("nan"), 1), OptionError, "direction needs three finite numbers"),
        (5, (0, 0, 1), SourceError, "cannot be drawn"),
    ],
)
def test_errors(shape, direction, error, words):
    with pytest.raises(error, match=words) as raised:
        project_ex(box() if shape is None else shape, direction)
    assert isinstance(raised.value, HlrError)
