"""The benchmarks measure what they say: same scenes on both sides, and a run that fails is reported as such."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from bench import loads, measure, occt, ours, run, scenes


def test_scenes_have_the_parts_they_promise() -> None:
    from cadquery import Shape

    plate = Shape.cast(scenes.plate(4))
    assert plate.isValid() and len(plate.Faces()) == 6 + 16
    assert plate.Volume() == pytest.approx(40 * 40 * 6 - 16 * 6 * 3.141592653589793 * 2.5**2, rel=1e-9)
    assembly = Shape.cast(scenes.assembly(28))
    assert len(assembly.Solids()) == 28 and len({len(solid.Faces()) for solid in assembly.Solids()}) == 2
    assert len(Shape.cast(scenes.tori(5)).Solids()) == 5


def test_cells_of_exact_cubes() -> None:
    assert [scenes._cells(count) for count in (1, 8, 9, 1000, 1001, 4000, 16000)] == [1, 2, 3, 10, 11, 16, 26]


def test_parts_of_an_assembly_do_not_touch() -> None:
    """Each stays in the ball of its cell: else the peer and we would be asked about contacts too."""
    from cadquery import Shape

    for number, solid in enumerate(Shape.cast(scenes.assembly(200)).Solids()):
        vertices, _ = solid.tessellate(0.1, 0.5)
        centre = np.array([number % 6, number // 6 % 6, number // 36]) * scenes.CELL
        assert np.linalg.norm([v.toTuple() - centre for v in vertices], axis=1).max() < scenes.CELL / 2


def test_kernel_gets_the_triangles_that_the_peer_has() -> None:
    shape = scenes.assembly(30)
    occt.mesh(shape, 0.1, 0.5)
    kernel = ours.Kernel(shape, contact=0.1)
    assert kernel.triangles == occt.triangle_count(shape)
    assert kernel.run() > 0
    assert kernel.counters["failed_checks"] == 0 and kernel.counters["pieces"] > 100
    assert occt.poly(shape) > 0 and occt.exact(shape) > 0


def test_measure_reports_a_median_and_memory() -> None:
    result = measure.measure("plate20", "kernel", 1)
    assert result["seconds"] == result["all"][0] and result["peak_mb"] > 50 and result["triangles"] > 40_000


def test_a_measurement_that_fails_stays_in_the_table() -> None:
    failed = run.measured("no such file.step", "poly", 1, 60)
    assert "failure" in failed and run.seconds(failed) == failed["failure"] and run.ratio(failed, failed) == "-"


@pytest.mark.parametrize("name", loads.FILES)
def test_mesh_files_of_all_kinds_hold_the_same_torus(name, tmp_path) -> None:
    from hlr.source import open_source

    points, triangles = loads.torus(loads.RINGS, loads.SIDES)
    (tmp_path / name).write_bytes(loads.FILES[name](points, triangles))
    (part,) = open_source(tmp_path / name).mesh(0.1, 0.5).parts
    assert part.triangles.shape == triangles.shape == (13_478, 3)
    assert np.allclose(part.points[part.triangles], points[triangles], atol=1e-5)


def test_tori_lie_apart_and_processes_are_measured() -> None:
    points, triangles = loads.tori(2)
    assert len(triangles) == 2 * 80_800 and triangles.max() == len(points) - 1
    one, other = np.split(points, 2)
    assert np.linalg.norm(one.mean(axis=0) - other.mean(axis=0)) > 80.0
    seconds, megabytes = loads.processor_seconds([sys.executable, "-c", "sum(range(1_000_000))"])
    assert seconds > 0.01 and megabytes > 5.0
    with pytest.raises(RuntimeError, match="ended with"):
        loads.processor_seconds([sys.executable, "-c", "raise SystemExit(3)"])
