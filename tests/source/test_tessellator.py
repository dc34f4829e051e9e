"""B-rep parts as meshes: conforming, outward, classified, and indexed as OpenCASCADE indexes them."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from hlr.source import open_source
from hlr.source.model import PartMesh, SurfaceParameters
from hlr.tables.line_classes import EdgeClass
from support.at_size import AT_SIZE
from support.brep_shapes import scrawled_cylinder

cq = pytest.importorskip("cadquery")


def box():
    return cq.Workplane().box(3, 4, 5)


SOLIDS = {
    "box": box,
    "cylinder": lambda: cq.Workplane().cylinder(5, 2),
    "cone": lambda: cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5)),
    "sphere": lambda: cq.Workplane().sphere(4),
    "torus": lambda: cq.Workplane(obj=cq.Solid.makeTorus(6, 2)),
    "holes": lambda: cq.Workplane().box(30, 30, 4).faces(">Z").workplane().rarray(6, 6, 4, 4).hole(3),
    "sinks": lambda: cq.Workplane().box(30, 30, 4).faces(">Z").workplane().rarray(9, 9, 3, 3).cskHole(3, 5, 82),
    "fillets": lambda: box().edges("|Z").fillet(1).faces(">Z").edges().fillet(0.4),
    "union": lambda: cq.Workplane(obj=cq.Solid.makeTorus(20, 6)).union(cq.Workplane().sphere(15)),
    "moved": lambda: box().translate((1, 2, 3)).rotate((0, 0, 0), (1, 1, 0), 37),
    "half sphere": lambda: (
        cq.Workplane().sphere(4).intersect(cq.Workplane().box(9, 9, 9, centered=(True, True, False)))
    ),
    "revolved": lambda: cq.Workplane("XZ").polyline([(0, 0), (3, 0), (1, 4), (0, 5)]).close().revolve(),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_closed_solids_become_closed_meshes(name, gaps, volume):
    solid = SOLIDS[name]()
    (part,) = open_source(solid).mesh(0.02, 0.2).parts
    assert gaps(part) == 0
    assert volume(part) == pytest.approx(solid.val().Volume(), rel=0.02)
    assert len(part.triangle_face) == len(part.triangles)
    assert part.triangle_face.max() < len(part.face_planar)
    used = np.unique(np.concatenate((part.triangles.ravel(), part.edge_nodes)))
    assert len(used) == len(part.points)


def test_mirrored_by_placement_is_outward_too(gaps, volume):
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    mirror = gp_Trsf()
    mirror.SetMirror(gp_Ax2(gp_Pnt(5, 0, 0), gp_Dir(1, 0, 0)))
    shape = cq.Workplane().box(1, 2, 3).edges("|Z").fillet(0.2).val()
    (part,) = open_source(shape.wrapped.Moved(TopLoc_Location(mirror), False)).mesh(0.01, 0.2).parts
    assert gaps(part) == 0
    assert volume(part) == pytest.approx(shape.Volume(), rel=0.01)
    assert part.points[:, 0].mean() == pytest.approx(10)
    assert np.bincount(part.edge_class).tolist() == [16, 8]


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (box, [12, 0, 0, 0]),
        (lambda: cq.Workplane().cylinder(5, 2), [2, 0, 1, 0]),
        (lambda: cq.Workplane().sphere(4), [0, 0, 1, 0]),
        (lambda: cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5)), [1, 0, 1, 0]),
        (lambda: cq.Workplane(obj=cq.Solid.makeTorus(6, 2)), [0, 0, 2, 0]),
        (lambda: box().edges("|Z").fillet(1), [16, 8, 0, 0]),
        (lambda: box().faces(">Z"), [0, 0, 0, 4]),
    ],
)
def test_edge_classes(make, expected, classes):
    (part,) = open_source(make()).mesh(0.02, 0.2).parts
    assert classes(part) == expected


def test_tangency_is_found_where_nobody_recorded_it(classes):
    # An extruded slot: its arcs meet its flats tangentially, but the extrusion records no continuity.
    (part,) = open_source(cq.Workplane().slot2D(10, 4).extrude(2)).mesh(0.02, 0.2).parts
    assert classes(part) == [8, 4, 0, 0]


def test_a_seam_that_folds_is_a_crease():
    drop = (
        cq.Workplane().spline([(0, 0), (4, 3), (8, 0), (4, -3), (0, 0)], tangents=[(1, 1), (-1, 1)]).wire().extrude(3)
    )
    (part,) = open_source(drop).mesh(0.02, 0.2).parts
    fold = part.edge_class[(np.diff(part.edge_offsets) == 2)]
    assert EdgeClass.SEAM not in fold
    assert EdgeClass.SHARP in fold


@pytest.mark.slow
@pytest.mark.parametrize("name", ["M6-1x12-countersunk-screw.step", "as1-oc-214.stp"])
def test_indices_are_those_of_the_index_maps(name, data):
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS
    from OCP.TopTools import TopTools_IndexedMapOfShape

    source = open_source(data / name)
    parts = source.mesh(0.005, 0.1).parts
    for part, entry in list(zip(parts, source.parts, strict=True))[:6]:
        root = source.prototypes.shapes[entry.prototype]
        faces, edges = TopTools_IndexedMapOfShape(), TopTools_IndexedMapOfShape()
        TopExp.MapShapes_s(root, Kind.TopAbs_FACE, faces)
        TopExp.MapShapes_s(root, Kind.TopAbs_EDGE, edges)
        a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
        areas = np.bincount(part.triangle_face, np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)
        for i in range(faces.Extent()):
            exact = GProp_GProps()
            BRepGProp.SurfaceProperties_s(faces.FindKey(i + 1), exact)
            assert areas[i] == pytest.approx(exact.Mass(), rel=0.05, abs=1e-3)
        back = np.linalg.inv(part.transform)
        for k, index in enumerate(part.edge_index):
            nodes = part.edge_nodes[part.edge_offsets[k] : part.edge_offsets[k + 1]]
            local = part.points[nodes] @ back[:3, :3].T + back[:3, 3]
            curve = BRepAdaptor_Curve(TopoDS.Edge_s(edges.FindKey(int(index) + 1)))
            for point, parameter in ((local[0], curve.FirstParameter()), (local[-1], curve.LastParameter())):
                exact_point = curve.Value(parameter)
                assert np.allclose(point, (exact_point.X(), exact_point.Y(), exact_point.Z()), atol=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["as1-oc-214.stp", "M6-1x12-countersunk-screw.step", "nist_ctc_01_asme1_ap242-e1.stp"])
def test_real_solids_are_closed(name, data, gaps):
    source = open_source(data / name)
    low, high = source.bounds()
    parts = source.mesh(float(np.linalg.norm(high - low)) / 2000, 0.35).parts
    assert [part.name for part in parts if gaps(part)] == []


def test_cone_tips_do_not_make_tangent_edges_sharp(data, classes):
    (part,) = open_source(data / "nist_ctc_01_asme1_ap242-e1.stp").mesh(0.5, 0.35).parts
    assert classes(part) == [220, 74, 24, 0]


def test_chord_error_and_turning_follow_the_request():
    source = open_source(cq.Workplane().sphere(10))
    sizes = []
    for deflection in (0.5, 0.005, 0.5):
        (part,) = source.mesh(deflection, 1.5).parts
        middle = part.points[part.triangles].mean(axis=1)
        assert 10 - np.linalg.norm(middle, axis=1).min() <= 1.5 * deflection
        sizes.append(len(part.triangles))
    assert sizes[0] == sizes[2] < sizes[1]
    coarse, fine = (len(source.mesh(5, angle).parts[0].triangles) for angle in (0.6, 0.1))
    assert coarse < fine


def same(a: PartMesh, b: PartMesh) -> bool:
    def equal(one: object, other: object, names: list[str]) -> bool:
        return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)

    on = [f.name for f in fields(SurfaceParameters) if f.name != "surfaces"]
    own = [f.name for f in fields(PartMesh) if f.name not in ("color", "surface_parameters")]
    return equal(a, b, own) and equal(a.surface_parameters, b.surface_parameters, on)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sinks", "fillets", "sphere", "revolved", "union"])
def test_triangles_of_another_mesher_are_joined_to_the_edges(name):
    """As they are where ours fails: here for every face of a sound solid, one by one and all."""
    from hlr.request.accuracy import ALONE
    from hlr.source.cad.rescue import faces_of, rescue

    source = open_source(SOLIDS[name]())
    source.mesh(0.05, 0.3)
    tessellator = source._tessellator
    (ours,) = source.mesh(0.05, 0.3).parts
    meshed = tessellator._model.mesh(ALONE * 0.05, 0.3)
    faces = faces_of(source.prototypes.shapes, set(range(tessellator._model.n_faces)))
    for number, face in faces.items():
        assert rescue(meshed, number, face, 0.08, 0.5)
        found = meshed.parts(tessellator._planar)
        assert sides_of(found.triangles) == {2}
        kept = [found.points[found.edge_nodes], ours.points[ours.edge_nodes]]
        assert np.array_equal(*kept)
    assert area(found.points, found.triangles) == pytest.approx(area(ours.points, ours.triangles), rel=0.01)


def sides_of(triangles):
    """How many triangles the edges of a mesh have."""
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    return set(np.unique(ends, axis=0, return_counts=True)[1].tolist())


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)).sum() / 2


def test_triangles_that_do_not_fill_the_face_are_refused():
    source = open_source(cq.Workplane().box(1, 2, 3))
    source.mesh(0.05, 0.3)
    meshed = source._tessellator._model.mesh(0.05, 0.3)
    uv = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    points = np.column_stack([uv, np.zeros(4)])
    borders = [([k, (k + 1) % 4], [0.0, 1.0]) for k in range(4)]
    half = np.array([(0, 1, 2)], np.int32)
    assert not meshed.replace(0, points, uv, half, borders)
    assert not meshed.replace(0, points, uv, half, borders[:3])


def test_a_damaged_dump_is_refused():
    from hlr import _kernel
    from hlr.source.cad.prototypes import binary_dump

    whole = binary_dump([cq.Workplane().box(1, 2, 3).val().wrapped])
    assert _kernel.BrepModel(whole).n_faces == 6
    with pytest.raises(ValueError, match="ends too early"):
        _kernel.BrepModel(whole[:-9])


def carried(shape):
    """The triangulations of a TopoDS_Shape's faces and the polygons of its edges, None where there is none."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    from hlr.source.cad.shapes import sub_shapes

    found = []
    for shape_of_face in sub_shapes(shape, Kind.TopAbs_FACE):
        mesh = BRep_Tool.Triangulation_s(TopoDS.Face(shape_of_face), TopLoc_Location())
        found.append(mesh)
        for edge in sub_shapes(shape_of_face, Kind.TopAbs_EDGE) if mesh is not None else ():
            found.append(BRep_Tool.PolygonOnTriangulation_s(TopoDS.Edge(edge), mesh, TopLoc_Location()))
    return found


