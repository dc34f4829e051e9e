"""Mesh files through trimesh: checked before they are loaded, so that a header cannot ask for endless memory."""

from __future__ import annotations

import io
import logging
import re
import struct
import warnings
from pathlib import Path
from typing import Any

from hlr.errors import SourceError, counted
from hlr.source.files import looks_like
from hlr.source.meshes import UNITS, Y_UP, MeshSource, from_trimesh
from hlr.source.model import Frame


def open_mesh_file(path: Path, kind: str) -> MeshSource:
    """An STL, OBJ, PLY, OFF, 3MF or GLB file.

    Raises:
        SourceError: the file is broken, is something else, or holds no triangles.
    """
    with path.open("rb") as file:
        head = file.read(65536)
    _CHECKS[kind](path, head, path.stat().st_size)
    try:
        scene = _load(path, kind)
    except SourceError:
        raise
    except MemoryError:
        raise SourceError(f"{path.name} asks for more memory than there is.") from None
    except Exception as error:  # whatever a broken file makes a reader raise
        raise SourceError(
            f"{path.name} cannot be read as {kind.upper()}: the file is broken{_detail(error)}."
        ) from None
    return from_trimesh(path.name, kind, scene, _frame(kind, scene), path.stem)


def _load(path: Path, kind: str) -> Any:
    import trimesh

    more: dict[str, Any] = {"process": False}
    if kind == "obj":
        # Materials would be looked up in other files; objects keep their names.
        more |= {"skip_materials": True, "split_object": True, "group_material": False, "maintain_order": True}
    # From memory, not from the folder: a file cannot make the reader open its neighbours.
    data = path.read_bytes()
    # It reports what it tried in vain, with tracebacks; without a handler they would go to standard error.
    logging.getLogger("trimesh").addHandler(_SILENT)
    if kind == "obj":
        data = data.removeprefix(b"\xef\xbb\xbf")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return trimesh.load_scene(io.BytesIO(data), file_type=kind, **more)


_SILENT = logging.NullHandler()


def _frame(kind: str, scene: Any) -> Frame:
    if kind == "glb":
        return Frame(1000.0, Y_UP)
    if kind == "3mf":
        return Frame(UNITS.get(str(scene.units or "millimeter").lower(), 1.0))
    return Frame()


def _detail(error: Exception) -> str:
    """What the reader says, where it says it in words."""
    text = " ".join(str(error).split())
    return f" ({text[:100]})" if isinstance(error, ValueError) and " " in text else ""


def _refuse(path: Path, kind: str, head: bytes) -> SourceError:
    return SourceError(f"{path.name} is not {kind}: it looks like {looks_like(head)}.")


