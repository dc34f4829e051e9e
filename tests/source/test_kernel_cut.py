"""Bodies cut by a plane in the kernel: volumes of what is left, faces and pieces, against formulas and OpenCASCADE."""

import math
import os
import re
import subprocess
import sys

import cadquery as cq
import numpy as np
import pytest
from OCP.gp import gp_Trsf
from OCP.TopLoc import TopLoc_Location

import hlr
from hlr import _kernel
from hlr.source import open_source
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_cut import KernelCut, NotHereError
from hlr.source.cad.prototypes import LivePrototypes
from hlr.source.cad.source_builder import with_appearance
from hlr.source.model import Appearance
from hlr.source.stepped import Stepped
from support.sections import hatch_of, opencascade_cuts, section

NEAR = 1e-7


def model_of(*shapes):
    return LivePrototypes([shape.wrapped for shape in shapes]).model


def cut(shape, normal, level):
    """What the kernel leaves of a shape: the model of its pieces, whether it was cut, and its pieces."""
    normal = np.array(normal, float) / np.linalg.norm(normal)
    cut = _kernel.CutParts(model_of(shape), [(0, normal.tolist(), level, NEAR)])
    [(why, is_cut, pieces)] = cut.found
    assert why is None
    return cut.with_parts([] if is_cut else [(model_of(shape), 0)]), is_cut, pieces


def why_not(shape, normal, level):
    """Why the kernel does not cut a shape."""
    [(why, is_cut, pieces)] = _kernel.CutParts(model_of(shape), [(0, normal, level, NEAR)]).found
    assert not is_cut and not pieces
    return why


def plane(normal):
    """Through the origin."""
    return Stepped(np.array(normal), np.array([normal[1], normal[2], normal[0]]), np.zeros(1), np.zeros(0))


def volumes(model, deflection=1e-4):
    """Of each part of a model; its mesh must be closed."""
    if not len(model.boxes()):
        return []
    meshed = model.mesh(deflection, 0.1)
    assert not meshed.faults()
    tables = meshed.parts(np.zeros(model.n_faces, bool))
    found = []
    for part in range(len(tables)):
        corners = tables.points[tables.triangles[slice(*tables.triangle_start[part : part + 2])]]
        a, b, c = np.moveaxis(corners - corners[0, 0], 1, 0)
        areas = np.cross(b - a, c - a)
        assert np.linalg.norm(areas.sum(axis=0)) < 1e-9 * np.abs(areas).sum()
        found.append(float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0)
    return found


def box():
    return cq.Workplane().box(10, 10, 10).val()


def angle():
    corners = [(0, 0), (10, 0), (10, 5), (5, 5), (5, 10), (0, 10)]
    return cq.Workplane().polyline(corners).close().extrude(4).val()


def channel():
    corners = [(0, 0), (10, 0), (10, 10), (7, 10), (7, 4), (3, 4), (3, 10), (0, 10)]
    return cq.Workplane().polyline(corners).close().extrude(4).val()


def segment(radius, depth):
    """The area of a circle's segment of this depth."""
    return radius**2 * math.acos(1 - depth / radius) - (radius - depth) * math.sqrt(2 * radius * depth - depth**2)


CONE = cq.Solid.makeCone(5, 0, 10)
TORUS = cq.Solid.makeTorus(10, 3)
BALL = cq.Workplane().sphere(5).val()
ROD = cq.Workplane().circle(5).extrude(10).val()
HALF_TORUS = math.pi**2 * 10 * 9


