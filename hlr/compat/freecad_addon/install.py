"""The files of the add-on, and where FreeCAD looks for them."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from hlr.drawing.files import write_all
from hlr.errors import OptionError


def user_folder() -> Path:
    """Where FreeCAD keeps add-ons and macros of a user. Raises OptionError where it has no such folder."""
    home = Path.home()
    match sys.platform:
        case "win32":
            folder = Path(os.environ.get("APPDATA", home / "AppData" / "Roaming")) / "FreeCAD"
        case "darwin":
            folder = home / "Library" / "Application Support" / "FreeCAD"
        case _:
            folder = Path(os.environ.get("XDG_DATA_HOME", home / ".local" / "share")) / "FreeCAD"
    if not folder.is_dir():
        raise OptionError(
            f"there is no folder {folder}: start FreeCAD once, or name its folder of user data with --to "
            "(in FreeCAD: FreeCAD.getUserAppDataDir())"
        )
    # From 1.1 on, each version has a folder of its own.
    versions = sorted(folder.glob("v[0-9]*-[0-9]*"), key=lambda each: [int(n) for n in each.name[1:].split("-")])
    return versions[-1] if versions else folder


def install(folder: str | os.PathLike[str]) -> list[Path]:
    """Write the add-on and the macro into FreeCAD's folder of user data; returns their paths.

    The add-on finds the packages of the Python that runs now, so FreeCAD has to run the same version of Python.

    Raises OptionError where there is no such folder, WriteError where it cannot be written.
    """
    user = Path(folder)
    if not user.is_dir():
        raise OptionError(f"there is no folder {user}: name FreeCAD's folder of user data")
    packages = [str(Path(__file__).parents[3]), *(each for each in sys.path if each.endswith("site-packages"))]
    known = {"version": sys.version_info[:2], "folders": list(dict.fromkeys(packages))}
    addon, macros = user / "Mod" / "ExactDrawing", user / "Macro"
    for each in (addon, macros):
        each.mkdir(parents=True, exist_ok=True)
    files = {
        addon / "exact_drawing_paths.py": _PATHS.format(**known),
        addon / "InitGui.py": _INIT_GUI,
        addon / "package.xml": _PACKAGE,
        addon / "icon.svg": _ICON,
        macros / "ExactDrawing.FCMacro": _MACRO,
    }
    write_all({path: text.encode() for path, text in files.items()})
    return list(files)


_PATHS = '''"""Makes hlr importable in FreeCAD. Written by `python -m hlr.compat.freecad_addon`."""

import site
import sys

if sys.version_info[:2] != {version}:
    raise ImportError(
        "hlr was installed for Python %d.%d, and FreeCAD runs %d.%d: install it for that version, "
        "and run python -m hlr.compat.freecad_addon there." % ({version} + tuple(sys.version_info[:2]))
    )
for folder in {folders}:
    site.addsitedir(folder)
'''

_INIT_GUI = """import FreeCAD

try:
    import exact_drawing_paths
    from hlr.compat.freecad_addon.command import register

    register()
except ImportError as error:
    FreeCAD.Console.PrintError("Exact drawing: %s\\n" % error)
"""

_MACRO = """# Draws the selected TechDraw page, the one that is open, or the selected objects, exactly.
import exact_drawing_paths
from hlr.compat.freecad_addon.command import run

run()
"""

_PACKAGE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<package format="1" xmlns="https://wiki.freecad.org/Package_Metadata">
  <name>Exact drawing</name>
  <description>TechDraw pages and models with exact hidden lines, drawn by hlr</description>
  <version>1.0.0</version>
  <content><workbench><classname>ExactDrawingWorkbench</classname><icon>icon.svg</icon></workbench></content>
</package>
"""

_ICON = """<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64" viewBox="0 0 64 64" fill="none" \
stroke="#1f4e79" stroke-width="4" stroke-linejoin="round" stroke-linecap="round">
<path d="M8 20 32 8 56 20 56 46 32 58 8 46ZM8 20 32 32 56 20M32 32V58"/>
<path d="M32 8V32M8 46 32 32 56 46" stroke-width="2" stroke-dasharray="4 4"/></svg>
"""
