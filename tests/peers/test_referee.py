"""The referee accepts right drawings and finds faults in wrong ones; otherwise zero faults would mean nothing."""

from __future__ import annotations

import ast
import copy
import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from peers import models, occt, referee
from PIL import Image

from support.programs import environment
from support.referee import exchange, reference
from support.referee.judge import FRACTIONS, RayCaster, judge, offenders
from support.referee.referee import Referee


def test_the_referee_imports_nothing_of_hlr() -> None:
    """A mistake that both share would not be found."""
    for path in Path(reference.__file__).parent.glob("*.py"):
        nodes = list(ast.walk(ast.parse(path.read_text("utf-8"))))
        names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
        names += [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)]
        own = [name for name in names if name.split(".")[0] == "support" and not name.startswith("support.referee")]
        assert not own and not [name for name in names if name.split(".")[0] == "hlr"], path.name


def wall_document(lines: list[dict[str, Any]], eye: list[float] | None = None) -> dict[str, Any]:
    view = {"name": "front", "projection": "orthographic", "direction": [0, -1, 0], "right": [1, 0, 0], "up": [0, 0, 1]}
    if eye is not None:
        view |= {"projection": "perspective", "eye": eye, "distance": 1.0}
    return {
        "format": "hlr-drawing",
        "version": 2,
        "view": view,
        "scale": 1.0,
        "origin": [0.0, 0.0],
        "model": {"unit": 1.0, "up_axis": np.eye(3).tolist()},
        "parts": [{"name": "wall", "color": None, "transform": np.eye(4).tolist()}],
        "lines": lines,
    }


def line(points3: list[list[float]], visible: bool) -> dict[str, Any]:
    points = [[x, z] for x, _, z in points3]
    return {
        "class": "sharp",
        "visible": visible,
        "part": 0,
        "edge": 3,
        "face": None,
        "points": points,
        "points3": points3,
    }


@pytest.fixture(scope="module")
def wall() -> RayCaster:
    """The square 0..10 in x and z at y = 0; the viewer looks along +y."""
    corners = [[0, 0, 0], [10, 0, 0], [10, 0, 10], [0, 0, 10]]
    return RayCaster(reference.from_arrays(corners, [[0, 1, 2], [0, 2, 3]]))


def wrong(caster: RayCaster, *lines: dict[str, Any], eye: list[float] | None = None) -> tuple[int, int]:
    verdict = judge(exchange.parse(wall_document(list(lines), eye)), caster)
    return int(verdict.wrong_visible.sum()), int(verdict.wrong_hidden.sum())


@pytest.mark.parametrize(
    ("depth", "visible", "expected"),
    [(5, True, (5, 0)), (5, False, (0, 0)), (-5, True, (0, 0)), (-5, False, (0, 5)), (0, True, (0, 0))],
)
def test_lines_before_and_behind_a_wall(
    wall: RayCaster, depth: float, visible: bool, expected: tuple[int, int]
) -> None:
    assert wrong(wall, line([[1, depth, 5], [9, depth, 5]], visible)) == expected


def test_line_that_leaves_the_wall_is_wrong_only_behind_it(wall: RayCaster) -> None:
    crossing = [[5.0, 3.0, 5.0], [15.0, 3.0, 5.0]]
    assert wrong(wall, line(crossing, True)) == (2, 0)  # at 0.1 and 0.3; 0.5 is the border itself
    assert wrong(wall, line(crossing, False)) == (0, 2)


def test_border_of_an_occluder_may_be_called_either_way(wall: RayCaster) -> None:
    border = [[0.0, 4.0, 1.0], [0.0, 4.0, 9.0]]
    assert wrong(wall, line(border, True)) == wrong(wall, line(border, False)) == (0, 0)


def test_depth_within_tolerance_does_not_hide(wall: RayCaster) -> None:
    diagonal = 10 * 2**0.5
    near, far = diagonal / 10000, diagonal / 7000
    assert wrong(wall, line([[1, near * 0.7, 5], [9, near * 0.7, 5]], True)) == (0, 0)
    assert wrong(wall, line([[1, far, 5], [9, far, 5]], True)) == (5, 0)


def test_short_lines_are_not_judged(wall: RayCaster) -> None:
    assert wrong(wall, line([[5, 5, 5], [5.01, 5, 5]], True)) == (0, 0)
    assert wrong(wall, line([[5, 5, 5], [5.001, 9, 5]], True)) == (0, 0)  # long, but along the line of sight