@pytest.mark.parametrize(
    ("shape", "normal", "level", "volume"),
    # The volume in all; None: nothing is left.
    [
        # Through the middle; a corner; along a face, from both sides; beside a face.
        (box(), (0, 0, 1), 0, 500),
        (box(), (1, 1, 1), 0, 500),
        (box(), (1, 1, 1), -math.sqrt(75) + 1, math.sqrt(27) / 6),
        (box(), (0, 0, 1), 5, 1000),
        (box(), (0, 0, 1), -5, None),
        (box(), (1, 0, 0), 4.999, 999.9),
        # Steps in the plane: their upper faces stay, their lower ones go.
        (angle(), (0, 1, 0), 5, 200),
        (angle(), (0, -1, 0), -5, 100),
        (channel(), (0, 1, 0), 4, 160),
        (channel(), (0, -1, 0), -4, 144),
        # Seams, poles and an apex in the plane, and rulings that it touches.
        (BALL, (0, 0, 1), 0, 250 / 3 * math.pi),
        (BALL, (0, 1, 0), 0, 250 / 3 * math.pi),
        (BALL, (1, 0, 0), 0, 250 / 3 * math.pi),
        (BALL, (1, 2, 3), -3, math.pi * 4 / 3 * (15 - 2)),
        (BALL, (0, 0, 1), -5, None),
        (ROD, (0, 0, 1), 2.5, 62.5 * math.pi),
        (ROD, (0, 1, 0), 0, 125 * math.pi),
        (ROD, (1, 0, 0), -3, 10 * segment(5, 2)),
        (ROD, (1, 0, 0), 5, 250 * math.pi),
        (ROD, (-1, 0, 0), -5, None),
        (CONE, (0, 0, 1), 5, (1 - 1 / 8) * 250 / 3 * math.pi),
        (CONE, (0, 1, 0), 0, 125 / 3 * math.pi),
        (CONE, (1, 0, 0), 0, 125 / 3 * math.pi),
        (TORUS, (0, 0, 1), 0, HALF_TORUS),
        (TORUS, (0, 1, 0), 0, HALF_TORUS),
        (TORUS, (1, 1, 0), 0, HALF_TORUS),
    ],
)
def test_what_is_left_has_its_volume(shape, normal, level, volume):
    model, is_cut, _ = cut(shape, normal, level)
    assert sum(volumes(model)) == pytest.approx(volume or 0.0, rel=2e-4)
    assert is_cut == (volume is None or volume < shape.Volume() - 1e-6)


def test_faces_know_which_they_were():
    # The plane lies at the height of no face: the lower half of each face beside it stays, and one face is new.
    model, _, [of] = cut(box(), (0, 0, 1), 1)
    assert sorted(of) == [-1, 0, 1, 2, 3, 4] and of[-1] == -1
    assert model.counts().tolist() == [[6, 12, 1]]


def test_pieces_and_cavities():
    plate = cq.Workplane().box(20, 20, 4)
    two = plate.cut(cq.Workplane().box(6, 16, 10).translate((0, 2, 0))).val()
    model, _, pieces = cut(two, (0, -1, 0), 0)
    assert len(pieces) == 2 and volumes(model) == pytest.approx([280, 280])
    hollow = cq.Workplane().box(10, 10, 10).cut(cq.Workplane().sphere(2)).val()
    ball = 32 / 3 * math.pi
    for level, left in ((3, 800 - ball), (0, 500 - ball / 2), (-3, 200)):
        model, _, pieces = cut(hollow, (0, 0, 1), level)
        assert len(pieces) == 1 and sum(volumes(model)) == pytest.approx(left, rel=2e-5)


def test_parts_that_stay_and_parts_that_are_cut_share_a_model():
    bodies = model_of(box(), ROD, BALL)
    planes = [(1, (0.0, 0.0, 1.0), 5.0, NEAR), (0, (1.0, 0.0, 0.0), -2.0, NEAR), (2, (1.0, 0.0, 0.0), 6.0, NEAR)]
    cut = _kernel.CutParts(bodies, planes)
    assert cut.found == [(None, True, [[0, 1, -1]]), (None, True, [[0, 2, 3, 4, 5, -1]]), (None, False, [])]
    model = cut.with_parts([(bodies, 2), (model_of(ROD), 0)])
    assert volumes(model) == pytest.approx([500 / 3 * math.pi, 250 * math.pi, 125 * math.pi, 300], rel=1e-4)


def test_planes_and_parts_are_checked():
    for plane in [((0.0, 0.0, math.nan), 0.0, NEAR), ((0.0, 0.0, 1.0), math.inf, NEAR), ((0.0, 0.0, 1.0), 0.0, 0.0)]:
        with pytest.raises(ValueError, match="planes must be finite"):
            _kernel.CutParts(model_of(box()), [(0, *plane)])
    with pytest.raises(ValueError, match="cuts"):
        _kernel.CutParts(model_of(box()), [(1, (0.0, 0.0, 1.0), 0.0, NEAR)])
    with pytest.raises(ValueError, match="parts"):
        _kernel.CutParts(model_of(box()), []).with_parts([(model_of(box()), 1)])


