"""What stands under `if __name__ == "__main__":` of a script.

A script is run as a viewer runs it, where `__name__` is "__cq_main__", so that what it does as a program of its own,
such as exports, is not done. Scripts for viewers in another window, such as those that import `ocp_vscode`, are
programs: they may make and show everything there::

    if __name__ == "__main__":
        show(bracket())
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import CodeType

from hlr.request.options import Parameter
from hlr.source.cad.script_parameters import parsed
from hlr.source.cad.viewers import is_viewer

_SHOWS = frozenset({"show", "show_object", "show_objects", "show_all"})


def main_block(path: Path, parameters: Mapping[str, Parameter], showing: bool) -> CodeType | None:
    """The code of that block, of all of them where there are several; None where there is none.

    showing: only of one that calls `show` or another such function itself. Raises as `parsed`.
    """
    tree = parsed(path, parameters)
    body = [each for block in _blocks(tree) for each in block.body if not showing or _shows(block, tree, path.parent)]
    future = [each for each in tree.body if isinstance(each, ast.ImportFrom) and each.module == "__future__"]
    return compile(ast.Module([*future, *body], []), str(path), "exec", dont_inherit=True) if body else None


def _blocks(tree: ast.Module) -> Iterator[ast.If]:
    """Its `if` statements, outside of functions, that ask whether the script is the program."""
    left = tree.body[::-1]
    while left:
        statement = left.pop()
        if isinstance(statement, ast.If):
            if _asks(statement.test):
                yield statement
            left += statement.orelse[::-1]  # an `elif` is an `if` in an `else`


def _asks(test: ast.expr) -> bool:
    match test:
        case ast.Compare(
            left=ast.Name("__name__") | ast.Constant("__main__") as left,
            ops=[ast.Eq()],
            comparators=[ast.Name("__name__") | ast.Constant("__main__") as right],
        ):
            return type(left) is not type(right)
    return False


def _shows(block: ast.If, tree: ast.Module, folder: Path) -> bool:
    """Whether it calls a function that shows shapes: one that every script finds, of a viewer, or of the project.

    A window of another library has a `show` as well, such as a plot.
    """
    known = _imported(tree)
    called = (node.func for statement in block.body for node in ast.walk(statement) if isinstance(node, ast.Call))
    return any(_shows_shapes(each, known, folder) for each in called)


def _shows_shapes(function: ast.expr, known: Mapping[str, str], folder: Path) -> bool:
    name = _dotted(function)
    first, _, rest = name.partition(".")
    whole = known.get(first, first) + (f".{rest}" if rest else "")
    module, _, last = whole.rpartition(".")
    if name.rpartition(".")[2] not in _SHOWS:
        return False
    if not rest and first not in known:
        return True  # found by every script, or its own
    return is_viewer(module) or (last in _SHOWS and _is_beside(module, folder))


def _imported(tree: ast.Module) -> dict[str, str]:
    """Names that import statements anywhere in it make, and what each stands for: its module, a dot, its name there."""
    found: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found.update((each.asname, each.name) for each in node.names if each.asname)
        elif isinstance(node, ast.ImportFrom):
            start = "." * node.level + (node.module or "")
            found.update((each.asname or each.name, f"{start}.{each.name}") for each in node.names)
    return found


def _dotted(expression: ast.expr) -> str:
    """The text of a name, or of a name with attributes; of anything else nothing."""
    match expression:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=value, attr=name) if start := _dotted(value):
            return f"{start}.{name}"
    return ""


def _is_beside(module: str, folder: Path) -> bool:
    """Whether a module, or the package that it is in, lies beside the script."""
    first = module.partition(".")[0]
    return not first or (folder / first).is_dir() or (folder / f"{first}.py").is_file()
