"""3MF and GLB files, read by trimesh: checked first, so that a false header cannot take all memory."""

from __future__ import annotations

import io
import logging
import struct
import sys
import warnings
from pathlib import Path
from typing import Any

from hlr.common.process import is_own
from hlr.errors import SourceError
from hlr.source.file_checks import wrong_format
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.objects import MM_PER_UNIT, Y_UP, from_trimesh
from hlr.source.model import Frame


def open_glb_or_3mf(path: Path, kind: str) -> MeshSource:
    """A 3MF or GLB file.

    Raises:
        SourceError: the file is broken, is something else, or holds no triangles.
    """
    with path.open("rb") as file:
        head = file.read(65536)
    (_check_glb if kind == "glb" else _check_3mf)(path, head, path.stat().st_size)
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
    trimesh = _trimesh(kind)
    # From memory, not by path: a file cannot make the reader open other files of its folder.
    data = io.BytesIO(path.read_bytes())
    # trimesh logs failed attempts with tracebacks; without a handler they would go to standard error.
    logging.getLogger("trimesh").addHandler(_SILENT)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return trimesh.load_scene(data, file_type=kind, process=False)


_SILENT = logging.NullHandler()

_UNUSED = (
    "charset_normalizer",
    "embreex",
    "httpx",
    "jsonschema",
    "manifold3d",
    "networkx",
    "rtree",
    "scipy",
    "shapely",
)
"""Packages that trimesh imports but does not use for these files, at four fifths of its import time.

Only 3MF needs networkx.
"""


def _trimesh(kind: str) -> Any:
    """The module trimesh: without its unused imports in hlr's own process, whole in a caller's."""
    wanted = "networkx" if kind == "3mf" else ""
    hidden = [name for name in _UNUSED if name != wanted and name not in sys.modules] if is_own() else []
    sys.modules.update(dict.fromkeys(hidden))  # type: ignore[arg-type]
    try:
        import trimesh
    finally:
        for name in hidden:
            del sys.modules[name]
    return trimesh


def _frame(kind: str, scene: Any) -> Frame:
    if kind == "glb":
        return Frame(1000.0, Y_UP)
    return Frame(MM_PER_UNIT.get(str(scene.units or "millimeter").lower(), 1.0))


def _detail(error: Exception) -> str:
    """The reader's message, where it is a sentence."""
    text = " ".join(str(error).split())
    return f" ({text[:100]})" if isinstance(error, ValueError) and " " in text else ""


def _check_glb(path: Path, head: bytes, size: int) -> None:
    import json

    if not head.startswith(b"glTF") or len(head) < 20:
        raise wrong_format(path, "a GLB file", head)
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


def _check_3mf(path: Path, head: bytes, _size: int) -> None:
    from hlr.source.mesh.zip_checks import check_3mf_archive

    if not head.startswith(b"PK"):
        raise wrong_format(path, "a 3MF file (they are ZIP archives)", head)
    check_3mf_archive(path)
