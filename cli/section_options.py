"""Sections on the command line: `--section` and `--uncut` of `hlr draw`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError

from .parameters import SectionPlane

if TYPE_CHECKING:
    from hlr.request.options import View


def _as_table(_ctx: click.Context, _parameter: click.Parameter, given: tuple[tuple[str, Any], ...]) -> dict[str, Any]:
    names = [name for name, _ in given]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise OptionError(f"--section gives {twice} twice: a view is cut once")
    return dict(given)


SECTION = (
    click.option(
        "--section",
        type=SectionPlane(),
        metavar="VIEW[@PLACE]",
        multiple=True,
        callback=_as_table,
        help="Draw this view as a section: what lies before a plane across it is taken away, and cut faces are "
        "hatched. front: through the middle of the model; front@12.5: at this coordinate, in millimetres, on the axis "
        "that the view looks along; front@0,12.5,0: through this point. May be repeated.",
    ),
    click.option(
        "--uncut",
        metavar="PART",
        multiple=True,
        help="--section: leave these parts whole, such as bolts, shafts and ribs. May be repeated.",
    ),
)


def with_sections(views: Sequence[View], sections: dict[str, Any], usual: Sequence[View]) -> tuple[View, ...]:
    """The views that are drawn: those that were asked for, or the usual ones, and those that are cut.

    usual: without any other view
    """
    from hlr.request.directions import directed

    found = tuple(views) or tuple(usual)
    names = [directed(view)[0] for view in found]
    more = [view for name in sections if name not in names for view in [_view(name)]]
    return (*found, *more)


def _view(name: str) -> View:
    """The view of a name, or of a direction that is written as one."""
    if "," not in name:
        return name  # type: ignore[return-value]
    x, y, z = map(float, name.split(","))
    return x, y, z
