"""Runs a CAD script: in its folder, with its own modules, one at a time; an error of its becomes one sentence."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from threading import RLock
from typing import Any

from hlr.common.own_modules import forgetting_own_modules, is_installed
from hlr.errors import OptionError, SourceError
from hlr.request.options import Parameter
from hlr.source.cad.child_process import found_by_children
from hlr.source.cad.main_block import main_block
from hlr.source.cad.occt_import import import_failure_message
from hlr.source.cad.script_choice import RESULT_VARIABLE, most_solid, shapes
from hlr.source.cad.script_module import Variables, as_program, module_of
from hlr.source.cad.script_parameters import compiled
from hlr.source.cad.script_variables import found_by_scripts, package_of
from hlr.source.cad.viewers import Showing, stand_ins


class _Turn:
    """Held by the thread whose script runs."""

    lock = RLock()

    @classmethod
    def renew(cls) -> None:
        """In a process that was forked the thread whose turn it was is not there, and never ends it."""
        cls.lock = RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_Turn.renew)


def run(path: Path, showing: Showing, parameters: Mapping[str, Parameter], var: str | None) -> dict[str, Any]:
    """Run a script, and return its variables. What it shows is in `showing` afterwards.

    var: the variable that is to be drawn.

    Raises:
        SourceError: the script fails, or leaves early with an exit code or a message and has shown nothing.
        OptionError: it has no such parameter, or one of another kind.
    """
    # Working folder, search path and modules are those of the whole process: one script at a time.
    with _Turn.lock:
        return _run_alone(path, showing, parameters, var)


def _run_alone(path: Path, showing: Showing, parameters: Mapping[str, Parameter], var: str | None) -> dict[str, Any]:
    values = Variables(found_by_scripts(path, showing))
    showing.drawable = lambda: most_solid(values)
    folder, working_folder = path.resolve().parent, _working_folder()
    saved_path, saved_arguments = list(sys.path), sys.argv
    sys.path.insert(0, str(folder))
    package, root = package_of(folder)
    if package:
        sys.path.append(str(root))
    sys.argv = [str(path)]
    try:
        os.chdir(folder)
        with (
            forgetting_own_modules(folder),
            stand_ins(showing),
            module_of(values),
            found_by_children(path, parameters),
        ):
            exec(compiled(path, parameters), values)
            _run_main_block(path, showing, values, parameters, var)
    except OptionError:
        raise
    except SystemExit as error:
        if error.code not in (None, 0) and not showing.shown:
            raise SourceError(_left_early(path, error.code, values)) from None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever a script raises, the caller gets one sentence
        raise SourceError(_failure_message(path, error)) from None
    finally:
        sys.argv = saved_arguments
        sys.path[:] = saved_path
        if working_folder is not None:
            os.chdir(working_folder)
    return values


def _run_main_block(
    path: Path, showing: Showing, values: Variables, parameters: Mapping[str, Parameter], var: str | None
) -> None:
    """Run what stands under `if __name__ == "__main__":` where without it nothing is there to draw.

    Where shapes are there, but neither shown nor called `result`, it is run if it shows something itself. var: the
    variable that is to be drawn; where it is there, nothing else counts.
    """
    found = shapes(values)
    if showing.shown or RESULT_VARIABLE in found or var in found:
        return
    block = main_block(path, parameters, showing=bool(found))
    if block is not None:
        with as_program(values):
            exec(block, values)


def _left_early(path: Path, code: object, values: dict[str, Any]) -> str:
    """One sentence on a script that left by sys.exit(code), and had shown nothing. code: a number, or a text."""
    how = f"exit code {code}" if isinstance(code, int) else f'the message "{" ".join(str(code).split())}"'
    found = list(shapes(values))
    if not found:
        return f"{path.name} left with {how}, and had shown nothing."
    name = RESULT_VARIABLE if RESULT_VARIABLE in found else found[-1]
    return (
        f'{path.name} left with {how}: its variable "{name}" may be unfinished, and is not drawn; what it shows by '
        "show_object(shape) before it leaves is."
    )


def _working_folder() -> str | None:
    try:
        return os.getcwd()
    except OSError:
        return None


def _failure_message(path: Path, error: BaseException) -> str:
    """One sentence: the line of the script, that of its own module which fails, and the exception."""
    if isinstance(error, ImportError) and "libGL" in str(error):
        return f"{path.name}: {import_failure_message(error)}"
    passed = [(frame.filename, frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    text = _text_of(error)
    if isinstance(error, SyntaxError):
        passed.append((error.filename or str(path), error.lineno))
        text = error.msg
    own = [(file, line) for file, line in passed if file == str(path) or _is_of_a_project(file)]
    lines = [line for file, line in own if file == str(path)]
    where = f", line {lines[-1]}" if lines and lines[-1] else ""
    if own and own[-1][0] != str(path):  # in a module that the script imports
        where += f" ({Path(own[-1][0]).name}, line {own[-1][1]})"
    return f"{path.name}{where}: {type(error).__name__}" + (f": {text}" if text else "")


def _text_of(error: BaseException) -> str:
    try:
        return " ".join(str(error).split())
    except Exception:  # the script's own class of exceptions
        return ""


def _is_of_a_project(file: str) -> bool:
    """Whether it is the file of a module that no package manager has installed. file: it may be such as <string>."""
    return file.endswith(".py") and not is_installed(Path(file).resolve())
