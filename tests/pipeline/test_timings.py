"""The times of a drawing's stages: all that is done for it counts in one of them."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import pytest
from pipeline.models import bracket

import hlr
import hlr.pipeline.finish
import hlr.pipeline.section.draw
import hlr.pipeline.session

WAIT = 0.1
"""Seconds."""

SLOWED = (
    (hlr.pipeline.session, "of_one_scale", None),
    (hlr.pipeline.session, "image_of", None),
    (hlr.pipeline.session, "hiding", None),
    (hlr.pipeline.finish, "also_called", None),
    (hlr.pipeline.section.draw, "open_selected", True),
)
"""Steps between the stages, and whether a section is asked for."""


def slow(step: Callable[..., Any]) -> Callable[..., Any]:
    def slowed(*args: Any, **options: Any) -> Any:
        time.sleep(WAIT)
        return step(*args, **options)

    return slowed


@pytest.mark.parametrize(("module", "name", "section"), SLOWED)
def test_what_happens_between_stages_counts_in_one(
    monkeypatch: pytest.MonkeyPatch, module: Any, name: str, section: bool | None
) -> None:
    monkeypatch.setattr(module, name, slow(getattr(module, name)))
    drawing = hlr.draw(bracket(), "front", section=section)
    stages = {stage: seconds for stage, seconds in drawing.timings.items() if stage != "total"}
    assert drawing.timings["total"] == pytest.approx(sum(stages.values()))
    assert max(stages.values()) >= WAIT
