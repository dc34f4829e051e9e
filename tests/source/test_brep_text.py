"""BREP files and FreeCAD's documents are read by the kernel: as OpenCASCADE reads them, and without it."""

import io
import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import hlr
from hlr import _kernel
from hlr.errors import SourceError
from hlr.source import open_source
from hlr.source.cad import brep_file
from hlr.source.cad.kernel_shapes import KernelShapes, NeedsOpenCascadeError
from hlr.source.cad.part_shapes import OcctShapes
from hlr.source.cad.parts import Leaf, PartCollector
from support.shapes_of_all_kinds import shapes, tables

DATA = Path(__file__).parents[1] / "data"
ROUNDED = DATA / "brep/rounded.brep"


def written(shape, version=3):
    pytest.importorskip("OCP")
    from OCP.BRepTools import BRepTools
    from OCP.Message import Message_ProgressRange
    from OCP.TopTools import TopTools_FormatVersion

    stream = io.BytesIO()
    kind = getattr(TopTools_FormatVersion, f"TopTools_FormatVersion_VERSION_{version}")
    BRepTools.Write_s(shape, stream, False, False, kind, Message_ProgressRange())
    return stream.getvalue()


def collected(data, opencascade):
    kind = OcctShapes() if opencascade else KernelShapes()
    shape = (brep_file.read_brep if opencascade else brep_file.read_lean)(data)
    collector = PartCollector(kind, [Leaf(shape, "part")])
    return collector, collector.prototypes


@pytest.mark.slow
def test_the_kernel_reads_what_opencascade_reads():
    for name, shape in shapes().items():
        for version in (1, 2, 3):
            data = written(shape, version)
            (wanted, prototypes), (found, own) = collected(data, True), collected(data, False)
            assert [part.name for part in found.parts] == [part.name for part in wanted.parts], name
            assert [part.prototype for part in found.parts] == [part.prototype for part in wanted.parts], name
            for one, other in zip(found.parts, wanted.parts, strict=True):
                assert np.allclose(one.transform, other.transform, rtol=0, atol=1e-12), name
            if found.parts:
                for one, other in zip(tables(own.model), tables(prototypes.model), strict=True):
                    assert one.shape == other.shape and np.array_equal(one, other), name


@pytest.mark.slow
def test_drawings_have_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.setenv("HLR_CACHE", "off")
    some = shapes()
    paths = []
    for name in ("mirrored", "scaled", "compound"):
        paths.append(tmp_path / f"{name}.brep")
        paths[-1].write_bytes(written(some[name]))
    lean = [hlr.draw(path, "iso").to_svg() for path in paths]

    def refuse(_):
        raise NeedsOpenCascadeError("asked for")

    monkeypatch.setattr(brep_file, "read_lean", refuse)
    assert [hlr.draw(path, "iso").to_svg() for path in paths] == lean


LOADED = """
import sys, hlr
drawings = [hlr.draw(sys.argv[1]), hlr.draw(sys.argv[2])]
drawings += hlr.draw_pages(sys.argv[2])
print(len(drawings), all(drawing.to_svg() for drawing in drawings))
print(sorted(name for name in sys.modules if name.partition(".")[0] in ("OCP", "cadquery")))
"""


@pytest.mark.slow
def test_opencascade_is_not_loaded():
    command = [sys.executable, "-P", "-c", LOADED, str(ROUNDED), str(DATA / "housing_body.FCStd")]
    environment = os.environ | {"HLR_CACHE": "off"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    first, modules = done.stdout.splitlines()
    assert first.endswith("True") and int(first.split()[0]) > 2
    assert modules == "[]"


def test_the_box_is_that_of_the_geometry():
    low, high = open_source(ROUNDED).bounds()
    assert np.allclose([low, high], [(-2, -1.5, -1), (2, 1.5, 1)], rtol=0, atol=1e-12)


def test_what_only_opencascade_may_read_is_left_to_it(tmp_path, monkeypatch):
    pytest.importorskip("OCP")
    asked = []
    read = brep_file.read_brep
    monkeypatch.setattr(brep_file, "read_brep", lambda data: asked.append(1) or read(data))
    data = ROUNDED.read_bytes()
    head, _, tail = data.partition(b"\nCurves ")
    count, _, rest = tail.partition(b"\n")
    # A line without a direction: OpenCASCADE leaves it out.
    odd = tmp_path / "odd.brep"
    odd.write_bytes(
        head + b"\nCurves %d\n" % (int(count) + 1) + rest.replace(b"Polygon3D", b"1 0 0 0 0 0 0\nPolygon3D", 1)
    )
    assert open_source(odd).infos()[0].faces == 26
    assert asked == [1]
    assert open_source(ROUNDED).infos()[0].faces == 26
    assert asked == [1]


@pytest.mark.parametrize("share", [0.0001, 0.3, 0.9, 0.999])
def test_a_file_that_is_cut_short(tmp_path, share):
    path = tmp_path / "cut.brep"
    data = ROUNDED.read_bytes()
    path.write_bytes(data[: int(len(data) * share) + 1])
    with pytest.raises(SourceError, match=r"cut\.brep (is not a BREP file|cannot be read as BREP)"):
        open_source(path)


def test_no_damage_does_more_than_an_error():
    data, dice = ROUNDED.read_bytes(), random.Random(3)
    refused = 0
    for _ in range(150):
        changed = bytearray(data)
        for _ in range(dice.randrange(1, 4)):
            changed[dice.randrange(len(data))] = dice.choice(b"0123456789 -+.e*i\n")
        try:
            file = _kernel.BrepFile(bytes(changed))
            _kernel.BrepModel(_kernel.dump_of_pieces([file], [(0, i) for i in range(len(file.pieces))])).boxes()
        except (ValueError, NotImplementedError):
            refused += 1
    assert 0 < refused < 150


def test_a_file_is_locked_once():
    file = _kernel.BrepFile(ROUNDED.read_bytes())
    with pytest.raises(ValueError, match="given twice"):
        _kernel.dump_of_pieces([file, file], [(0, 0), (1, 0)])
    with pytest.raises(ValueError, match="a piece that there is not"):
        _kernel.dump_of_pieces([file], [(0, 1)])
