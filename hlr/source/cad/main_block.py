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

_SHOWS = frozenset({"show", "show_object", "show_objects", "show_all"})


def main_block(path: Path, parameters: Mapping[str, Parameter], showing: bool) -> CodeType | None:
    """The code of that block, of all of them where there are several; None where there is none.

    showing: only of one that calls `show` or another such function itself. Raises as `parsed`.
    """
    tree = parsed(path, parameters)
    body = [each for block in _blocks(tree) for each in block.body if not showing or _shows(block)]
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


def _shows(block: ast.If) -> bool:
    called = (node.func for statement in block.body for node in ast.walk(statement) if isinstance(node, ast.Call))
    return any((getattr(name, "id", None) or getattr(name, "attr", "")) in _SHOWS for name in called)
