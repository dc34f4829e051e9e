"""B-rep files through the cache: a file that is drawn again is not read again, and OpenCASCADE is not needed.

The JSON of an entry (`hlr.cache.entry`) has the numbers of prototypes and coloured faces, the notes, and for each part
[name, product, colour or null, prototype, transparent, colour and opacity or null, assemblies]. Its data are,
little-endian:

    transforms   (parts, 4, 4)        f8   placement of each part
    boxes        (prototypes, 2, 3)   f8   as of `hlr.source.cad.prototypes.Prototypes`
    colours      (faces, 4)           f8   red, green, blue, opacity of faces that have their own
    counts       (prototypes, 3)      i4   as of `Prototypes`
    coloured     (parts + 1)          i4   offsets of each part's coloured faces
    faces        (faces)              i4   their indices in the part's face map
    dump                                   the rest: OpenCASCADE's binary dump of all prototypes
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from hlr.cache.entry import DamagedError, packed, unpacked
from hlr.cache.folder import folder, most_bytes
from hlr.cache.store import NotKeptError, Store
from hlr.common.types import Rgba
from hlr.drawing.notes import CODES, Note
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.cache_key import cache_key
from hlr.source.cad.parts import Part
from hlr.source.cad.prototypes import EMPTY_BOX, Prototypes
from hlr.source.cad.source_builder import with_appearance
from hlr.source.joined import JoinedSource
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.model import Appearance

FileSource = BrepSource | JoinedSource | MeshSource


def read_through_cache(path: Path, kind: str, all_of_it: bool, read: Callable[[], FileSource]) -> FileSource:
    """The source of a file: from the cache, else from `read`, whose result is cached where that is possible.

    A source that has meshes is not: they would take long to write, and are read as fast from the file.

    Raises:
        SourceError: whatever `read` raises; a failure is not cached.
    """
    started = perf_counter()
    cache_folder = folder()
    if cache_folder is None:
        source: FileSource = read()
        source.reading = f"{path.name} was read in {_seconds_since(started)}; the cache is off"
        return source
    store = Store(cache_folder, most_bytes())
    key = cache_key(path, kind, all_of_it)
    entry = store.read(key)
    damage = ""
    if entry is not None:
        try:
            source = from_entry(path.name, kind, *unpacked(key, entry))
        except DamagedError as error:
            damage = f"what the cache had of it was not used, for {error}; "
        else:
            store.touch(key)
            source.reading = f"{path.name} was not read again, it is in the cache: {store.path(key)}"
            return source
    source = read()
    source.reading = f"{damage}{path.name} was read in {_seconds_since(started)}"
    try:
        if key != cache_key(path, kind, all_of_it):
            raise NotKeptError("the file has changed meanwhile")
        if not isinstance(source, BrepSource):
            raise NotKeptError("it holds meshes")
        store.write(key, packed(key, *to_entry(source)))
        source.reading += f" and is in the cache now: {store.path(key)}"
    except (NotKeptError, OSError) as error:
        source.reading += f" and not kept in the cache ({error})"
    return source


def _seconds_since(started: float) -> str:
    return f"{perf_counter() - started:.2g} s"


def to_entry(source: BrepSource) -> tuple[dict[str, Any], list[bytes]]:
    """JSON and data of the cache entry of a source."""
    prototypes, looks = source.prototypes, [part.appearance() for part in source.parts]
    painted = [(number, rgba) for look in looks for number, rgba in look.faces.items()]
    facts = {
        "prototypes": len(prototypes.counts),
        "faces": len(painted),
        "notes": [[note.code, note.text] for note in source.notes],
        "parts": [
            [part.name, part.product, part.color, part.prototype, part.transparent, look.whole, part.above]
            for part, look in zip(source.parts, looks, strict=True)
        ],
    }
    arrays = [
        np.array([part.transform for part in source.parts], "<f8"),
        prototypes.boxes.astype("<f8"),
        np.array([rgba for _, rgba in painted], "<f8"),
        prototypes.counts.astype("<i4"),
        np.cumsum([0, *(len(look.faces) for look in looks)]).astype("<i4"),
        np.array([number for number, _ in painted], "<i4"),
    ]
    return facts, [*(array.tobytes() for array in arrays), prototypes.dump]


def from_entry(name: str, kind: str, facts: dict[str, Any], data: memoryview) -> BrepSource:
    """The source that a cache entry describes; every value is checked.

    Raises:
        DamagedError: `to_entry` cannot have made this entry.
    """
    try:
        return _checked_source(name, kind, facts, data)
    except (ValueError, TypeError, KeyError, IndexError, OverflowError, MemoryError):
        raise DamagedError("its content does not fit together") from None


def _checked_source(name: str, kind: str, facts: dict[str, Any], data: memoryview) -> BrepSource:
    parts = facts["parts"]
    n_parts, n_prototypes, n_faces = len(parts), _index(facts["prototypes"]), _index(facts["faces"])
    offset = 0

    def table(kind: str, *shape: int) -> Any:
        nonlocal offset
        dtype = np.dtype(kind)
        count = math.prod(shape)
        _require(count * dtype.itemsize <= len(data) - offset)
        found = np.frombuffer(data, dtype, count, offset).astype(dtype.newbyteorder("="))
        offset += found.nbytes
        return found.reshape(shape)

    transforms, boxes, colors = (
        table("<f8", n_parts, 4, 4),
        table("<f8", n_prototypes, 2, 3),
        table("<f8", n_faces, 4),
    )
    counts, start, faces = table("<i4", n_prototypes, 3), table("<i4", n_parts + 1), table("<i4", n_faces)
    _require(n_parts > 0 and bool(np.isfinite(transforms).all()))
    sound = np.isfinite(boxes).all(axis=(1, 2)) & (boxes[:, 0] <= boxes[:, 1]).all(axis=1)
    _require(bool((sound | (boxes == EMPTY_BOX).all(axis=(1, 2))).all()))
    _require(bool(((colors >= 0.0) & (colors <= 1.0)).all()))
    _require(start[0] == 0 and start[-1] == n_faces and bool((np.diff(start) >= 0).all()))
    prototypes = Prototypes(bytes(data[offset:]), counts, boxes)
    _require(prototypes.model.faces_of_parts == counts[:, 0].tolist() and bool((counts >= 0).all()))

    def part(number: int) -> Part:
        own, product, color, prototype, transparent, whole, above = parts[number]
        _require(isinstance(above, list) and all(isinstance(text, str) for text in (own, product, *above)))
        _require(isinstance(transparent, bool))
        _require(0 <= _index(prototype) < n_prototypes)
        _require(counts[prototype, 0] > 0)
        mine = slice(start[number], start[number + 1])
        numbers = faces[mine].tolist()
        _require(all(0 <= face < counts[prototype, 0] for face in numbers))
        rgba: list[Rgba] = [(r, g, b, a) for r, g, b, a in colors[mine].tolist()]
        look = Appearance(_numbers(whole, 4), dict(zip(numbers, rgba, strict=True)))
        found = Part(
            own, product, _numbers(color, 3), prototype, transforms[number], transparent, Appearance, tuple(above)
        )
        return with_appearance(found, look)

    _require(all(code in CODES and isinstance(text, str) for code, text in facts["notes"]))
    notes = [Note(code, text) for code, text in facts["notes"]]
    source = BrepSource(name, kind, [part(number) for number in range(n_parts)], prototypes, notes)
    _require(len({part.name for part in source.parts}) == n_parts)
    return source


def _require(true: bool) -> None:
    if not true:
        raise ValueError("an entry that was not made here")


def _index(value: Any) -> int:
    _require(isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**31)
    return int(value)


def _numbers(values: Any, count: int) -> Any:
    """`count` numbers from 0 to 1 as a tuple, or None."""
    if values is None:
        return None
    _require(len(values) == count and all(isinstance(v, int | float) and 0.0 <= v <= 1.0 for v in values))
    return tuple(map(float, values))