def values(carried):
    """What is in them."""
    return [
        (x.NbNodes(), *(x.Node(i).Coord() if hasattr(x, "NbTriangles") else x.Node(i) for i in (1, x.NbNodes())))
        for x in carried
        if x is not None
    ]


OWNERS = {
    "cadquery": lambda: cq.Workplane().sphere(3).union(cq.Workplane().box(8, 1, 1)).val(),
    "to be rescued": lambda: scrawled_cylinder()[0],
}


@pytest.mark.slow
@pytest.mark.parametrize("name", [*OWNERS, "build123d"])
@pytest.mark.parametrize("meshed", [True, False])
def test_the_triangles_that_a_caller_s_shape_brings_stay(name, meshed):
    """The same objects, and the same in them; none where there were none. The drawing is finer than they are."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    import hlr

    if name == "build123d":
        bd = pytest.importorskip("build123d")
        owner = bd.Sphere(3) + bd.Box(8, 1, 1)
    else:
        owner = OWNERS[name]()
    if meshed:
        BRepMesh_IncrementalMesh(owner.wrapped, 0.5)
    before = carried(owner.wrapped)
    inside = values(before)
    assert bool(inside) == meshed
    drawing = hlr.draw(owner, "iso", accuracy=0.01, **AT_SIZE)
    hlr.info(owner)
    assert drawing.counters["triangles"] > 100 and drawing.counters["rescued_faces"] == (name == "to be rescued")
    after = carried(owner.wrapped)
    assert after == before and values(after) == inside


def test_the_dump_of_shapes_in_memory_is_not_kept():
    source = open_source(cq.Workplane().sphere(3))
    before = source._prototypes.dump
    source.mesh(0.1, 0.3)
    assert "dump" not in vars(source._prototypes)
    assert source._prototypes.dump == before and len(source._prototypes.shapes_from_dump) == 1


def test_a_stream_gives_the_same_drawing_as_the_dump(monkeypatch):
    import hlr
    from hlr.source.cad import prototypes

    part = cq.Workplane().box(30, 20, 10).edges("|Z").fillet(3).faces(">Z").workplane().hole(6)
    turned = part.val().moved(cq.Location((40, 5, 0), (1, 2, 3), 50))
    scene = [
        part.val(),
        turned,
        cq.Workplane().sphere(4).val(),
        cq.Workplane("XZ").circle(5).revolve(90, (9, 0), (9, 1)).val(),
    ]
    whole = cq.Compound.makeCompound([*scene, cq.Compound.makeCompound(scene[:2]).moved(cq.Location((0, 60, 0)))])
    dumped = []
    dump = prototypes.binary_dump
    monkeypatch.setattr(prototypes, "binary_dump", lambda shapes: dumped.append(shapes) or dump(shapes))
    by_stream = hlr.draw(whole, hidden=True).to_svg()
    assert not dumped
    monkeypatch.setattr(prototypes, "shape_stream", lambda shapes: None)
    by_dump = hlr.draw(whole, hidden=True).to_svg()
    assert len(dumped) == 1
    assert by_stream == by_dump


def test_faces_of_triangles_alone_come_from_the_dump():
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Face

    import hlr
    from hlr.source.cad import prototypes

    triangles = triangulation_of_a_square()
    face = TopoDS_Face()
    BRep_Builder().MakeFace(face, triangles)
    stream = prototypes.shape_stream([face])
    assert stream is not None
    with pytest.raises(ValueError, match="triangles"):
        prototypes._kernel.BrepModel(stream)
    assert hlr.draw(face, (0, 0, 1)).counters["triangles"] == 2


def triangulation_of_a_square():
    from OCP.gp import gp_Pnt
    from OCP.Poly import Poly_Triangle, Poly_Triangulation

    made = Poly_Triangulation(4, 2, False)
    for i, (x, y) in enumerate([(0, 0), (9, 0), (9, 9), (0, 9)], 1):
        made.SetNode(i, gp_Pnt(x, y, 0))
    made.SetTriangle(1, Poly_Triangle(1, 2, 3))
    made.SetTriangle(2, Poly_Triangle(1, 3, 4))
    return made


def test_two_runs_give_the_same_bytes():
    first, second = (open_source(SOLIDS["union"]()).mesh(0.05, 0.3).parts[0] for _ in range(2))
    assert same(first, second)


def test_instances_have_the_same_mesh_and_stand_apart():
    one = cq.Workplane().box(1, 2, 3).val()
    source = open_source([one, one.moved(cq.Location((10, 0, 0))), one.moved(cq.Location((0, 10, 0), (0, 0, 1), 90))])
    parts = source.mesh(0.1, 0.3).parts
    assert [part.name for part in parts] == ["part", "part:2", "part:3"]
    assert np.array_equal(parts[0].triangles, parts[1].triangles)
    assert np.allclose([part.points.mean(axis=0) for part in parts], [(0, 0, 0), (10, 0, 0), (0, 10, 0)])
    assert np.allclose(np.ptp(parts[2].points, axis=0), (2, 1, 3))


def test_loose_faces_and_wires_beside_a_solid():
    solid = cq.Workplane().box(1, 1, 1).val()
    face = cq.Workplane().rect(1, 1).extrude(1).faces(">Z").val().moved(cq.Location((5, 0, 0)))
    wire = cq.Workplane().circle(1).val().moved(cq.Location((9, 0, 0)))
    source = open_source(cq.Compound.makeCompound([solid, face, wire]))
    body, loose = source.mesh(0.01, 0.3).parts
    assert (body.name, loose.name) == ("part", "part:loose")
    assert np.bincount(loose.edge_class, minlength=4).tolist() == [1, 0, 0, 4]
    free = loose.edge_nodes[loose.edge_offsets[4] : loose.edge_offsets[5]]
    assert not np.isin(free, loose.triangles).any()
    assert np.allclose(np.linalg.norm(loose.points[free] - (9, 0, 0), axis=1), 1)


def test_planar_faces_are_known():
    (part,) = open_source(cq.Workplane().cylinder(5, 2)).mesh(0.1, 0.3).parts
    assert sorted(part.face_planar.tolist()) == [False, True, True]


def test_progress_runs_from_nothing_to_done():
    seen: list[tuple[str, float]] = []
    open_source(box()).mesh(0.1, 0.3, lambda stage, done: seen.append((stage, done)))
    assert seen[0] == ("tessellate", 0.0)
    assert seen[-1] == ("tessellate", 1.0)
