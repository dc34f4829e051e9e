"""Processes that a script starts by multiprocessing: those that are not forked find the script's functions there.

Such a process gets the search path for modules of the one that starts it, and imports what a function that it is to
call belongs to: `__cq_main__`, which is a file beside this one. It runs the script again, as a module is imported in
such a process everywhere. What the script shows there is shown to nobody.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from hlr.request.options import Parameter

_MARK = "script for child processes: "
"""Begins the entry of the search path that says which script it is. Python passes over what is no folder."""


@contextmanager
def found_by_children(path: Path, parameters: Mapping[str, Parameter]) -> Iterator[None]:
    """Within this block processes that are started find the module of this script. The search path stays as it was."""
    before = list(sys.path)
    sys.path += [str(Path(__file__).parent), _MARK + json.dumps([str(path), dict(parameters)])]
    try:
        yield
    finally:
        sys.path[:] = before


def run_again(values: dict[str, Any]) -> None:
    """Run the script of which this is a child process, with these variables. Where it fails, it has no more of them."""
    from hlr.source.cad.script_parameters import compiled
    from hlr.source.cad.script_variables import found_by_scripts
    from hlr.source.cad.viewers import Showing, stand_ins

    text = next((entry for entry in sys.path if entry.startswith(_MARK)), None)
    if text is None:
        raise ImportError("no script is being drawn", name=values["__name__"])
    file, parameters = json.loads(text.removeprefix(_MARK))
    showing = Showing()
    values.update(found_by_scripts(Path(file), showing))
    with suppress(Exception, SystemExit), stand_ins(showing):
        exec(compiled(Path(file), parameters), values)
