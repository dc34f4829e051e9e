"""STL, OBJ, PLY and OFF files: checked first, so that the error for another format names it."""

from __future__ import annotations

import re
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hlr import _kernel
from hlr.errors import SourceError, counted
from hlr.source.file_checks import without_mark, wrong_format
from hlr.source.mesh.colors import FileColors
from hlr.source.mesh.mesh_source import Instance, MeshSource
from hlr.source.mesh.objects import node_name

if TYPE_CHECKING:
    from hlr.common.types import Floats, Ints


def open_mesh_file(path: Path, kind: str) -> MeshSource:
    """An STL, OBJ, PLY or OFF file.

    Raises:
        SourceError: the file is broken, is something else, or holds no triangles.
    """
    with path.open("rb") as file:
        head = file.read(65536)
    of_text = kind != "stl" or without_mark(head).lstrip()[:5].lower() == b"solid"
    content = without_mark if of_text else bytes
    _CHECKS[kind](path, content(head), path.stat().st_size)
    try:
        points, pieces, vertex_colors, face_colors = _kernel.read_mesh(content(path.read_bytes()), kind)
    except EOFError as error:
        raise SourceError(f"{path.name} is cut short: {error}: export or download it again.") from None
    except ValueError as error:
        raise SourceError(
            f"{path.name} cannot be read as {kind.upper()}: the file is broken ({error}); export it again."
        ) from None
    except MemoryError:
        raise SourceError(f"{path.name} asks for more memory than there is.") from None
    if not pieces:
        pieces = [("", np.zeros((0, 3), np.int32))]
    geometries: list[tuple[Floats, Ints]] = []
    instances: list[Instance] = []
    for name, triangles in pieces:
        used, renumbered = _used_points(triangles) if len(pieces) > 1 else (slice(None), triangles)
        paint = None
        if vertex_colors is not None:
            paint = FileColors(vertex_colors[used], renumbered)
        elif face_colors is not None:
            paint = FileColors(face_colors, None)
        instances.append(Instance(node_name(name, name, path.stem), len(geometries), np.eye(4), None, paint))
        geometries.append((points[used], renumbered))
    return MeshSource(path.name, kind, geometries, instances)


def _used_points(triangles: Ints) -> tuple[Ints, Ints]:
    """Indices (k,) of the points that triangles (m, 3) use, and the triangles as indices into those."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    return used, renumbered.reshape(-1, 3).astype(np.int32)


def _check_stl(path: Path, head: bytes, size: int) -> None:
    count = struct.unpack_from("<I", head, 80)[0] if len(head) >= 84 else 0
    if len(head) >= 84 and size >= 84 + 50 * count and (count or size == 84):
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
    raise wrong_format(path, "an STL file", head)


_OBJ_LINE = re.compile(rb"^\s*(?:v\s+[-+.\d]|mtllib\s|o\s|g\s|f\s+-?\d|usemtl\s)", re.MULTILINE)


def _check_obj(path: Path, head: bytes, size: int) -> None:
    if b"\0" in head or (head.lstrip()[:1] == b"<") or (_OBJ_LINE.search(head) is None and size <= len(head)):
        raise wrong_format(path, "an OBJ file", head)


def _check_ply(path: Path, head: bytes, size: int) -> None:
    if not head.startswith(b"ply") or b"end_header" not in head:
        raise wrong_format(path, "a PLY file", head)


def _check_off(path: Path, head: bytes, size: int) -> None:
    lines = [line.split(b"#")[0].strip() for line in head.splitlines()]
    words = b" ".join(line for line in lines if line).split()
    if not words or not re.fullmatch(rb"(ST)?C?N?4?n?OFF", words[0]):
        raise wrong_format(path, "an OFF file", head)


_CHECKS = {"stl": _check_stl, "obj": _check_obj, "ply": _check_ply, "off": _check_off}
