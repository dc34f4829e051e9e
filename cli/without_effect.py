"""What was typed, and cannot change anything: a note says so. What is for another use of the verb is refused.

`ROWS` is the table. An option that is not in it always has a meaning, or is refused where it has none by the check of
the request itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import click
from click.core import ParameterSource

from hlr.errors import OptionError
from hlr.request.concerns import OF_FORMATS, OF_SOURCES, OfSources
from hlr.tables.entry import listed
from hlr.tables.projection_methods import PROJECTION_METHODS
from hlr.tables.readers import of_ending

from .exits import remark

if TYPE_CHECKING:
    from hlr.request.options import View


class Asked:
    """What was typed after a verb.

    verb    its name
    values  of all options and arguments, typed or not
    given   the options that were typed, by name
    """

    def __init__(self, ctx: click.Context) -> None:
        self.verb = ctx.command.name
        self.values: dict[str, Any] = ctx.params
        self._known = {each.name: each for each in ctx.command.params if isinstance(each, click.Option) and each.name}
        self.given = {
            name: each
            for name, each in self._known.items()
            if ctx.get_parameter_source(name) is ParameterSource.COMMANDLINE
        }

    def spelled(self, name: str) -> str:
        """An option as it was typed: --smooth, or --no-smooth."""
        option = self.given[name]
        off = self.values.get(name) is False and option.secondary_opts
        return max(off or option.opts, key=len)

    def as_typed(self, name: str) -> str:
        """An option that has this name in Python: as it was typed, else as it would be."""
        if typed := [self.spelled(each) for each in _ASKING.get(name, (name,)) if each in self.given]:
            return listed(typed, "and")
        return max(self._known[name].opts, key=len) if name in self._known else f"--{name.replace('_', '-')}"


_ASKING = {"perspective": ("perspective", "eye", "target", "fov")}
"""Options of Python that several of the command line ask for."""


@dataclass(frozen=True, slots=True)
class Row:
    """Options that mean something in some requests only.

    options  as the command calls them
    why      of a request: why they mean nothing, after the name of the option; empty: they mean something
    verb     that has them; empty: whichever does
    refused  they are for another use of the verb, which was not asked for
    """

    options: tuple[str, ...]
    why: Callable[[Asked], str]
    verb: str = ""
    refused: bool = False


def refuse(ctx: click.Context) -> None:
    """Raise OptionError where an option was typed that is for another use of the verb."""
    asked = Asked(ctx)
    for name, why in _without_effect(asked, refused=True):
        raise OptionError(f"{asked.spelled(name)} {why}")


def tell(ctx: click.Context) -> None:
    """Print a note for each option that was typed and has changed nothing."""
    asked = Asked(ctx)
    if not asked.values.get("quiet"):
        for name, why in _without_effect(asked, refused=False):
            remark(f"{asked.spelled(name)} {why}")


def _without_effect(asked: Asked, refused: bool) -> Iterator[tuple[str, str]]:
    told: set[str] = set()
    for row in ROWS:
        if row.refused is refused and row.verb in ("", asked.verb):
            for name in row.options:
                if name in asked.given and name not in told and (why := row.why(asked)):
                    told.add(name)
                    yield name, why


def _for_sources(of: OfSources, asked: Asked) -> str:
    named = (asked.values.get(each) for each in ("source", "before", "after"))
    readers = {Path(source).name: of_ending(Path(source).suffix) for source in named if source}
    known = {name: reader for name, reader in readers.items() if reader is not None}
    if not known or any(map(of.fits, known.values())):
        return ""
    whose = listed((f"{name} is {reader.noun or 'a mesh'}" for name, reader in known.items()), "and")
    return f"has no effect{of.but}: it is for {of.whose}, and {whose}"


def _for_formats(formats: tuple[str, ...], asked: Asked) -> str:
    from .drawn_files import formats_of

    written = formats_of(asked.values["outputs"], asked.values["format"])
    if set(written) & set(formats):
        return ""
    whose = listed((name.upper() for name in formats if name != "json" or len(formats) > _FEW), "and")
    return f"has no effect: it is for {whose}, and what is written is {listed(map(str.upper, written), 'and')}"


_FEW = 2
"""Formats. JSON is named where it is one of many: else it only carries what another format needs."""


def _for_background(asked: Asked) -> str:
    # A part's colour is made darker or lighter where it is too close to the background.
    colored = asked.values["part_colors"] is not None or asked.values["style"] is not None
    return "" if colored else _for_formats(OF_FORMATS["background"], asked)


def _for_hidden_lines(asked: Asked) -> str:
    values = asked.values
    if values["all_pages"] or values["hidden"]:
        return ""
    if values["hidden"] is None:
        from hlr.request.directions import directed, pictorial

        from .document_pages import names_a_page

        if names_a_page(values["source"], values["page"]):
            return ""
        method = PROJECTION_METHODS.get(values["arrange"] or "")
        views = values["views"] or (cast("tuple[View, ...]", method.usual) if method else ())
        views = _not_cut(views, values) if values["section"] else views or ("iso",)
        if not views:
            return "has no effect: sections have no hidden lines, unless --hidden asks for them"
        in_perspective = values["perspective"] or any(values[name] is not None for name in ("eye", "target", "fov"))
        if not in_perspective and not all(pictorial(directed(view)[1]) for view in views):
            return ""
        return "has no effect: pictorial views have no hidden lines, unless --hidden asks for them"
    return "has no effect: --no-hidden leaves the hidden lines out"


def _not_cut(views: tuple[View, ...], values: Mapping[str, Any]) -> tuple[View, ...]:
    """Of views that are asked for, those that are no sections; and those that are drawn whole besides theirs."""
    from hlr.request.directions import directed

    cut = {name for name, _ in values["section"]}
    return (*(view for view in views if directed(view)[0] not in cut), *values["whole"])


def _without(option: str, why: str) -> Callable[[Asked], str]:
    """Why options mean nothing where this one is not given."""
    return lambda asked: "" if asked.values[option] else why


def _with(option: str, why: str) -> Callable[[Asked], str]:
    """Why options mean nothing where this one is given."""
    return lambda asked: why if asked.values[option] else ""


def _for_several_scales(asked: Asked) -> str:
    values = asked.values
    if values["scale"] is not None:
        return "has no effect: all views have the scale that is asked for"
    if values.get("arrange"):
        return "has no effect: views on one page have one scale"
    views = values["views"]
    if sections := values.get("section"):
        from hlr.request.section import checked_section, checked_whole, with_sections
        from hlr.request.shown_views import shown_views

        whole = checked_whole(values["whole"])
        views = shown_views(with_sections(views, sections), checked_section(sections), whole)
    return "has no effect: there is one view" if len(views) < _FEW else ""


def _without_lines(asked: Asked) -> str:
    lines = asked.values["edges"] or asked.values["look"] != "shaded"
    return "" if lines else "has no effect: the picture has no lines, unless --edges asks for them"


def _with_look(why: str, asked: Asked) -> str:
    look = asked.values["look"]
    return "" if look == "shaded" else f"has no effect: a {look} look {why}"


_DRAWS = (
    "output",
    "views",
    "arrange",
    "formats",
    "jobs",
    "address",
    "baseline",
    "fail_on_change",
    "prune",
    "strict",
    "time_limit",
    "total_time_limit",
    "no_cache",
)
_RUNS = ("jobs", "total_time_limit", "address", "baseline", "fail_on_change")

ROWS: tuple[Row, ...] = (
    *(Row((name,), partial(_for_sources, of)) for name, of in OF_SOURCES.items()),
    *(Row((name,), partial(_for_formats, OF_FORMATS[name]), "draw") for name in ("dpi", "size", "layers")),
    Row(("background",), _for_background, "draw"),
    Row(("hidden_color",), _for_hidden_lines, "draw"),
    Row(("same_scale",), _for_several_scales),
    Row(("strict",), lambda _: "has no effect: a plan writes nothing, and has no warnings", "plan"),
    Row(("smooth",), _without_lines, "preview"),
    Row(("edges",), partial(_with_look, "has lines without it"), "preview"),
    Row(("antialias",), partial(_with_look, "has no faces, and lines are always smoothed"), "preview"),
    Row(("pixels",), _without("rivals", "has no effect: --no-rivals leaves the z-buffer out"), "study"),
    Row(
        ("template", "texts", "room"),
        _without("arrange", "is for --arrange: leave it out, or say how views are arranged"),
        "draw",
        refused=True,
    ),
    Row(
        ("uncut", "whole"),
        _without("section", "is for --section: leave it out, or say what is cut"),
        refused=True,
    ),
    Row(("view", "no_cache"), _without("source", "is for a model: name one, or leave it out"), "methods", refused=True),
    Row(("coarse",), _without("against", "is for --against: leave it out"), "compare", refused=True),
    Row(_DRAWS, _with("init", "is for a batch, and --init draws none: leave it out"), "batch", refused=True),
    Row(
        ("only_list", "dry_run", "watch"),
        _with("init", "and --init contradict one another: give one of them"),
        "batch",
        refused=True,
    ),
    Row(("fail_on_change",), _with("watch", "has no use with --watch, which has no exit code"), "batch", refused=True),
    Row(
        (*_RUNS, "prune", "strict", "time_limit", "no_cache"),
        _with("only_list", "has no effect: --list draws nothing"),
        "batch",
    ),
    Row(_RUNS, _with("dry_run", "has no effect: --dry-run draws nothing"), "batch"),
)
