"""The benchmarks measure what they say: the same scenes on both sides, and a run that fails is reported."""

from __future__ import annotations

import json
import sys
from argparse import Namespace

import numpy as np
import pytest
from bench import cuts, drawings, loads, measure, occt, ours, pairs, run, scenes
from cadquery import Shape

from hlr.lab.rivals.opencascade import ExactAlgo, PolyAlgo, triangle_count


def test_scenes_have_the_parts_they_promise() -> None:
    plate = Shape.cast(scenes.plate(4))
    assert plate.isValid() and len(plate.Faces()) == 6 + 16
    assert plate.Volume() == pytest.approx(40 * 40 * 6 - 16 * 6 * 3.141592653589793 * 2.5**2, rel=1e-9)
    assembly = Shape.cast(scenes.assembly(28))
    assert len(assembly.Solids()) == 28 and len({len(solid.Faces()) for solid in assembly.Solids()}) == 2
    assert len(Shape.cast(scenes.tori(5)).Solids()) == 5


def test_cells_of_exact_cubes() -> None:
    assert [scenes._cells(count) for count in (1, 8, 9, 1000, 1001, 4000, 16000)] == [1, 2, 3, 10, 11, 16, 26]


@pytest.mark.slow
def test_parts_of_an_assembly_do_not_touch() -> None:
    """Each stays within a ball in its cell; otherwise the benchmark would also measure contacts."""
    for number, solid in enumerate(Shape.cast(scenes.assembly(200)).Solids()):
        vertices, _ = solid.tessellate(0.1, 0.5)
        centre = np.array([number % 6, number // 6 % 6, number // 36]) * scenes.CELL
        assert np.linalg.norm([v.toTuple() - centre for v in vertices], axis=1).max() < scenes.CELL / 2


def test_kernel_gets_the_triangles_that_the_peer_has() -> None:
    shape = scenes.assembly(30)
    occt.mesh(shape, 0.1, 0.5)
    kernel = ours.Kernel(shape, contact=0.1)
    assert kernel.triangles == triangle_count(shape)
    assert kernel.run() > 0
    assert kernel.counters["failed_checks"] == 0 and kernel.counters["pieces"] > 100
    assert occt.hide(shape, PolyAlgo) > 0 and occt.hide(shape, ExactAlgo) > 0


@pytest.mark.slow
def test_measure_reports_a_median_and_memory() -> None:
    (result,) = measure.measure("plate20", ["kernel"], 1)
    assert result["seconds"] == result["all"][0] and result["peak_mb"] > 50 and result["triangles"] > 40_000


@pytest.mark.slow
def test_a_measurement_that_fails_stays_in_the_table() -> None:
    given = Namespace(budget=60.0, timeout=60.0, repeat=1, memory=True)
    failed, other = pairs.together("no such file.step", ["poly", "kernel"], given)
    assert "failure" in failed and pairs.seconds(failed) == failed["failure"] and "failure" in other
    assert pairs.ratio(failed, other) is None and pairs.times(None) == pairs.memory(failed) == "-"


def test_pairs_take_turns_and_stop_within_their_budget(monkeypatch) -> None:
    ran = []
    monkeypatch.setattr(measure, "_runner", lambda *given: lambda: ran.append(given[2]) or 1.0)
    one, other = measure.measure("box", ["hlr-svg", "cadquery-svg"], 3)
    assert ran == ["hlr-svg", "cadquery-svg", "cadquery-svg", "hlr-svg", "hlr-svg", "cadquery-svg"]
    assert one["all"] == other["all"] == [1.0, 1.0, 1.0] and "peak_mb" not in one
    (alone,) = measure.measure("box", ["hlr-svg"], 3, budget=0.0)
    assert alone["all"] == [1.0]


def test_what_is_lost_stands_out() -> None:
    assert [pairs.times(value) for value in (3.14, 1.0, 0.5)] == ["3.1 x", "1.0 x", "**0.50 x**"]
    assert pairs.won([2.0, 0.5, None]) == "Geometric mean of 2 ratios: 1.00; lost: 1."


def test_a_drawing_beyond_its_limits_stands_out() -> None:
    stages = dict.fromkeys(drawings.STAGES.values(), 0.5)
    row = {"model": "a.step", "view": "iso", "scale": 0.5, "read": 1.0, "seconds": 9.0, "processor": 8.0}
    row |= {"stages": stages, "memory": 1500.0, "lines": 1234, "notes": ["defects: open", "defects: open too"]}
    cells = drawings.cells(row)
    assert len(cells) == len(drawings.HEADINGS)
    assert "9.0" in cells and "**1500**" in cells and cells[-2:] == ["1,234", "defects"]
    failed = drawings.cells({"model": "b.step", "view": "iso", "failure": "not in 200 s"})
    assert len(failed) == len(cells) and failed[-1] == "**not in 200 s**"


@pytest.mark.slow
def test_tables_are_made_of_what_was_asked_for(tmp_path, capsys) -> None:
    shapes = {"solid.brep": scenes.box(), "wire.brep": Shape.cast(scenes.box()).Edges()[0].wrapped}
    for name, shape in shapes.items():
        Shape.cast(shape).exportBrep(str(tmp_path / name))
    out = tmp_path / "figures.json"
    asked = ["--only", "svg,meshing", "--scenes", "sphere", "--repeat", "1", "--no-memory", "--json", str(out)]
    assert run.main([str(tmp_path), *asked]) == 0
    printed = capsys.readouterr().out
    assert "load average" in printed and "## svg" in printed and "Geometric mean of 2 ratios" in printed
    figures = json.loads(out.read_text())
    assert {row["scene"].rpartition("/")[2] for row in figures["svg"]} == {"sphere", "solid.brep"}
    assert [row["model"] for row in figures["meshing"]] == ["solid.brep"]
    with pytest.raises(SystemExit):
        run.main(["--only", "nothing"])


@pytest.mark.parametrize("who", [who for who in measure.WHO if who != "memory"])
def test_all_that_can_be_measured_can(who) -> None:
    if "build123d" in who:
        pytest.importorskip("build123d")
    (result,) = measure.measure("filleted box", [who], 1)
    assert result["seconds"] > 0.0
    assert ("svg" in who or "build123d" in who) == ("bytes" in result) and result.get("lines", 1) > 0


@pytest.mark.slow
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


def test_sections_are_cut_by_either() -> None:
    found = cuts.table(["filleted box"], 1)
    (result,) = found.results
    assert result["scene"] == "filleted box" and 0.0 < result["kernel"] < float("inf") > result["opencascade"] > 0.0
    assert cuts.sources.KernelCut is cuts.KernelCut