def test_perspective_rays_end_at_the_eye(wall: RayCaster) -> None:
    behind = line([[4, 5, 5], [6, 5, 5]], True)
    assert wrong(wall, behind, eye=[5, -20, 5]) == (5, 0)
    assert wrong(wall, behind, eye=[5, 2, 5]) == (0, 0)  # the wall lies behind the viewer
    aside = line([[30, 5, 5], [31, 5, 5]], True)
    assert wrong(wall, aside, eye=[5, -1, 5]) == (5, 0)  # seen obliquely through the wall


def test_paper_position_must_be_the_projection(wall: RayCaster) -> None:
    moved = line([[1, -1, 5], [9, -1, 5]], True)
    moved["points"][1][0] += 0.5
    assert judge(exchange.parse(wall_document([moved])), wall).displaced == 1


def test_paper_position_in_perspective(wall: RayCaster) -> None:
    entry = line([[4, 0, 5], [8, 0, 7]], True)
    entry["points"] = [[-0.1, 0.0], [0.3, 0.2]]  # the eye is 10 before the wall, the image plane 1 before the eye
    assert judge(exchange.parse(wall_document([entry], eye=[5, -10, 5])), wall).displaced == 0
    entry["points"][1][1] = 0.21
    assert judge(exchange.parse(wall_document([entry], eye=[5, -10, 5])), wall).displaced == 1


def test_offenders_name_part_edge_and_place(wall: RayCaster) -> None:
    drawing = exchange.parse(wall_document([line([[1, 5, 5], [9, 5, 5]], True)]))
    (text,) = offenders(drawing, judge(drawing, wall))
    assert text.startswith("5/5 sharp visible: part 0 'wall' edge 3") and "(1.8, 5, 5)" in text


@pytest.mark.parametrize("spoil", ["format", "points3", "part", "direction", "nan"])
def test_broken_documents_are_refused(spoil: str) -> None:
    document = wall_document([line([[1, 5, 5], [9, 5, 5]], True)])
    if spoil == "format":
        document["format"] = "svg"
    elif spoil == "points3":
        document["lines"][0]["points3"].pop()
    elif spoil == "part":
        document["lines"][0]["part"] = 1
    elif spoil == "direction":
        document["view"]["direction"] = [0, 1, 0]
    else:
        document["lines"][0]["points"][0][0] = float("nan")
    with pytest.raises(exchange.FormatError):
        exchange.parse(document)


@pytest.mark.parametrize("view", ["front", "iso"])
def test_exact_peer_passes_on_a_bracket_and_fails_when_inverted(view: str) -> None:
    shape = models.shape("bracket")
    caster = RayCaster(reference.from_shape(shape))
    document = occt.draw(shape, "exact", occt.camera_of(view))
    verdict = judge(exchange.parse(document), caster)
    assert verdict.judged > 30 and verdict.wrong == 0 and verdict.displaced == 0
    inverted = copy.deepcopy(document)
    for entry in inverted["lines"]:
        entry["visible"] = not entry["visible"]
    # Not all: coincident hidden lines of a front view lie on the very contour that the ring straddles.
    assert judge(exchange.parse(inverted), caster).wrong > 0.4 * verdict.judged * len(FRACTIONS)


def test_reference_of_a_far_away_model_is_as_good(tmp_path: Path) -> None:
    """Single precision in Embree must not matter: the same answer a kilometre from the origin."""
    import cadquery as cq

    for offset in (0.0, 1e6):
        shape = models.MODELS["bracket"]().val().moved(cq.Location((offset, 0, -offset))).wrapped
        verdict = judge(
            exchange.parse(occt.draw(shape, "exact", occt.camera_of("iso"))), RayCaster(reference.from_shape(shape))
        )
        assert verdict.wrong == 0