def test_what_is_no_body_is_left_to_opencascade():
    open_box = cq.Shell.makeShell(cq.Workplane().box(1, 1, 1).faces("#Z").vals())
    assert why_not(open_box, (0, 0, 1), 0) == "it is no closed body"
    inside_out = cq.Shape.cast(box().wrapped.Reversed())
    assert why_not(inside_out, (0, 0, 1), 0) == "it is turned inside out"


def test_a_plane_that_a_coarse_mesh_may_miss_is_left_to_opencascade():
    """Slices of a ball, down to a ten-thousandth of a millimetre high and a fifth of a millimetre wide."""
    ball, reasons = cq.Workplane().sphere(50).val(), set()
    rng = np.random.default_rng(5)
    for height in (1e-2, 1e-3, 1e-4) * 4:
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        for level in (50 - height, height - 50):
            [(why, is_cut, pieces)] = _kernel.CutParts(model_of(ball), [(0, normal.tolist(), level, NEAR)]).found
            assert why is not None or (is_cut and len(pieces) == 1), (height, normal)
            reasons.add(why)
    assert reasons == {None, "the plane nearly touches it"}
    normal = np.array([0.48, -0.64, 0.6])
    drawing = section(cq.Workplane(obj=ball), tuple(normal.tolist()), where=tuple((49.999 * normal).tolist()), scale=10)
    assert len(hatch_of(drawing)) > 5


def test_each_part_is_cut_by_what_can_cut_it():
    parts = cq.Assembly()
    sides = cq.Shell.makeShell(cq.Workplane().box(10, 10, 10).translate((40, 0, 0)).faces("#Z").vals())
    for name, body in (("ball", BALL), ("sides", sides), ("far", box().moved(cq.Location((0, 30, 0))))):
        parts.add(body, name=name)
    source = open_source(parts)
    cut = KernelCut(source, plane((0.0, -1.0, 0.0)), NEAR, ["ball", "sides"])
    assert cut.failed == {"sides": "it is no closed body"} and cut.cut == {"ball"}
    drawing = hlr.draw(parts, "front", section=0)
    assert [part.name for part in drawing.parts] == ["ball", "sides", "far"]
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["ball"]
    assert sum(line.part == 1 and line.kind != "hatch" for line in drawing.visible) > 2


def wavy():
    """A profile with a spline."""
    return cq.Workplane().spline([(0, 0), (3, 4), (8, 1), (10, 3)]).lineTo(10, -5).lineTo(0, -5).close()


def drilled():
    return cq.Workplane().box(10, 10, 10).faces(">Z").hole(4).faces(">X").hole(3).edges("%CIRCLE").chamfer(0.3)


def comb():
    slots = cq.Workplane().rarray(4, 1, 5, 1).rect(2, 6).extrude(5, both=True)
    return cq.Workplane().box(20, 10, 2).cut(slots)


def bowl():
    ball = cq.Workplane().sphere(6).cut(cq.Workplane().sphere(5))
    return ball.cut(cq.Workplane().box(20, 20, 9).translate((0, 0, 6)))


BODIES = {
    "drilled": drilled,
    "filleted": lambda: cq.Workplane().box(10, 10, 10).edges().fillet(1),
    "comb": comb,
    "spline": lambda: wavy().extrude(5),
    "turned": lambda: wavy().revolve(270, (-1, 0), (-1, 1)),
    "loft": lambda: cq.Workplane().rect(10, 10).workplane(offset=10).circle(3).loft(),
    "twisted": lambda: cq.Workplane().rect(6, 3).twistExtrude(8, 70),
    "bowl": bowl,
    "ring": lambda: cq.Workplane(obj=TORUS).cut(cq.Workplane().box(6, 30, 3)),
}


@pytest.mark.parametrize("name", BODIES)
def test_random_planes_leave_what_opencascade_leaves(name):
    shape = BODIES[name]().val()
    box = shape.BoundingBox()
    low, high = np.array([box.xmin, box.ymin, box.zmin]), np.array([box.xmax, box.ymax, box.zmax])
    rng = np.random.default_rng(7)
    for _ in range(12):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        at = low + (high - low) * rng.uniform(0.15, 0.85, 3)
        beyond = cq.Workplane(cq.Plane(tuple(at), normal=tuple(normal))).rect(200, 200).extrude(200).val()
        wanted = shape.cut(beyond).Volume()
        model, is_cut, _ = cut(shape, normal, float(normal @ at))
        assert is_cut and sum(volumes(model, 1e-3)) == pytest.approx(wanted, abs=1e-3 * shape.Area())


