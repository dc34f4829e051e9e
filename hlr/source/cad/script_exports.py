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
    ordered = sorted(calls, key=lambda call: (call.lineno, call.col_offset))
    return [name for call in ordered for name in _written(call)]


def _written(call: ast.Call) -> list[str]:
    """The variables that a call may write to a file: the one whose method it is, and the first that it is given."""
    function = call.func
    called = getattr(function, "attr", "") or getattr(function, "id", "")
    if called != "save" and not called.startswith("export"):
        return []
    of = [function.value] if isinstance(function, ast.Attribute) else []
    return [each.id for each in (*of, *call.args[:1]) if isinstance(each, ast.Name)]
