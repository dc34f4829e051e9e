"""Options of a drawing as a manifest writes them: from plain values to `hlr.Options`, and their check."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from hlr.errors import HlrError, OptionError
from hlr.request.options import Options, Perspective

NAMES = tuple(Options.__dataclass_fields__)
"""Of all options that a manifest may give."""


_FILES = ("style",)
"""Options that may name a file; it is looked for from the root of the batch."""


def options_of(values: Mapping[str, Any], root: str) -> Options:
    """The options with these values; arrays become tuples, and a table of `perspective` becomes the camera.

    root: the folder that names of files start from.

    Raises OptionError for a camera that has no such field; `check` says whether the values are right.
    """
    given = {name: _tuples(value) for name, value in values.items()}
    camera = given.get("perspective")
    if isinstance(camera, Mapping):
        unknown = [name for name in camera if name not in Perspective.__dataclass_fields__]
        if unknown:
            known = ", ".join(Perspective.__dataclass_fields__)
            raise OptionError(f"perspective has no field {unknown[0]!r}: use {known}")
        given["perspective"] = Perspective(**{name: _tuples(value) for name, value in camera.items()})
    return Options(**given | {name: os.path.join(root, file) for name, file in files_of(values, root).items()})


def files_of(values: Mapping[str, Any], root: str) -> dict[str, str]:
    """The files that options name: the name of each option, and the path seen from the root."""
    named = {name: values[name] for name in _FILES if str(values.get(name, "")).endswith(".toml")}
    return {name: file for name, file in named.items() if os.path.isfile(os.path.join(root, file))}


def check(values: Mapping[str, Any], views: tuple[Any, ...], root: str, arrange: str = "") -> None:
    """Check options and views as `hlr.draw_views` does, before any work. Raises OptionError, ViewError.

    arrange: the method by which the views are arranged on one page; empty: they are not.
    """
    from hlr.image.arrangement import check_views
    from hlr.image.method_cells import cells_of
    from hlr.public.arranged import check_arranged
    from hlr.request.check import checked, checked_views
    from hlr.request.shown_views import shown_views
    from hlr.tables.projection_methods import PROJECTION_METHODS

    options = checked(options_of(values, root))
    views = tuple(checked_views(views, options))
    if options.section is not None:
        from hlr.request.section import check_sections

        check_sections(options.section, views, options.whole, by_name=bool(arrange))
    if arrange:
        method = PROJECTION_METHODS[arrange]
        check_arranged(options)
        shown = shown_views(views, options.section, options.whole)
        check_views([each.name for each in shown], cells_of(shown, method)[0], method)


def names_of_drawings(section: Any, views: tuple[Any, ...], whole: Any = ()) -> tuple[Any, ...]:
    """What the drawings of views are called of which some are cut; the views, where `check` refuses them."""
    from hlr.request.check import checked_views
    from hlr.request.section import checked_section, checked_whole
    from hlr.request.shown_views import shown_views

    try:
        shown = shown_views(checked_views(views, Options()), checked_section(section), checked_whole(whole))
    except HlrError:
        return views
    return tuple(each.name for each in shown)


def wrong_one(values: Mapping[str, Any], root: str, arrange: str = "") -> str | None:
    """The first of these options that is refused, by itself or else beside those before it; None: the views are."""
    for name, value in values.items():
        if name == "whole" and "section" in values:
            continue  # its views are right or wrong beside their sections alone
        # Parts are left whole in sections alone.
        beside = {"section": {"iso": True}} if name == "uncut" and values.get("section") else {}
        if _is_refused({name: value, **beside}, root, arrange):
            return name
    names = sorted(values, key=lambda name: name != "section")  # `uncut` and `whole` are nothing without it
    for number, name in enumerate(names):
        if _is_refused({each: values[each] for each in names[: number + 1]}, root, arrange):
            return name
    return None


def _is_refused(values: Mapping[str, Any], root: str, arrange: str) -> bool:
    """Whether options are refused beside a view that any options can have."""
    from hlr.request.section import by_view, checked_section, checked_whole, with_sections

    try:
        # Some sections are said by their views.
        places = by_view(checked_section(values.get("section")))
        named = places or tuple((name, True) for name in checked_whole(values.get("whole", ())))
        check(values, with_sections((), named) or ("iso",), root, arrange)
    except HlrError:
        return True
    return False


def _tuples(value: Any) -> Any:
    return tuple(map(_tuples, value)) if isinstance(value, list) else value
