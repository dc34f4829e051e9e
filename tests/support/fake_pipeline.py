"""Stand-ins for the pipeline: the source's name decides what they do, so the command line is tested without a model.

`python -m support.fake_pipeline` runs the command line with these stand-ins in place of the pipeline.
"""

import os
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import hlr
from hlr import errors
from hlr.common import faults
from hlr.drawing.notes import Note
from support.drawings import ISO, drawing, line, sample


@dataclass(frozen=True)
class PartReport:
    name: str
    color: tuple | None
    solids: int
    faces: int
    edges: int
    triangles: int
    closed: bool
    oriented: bool
    defects: tuple


@dataclass(frozen=True)
class ModelInfo:
    source: str
    kind: str
    unit: float
    bounds: tuple
    parts: tuple
    notes: tuple


PROGRAM = [sys.executable, "-P", "-m", "support.fake_pipeline"]

ASKED = []
"""What draw_views was called with, last call last."""


def draw_views(source, views, options, progress=None, noted=None):
    ASKED.append((source, views, options))
    stem = Path(source).stem
    if progress is not None:
        progress("source", 0.0)
    if stem == "missing":
        raise errors.SourceError(f"cannot read {source}: there is no such file")
    if stem == "bug":
        raise ZeroDivisionError("division by\nzero")
    if stem == "panic":
        raise faults.fault("visibility/src/scan/sweep.rs:7: index out of bounds")
    if stem == "memory":
        raise MemoryError
    if stem == "prints":
        print("printed by a script")
        os.write(1, b"printed by a library\n")
    if stem == "forever":
        print("computing", file=sys.stderr, flush=True)
        _hold_the_interpreter(20)
    if stem.startswith("crash"):
        _crash(stem, progress)
    if stem == "slow":
        for i in range(30):
            if progress is not None:
                progress("visibility", i / 30)
            time.sleep(0.1)
    made = sample() if stem != "large" else drawing([line([[0, 0], [1, 1]], edge=i) for i in range(20_000)])
    made = replace(made, source=Path(source).name)
    names = [view if isinstance(view, str) else "free" for view in views]
    return [replace(made, view=replace(ISO, name=name), notes=_notes(stem, k)) for k, name in enumerate(names)]


def _notes(stem, number):
    """Of one of the views."""
    if stem == "crowded":
        return (Note("crowded", "its lines are close together."),) if number == 0 else ()
    texts = ("part 3 could not be read", "part 4 is open") if stem == "notes" else ()
    return tuple(Note("defects", text) for text in texts)


def info(source, *, crease=30.0, var=None, parameters=None, annotations=False, hidden_objects=False, progress=None):
    if Path(source).stem == "missing":
        raise errors.SourceError(f"cannot read {source}: there is no such file")
    parts = (
        PartReport("housing", None, 1, 120, 340, 5600, True, True, ()),
        PartReport("a name so long that no terminal could show all of it", (1, 0.5, 0), 0, 3, 9, 12, False, True,
                   ("4 open edges", "1 duplicated face")),
        PartReport("tw\x1bisted", None, 1, 6, 12, 12, True, False, ()),
    )  # fmt: skip
    return ModelInfo(
        Path(source).name,
        "step",
        25.4,
        ((0, 0, 0), (1, 2, 3.5)),
        parts,
        (Note("not-meshed", "part 9 could not be read"),),
    )


def _crash(stem, progress):
    """Crash as the name asks: in our own code, after the work, or after some progress."""
    import atexit
    import ctypes

    if stem == "crash-late":
        atexit.register(ctypes.string_at, 0)
        return
    for i in range(15 if stem == "crash-slowly" else 1):
        progress("visibility", i / 30)
        time.sleep(0.1)
    ctypes.string_at(0)


def _hold_the_interpreter(seconds):
    """Stay in C without releasing the interpreter, as OpenCASCADE does: Python cannot handle signals meanwhile."""
    import ctypes

    ctypes.PyDLL(None).usleep(int(seconds * 1e6))


def install(target=hlr):
    """Put the stand-ins where the command line looks for the pipeline."""
    target.draw_views, target.info = draw_views, info


if __name__ == "__main__":
    from hlr.cli import main

    install()
    main()
