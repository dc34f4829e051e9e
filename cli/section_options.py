"""Sections on the command line: `--section` and `--uncut` of `hlr draw`."""

from __future__ import annotations

from typing import Any

import click

from hlr.errors import OptionError

from .parameters import SectionPlane


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
