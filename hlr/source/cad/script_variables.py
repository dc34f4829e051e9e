"""What every script finds without an import: the functions of CQ-editor, cq-cli, CQGI, viewers and notebooks."""

from __future__ import annotations

import builtins
from importlib import import_module
from pathlib import Path
from typing import Any

from hlr.source.cad.viewers import Showing


def found_by_scripts(path: Path, showing: Showing) -> dict[str, Any]:
    """These functions and the script's own names. showing: gets what the script shows."""
    return {
        "__name__": "__cq_main__",
        "__file__": str(path.resolve()),
        "__package__": package_of(path.resolve().parent)[0],
        "__builtins__": builtins,
        "show_object": showing.show_object,
        "show": showing.show,
        "show_all": showing.show_all,
        "display": showing.display,  # of notebooks
        "build_object": showing.show_object,  # of CQGI, as it was called before
        "describe_parameter": _ignore,  # of CQGI
        "debug": _ignore,
        "log": _ignore,
        "cq": _CadQuery(),
        "cadquery": _CadQuery(),
        "rand_color": lambda *_, **__: {},  # of CQ-editor: no two drawings would be alike
    }


def package_of(folder: Path) -> tuple[str, Path]:
    """The package that a folder is, and the folder that it is found in: relative imports of a script need both.

    It is "", and the folder itself, where it has no __init__.py.
    """
    names: list[str] = []
    while folder.name and (folder / "__init__.py").is_file():
        names.insert(0, folder.name)
        folder = folder.parent
    return ".".join(names), folder


class _CadQuery:
    """CadQuery under the names that it has in CQ-editor and CQGI without an import; imported where a script uses it."""

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module("cadquery"), name)


def _ignore(*_: Any, **__: Any) -> None: ...
