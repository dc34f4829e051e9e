"""CAD scripts: a Python file is run, and what it shows is drawn.

The file is executed with the caller's rights, because the caller asked to draw it. As in CQ-editor and cq-cli the
script finds `show_object(obj, name=None, options=None)` and `debug(obj)`, and its `__name__` is "__cq_main__";
`show(...)` is there for scripts written for viewers. If nothing was shown, the variable `result` counts, then the
names other tools look for, then the last shape that was assigned.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hlr.errors import SourceError
from hlr.source.brep import BrepSource
from hlr.source.model import Color
from hlr.source.objects import is_shape_like, to_leaves
from hlr.source.occt import explain, ready
from hlr.source.parts import Leaf

_NAMES = ("result", "part", "assembly", "assy", "model", "shape", "solid", "r", "res")


def open_script(path: Path) -> BrepSource:
    """Run a script and take what it shows.

    Raises:
        SourceError: the script fails (line and exception are named), or shows nothing.
    """
    shown: list[tuple[Any, str, Color | None]] = []
    values = _run(path, shown)
    ready()
    leaves: list[Leaf] = []
    for thing, name, color in shown or _variables(values):
        try:
            leaves.extend(to_leaves(thing, name or path.stem, color))
        except SourceError as error:
            raise SourceError(f"{path.name} shows something that is no shape: {error}") from None
    if not leaves:
        raise SourceError(
            f'{path.name} shows nothing: call show_object(shape) in it, or assign the shape to a variable "result".'
        )
    return BrepSource(path.name, "script", leaves)


def _run(path: Path, shown: list[tuple[Any, str, Color | None]]) -> dict[str, Any]:
    def show_object(obj: Any, name: str | None = None, options: Any = None, *_: Any, **more: Any) -> None:
        shown.append((obj, name or "", _color(options, more)))

    def show(*objects: Any, names: Any = (), **_: Any) -> None:
        given = list(names or ())
        for i, obj in enumerate(objects):
            shown.append((obj, str(given[i]) if i < len(given) else "", None))

    def nothing(*_: Any, **__: Any) -> None: ...

    values: dict[str, Any] = {
        "__name__": "__cq_main__",
        "__file__": str(path.resolve()),
        "__builtins__": __builtins__,
        "show_object": show_object,
        "show": show,
        "show_all": nothing,
        "debug": nothing,
        "log": nothing,
    }
    folder, here = path.resolve().parent, _here()
    before, arguments = list(sys.path), sys.argv
    sys.path.insert(0, str(folder))
    sys.argv = [str(path)]
    try:
        os.chdir(folder)
        code = compile(path.read_bytes(), str(path), "exec")
        exec(code, values)
    except SyntaxError as error:
        raise SourceError(f"{path.name}, line {error.lineno}: SyntaxError: {error.msg}.") from None
    except SystemExit as error:
        if error.code not in (None, 0) and not shown:
            raise SourceError(f"{path.name} left with exit code {error.code} before it showed anything.") from None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever a script raises, the caller gets one sentence
        raise SourceError(_sentence(path, error)) from None
    finally:
        sys.argv = arguments
        sys.path[:] = before
        if here is not None:
            os.chdir(here)
    return values


def _here() -> str | None:
    try:
        return os.getcwd()
    except OSError:
        return None


def _sentence(path: Path, error: BaseException) -> str:
    """The script's own line, and what was raised."""
    if isinstance(error, ImportError) and "libGL" in str(error):
        return f"{path.name}: {explain(error)}"
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(path)]
    text = " ".join(str(error).split())
    where = f", line {lines[-1]}" if lines else ""
    return f"{path.name}{where}: {type(error).__name__}" + (f": {text}" if text else "")


def _variables(values: dict[str, Any]) -> list[tuple[Any, str, Color | None]]:
    """What a script that shows nothing means to show."""
    found = {key: value for key, value in values.items() if not key.startswith("_") and _safe(is_shape_like, value)}
    for name in _NAMES:
        if name in found:
            return [(found[name], "", None)]
    return [(found[name], "", None) for name in list(found)[-1:]]


def _safe(check: Callable[[Any], bool], value: Any) -> bool:
    try:
        return check(value)
    except Exception:  # a variable with strange attributes is no shape
        return False


def _color(options: Any, more: dict[str, Any]) -> Color | None:
    """The colour of show_object(..., options={"color": ...}): a name, "#rrggbb", a triple, or an object with rgb."""
    given = options if isinstance(options, dict) else {}
    color = given.get("color", more.get("color"))
    if isinstance(color, list | tuple) and len(color) in (3, 4) and all(isinstance(v, int | float) for v in color):
        scale = 255.0 if max(color[:3]) > 1 else 1.0
        return color[0] / scale, color[1] / scale, color[2] / scale
    if isinstance(color, str) and len(color) == 7 and color.startswith("#"):
        try:
            return tuple(int(color[i : i + 2], 16) / 255.0 for i in (1, 3, 5))  # type: ignore[return-value]
        except ValueError:
            return None
    return None
