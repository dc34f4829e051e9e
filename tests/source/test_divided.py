"""The kernel divides shapes in memory into the same parts as a walk through OpenCASCADE."""

import numpy as np
import pytest

pytest.importorskip("OCP")

from hlr import _kernel
from hlr.source.cad.part_shapes import LiveShapes, OcctShapes
from hlr.source.cad.parts import Leaf, PartCollector
from hlr.source.cad.prototypes import DividedPrototypes, shape_stream
from support.shapes_of_all_kinds import placed, shapes, tables


def scenes():
    """Leaves of a model: each shape alone, and all of them with instances of one another."""
    each = shapes()
    yield from ([shape] for shape in each.values())
    yield [*each.values(), placed(each["compound"]), placed(each["box"], mirrored=True), each["box"].Reversed()]


def test_the_parts_are_the_same():
    for scene in scenes():
        leaves = [Leaf(shape, f"leaf {i % 3}") for i, shape in enumerate(scene)]
        wanted, found = PartCollector(OcctShapes(), leaves), PartCollector(LiveShapes(), leaves)
        assert isinstance(found.prototypes, DividedPrototypes), "the kernel has not divided them"
        for one, other in zip(found.parts, wanted.parts, strict=True):
            assert (one.name, one.product, one.prototype) == (other.name, other.product, other.prototype)
            assert np.allclose(one.transform, other.transform, rtol=0, atol=1e-12), one.name
            assert one.appearance() == other.appearance()
        if not found.parts:
            continue
        for one, other in zip(tables(found.prototypes.model), tables(wanted.prototypes.model), strict=True):
            assert one.shape == other.shape and np.array_equal(one, other)
        # Where OpenCASCADE's own shapes are asked for, they come in the order of the kernel's pieces.
        again = _kernel.BrepModel(found.prototypes.dump)
        assert np.array_equal(again.counts(), found.prototypes.counts)
        assert found.prototypes.has_faces == wanted.prototypes.has_faces
        assert len(found.prototypes.shapes) == len(wanted.prototypes.shapes)


def test_instances_share_one_prototype():
    box = shapes()["box"]
    collector = PartCollector(LiveShapes(), [Leaf(box, "one"), Leaf(placed(box), "two"), Leaf(box.Reversed(), "three")])
    assert [part.prototype for part in collector.parts] == [0, 0, 1]


def test_one_shape_alone_is_divided_as_in_a_compound():
    for name, shape in shapes().items():
        for each in (shape, placed(shape), shape.Reversed()):
            alone, whole = shape_stream([each]), shape_stream([each, each])
            assert alone is not None and whole is not None
            model, (pieces, places) = _kernel.BrepModel.divided(alone, alone=True)
            of_two, (twice, both) = _kernel.BrepModel.divided(whole)
            assert twice == pieces * 2, name
            assert np.array_equal(both, np.concatenate([places, places])), name
            assert np.array_equal(of_two.counts(), model.counts()), name


def test_damaged_streams_are_refused():
    stream = shape_stream([shapes()["compound"]])
    assert stream is not None
    for end in range(0, len(stream), 97):
        with pytest.raises(ValueError):
            _kernel.BrepModel.divided(stream[:end])
    assert _kernel.BrepModel.divided(stream)[0].n_faces > 0


def test_loose_edges_beside_a_solid_do_not_make_the_kernel_read_it_again(monkeypatch):
    import cadquery as cq

    from hlr.source import open_source
    from hlr.source.cad import prototypes

    def unwanted(shapes):
        raise AssertionError("the shapes are written once more")

    box, edge = cq.Workplane().box(30, 20, 10).val(), cq.Edge.makeLine(cq.Vector(), cq.Vector(9, 9, 90))
    other = cq.Workplane().box(5, 5, 5).val().moved(cq.Location(cq.Vector(40, 0, 0)))
    alone = open_source([box, other])
    monkeypatch.setattr(prototypes, "binary_dump", unwanted)
    beside = open_source([cq.Compound.makeCompound([edge, box]), other])
    assert len(beside.infos()) == len(alone.infos()) + 1
    one, two = (source.mesh(0.1, 0.5).parts.tables for source in (alone, beside))
    assert np.array_equal(one.points[one.triangles], two.points[two.triangles])
    # Of chosen parts alone the kernel reads no other.
    with pytest.raises(AssertionError, match="written once more"):
        beside.of_parts({beside.names()[0]}, None).mesh(0.1, 0.5)
