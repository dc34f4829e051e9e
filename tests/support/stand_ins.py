"""Draws stand-ins for a source: test objects with the methods of an opened source."""

from collections.abc import Sequence
from typing import Any
from unittest import mock

from hlr import Drawing, Options
from hlr.pipeline import session
from hlr.pipeline.draw import draw_views


def draw_source(source: Any, view: str | Sequence[float], options: Options) -> Drawing:
    """Draw an object that has the methods of an opened source: `hlr.draw_views` without reading."""
    with mock.patch.object(session, "open_selected", lambda thing, _: thing):
        return draw_views(source, [view], options)[0]
