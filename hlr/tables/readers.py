"""Readers: a row for each kind of source that can be opened, a file or an object in memory.

A new reader is a new row. What it returns follows the protocol `hlr.source.model.Source`. An object that follows it
already needs no row: `hlr.draw` takes it as it is.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hlr.tables.entry import Table, called, listed

BROKEN_FILE = (
    "{name} crashed OpenCASCADE ({reason}) while it was {doing}; nothing was written; the file is probably broken: "
    "export it again, or in another format"
)
BROKEN_SCRIPT = "{name} crashed ({reason}) in compiled code that it uses; nothing was written"

DOING = {"": "read", "source": "read", "tessellate": "meshed", "section": "cut"}
"""Stages in which OpenCASCADE or a script runs, and what is done to the model there; all others run our code alone."""


@dataclass(frozen=True, slots=True)
class Reader:
    """A row of the table.

    title     what it reads, for help texts
    kind      of the sources that it opens: `Source.kind`
    entry     "module:function": opens a file, given by its path, or an object. The module is imported when it is used
    endings   of the files that it reads, in small letters; none for objects in memory
    fits      "module:function": whether it opens this object in memory; empty for files
    takes     what the entry is given besides, by name: kind; var and parameters, of a script; annotations and
              hidden_objects, whether what a file hides is read
    brep      sources have surfaces and edges, not only triangles
    meshes    of sources with surfaces: they have parts without any as well
    noun      one such source, for people: "a STEP file"
    cached    what was read is kept, and is not read again (of a `hlr.source.cad.brep_source.BrepSource` alone)
    needs     the Python package that must be installed, where hlr itself does not
    crash     what the command line says where reading or meshing ends the process by a signal: {name} of the file,
              {reason}, what it was {doing}; empty where that is a fault of hlr
    """

    title: str
    kind: str
    entry: str
    endings: tuple[str, ...] = ()
    fits: str = ""
    takes: tuple[str, ...] = ()
    brep: bool = False
    meshes: bool = False
    noun: str = ""
    cached: bool = False
    needs: str = ""
    crash: str = ""

    def open(self, thing: Any, **given: Any) -> Any:
        """The opened source; given: values of all that a reader may take."""
        return called(self.entry)(thing, **{name: given[name] for name in self.takes})

    def opens(self, thing: Any) -> bool:
        """Whether it opens this object in memory; only where `fits` says so."""
        return bool(called(self.fits)(thing))


def _cad_file(title: str, kind: str, entry: str, endings: tuple[str, ...], takes: tuple[str, ...] = ()) -> Reader:
    noun = f"{'an' if title[0] in 'AEIO' else 'a'} {title} file"
    return Reader(title, kind, entry, endings, takes=takes, brep=True, noun=noun, cached=True, crash=BROKEN_FILE)


def _mesh_file(title: str, entry: str, needs: str = "") -> Reader:
    kind = title.lower()
    return Reader(title, kind, entry, (f".{kind}",), takes=("kind",), needs=needs)


_MESHES = "hlr.source.mesh.mesh_file:open_mesh_file"
_PACKED = "hlr.source.mesh.glb_3mf:open_glb_or_3mf"

READERS: Table[Reader] = Table(
    (reader.title, reader)
    for reader in (
        _cad_file("STEP", "step", "hlr.source.cad.step:open_step", (".step", ".stp"), takes=("annotations",)),
        _cad_file("IGES", "iges", "hlr.source.cad.iges:open_iges", (".iges", ".igs")),
        _cad_file("BREP", "brep", "hlr.source.cad.brep_file:open_brep", (".brep", ".brp")),
        _cad_file("FreeCAD", "fcstd", "hlr.source.freecad.fcstd:open_fcstd", (".fcstd",), takes=("hidden_objects",)),
        Reader(
            "CadQuery and build123d scripts",
            "script",
            "hlr.source.cad.script:open_script",
            (".py",),
            takes=("var", "parameters"),
            brep=True,
            noun="a script",
            crash=BROKEN_SCRIPT,
        ),
        _mesh_file("STL", _MESHES),
        _mesh_file("OBJ", _MESHES),
        _mesh_file("PLY", _MESHES),
        _mesh_file("OFF", _MESHES),
        _mesh_file("3MF", _PACKED, needs="trimesh"),
        _mesh_file("GLB", _PACKED, needs="trimesh"),
        Reader(
            "a CadQuery, build123d or OpenCASCADE object",
            "object",
            "hlr.source.cad.objects:open_object",
            fits="hlr.source.cad.objects:is_shape_like",
            brep=True,
            noun="an object",
        ),
        Reader(
            "a FreeCAD shape, object or document",
            "object",
            "hlr.source.freecad.objects:open_freecad",
            fits="hlr.source.freecad.objects:is_freecad",
            brep=True,
            noun="an object",
        ),
        Reader(
            "a trimesh object, a manifold3d object, a list or a dict of meshes, (vertices, faces)",
            "mesh",
            "hlr.source.mesh.open_objects:open_meshes",
            fits="hlr.source.mesh.open_objects:are_meshes",
        ),
        Reader(
            "a list or a dict of CAD objects and meshes",
            "mixed",
            "hlr.source.joined:open_both",
            fits="hlr.source.joined:are_both",
            brep=True,
            meshes=True,
            noun="CAD objects and meshes",
        ),
    )
)
"""All readers, by title."""

BESIDE = (".mtl", ".gltf")
"""What models refer to, or are kept in, without being read."""


def of_ending(ending: str) -> Reader | None:
    """The reader of files with this ending, of any case; None: there is none."""
    return _by_ending().get(ending.lower())


@READERS.derived
def _by_ending() -> dict[str, Reader]:
    """The first reader of each ending."""
    found: dict[str, Reader] = {}
    for reader in READERS.values():
        for ending in reader.endings:
            found.setdefault(ending, reader)
    return found


def endings() -> list[str]:
    """Of all files that are read."""
    return [ending for reader in READERS.values() for ending in reader.endings]


@READERS.derived
def of_objects() -> tuple[Reader, ...]:
    """The readers of objects in memory."""
    return tuple(reader for reader in READERS.values() if reader.fits)


@READERS.derived
def _by_kind() -> dict[str, Reader]:
    """The first reader of each kind."""
    found: dict[str, Reader] = {}
    for reader in READERS.values():
        found.setdefault(reader.kind, reader)
    return found


def of_kind(kind: str) -> Reader | None:
    """A reader that opens sources of this kind; None: there is none."""
    return _by_kind().get(kind)


def is_brep(kind: str) -> bool:
    """Whether sources of this kind have surfaces and edges; those of an unknown kind count as meshes."""
    reader = of_kind(kind)
    return reader is not None and reader.brep


def holds_meshes(kind: str) -> bool:
    """Whether sources of this kind have parts that are meshes; those of an unknown kind are nothing else."""
    reader = of_kind(kind)
    return reader is None or not reader.brep or reader.meshes


def file_titles(fits: Callable[[Reader], bool] = lambda _: True) -> str:
    """What is read from files, for help texts; fits: only of such readers."""
    return listed((reader.title for reader in READERS.values() if reader.endings and fits(reader)), "and")


def what_to_pass() -> str:
    """What can be drawn, for errors: every kind of object in memory, and files."""
    return listed((*(reader.title for reader in READERS.values() if reader.fits), "the name of a file"), "or")


def is_model(path: Path | str) -> bool:
    """Whether a file is a model, or a part of one, by its ending."""
    ending = os.path.splitext(path)[1].lower()
    return ending in BESIDE or of_ending(ending) is not None
