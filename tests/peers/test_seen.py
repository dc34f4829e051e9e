"""Missing lines, lines off their curves and lost faces are found, and a right drawing passes."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from peers import models, referee

import hlr
from hlr.drawing.drawing import Drawing
from hlr.drawing.saving import render
from support.at_size import AT_SIZE
from support.referee import exchange, reference
from support.referee.judge import RayCaster
from support.referee.seen import look

QUICK = 4000
"""Fineness of the reference mesh, diagonals per deflection."""
PIXELS = 400
RIGHT = ("bracket", "cone_and_cylinder", "clash", "shaft_in_bore", "thin_walls")


def judged(path: Path, drawer: Callable[[list[Drawing]], list[Drawing]] | None = None) -> list[referee.Judged]:
    """Front and isometric view of a model, judged; `drawer` spoils the drawings first."""
    with pytest.MonkeyPatch.context() as patch:
        if drawer is not None:
            draw_views = hlr.draw_views
            patch.setattr(hlr, "draw_views", lambda *given: drawer(draw_views(*given)))
        return list(referee.judge_file(path, ["front", "iso"], fineness=QUICK, pixels=PIXELS))


@pytest.mark.slow
@pytest.mark.parametrize("name", RIGHT)
def test_a_right_drawing_passes(name: str, tmp_path: Path) -> None:
    for each in judged(models.save(name, tmp_path)):
        assert each.row.asked > 300 and not each.row.bad, [str(each.row), *each.why()]


@pytest.mark.slow
def test_a_drawing_of_nothing_is_refused(tmp_path: Path) -> None:
    found = judged(models.save("clash", tmp_path), lambda drawings: [replace(d, lines=[]) for d in drawings])
    for each in found:
        assert each.row.faults and each.row.missing == each.row.asked > 300


@pytest.mark.slow
def test_a_drawing_of_everything_as_visible_is_refused(tmp_path: Path) -> None:
    def all_visible(drawings: Sequence[Drawing]) -> list[Drawing]:
        return [replace(d, lines=[replace(line, visible=True) for line in d.lines]) for d in drawings]

    for each in judged(models.save("clash", tmp_path), all_visible):
        assert each.row.wrong_visible and not each.row.missing


@pytest.fixture(scope="module")
def bracket(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, referee.Referee, dict[str, Any]]:
    """A file, its referee, and the document of its isometric drawing."""
    path = models.save("bracket", tmp_path_factory.mktemp("bracket"))
    model = reference.load(path, QUICK)
    drawing = hlr.draw(path, "iso", accuracy=model.accuracy, **AT_SIZE)
    return path, referee.Referee(model, referee.curves_of(path), PIXELS), json.loads(render(drawing, "json"))


def longest(document: dict[str, Any], **fits: Any) -> dict[str, Any]:
    """The longest visible line of a class; of several as long, the first."""
    lines = [line for line in document["lines"] if line["visible"] and fits.items() <= line.items()]
    assert lines
    length = [round(float(np.linalg.norm(np.ptp(line["points"], axis=0))), 6) for line in lines]
    found: dict[str, Any] = lines[length.index(max(length))]
    return found


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["sharp", "outline"])
def test_a_line_that_is_not_drawn_is_missed(bracket: Any, kind: str) -> None:
    _, judging, document = bracket
    gone = longest(document, **{"class": kind})
    rest = {**document, "lines": [line for line in document["lines"] if line is not gone]}
    found = judging.judge("bracket", "hlr", exchange.parse(rest))
    assert not judging.judge("bracket", "hlr", exchange.parse(document)).row.bad
    faults = found.seen.gaps.faults
    ink = exchange.parse({**document, "lines": [gone]}).lines[0].ink(0.1)
    length = float(np.linalg.norm(np.diff(ink, axis=0), axis=1).sum())
    # Near other lines that it meets or passes, those lines cover for it.
    assert sum(run.length for run in faults) == pytest.approx(length, rel=0.15, abs=15 * found.seen.sheet.pixel)
    assert all(np.linalg.norm(ink - run.at, axis=1).min() < 2 * found.seen.sheet.pixel for run in faults)
    assert found.row.bad and any("no visible line" in text for text in found.why())


@pytest.mark.parametrize("accuracies", [0.5, 2.0])
def test_an_edge_off_its_curve_is_noticed(bracket: Any, accuracies: float) -> None:
    """The edge is moved on paper and in the model alike, so that only its own curve shows the fault."""
    _, judging, document = bracket
    moved = longest(document, **{"class": "sharp", "visible": True})
    drawing = exchange.parse(document)
    (ax, ay), (bx, by) = moved["points"][0], moved["points"][-1]
    aside = np.array([ay - by, bx - ax]) / np.hypot(ax - bx, ay - by) * accuracies * drawing.accuracy
    there = aside / drawing.factor @ [drawing.camera.right, drawing.camera.up]
    off = {
        **moved,
        "points": (np.array(moved["points"]) + aside).tolist(),
        "points3": (np.array(moved["points3"]) + there).tolist(),
    }
    assert "curve" not in moved
    spoilt = {**document, "lines": [off if line is moved else line for line in document["lines"]]}
    found = judging.judge("bracket", "hlr", exchange.parse(spoilt))
    assert len(found.off) == (accuracies > 1)
    if found.off:
        assert found.off[0].accuracies == pytest.approx(accuracies, rel=0.01)
        assert found.row.bad and any("off its curve" in text for text in found.why())


@pytest.mark.slow
def test_a_face_that_is_lost_is_noticed_both_ways(bracket: Any) -> None:
    path, _, document = bracket
    whole, drawing = reference.load(path, QUICK), exchange.parse(document)
    corners = whole.points[whole.triangles]
    top = (np.ptp(corners[:, :, 2], axis=1) < 1e-9) & (corners[:, 0, 2] > 34)
    assert top.any() and not top.all()
    holed = reference.from_arrays(whole.points, whole.triangles[~top])
    area = np.pi * (15**2 - 9**2) / 3**0.5
    for model, own in ((whole, holed), (holed, whole)):
        lost = look(drawing, RayCaster(replace(model, fineness=QUICK)), own, PIXELS).lost
        assert lost is not None and sum(each for each, _ in lost.areas) == pytest.approx(area, rel=0.15)
    same = look(drawing, RayCaster(whole), whole, PIXELS).lost
    assert same is not None and not same.areas


def test_a_drawing_made_without_a_face_is_refused(bracket: Any) -> None:
    """As if the mesher had given up on it: the referee needs no triangles of ours to see that."""
    from OCP.BRepTools import BRepTools_ReShape

    path, judging, _ = bracket
    shape = models.MODELS["bracket"]()
    without = BRepTools_ReShape()
    without.Remove(shape.faces(">Z").val().wrapped)
    drawing = hlr.draw(
        without.Apply(shape.val().wrapped), "iso", accuracy=reference.load(path, QUICK).accuracy, **AT_SIZE
    )
    found = judging.judge("bracket", "hlr", exchange.parse(render(drawing, "json")))
    assert found.row.bad, found.row


def test_a_crack_is_no_jump() -> None:
    """Two unjoined sheets before a wall: less than an accuracy apart nothing need be drawn, farther apart it is."""
    document = {
        "format": "hlr-drawing",
        "version": 2,
        "accuracy": {"used": 0.05},
        "view": {
            "name": "front",
            "projection": "orthographic",
            "direction": [0, -1, 0],
            "right": [1, 0, 0],
            "up": [0, 0, 1],
        },
        "scale": 1.0,
        "origin": [0.0, 0.0],
        "model": {"unit": 1.0},
        "parts": [{"name": "sheets"}],
    }
    border = [[0, 0], [100, 0], [100, 100], [0, 100], [0, 0]]
    frame = {"class": "boundary", "visible": True, "part": 0, "edge": 0, "face": None, "points": border}
    document["lines"] = [{**frame, "points3": [[x, 0, z] for x, z in border]}]
    for wide, lines in ((0.04, 0), (0.4, 2)):
        sheets = [square(0, 50, 0), square(50 + wide, 100, 0), square(0, 100, 20)]
        points = np.concatenate(sheets)
        triangles = [[4 * i + a, 4 * i + b, 4 * i + c] for i in range(3) for a, b, c in ((0, 1, 2), (0, 2, 3))]
        # Across the grid's columns, so that pixels fall into the crack somewhere.
        inner = (points[:, 0] > 0) & (points[:, 0] < 100)
        points[inner, 0] += 0.01 * points[inner, 2]
        gaps = look(exchange.parse(document), RayCaster(reference.from_arrays(points, triangles)), pixels=PIXELS).gaps
        assert (len(gaps.faults) > 0) == bool(lines), gaps.faults


def square(low: float, high: float, depth: float) -> np.ndarray:
    return np.array([[low, depth, 0], [high, depth, 0], [high, depth, 100], [low, depth, 100]], dtype=float)
