"""How far off the mesh of a face may be is told in millimetres, unless the number tells nothing."""

import numpy as np

from hlr.source.cad.meshing_faults import MeshingFaults


def texts(faults: MeshingFaults) -> list[str]:
    return [note.text for note in faults.notes("case", np.arange(4, dtype=np.int32))]


def test_a_distance_that_a_model_can_have_is_told():
    assert texts(MeshingFaults(torn={1: 2.625, 3: 0.1})) == [
        'Part "case": 2 of 4 faces have surfaces that fold or jump, and may be 2.6 mm off there (faces 1 and 3).'
    ]


def test_that_of_a_surface_that_runs_away_to_infinity_is_not():
    assert texts(MeshingFaults(torn={1: 2.6e12})) == [
        'Part "case": 1 of 4 faces has a surface that folds over itself or jumps, and may be far off there (face 1).'
    ]
    assert texts(MeshingFaults(unfinished={2: 2.6e12})) == [
        'Part "case": 1 of 4 faces takes too much work to be meshed as finely as needed, and may be far off (face 2).'
    ]
