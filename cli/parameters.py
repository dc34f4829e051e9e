"""Types of option values: vectors, views, scales, sizes, durations."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, cast

import click

from hlr.common.numbers import typed
from hlr.errors import OptionError
from hlr.tables.sheets import papers

if TYPE_CHECKING:
    from hlr.request.options import Steps

Vector3 = tuple[float, float, float]


class Vector(click.ParamType[Vector3]):
    """Three numbers: X,Y,Z."""

    name = "X,Y,Z"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> Vector3:
        """Three finite numbers."""
        vector = vector_of(str(value))
        if vector is None:
            self.fail(f"{value!r} is not three numbers such as 1,-1,1", param, ctx)
        return vector


class OutputName(click.ParamType[str]):
    """The name of a file or folder that is written. An empty one, of a variable that is not set, is refused."""

    name = "FILE"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Any text but an empty one."""
        if value == "":
            self.fail("the name of the output is empty", param, ctx)
        return str(value)


class ViewName(click.ParamType[str | Vector3]):
    """A named view, or a direction from the object toward the viewer."""

    name = "NAME|X,Y,Z"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> str | Vector3:
        """A vector where there is a comma; any other text must be a name. Names are checked before a long reading."""
        from hlr.request.directions import NAMED, is_several

        text = str(value).strip()
        if is_several(text):
            cure = "give the option once for each" if getattr(param, "multiple", False) else "give one of them"
            self.fail(f"{text!r} is several views: {cure}", param, ctx)
        if "," not in text:
            if text.lower() in NAMED:
                return text.lower()
            near = get_close_matches(text.lower(), NAMED, 1)
            if near:
                self.fail(f"{text!r} is no view: did you mean {near[0]}?", param, ctx)
            self.fail(f"{text!r} is none of {', '.join(NAMED)}, nor three numbers such as 1,-1,1", param, ctx)
        vector = vector_of(text)
        if vector is None:
            self.fail(f"{text!r} is neither a name such as iso nor three numbers such as 1,-1,1", param, ctx)
        return vector


class SectionPlane(click.ParamType["tuple[str, bool | float | Vector3 | Steps]"]):
    """A view that is cut, and where: front is front@middle; front@12.5, at a coordinate; front@0,12.5,0, at a point.

    front@12.5,30:40 steps: from 30 on it is at 40.
    """

    name = "VIEW[@PLACE]"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, bool | float | Vector3 | Steps]:
        """The name of the view, or its direction as text, and True, a coordinate, a point or steps."""
        text, at, where = str(value).partition("@")
        view = ViewName().convert(text, param, ctx)
        name = view if isinstance(view, str) else ",".join(f"{c:g}" for c in view)
        if not at or where.strip().lower() == "middle":
            return name, True
        place = _steps_of(where) if ":" in where else vector_of(where) if "," in where else number_of(where)
        if place is None:
            self.fail(
                f"{value!r} names no plane: give {text}, {text}@12.5 in millimetres, or {text}@0,12.5,0, or, where it "
                f"steps, {text}@12.5,30:40",
                param,
                ctx,
            )
        return name, place


class Scale(click.ParamType[float]):
    """Paper to model: 1:2, 0.5 or 2."""

    name = "1:2|0.5|2"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """A positive number."""
        from hlr.request.scale import scale_of

        found = scale_of(str(value))
        if found is None:
            self.fail(f"{value!r} is not a scale such as 1:2, 0.5 or 2", param, ctx)
        return found


class Size(click.ParamType["tuple[float, float] | str"]):
    """Width and height in millimetres: 200x150, or the name of a sheet of paper: A4, A4-landscape."""

    name = "WxH|A4"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float] | str:
        """Two positive numbers, or the text that names a sheet."""
        sides = [number_of(side) for side in re.split("[xX×]", str(value))]
        match sides:
            case [float(width), float(height)] if width > 0.0 and height > 0.0:
                return (width, height)
        try:
            papers(str(value))
        except ValueError:
            self.fail(f"{value!r} is not a size in millimetres such as 200x150, A4 or A4-landscape", param, ctx)
        return str(value)


class Window(click.ParamType[tuple[float, float, float, float]]):
    """Two corners of a rectangle on paper: X0,Y0,X1,Y1."""

    name = "X0,Y0,X1,Y1"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float, float, float]:
        """Four finite numbers; whether they make a rectangle the request's own check says."""
        match [number_of(part) for part in str(value).split(",")]:
            case [float(x0), float(y0), float(x1), float(y1)]:
                return (x0, y0, x1, y1)
        self.fail(f"{value!r} is not four numbers such as 0,0,100,80", param, ctx)


