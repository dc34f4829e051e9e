"""Drawings of sources that are no file and no object: stand-ins with the methods of one."""

from collections.abc import Sequence
from typing import Any
from unittest import mock

from hlr import Drawing, Options
from hlr.pipeline import session
from hlr.pipeline.draw import draw_views


def draw_source(source: Any, view: str | Sequence[float], options: Options) -> Drawing:
    """`hlr.draw_views` of something that has the methods of an opened source: all stages but reading."""
    with mock.patch.object(session, "open_selected", lambda thing, _: thing):
        return draw_views(source, [view], options)[0]
