"""Check a request before any work is done for it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import is_dataclass, replace
from numbers import Integral
from typing import Any, Protocol, cast

import numpy as np

from hlr.common.numbers import is_finite, is_real, typed, typed_value
from hlr.errors import OptionError, ViewError
from hlr.request.directions import check_directions
from hlr.request.drawing_effects import left_to_view
from hlr.request.options import Options, Perspective, Vector, View
from hlr.request.scale import scale_of
from hlr.request.style_file import style_of
from hlr.tables.sheets import papers

MOST_THREADS = 1024
MOST_SCALE = 1e9
SMALLEST_FIT, LARGEST_FIT = 1e-3, 1e7
"""Millimetres."""
SWITCHES = (
    "seam",
    "intersections",
    "same_scale",
    "see_through",
    "details",
    "fill",
    "circles",
    "strict",
    "report",
    "annotations",
    "hidden_objects",
)
"""Options that are yes or no."""
FARTHEST = 1e12
"""Millimetres: of an eye or a target, in any coordinate."""
NARROWEST, WIDEST = 0.01, 170.0
"""Degrees: fields of view that can be drawn."""
_SEQUENCES, _WHOLE = (tuple, list, Sequence), (int, Integral)
"""The usual types first: to ask for an abstract class takes ten times as long."""


def checked(options: Options) -> Options:  # noqa: C901, PLR0912 - one check for each option
    """The same options, checked: types, ranges, contradictions. Raises OptionError that says what is allowed.

    A scale is then a number, and a style that was named a `Style`; faces are painted where it wants their parts'
    colours.
    """
    open_to_view = left_to_view()
    for name in (*open_to_view, *SWITCHES):
        value = getattr(options, name)
        if value is True or value is False or (value is None and name in open_to_view):
            continue
        if not isinstance(value, np.bool_) and not (isinstance(value, Integral) and value in (0, 1)):
            raise OptionError(f"{name} is yes or no: give True or False, not {value!r}")
    options = _with_size(options)
    if options.accuracy is not None:
        check_accuracy(options.accuracy)
    within = options.within
    if within is not None and not (is_finite(within) and within > 0.0):
        raise OptionError(f"within needs a positive number of seconds, not {typed_value(within)}")
    if options.see_through and options.report:
        raise OptionError("a report measures what all parts hide: leave out `report`, or `see_through`")
    if options.section is not None:
        from hlr.request.section import checked_section

        options = replace(options, section=checked_section(options.section))
        for name in ("perspective", "report"):
            if options.section is not None and getattr(options, name):
                raise OptionError(f"a section has no {name}: leave out `{name}`, or `section`")
    if not isinstance(options.whole, _SEQUENCES) or len(options.whole) > 0:
        from hlr.request.section import checked_whole

        options = replace(options, whole=checked_whole(options.whole))
        if options.section is None:
            raise OptionError("`whole` is for the views of sections: give `section` as well, or leave it out")
    if options.window is not None:
        _window(options.window)
    for name in ("only", "hide", "uncut"):
        patterns = getattr(options, name)
        if isinstance(patterns, str) or not _is_strings(patterns):
            raise OptionError(f"{name} needs a list of names or patterns of parts, not {patterns!r}")
    if options.section is None and len(options.uncut) > 0:
        raise OptionError("`uncut` is for parts of a section: give `section` as well, or leave it out")
    if options.var is not None and not isinstance(options.var, str):
        raise OptionError(f"var needs the name of a variable, not {options.var!r}")
    if options.parameters is not None:
        _parameters(options.parameters)
    check_crease(options.crease)
    options = _with_up(options)
    threads = options.threads
    if not isinstance(threads, _WHOLE) or isinstance(threads, bool) or not 0 <= int(threads) <= MOST_THREADS:
        raise OptionError(f"{threads!r} threads cannot work: give 0 for all cores, or a number up to {MOST_THREADS}")
    if options.perspective is not None:
        _perspective(options.perspective)
    style = style_of(options.style)
    fill = options.fill or style.part_colors == "fills"
    if options.style in (None, style) and options.fill == fill:
        return options
    return replace(options, style=style, fill=fill)


def _with_size(options: Options) -> Options:
    """Scale, fit and page, checked; the scale as a number."""
    scale, fit, page = options.scale, options.fit, options.page
    if scale is not None:
        number = scale_of(scale) if isinstance(scale, str) or is_real(scale) else None
        if number is None or not 1.0 / MOST_SCALE <= number <= MOST_SCALE:
            limits = f", from 1:{typed(MOST_SCALE, 10)} to {typed(MOST_SCALE, 10)}:1" if number and number > 0.0 else ""
            raise OptionError(
                f"scale {typed_value(scale)} cannot be drawn: give a positive number or a ratio, 0.5 or 1:2{limits}"
            )
        if number != scale:
            options = replace(options, scale=number)
    if scale is not None and fit is not None:
        raise OptionError("`scale` and `fit` contradict one another: give one of them")
    if isinstance(fit, str):
        _check_page(fit)
        if page is not None:
            raise OptionError(f"`page` and `fit` both name a sheet, {page!r} and {fit!r}: give one of them")
    elif fit is not None:
        _check_fit(fit)
    if page is not None:
        _check_page(page)
    return options


def _check_fit(fit: Any) -> None:
    if not _is_vector(fit, 2) or min(fit) <= 0.0:
        is_alone = isinstance(fit, tuple | list) and len(fit) == 1
        raise OptionError(
            "`fit` needs a positive width and height in millimetres, such as 277x190, or a sheet such as A4, not "
            f"{repr(fit) if is_alone else typed_value(fit, 'x')}"
        )
    if min(fit) < SMALLEST_FIT or max(fit) > LARGEST_FIT:
        limits = f"{typed(SMALLEST_FIT)} to {typed(LARGEST_FIT, 8)} mm"
        raise OptionError(f"`fit` needs a width and height of {limits}, not {typed_value(fit, 'x')}")


def _check_page(page: Any) -> None:
    if not isinstance(page, str) and not _is_vector(page, 2):
        raise OptionError(f"page needs the name of a sheet, such as A3, or a width and height, not {page!r}")
    try:
        papers(page)
    except ValueError as error:
        raise OptionError(str(error)) from None


def check_accuracy(accuracy: float) -> None:
    """Raises OptionError unless the accuracy is a positive length."""
    if not (is_finite(accuracy) and accuracy > 0.0):
        raise OptionError(f"accuracy {typed_value(accuracy)} mm cannot be kept: give a positive length, such as 0.05")


def check_crease(crease: float) -> None:
    """Raises OptionError unless the crease angle is 0 to 180 degrees."""
    if not is_real(crease) or not 0.0 <= crease <= 180.0:
        raise OptionError(f"crease {typed_value(crease)} is not a crease angle: give 0 to 180 degrees")


def _with_up(options: Options) -> Options:
    """With `up` as a tuple: an array has no truth value, and equals nothing."""
    up = options.up
    if up is None:
        return options
    if not _is_vector(up, 3):
        raise OptionError(f"up needs three finite numbers, such as 0,0,1, not {up!r}")
    return options if isinstance(up, tuple) else replace(options, up=(float(up[0]), float(up[1]), float(up[2])))


def checked_views(views: Sequence[View], options: CameraOptions) -> list[View]:
    """The views as a list, names in small letters; a single name or direction is understood as one view.

    options: checked already. Raises ViewError where a view is neither a name nor three numbers, or contradicts `up` or
    the camera. So a wrong view is refused before the model is read.
    """
    if isinstance(views, str):
        views = [cast(View, views)]
    elif _is_vector(views, 3):
        views = [cast(Sequence[float], views)]
    try:
        found = [cast(View, view.strip().lower()) if isinstance(view, str) else view for view in views]
    except TypeError:
        raise ViewError(f"{views!r} is no list of views: give names such as 'iso', or directions") from None
    for view in found:
        if not isinstance(view, str) and not _is_vector(view, 3, finite=False):
            what = type(view).__name__ if is_dataclass(view) else repr(view)
            several = isinstance(view, list | tuple) and any(isinstance(each, str) for each in view)
            more = "; draw_views draws several, and draw_arranged puts them on one page" if several else ""
            raise ViewError(f"{what} is no view: give a name such as 'iso', or a direction such as (1, -1, 1){more}")
    check_directions(found, options.up, options.perspective)
    return found


class CameraOptions(Protocol):
    """The options of a camera, of a drawing or a picture."""

    @property
    def up(self) -> Vector | None:
        """The direction that points up on paper, world axes."""

    @property
    def perspective(self) -> Perspective | None:
        """None: orthographic."""


def _parameters(values: Any) -> None:
    if not isinstance(values, Mapping) or not all(isinstance(name, str) for name in values):
        raise OptionError(f"parameters needs names with values, such as {{'size': 20}}, not {values!r}")
    for name, value in values.items():
        if not isinstance(value, bool | str) and not is_finite(value):
            raise OptionError(f"the parameter {name} needs a number, a text, True or False, not {value!r}")


def _window(window: Any) -> None:
    if not _is_vector(window, 4) or max(map(abs, window)) > LARGEST_FIT:
        raise OptionError(
            f"`window` needs x0,y0,x1,y1 in millimetres, four numbers of at most {typed(LARGEST_FIT, 8)}, "
            f"not {typed_value(window)}"
        )
    x0, y0, x1, y1 = window
    if x1 - x0 < SMALLEST_FIT or y1 - y0 < SMALLEST_FIT:
        raise OptionError(
            f"the window {typed_value(window)} holds nothing: give its lower left corner first, x0 < x1 and y0 < y1, "
            f"at least {SMALLEST_FIT:g} mm apart"
        )


def _perspective(camera: Any) -> None:
    if not isinstance(camera, Perspective):
        raise OptionError(f"perspective needs an hlr.Perspective, not {camera!r}")
    for name, point in (("eye", camera.eye), ("target", camera.target)):
        if point is not None and not _is_vector(point, 3):
            raise OptionError(f"`{name}` needs three finite numbers in millimetres, not {typed_value(point)}")
        if point is not None and max(map(abs, point)) > FARTHEST:
            most = typed(FARTHEST, 13)
            raise OptionError(
                f"`{name}` {typed_value(point)} is too far away: give numbers of at most {most} millimetres"
            )
    if camera.fov is not None and (not is_real(camera.fov) or not NARROWEST <= camera.fov <= WIDEST):
        raise OptionError(
            f"a field of view of {typed_value(camera.fov)} degrees cannot be drawn: give {NARROWEST} to {WIDEST:g}"
        )


def _is_strings(value: Any) -> bool:
    return isinstance(value, _SEQUENCES) and all(isinstance(each, str) for each in value)


def _is_vector(value: Any, length: int, finite: bool = True) -> bool:
    try:
        numbers = list(value)
    except TypeError:
        return False
    return len(numbers) == length and all(is_finite(n) if finite else is_real(n) for n in numbers)
