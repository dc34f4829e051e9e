"""Meshes of all parts in one set of arrays that the kernel holds; a sequence of single parts as well."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Color, Floats, Ints
from hlr.errors import SourceError
from hlr.source.model import PartMesh, SurfaceParameters, Surfaces

if TYPE_CHECKING:
    from hlr.source.cad.parts import Part

MAX_TRIANGLES = 2**31 // 3 - 1
"""Limit of 32-bit indices of triangles' sides, three per triangle."""


@dataclass(frozen=True, slots=True)
class PartLabel:
    """Name, colour and placement (4, 4) of a part."""

    name: str
    color: Color | None
    transform: Floats


class PartMeshes(Sequence[PartMesh]):
    """Meshes of all parts in common arrays; a single part is cut out when it is asked for.

    labels    name, colour and placement of each part
    tables    the meshes
    surfaces  those of the parts' faces; None where no part has any
    """

    def __init__(
        self, labels: Sequence[PartLabel | Part], tables: _kernel.PartTables, surfaces: Surfaces | None
    ) -> None:
        self.labels, self.tables, self.surfaces = labels, tables, surfaces

    def __len__(self) -> int:
        return len(self.labels)

    @overload
    def __getitem__(self, i: int) -> PartMesh: ...
    @overload
    def __getitem__(self, i: slice) -> list[PartMesh]: ...
    def __getitem__(self, i: int | slice) -> PartMesh | list[PartMesh]:
        """The part with this index. Its arrays may be read-only views of the common ones."""
        if isinstance(i, slice):
            return [_single_part(self, k) for k in range(len(self))[i]]
        return _single_part(self, range(len(self))[i])


def check_triangle_count(triangles: int) -> None:
    """Raise SourceError where a model has more triangles than 32-bit indices allow."""
    if triangles > MAX_TRIANGLES:
        raise SourceError("the model has more than 700 million triangles: give a coarser accuracy")


def combine_parts(parts: Sequence[PartMesh]) -> PartMeshes:
    """The meshes of parts in common arrays. Raises SourceError where there are too many triangles."""
    if isinstance(parts, PartMeshes):
        return parts
    check_triangle_count(sum(len(part.triangles) for part in parts))
    points = _offsets([len(part.points) for part in parts])
    on = [part.surface_parameters for part in parts]
    known = [o for o in on if o is not None]
    nodes = _offsets([0 if o is None else len(o.uv) for o in on])
    chains = _offsets([len(part.edge_nodes) for part in parts])
    counts = [len(part.face_planar) for part in parts]

    def of_faces(of: Callable[[SurfaceParameters], npt.NDArray[Any]], none: npt.NDArray[Any]) -> npt.NDArray[Any]:
        rows = [np.repeat(none[None], n, axis=0) if o is None else of(o) for o, n in zip(on, counts, strict=True)]
        return _concatenated(rows, none.shape, none.dtype)

    corner = [
        np.full((len(part.triangles), 3), -1, np.int32) if o is None else o.corner + first
        for part, o, first in zip(parts, on, nodes.tolist(), strict=False)
        if known
    ]
    return PartMeshes(
        labels=[PartLabel(part.name, part.color, part.transform) for part in parts],
        tables=_kernel.PartTables(
            point_start=points,
            points=_concatenated([part.points for part in parts], (3,), np.float64),
            triangle_start=_offsets([len(part.triangles) for part in parts]),
            # Those of the first part keep their numbers: of a scan all do, and a copy would be large.
            triangles=_concatenated(
                [p.triangles + n if n else p.triangles for p, n in zip(parts, points.tolist(), strict=False)],
                (3,),
                np.int32,
            ),
            triangle_face=_concatenated([part.triangle_face for part in parts], (), np.int32),
            origin=None
            if all(part.origin is None for part in parts)
            else _concatenated([_origin(part) for part in parts], (), np.int32),
            face_start=_offsets(counts),
            face_planar=_concatenated([part.face_planar for part in parts], (), np.bool_),
            edge_start=_offsets([len(part.edge_index) for part in parts]),
            edge_offsets=_concatenated(
                [np.zeros(1), *[p.edge_offsets[1:] + n for p, n in zip(parts, chains.tolist(), strict=False)]],
                (),
                np.int32,
            ),
            edge_nodes=_concatenated(
                [p.edge_nodes + n for p, n in zip(parts, points.tolist(), strict=False)], (), np.int32
            ),
            edge_index=_concatenated([part.edge_index for part in parts], (), np.int32),
            edge_class=_concatenated([part.edge_class for part in parts], (), np.uint8),
            brep=np.array([part.brep for part in parts], np.bool_),
            joined=np.array([part.joined for part in parts], np.bool_),
            transform=_concatenated([part.transform[None, :3] for part in parts], (3, 4), np.float64),
            precision=np.array([part.precision for part in parts], np.float64),
            node_start=nodes,
            corner=_concatenated(corner, (3,), np.int32),
            uv=_concatenated([o.uv for o in known], (2,), np.float64),
            face_shape=of_faces(lambda o: o.number, np.array(-1, np.int32)),
            face_place=of_faces(lambda o: o.place, np.eye(3, 4)),
            face_reversed=of_faces(lambda o: o.reversed, np.array(False)),
        ),
        surfaces=known[0].surfaces if known else None,
    )


def _single_part(whole: PartMeshes, i: int) -> PartMesh:
    t, label = whole.tables, whole.labels[i]
    starts = (t.point_start, t.triangle_start, t.face_start, t.edge_start, t.node_start)
    points, triangles, faces, edges, nodes = (slice(*start[i : i + 2].tolist()) for start in starts)
    offsets = t.edge_offsets[edges.start : edges.stop + 1]
    own, on = t.origin[triangles], None
    if whole.surfaces is not None and t.brep[i]:
        on = SurfaceParameters(
            corner=t.corner[triangles] - np.int32(nodes.start),
            uv=t.uv[nodes],
            number=t.face_shape[faces],
            place=t.face_place[faces],
            reversed=t.face_reversed[faces],
            surfaces=whole.surfaces,
        )
    return PartMesh(
        name=label.name,
        color=label.color,
        transform=label.transform,
        points=t.points[points],
        triangles=t.triangles[triangles] - np.int32(points.start),
        triangle_face=t.triangle_face[triangles],
        face_planar=t.face_planar[faces],
        edge_nodes=t.edge_nodes[offsets[0] : offsets[-1]] - np.int32(points.start),
        edge_offsets=offsets - offsets[0],
        edge_index=t.edge_index[edges],
        edge_class=t.edge_class[edges],
        brep=bool(t.brep[i]),
        surface_parameters=on,
        precision=float(t.precision[i]),
        joined=bool(t.joined[i]),
        origin=None if (own == np.arange(len(own))).all() else own,
    )


def _origin(part: PartMesh) -> Ints:
    return np.arange(len(part.triangles), dtype=np.int32) if part.origin is None else part.origin


def _offsets(counts: list[int]) -> Ints:
    out = np.zeros(len(counts) + 1, np.int32)
    np.cumsum(counts, out=out[1:])
    return out


def _concatenated(tables: Sequence[npt.NDArray[Any]], row: tuple[int, ...], dtype: Any) -> npt.NDArray[Any]:
    """The tables one after another: rows of shape `row`, numbers of type `dtype`."""
    if not tables:
        return np.zeros((0, *row), dtype)
    whole = tables[0] if len(tables) == 1 else np.concatenate(tables)
    return np.ascontiguousarray(whole, dtype)
