"""`python -m hlr.compat.freecad_addon`: put the command "Exact drawing" into FreeCAD's folder of add-ons."""

from __future__ import annotations

import argparse
import sys

from hlr.compat.freecad_addon.install import install, user_folder
from hlr.errors import HlrError


def main(arguments: list[str] | None = None) -> int:
    """Install, and say where. Returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m hlr.compat.freecad_addon", description=__doc__)
    parser.add_argument(
        "--to", metavar="FOLDER", help="FreeCAD's folder of user data (in FreeCAD: FreeCAD.getUserAppDataDir())"
    )
    given = parser.parse_args(arguments)
    try:
        for path in install(given.to or user_folder()):
            print(path)
    except HlrError as error:
        print(f"Error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