@pytest.mark.slow
def test_command_judges_a_peer_and_writes_the_table(tmp_path: Path) -> None:
    path = models.save("box", tmp_path)
    table = tmp_path / "table.md"
    command = [
        sys.executable,
        "-P",
        "-m",
        "peers.referee",
        path,
        "--views=iso",
        "--peer=occt-exact",
        "--peer=occt-poly",
        "--pixels=400",
    ]
    done = subprocess.run(
        [*command, f"--table={table}", f"--png={tmp_path}"],
        capture_output=True,
        text=True,
        check=False,
        env=environment(),
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert table.read_text().count("| box.brep") == 2
    with Image.open(tmp_path / "box-occt-exact-iso.png") as picture:
        assert picture.size[0] > 400 and len(picture.getcolors(1000) or []) > 2


def test_command_judges_in_perspective(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The drawing judged is one in perspective; were the option lost, it would have no eye."""
    judged: list[exchange.Exchange] = []
    judge = Referee.judge

    def noted(self: Referee, file: str, drawer: str, drawing: exchange.Exchange, *rest: Any) -> Any:
        judged.append(drawing)
        return judge(self, file, drawer, drawing, *rest)

    monkeypatch.setattr(Referee, "judge", noted)
    path = str(models.save("box", tmp_path))
    assert referee.main([path, "--view", "iso", "--perspective", "50", "--fineness", "2000"]) == 0
    assert referee.main([path, "--view", "iso", "--fineness", "2000"]) == 0
    assert [drawing.camera.eye is None for drawing in judged] == [False, True]


def test_command_says_when_a_peer_does_not_end(tmp_path: Path) -> None:
    path = models.save("box", tmp_path)
    (judged,) = referee.judge_file(path, ["iso"], ["occt-exact"], timeout=0.05)
    assert judged.row.bad and "no end" in judged.row.failure


def test_meshes_load_in_their_own_units(tmp_path: Path) -> None:
    for suffix in (".stl", ".obj", ".ply", ".glb"):
        model = reference.load(models.save("box", tmp_path, suffix))
        assert len(model.triangles) == 12
        assert model.diagonal == pytest.approx((30**2 + 20**2 + 10**2) ** 0.5, rel=1e-6)
        assert model.unit == (1000.0 if suffix == ".glb" else 1.0)


def test_a_coarser_mesh_is_judged_by_longer_measures() -> None:
    """Twice the deflection, twice the depth from which a hit counts."""
    corners, faces = [[0, 0, 0], [10, 0, 0], [10, 0, 10], [0, 0, 10]], [[0, 1, 2], [0, 2, 3]]
    full = reference.from_arrays(corners, faces)
    behind = line([[1, full.diagonal / 6000, 5], [9, full.diagonal / 6000, 5]], True)
    assert wrong(RayCaster(full), behind) == (5, 0)
    assert wrong(RayCaster(replace(full, fineness=reference.FINENESS / 2)), behind) == (0, 0)


def test_cache_gives_the_same_mesh(tmp_path: Path) -> None:
    path = models.save("bracket", tmp_path)
    fresh, kept = (reference.load(path, 5000, tmp_path / "cache") for _ in range(2))
    assert (fresh.points == kept.points).all() and (fresh.triangles == kept.triangles).all()
    assert (fresh.diagonal, fresh.fineness) == (kept.diagonal, kept.fineness) and len(
        list(tmp_path.glob("cache/*"))
    ) == 1
    assert len(reference.load(path, 20000, tmp_path / "cache").triangles) > len(kept.triangles)


def test_json_survives_a_round_trip(tmp_path: Path) -> None:
    document = wall_document([line([[1, 5, 5], [9, 5, 5]], True)])
    (tmp_path / "a.json").write_text(json.dumps(document))
    assert exchange.read(tmp_path / "a.json").lines[0].kind == "sharp"


@pytest.mark.slow
def test_command_judges_a_finished_drawing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = models.save("bracket", tmp_path)
    document = occt.draw(reference.read_shape(model), "exact", occt.camera_of("iso"))
    (tmp_path / "a.json").write_text(json.dumps(document))
    assert referee.main([str(tmp_path / "a.json"), "--against", str(model)]) == 0
    drawing, caster = exchange.parse(document), RayCaster(reference.load(model))
    verdict = judge(drawing, caster)
    deep = int(verdict.samples.line[np.flatnonzero(verdict.blocked == 9)[0]])
    document["lines"][deep]["visible"] = True
    (tmp_path / "a.json").write_text(json.dumps(document))
    assert referee.main([str(tmp_path / "a.json"), "--against", str(model), "--why"]) == 1
    assert f"line {deep} at" in capsys.readouterr().out


@pytest.mark.slow
def test_missing_and_wrongly_hidden_outlines_are_noticed() -> None:
    """Rays from drawn lines cannot find these: a contour wrongly hidden, and a missing line."""
    shape = models.shape("bracket")
    judging = referee.Referee(reference.from_shape(shape))
    document = occt.draw(shape, "exact", occt.camera_of("iso"))
    whole = judging.judge("bracket", "occt", exchange.parse(document))
    assert whole.row.asked > 200 and not whole.row.bad, list(whole.why())
    outlines = [entry for entry in document["lines"] if entry["class"] == "outline" and entry["visible"]]
    seen = max(outlines, key=lambda entry: float(np.ptp(entry["points"], axis=0).max()))
    seen["visible"] = False
    called_hidden = judging.judge("bracket", "occt", exchange.parse(document)).row
    assert called_hidden.missing and not called_hidden.wrong_hidden
    document["lines"] = []
    assert judging.judge("bracket", "occt", exchange.parse(document)).row.missing > 0.5 * whole.row.asked
