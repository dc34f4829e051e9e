"""Sections on the command line: `--section` and `--uncut` of `hlr draw` and `hlr plan`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError

from .parameters import SectionPlane, as_table

if TYPE_CHECKING:
    from hlr.request.options import View

    from .parameters import Vector3


SECTION = (
    click.option(
        "--section",
        type=SectionPlane(),
        metavar="VIEW[@PLACE]",
        multiple=True,
        callback=as_table("a view is cut once"),
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


def with_sections(views: tuple[View, ...], sections: dict[str, Any] | None, eye: Vector3 | None) -> tuple[View, ...]:
    """The views that were asked for, and those that are cut. Raises OptionError where one is seen from an eye."""
    if not sections:
        return views
    if eye is not None:
        raise OptionError("a section is seen in parallel projection: leave out --eye, or --section")
    from hlr.request.section import with_sections as with_cut_ones

    return with_cut_ones(views, sections)