def test_a_plane_in_any_place_leaves_the_same():
    # The same body and plane, turned and moved far away.
    shape, normal, level = drilled().val(), np.array([1.0, 2.0, 3.0]) / math.sqrt(14), 1.0
    move = gp_Trsf()
    move.SetValues(0, -1, 0, 5e3, 1, 0, 0, -7e3, 0, 0, 1, 9e3)
    rows = np.array([[move.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
    turned = rows[:, :3] @ normal
    moved = cq.Shape.cast(shape.wrapped.Moved(TopLoc_Location(move)))
    here, _, _ = cut(shape, normal, level)
    there, _, _ = cut(moved, turned, level + float(turned @ rows[:, 3]))
    assert there.counts().tolist() == here.counts().tolist()
    assert volumes(there) == pytest.approx(volumes(here), rel=1e-7)


def test_a_drawing_is_that_of_opencascade(monkeypatch):
    for name in ("drilled", "comb", "ring"):
        body = BODIES[name]()
        own = section(body, "iso")
        with monkeypatch.context() as patched:
            opencascade_cuts(patched)
            rival = section(body, "iso")
        assert len(hatch_of(own)) == len(hatch_of(rival)) > 10
        assert _ink(own) == pytest.approx(_ink(rival), rel=1e-3)


def test_what_the_kernel_cannot_put_together_is_cut_by_opencascade_as_a_whole(monkeypatch):
    pair = cq.Assembly().add(comb(), name="comb").add(BALL.moved(cq.Location((0, 30, 0))), name="ball")
    own, asked = section(pair, where=0), []

    def cannot(*_):
        asked.append(1)
        raise NotHereError

    monkeypatch.setattr(KernelCut, "joined", cannot)
    rival = section(pair, where=0)
    assert asked and [part.name for part in rival.parts] == [part.name for part in own.parts] == ["comb", "ball"]
    assert len(hatch_of(own)) == len(hatch_of(rival)) > 10
    assert _ink(own) == pytest.approx(_ink(rival), rel=1e-3)


def _ink(drawing):
    """Length of all lines but hatches, by class and visibility, millimetres."""
    found = {}
    for line in drawing.lines:
        if line.kind != "hatch":
            long = float(np.hypot(*np.diff(line.points, axis=0).T).sum())
            found[line.kind, line.visible] = found.get((line.kind, line.visible), 0.0) + long
    return found


def test_the_section_of_a_ball_is_a_circle():
    svg = hlr.draw(cq.Workplane(obj=BALL), (1, 2, 3), section=(0, 0, 3), scale=1).to_svg()
    radius = math.sqrt(25 - 81 / 14)
    assert sorted(float(r) for r in re.findall(r'<circle[^>]* r="([0-9.]+)"', svg)) == [pytest.approx(radius), 5]


def test_faces_that_are_left_keep_their_colours():
    whole = open_source(cq.Workplane(obj=box()))
    red, (part,) = (1.0, 0.0, 0.0, 1.0), whole.parts
    # The faces at x = -5, x = 5, y = -5 and so on. The second one is lost.
    coloured = with_appearance(part, Appearance(None, {1: red, 3: red}))
    source = BrepSource("box", "object", [coloured], whole.prototypes)
    cut = KernelCut(source, plane((1.0, 0.0, 0.0)), NEAR, [part.name])
    assert cut.cut == {part.name} and not cut.failed
    assert cut.joined([], None).appearances() == {part.name: Appearance(None, {2: red})}


def test_a_section_of_a_file_in_the_cache_needs_no_opencascade(tmp_path):
    path = tmp_path / "drilled.step"
    cq.exporters.export(drilled(), str(path))
    program = (
        "import sys, hlr; print(len(hlr.draw(sys.argv[1], 'front', section=True).lines)); "
        "print([name for name in sys.modules if name.split('.')[0] in ('OCP', 'cadquery')])"
    )
    environment = {**os.environ, "HLR_CACHE": str(tmp_path / "cache")}
    found = [
        subprocess.run(
            [sys.executable, "-P", "-c", program, str(path)],
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        for _ in range(2)
    ]
    assert found[0][0] == found[1][0] and int(found[0][0]) > 10
    assert found[0][1] != "[]" and found[1][1] == "[]"
