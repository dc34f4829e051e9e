"""Drawings by hlr before the referee: no wrong sample on models that are each hard in one way."""

from __future__ import annotations

from pathlib import Path

import pytest
from peers import models, referee

import hlr
from support.at_size import AT_SIZE
from support.referee import exchange, reference
from support.referee.judge import RayCaster, judge, offenders

QUICK, PIXELS = 4000, 400
"""Fineness of the tests, and pixels of their depth images: the same rules at some times the lengths. The command line
judges at the full ones."""
VIEWS: list[referee.View] = ["front", "top", "right", "iso", *referee.random_views(1)]


@pytest.mark.slow
@pytest.mark.parametrize("name", models.MODELS)
def test_brep(name: str, tmp_path: Path) -> None:
    expect_faultless(models.save(name, tmp_path))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".stl", ".ply", ".glb"])
@pytest.mark.parametrize("name", ["bracket", "clash", "ball_in_ring"])
def test_mesh(name: str, suffix: str, tmp_path: Path) -> None:
    expect_faultless(models.save(name, tmp_path, suffix))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bracket", "ball_in_ring"])
def test_perspective(name: str, tmp_path: Path) -> None:
    from hlr.drawing.saving import render
    from hlr.request.options import Options, Perspective

    path = models.save(name, tmp_path)
    model = reference.load(path, QUICK)
    for fov in (30.0, 90.0):
        options = Options(accuracy=model.accuracy, perspective=Perspective(fov=fov), **AT_SIZE)
        (drawing,) = hlr.draw_views(path, ["iso"], options)
        document = exchange.parse(render(drawing, "json"))
        assert document.camera.eye is not None
        verdict = judge(document, RayCaster(model))
        assert verdict.judged and not verdict.wrong, "\n".join(offenders(document, verdict))


def expect_faultless(path: Path) -> None:
    drawn = 0
    for judged in referee.judge_file(path, VIEWS, fineness=QUICK, pixels=PIXELS):
        assert not judged.row.bad, f"{judged.row}\n" + "\n".join(judged.why())
        assert judged.row.visible and judged.row.asked, "a drawing with nothing visible proves nothing"
        drawn += 1
    assert drawn == len(VIEWS)