class ScriptParameter(click.ParamType[tuple[str, bool | int | float | str]]):
    """A variable of a script, and its value: a number, true or false; anything else is a text, as is "20" in quotes."""

    name = "NAME=VALUE"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, bool | int | float | str]:
        """The name and the value."""
        name, equals, text = (part.strip() for part in str(value).partition("="))
        if not equals or not name.isidentifier():
            self.fail(f"{value!r} is not a name and a value such as size=20", param, ctx)
        if text.lower() in ("true", "false"):
            return name, text.lower() == "true"
        if len(text) > 1 and text[0] == text[-1] and text[0] in "'\"":
            return name, text[1:-1]
        number = number_of(text)
        if number is None:
            return name, text
        return name, int(text) if re.fullmatch(r"[+-]?\d{1,18}", text) else number


class FieldText(click.ParamType[tuple[str, str]]):
    """A field of a page template, and the text for it."""

    name = "FIELD=TEXT"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, str]:
        """The key of the field and the text."""
        key, equals, text = str(value).partition("=")
        if not equals or not key.strip():
            self.fail(f"{value!r} is not a field and a text such as TITLE=Bracket", param, ctx)
        return key.strip(), text


def as_table(_ctx: click.Context, option: click.Parameter, given: tuple[tuple[str, Any], ...]) -> dict[str, Any] | None:
    """Callback of an option that may be repeated, each time with a name: the values by name; None: there are none.

    Raises OptionError where a name is given twice.
    """
    names = [name for name, _ in given]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise OptionError(f"{option.opts[0]} gives {twice} twice: give it once")
    return dict(given) or None


@dataclass(frozen=True)
class Number(click.ParamType[float]):
    """A number. least, most: what is allowed; with above the least itself is not."""

    least: float | None = None
    most: float | None = None
    above: bool = False

    name = "NUMBER"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """A finite number in the range."""
        number = number_of(str(value))
        if number is None:
            self.fail(f"{value!r} is not a number", param, ctx)
        low, high = self.least, self.most
        if (low is not None and (number <= low if self.above else number < low)) or (
            high is not None and number > high
        ):
            self.fail(f"{_exactly(number)} is out of range: give a number {self._range()}", param, ctx)
        return number

    def _range(self) -> str:
        """What is allowed, for people."""
        low, high = ("" if each is None else _exactly(each) for each in (self.least, self.most))
        if low and high and not self.above:
            return f"from {low} to {high}"
        least = low and f"{'above' if self.above else 'of at least'} {low}"
        most = high and f"of at most {high}"
        return " and ".join(filter(None, (least, most)))


class Whole(click.ParamType[int]):
    """A whole number."""

    name = "N"

    def __init__(self, least: int, most: int | None = None) -> None:
        self._range = Number(least, most)

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """A whole number in the range."""
        if not re.fullmatch(r"\s*[+-]?[0-9]{1,15}\s*", str(value)):
            self.fail(f"{value!r} is not a whole number", param, ctx)
        return int(self._range.convert(value, param, ctx))


class Duration(click.ParamType[float]):
    """A time: 2s, 500ms, 1min; a number alone is seconds."""

    name = "TIME"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Seconds, more than none."""
        match = re.fullmatch(r"\s*([0-9.eE+-]+?)\s*(ms|s|min|)\s*", str(value))
        number = number_of(match[1]) if match else None
        if match is None or number is None or number <= 0.0:
            self.fail(f"{value!r} is not a time such as 2s, 500ms or 1min", param, ctx)
        return number * {"ms": 1e-3, "s": 1.0, "": 1.0, "min": 60.0}[match[2]]


class Pixels(click.ParamType[tuple[int, int]]):
    """Width and height in pixels: 1920x1080."""

    name = "WxH"

    @staticmethod
    def text(size: tuple[int, int]) -> str:
        """A size as it is given."""
        return f"{size[0]}x{size[1]}"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Two positive whole numbers; what is too large the pictures' own check says."""
        match = re.fullmatch(r"\s*(\d{1,9})\s*[xX×]\s*(\d{1,9})\s*", str(value))
        if match is None or "0" in (match[1].lstrip("0") or "0", match[2].lstrip("0") or "0"):
            self.fail(f"{value!r} is not a size in pixels such as 1920x1080", param, ctx)
        return int(match[1]), int(match[2])


def _steps_of(text: str) -> Steps | None:
    """A number, then pairs of numbers with a colon between them, all with commas between them; or None."""
    first, *rest = text.split(",")
    numbers = [number_of(first), *(number_of(each) for step in rest for each in step.split(":"))]
    if any(number is None for number in numbers) or any(step.count(":") != 1 for step in rest):
        return None
    found = cast("list[float]", numbers)
    return (found[0], *zip(found[1::2], found[2::2], strict=True))


def vector_of(text: str) -> Vector3 | None:
    """Three finite numbers with commas between them, or None."""
    match [number_of(part) for part in text.split(",")]:
        case [float(x), float(y), float(z)]:
            return (x, y, z)
    return None


def _exactly(number: float) -> str:
    """A number as a person would type it, with all of its digits."""
    return typed(number, digits=15, places=15)


def number_of(text: str) -> float | None:
    """A finite number, or None."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
