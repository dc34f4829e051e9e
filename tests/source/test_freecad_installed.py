"""Documents that an installed FreeCAD makes at random: every solid lies where FreeCAD itself has it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from hlr.source.cad.shapes import sub_shapes
from hlr.source.freecad.document import open_document
from hlr.source.freecad.shapes import Shapes
from hlr.source.freecad.tree import Tree
from support.installed_freecad import needs_freecad, run

SCRIPT = Path(__file__).parents[1] / "support" / "freecad_makes_documents.py"


def solids(shape):
    """[volume, x, y, z of the centre] of each solid."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    found = []
    for solid in sub_shapes(shape, Kind.TopAbs_SOLID):
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid, properties)
        centre = properties.CentreOfMass()
        found.append([properties.Mass(), centre.X(), centre.Y(), centre.Z()])
    return found


def in_order(found):
    return np.array(sorted(found, key=lambda numbers: [round(value, 2) for value in numbers])).reshape(-1, 4)


@needs_freecad
@pytest.mark.slow
def test_every_solid_lies_where_freecad_has_it(tmp_path):
    said = run(SCRIPT, HLR_FREECAD_FOLDER=str(tmp_path), HLR_FREECAD_COUNT="12")
    assert (tmp_path / "found.json").exists(), said
    documents = json.loads((tmp_path / "found.json").read_text())
    assert len(documents) == 12
    for path, expected in documents.items():
        with open_document(Path(path)) as document:
            tree = Tree(document, Shapes(opencascade=True), hidden=False)
        found = {label: [] for label in expected}
        for leaf in tree.leaves:
            found[leaf.name.split("/")[0]] += solids(leaf.shape)
        assert tree.notes == []
        for label in expected:
            here, there = in_order(found[label]), in_order(expected[label])
            assert here.shape == there.shape, (path, label)
            assert np.allclose(here, there, rtol=1e-5, atol=1e-4), (path, label)
