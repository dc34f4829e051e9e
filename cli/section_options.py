"""Sections on the command line: `--section`, `--whole` and `--uncut` of `hlr draw` and `hlr plan`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from hlr.errors import OptionError

from .parameters import SectionPlane, ViewName
from .view_options import names_of

if TYPE_CHECKING:
    from hlr.request.options import SectionPlace, View

    from .parameters import Vector3


SECTION = (
    click.option(
        "--section",
        type=SectionPlane(),
        metavar="VIEW[@PLACE]",
        multiple=True,
        help="Draw this view as a section: what lies before a plane across it is taken away, and cut faces are "
        "hatched. front: through the middle of the model; front@12.5: at this coordinate, in millimetres, on the axis "
        "that the view looks along; front@0,12.5,0: through this point. May be repeated, also for one view, which "
        "is then drawn once for each plane.",
    ),
    click.option(
        "--whole",
        type=ViewName(),
        metavar="VIEW",
        multiple=True,
        help="--section: draw this view whole as well. It has its place on a page, and its sections lie beside it. "
        "May be repeated. Default: a section takes the place of its view.",
    ),
    click.option(
        "--uncut",
        metavar="PART",
        multiple=True,
        help="--section: leave these parts whole, such as bolts, shafts and ribs. May be repeated.",
    ),
)


def with_sections(
    views: tuple[View, ...], sections: tuple[tuple[str, SectionPlace], ...], eye: Vector3 | None
) -> tuple[View, ...]:
    """The views that were asked for, and those that are cut. Raises OptionError where one is seen from an eye."""
    if not sections:
        return views
    if eye is not None:
        raise OptionError("a section is seen in parallel projection: leave out --eye, or --section")
    from hlr.request.section import with_sections as with_cut_ones

    return with_cut_ones(views, sections)


def names_of_drawings(
    views: tuple[View, ...],
    sections: tuple[tuple[str, SectionPlace], ...],
    whole: tuple[View, ...],
    eye: Vector3 | None,
) -> list[str]:
    """The names of drawings in file names: those of the views, and of the sections of one view.

    views: with those that are cut; whole: those that are drawn besides their sections

    Raises OptionError where both an eye and a view are given, or a plane twice.
    """
    names = names_of(views, eye)
    if not sections:
        return names
    from hlr.request.section import checked_section, checked_whole
    from hlr.request.shown_views import shown_views

    return [each.name for each in shown_views(views, checked_section(sections), checked_whole(whole))]