def _check_stl(path: Path, head: bytes, size: int) -> None:
    count = struct.unpack_from("<I", head, 80)[0] if len(head) >= 84 else 0
    if len(head) >= 84 and size >= 84 + 50 * count and count:
        return
    if head.lstrip()[:5].lower() == b"solid" and (b"facet" in head or b"endsolid" in head):
        with path.open("rb") as file:
            file.seek(max(0, size - 4096))
            if b"endsolid" not in file.read().lower():
                raise SourceError(f"{path.name} is cut short (endsolid is missing): export or download it again.")
        return
    if b"\0" in head[:84] and len(head) >= 84:
        held = max(0, (size - 84) // 50)
        raise SourceError(
            f"{path.name} is cut short or no STL file: it announces {counted(count, 'triangle')} and has room for "
            f"{held}: export or download it again."
        )
    raise _refuse(path, "an STL file", head)


_OBJ_LINE = re.compile(rb"^\s*(?:v\s+[-+.\d]|mtllib\s|o\s|g\s|f\s+-?\d|usemtl\s)", re.MULTILINE)


def _check_obj(path: Path, head: bytes, size: int) -> None:
    if b"\0" in head or (head.lstrip()[:1] == b"<") or (_OBJ_LINE.search(head) is None and size <= len(head)):
        raise _refuse(path, "an OBJ file", head)


_PLY_SIZES = {
    **dict.fromkeys((b"char", b"uchar", b"int8", b"uint8"), 1),
    **dict.fromkeys((b"short", b"ushort", b"int16", b"uint16"), 2),
    **dict.fromkeys((b"int", b"uint", b"int32", b"uint32", b"float", b"float32"), 4),
    **dict.fromkeys((b"double", b"float64"), 8),
}


def _check_ply(path: Path, head: bytes, size: int) -> None:
    end = head.find(b"end_header")
    if not head.startswith(b"ply") or end < 0:
        raise _refuse(path, "a PLY file", head)
    text = b"format ascii" in head[:end]
    need = count = rows = 0
    last: list[bool] = []
    for line in head[:end].splitlines():
        words = line.split()
        if len(words) == 3 and words[0] == b"element" and words[2].isdigit():
            count, last = int(words[2]), []
            rows += count
        elif len(words) >= 3 and words[0] == b"property":
            # A list takes at least its own length; a number in a text takes a digit and a blank.
            need += count * (2 if text else _PLY_SIZES.get(words[2] if words[1] == b"list" else words[1], 1))
            last.append(words[1] == b"list")
    if need > size:
        raise SourceError(
            f"{path.name} is cut short: its header announces at least {need} bytes of data, the file has {size}: "
            "export or download it again."
        )
    if text:
        body = path.read_bytes()[end:].partition(b"\n")[2]
        _check_rows(path, [row for row in body.splitlines() if row.strip()], rows, last if count else [])


def _check_rows(path: Path, lines: list[bytes], rows: int, last: list[bool]) -> None:
    """As many rows of numbers as were announced, and the last one whole; last: of its values, which are lists."""
    if len(lines) < rows:
        raise SourceError(
            f"{path.name} is cut short: its header announces {counted(rows, 'row')} of numbers, the file has "
            f"{len(lines)}: export or download it again."
        )
    words = lines[rows - 1].split() if rows else []
    at = 0
    for is_list in last:
        at += 1 + (int(words[at]) if is_list and at < len(words) and words[at].isdigit() else 0)
    if at > len(words):
        raise SourceError(f"{path.name} is cut short (its last row is not whole): export or download it again.")


def _check_off(path: Path, head: bytes, size: int) -> None:
    lines = [line.split(b"#")[0].strip() for line in head.splitlines()]
    words = b" ".join(line for line in lines if line).split()
    if not words or not re.fullmatch(rb"(ST)?C?N?4?n?OFF", words[0]):
        raise _refuse(path, "an OFF file", head)
    if any(word.isdigit() and 2 * int(word) > size for word in words[1:3]):
        raise SourceError(f"{path.name} is cut short: its header announces more than the file holds.")
    if len(words) < 3 or not (words[1].isdigit() and words[2].isdigit()):
        return
    every = (line.partition(b"#")[0].strip() for line in path.read_bytes().splitlines())
    rows = [line for line in every if line]
    start = 1 if len(rows[0].split()) > 1 else 2
    faces = int(words[2])
    _check_rows(path, rows[start:], int(words[1]) + faces, [True] if faces else [])


def _check_glb(path: Path, head: bytes, size: int) -> None:
    import json

    if not head.startswith(b"glTF") or len(head) < 20:
        raise _refuse(path, "a GLB file", head)
    version, length, chunk = struct.unpack_from("<III", head, 4)
    if version != 2:
        raise SourceError(f"{path.name} is glTF version {version}: only version 2 is read; export it again.")
    if length > size or 20 + chunk > size:
        raise SourceError(f"{path.name} is cut short: it announces {length} bytes and has {size}: download it again.")
    with path.open("rb") as file:
        file.seek(20)
        text = file.read(chunk)
    try:
        tree = json.loads(text)
        counts = [int(accessor.get("count", 0)) for accessor in tree.get("accessors", ())]
        packed = {str(name) for name in tree.get("extensionsRequired", ())} & _PACKED
    except (ValueError, AttributeError, TypeError, RecursionError):
        raise SourceError(f"{path.name} cannot be read as GLB: its JSON part is broken.") from None
    if packed:
        raise SourceError(f"{path.name} is compressed ({', '.join(sorted(packed))}): export it without compression.")
    if any(count > size for count in counts):
        raise SourceError(f"{path.name} announces more data than it holds: export or download it again.")


_PACKED = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization_compressed"}


def _check_3mf(path: Path, head: bytes, size: int) -> None:
    from hlr.source.archive import check

    if not head.startswith(b"PK"):
        raise _refuse(path, "a 3MF file (they are ZIP archives)", head)
    check(path, size)


_CHECKS = {
    "stl": _check_stl,
    "obj": _check_obj,
    "ply": _check_ply,
    "off": _check_off,
    "glb": _check_glb,
    "3mf": _check_3mf,
}
