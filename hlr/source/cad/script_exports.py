"""Which variables a script exports: what it writes to a file is what it is about, where it shows nothing."""

from __future__ import annotations

import ast
from pathlib import Path


def exported(path: Path) -> list[str]:
    """The variables that a script hands to an exporter, in the order of its lines: nothing of it is run.

    So are meant `exporters.export(part, "part.stl")` of CadQuery, `export_step(part, "part.step")` of build123d, and
    `part.export("part.stl")`, `assembly.save("all.step")`, `part.export_stl("part.stl")` of both.
    """
    calls = [node for node in ast.walk(ast.parse(path.read_bytes(), str(path))) if isinstance(node, ast.Call)]
    names = [_written(call) for call in sorted(calls, key=lambda call: (call.lineno, call.col_offset))]
    return [name for name in names if name]


def _written(call: ast.Call) -> str:
    """The variable that a call writes to a file, or ""."""
    of, name = None, ""
    if isinstance(call.func, ast.Attribute):
        of, name = call.func.value, call.func.attr
    elif isinstance(call.func, ast.Name):
        name = call.func.id
    if name != "save" and not name.startswith("export"):
        return ""
    first = call.args[0] if call.args else None
    if isinstance(first, ast.Name):
        return first.id
    return of.id if isinstance(of, ast.Name) else ""
