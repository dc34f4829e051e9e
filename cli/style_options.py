"""Options for the look of a drawing: a style, and single values that override it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.request.defaults import DPI
from hlr.request.style_check import MOST_DPI
from hlr.request.styles import STYLES

from .parameters import Number, Pixels

if TYPE_CHECKING:
    from hlr.request.style import Style

STYLE = (
    click.option(
        "--style",
        metavar="NAME|FILE",
        help=f"{', '.join(STYLES)}, or a TOML file. The single options below override it. Default: iso.",
    ),
    click.option(
        "--line-width",
        type=Number(0.01, 100.0),
        metavar="MM",
        help="Wide lines; narrow ones are half as wide. Default: 0.5, and 0.7 on sheets larger than A2.",
    ),
    click.option("--color", metavar="COLOUR", help="All lines: a CSS name, #rrggbb, or for SVG currentColor."),
    click.option("--hidden-color", metavar="COLOUR", help="Hidden lines."),
    click.option("--background", metavar="COLOUR", help="Of the page: a CSS name, #rrggbb, or none. Default: white."),
    click.option("--layers", type=click.Choice(["class", "part"]), help="Of SVG, PDF and DXF. Default: class."),
    click.option(
        "--part-colors",
        type=click.Choice(["lines", "fills"]),
        help="Colours of the model's parts: for their lines, or to paint their visible faces.",
    ),
    click.option(
        "--dpi",
        type=Number(1.0, MOST_DPI),
        metavar="N",
        help=f"PNG: pixels per inch of paper. Default: {DPI:g}.",
    ),
    click.option("--size", type=Pixels(), metavar="WxH", help="PNG: in pixels, instead of --dpi."),
)
"""How the drawing looks."""

SINGLE = ("line_width", "color", "hidden_color", "background", "layers", "part_colors", "dpi", "size")
"""The options that override the style, as the command line calls them."""


def style_from(chosen: dict[str, Any]) -> Style | None:
    """The style of these options, which are taken out of all that were chosen; None: nothing was asked for.

    It is the one that is named, with the single values in place of its own. Raises OptionError for a style that does
    not exist, or a value that is not allowed.
    """
    name = chosen.pop("style")
    single = {name: chosen.pop(name) for name in SINGLE}
    given = {name: value for name, value in single.items() if value is not None}
    if name is None and not given:
        return None
    from hlr.request.style_file import overridden, style_of

    if "size" in given or "dpi" in given:
        given = {"size": None, "dpi": None, **given}
    return overridden(style_of(name), **given)
