"""Parameters of a script: variables that it sets to a plain value, which a caller may set otherwise.

As in CadQuery's CQGI a parameter is a variable that a statement of the script itself, not one inside a function, a loop
or a condition, sets to a number, a text, True or False::

    size = 10
    label: str = "A"

The value in the statement is replaced before the script runs, so all that is computed from it follows.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from types import CodeType

from hlr.errors import OptionError
from hlr.request.options import Parameter


def compiled(path: Path, parameters: Mapping[str, Parameter]) -> CodeType:
    """The code of a script whose parameters have these values.

    Raises SyntaxError; OptionError where it has no such parameter, or one of another kind.
    """
    if not parameters:
        return compile(path.read_bytes(), str(path), "exec", dont_inherit=True)
    return compile(parsed(path, parameters), str(path), "exec", dont_inherit=True)


def parsed(path: Path, parameters: Mapping[str, Parameter]) -> ast.Module:
    """The statements of a script whose parameters have these values. Raises as `compiled`."""
    tree = ast.parse(path.read_bytes(), str(path))
    found: dict[str, Parameter] = {}
    for name, statement, value in _settings(tree):
        found.setdefault(name, value)
        if name in parameters:
            statement.value = ast.copy_location(ast.Constant(parameters[name]), statement)
    for name, given in parameters.items():
        check_parameter(path, name, given, found)
    return ast.fix_missing_locations(tree)


def parameters_of(path: Path) -> dict[str, Parameter]:
    """The parameters of a script, and the value of each. It is read, and not run. Raises SyntaxError."""
    found: dict[str, Parameter] = {}
    for name, _, value in _settings(ast.parse(path.read_bytes(), str(path))):
        found.setdefault(name, value)
    return found


def _settings(tree: ast.Module) -> Iterator[tuple[str, ast.Assign | ast.AnnAssign, Parameter]]:
    """Each statement that sets a parameter: its name, the statement, the value."""
    for statement in tree.body:
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.expr() as expression):
                pass
            case ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as expression):
                pass
            case _:
                continue
        try:
            value = ast.literal_eval(expression)
        except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
            continue
        if isinstance(value, bool | int | float | str):
            yield name, statement, value


def check_parameter(path: Path, name: str, given: Parameter, found: Mapping[str, Parameter]) -> None:
    """Raise OptionError where a script has no such parameter, or one of another kind. found: as of `parameters_of`."""
    if name not in found:
        near = get_close_matches(name, found, 1)
        known = f"its parameters are {', '.join(found)}" if found else "it sets no variable to a plain value"
        raise OptionError(f"{path.name} has no parameter {name}: {f'did you mean {near[0]}?' if near else known}")
    if _kind(given) != _kind(found[name]):
        raise OptionError(
            f"the parameter {name} of {path.name} is {_kind(found[name])}, such as {found[name]!r}, not {given!r}"
        )


def _kind(value: Parameter) -> str:
    if isinstance(value, bool):
        return "True or False"
    return "a text" if isinstance(value, str) else "a number"
