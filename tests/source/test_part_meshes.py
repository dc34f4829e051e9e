"""All parts in one set of arrays, which lies in the kernel, and each taken out again."""

from __future__ import annotations

import numpy as np
import pytest

from hlr import _kernel
from hlr.source import open_source
from hlr.source.part_meshes import PartMeshes, combine_parts

cq = pytest.importorskip("cadquery")

ARRAYS = [name for name in vars(_kernel.PartTables) if not name.startswith("_")]


def tables() -> PartMeshes:
    body = cq.Workplane().box(3, 4, 5).faces(">Z").hole(1)
    bolt = cq.Workplane().cylinder(4, 1).val()
    wire = cq.Compound.makeCompound([cq.Workplane().box(1, 1, 1).val(), cq.Edge.makeLine((0, 0, 0), (9, 9, 9))])
    parts = [body.val(), body.mirror("XZ").val(), bolt, bolt.moved(cq.Location((8, 0, 0), (1, 0, 0), 30)), wire]
    found = open_source(parts).mesh(0.1, 0.3).parts
    assert isinstance(found, PartMeshes)
    return found


def arrays(whole: PartMeshes) -> dict[str, np.ndarray]:
    found = {name: getattr(whole.tables, name) for name in ARRAYS}
    return {name: value for name, value in found.items() if isinstance(value, np.ndarray)}


def test_parts_taken_out_and_put_together_again_are_the_same():
    whole = tables()
    again = arrays(combine_parts(list(whole)))
    assert len(again) == 23
    for name, array in arrays(whole).items():
        assert array.dtype == again[name].dtype and np.array_equal(array, again[name]), name
    assert combine_parts(whole) is whole


def test_a_slice_of_parts():
    whole = tables()
    assert [part.name for part in whole[1:3]] == [whole[1].name, whole[2].name]
    assert whole[-1].name == list(whole)[-1].name
    with pytest.raises(IndexError):
        whole[len(whole)]


def test_nobody_can_write_to_what_lies_in_the_kernel():
    whole = tables()
    scene = whole.tables.facts().scene()
    for array in (*arrays(whole).values(), scene.edge_kind, scene.face_place, scene.mesh.normals):
        assert not array.flags.writeable
    points = whole.tables.points
    before = points.copy()
    del whole, scene
    assert np.array_equal(points, before), "an array keeps what it lies in"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("triangles", lambda a: a + a.max()),
        ("triangles", lambda a: -1 - a),
        ("edge_nodes", lambda a: a + 10_000),
        ("triangle_face", lambda a: a + 100),
        ("corner", lambda a: a + 100_000),
        ("corner", lambda a: a[:-1]),
        ("point_start", lambda a: a[::-1].copy()),
        ("edge_offsets", lambda a: a + 1),
        ("origin", lambda a: a[1:]),
        ("transform", lambda a: a[:, :2].copy()),
        ("face_place", lambda a: a[1:]),
        ("edge_class", lambda a: a[1:]),
    ],
)
def test_what_does_not_fit_is_refused(name, change):
    given = arrays(tables())
    _kernel.PartTables(**given)
    with pytest.raises(ValueError, match=f"{name}|number of"):
        _kernel.PartTables(**{**given, name: change(given[name])})
    whole = tables().tables
    with pytest.raises(ValueError, match="part holds"):
        whole.placed(np.array([99], np.int32), np.eye(4)[None, :3].copy(), np.zeros(1))
