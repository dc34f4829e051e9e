"""Read a meshed B-rep through OpenCASCADE's binary dump, parsed with NumPy.

Asking the bindings for every node and triangle costs a microsecond each; BinTools writes them all at C++ speed.
The dump (BinTools_ShapeSet, "Topology V4") is a sequence of sections with a text header each:

    Locations, Curve2ds, Curves, Polygon3D, PolygonOnTriangulations, Surfaces, Triangulations, TShapes

Curves and surfaces are skipped: the wanted sections are found by their headers, and a wrong hit is noticed because
every section parsed must end exactly where the next header stands. Anything unexpected raises `DumpError`; the caller
then walks the shape through the bindings (`hlr.source.walk`).
"""

from __future__ import annotations

import io
import re
import struct
from typing import Any

import numpy as np

from hlr.source.locations import Chain, Locations
from hlr.source.model import Floats, Ints
from hlr.source.tables import EDGE, FACE, Bytes, Tables, starts


class DumpError(Exception):
    """The dump is not laid out as expected."""


# One TShape. Bytes 0-7 begin a record, sub-shapes begin with an orientation 0-3 and end with '*': no two alternatives
# can match at one place, so the expression never backtracks.
_SUBS = rb"(?:[\x00-\x03].{8})*+\*"
_FLAGS = rb".{7}"
_RECORD = re.compile(
    rb"(?:\x07.{32}(?:\x01.{16}|\x02.{20}|\x03.{24})*+\x00"
    rb"|\x06.{11}(?:\x01.{24}|\x02.{28}|\x03.{33}|\x04.{17}|\x05.{8}|\x06.{12}|\x07.{16})*+\x00"
    rb"|\x04.{17}(?:\x02.{4}|[\x00\x01])"
    rb"|[\x00-\x03\x05])" + _FLAGS + _SUBS,
    re.DOTALL,
)
_COUNT = re.compile(rb"(\d{1,9})\n")
_NO_NUMBER = struct.pack("<d", float("nan"))
_STEPS_TOGETHER = 40
_REPRESENTATION_SIZE = np.array([0, 25, 29, 34, 18, 9, 13, 17] + [0] * 248, dtype=np.int64)


def read_dump(compound: Any) -> Tables:
    """Tables of a meshed TopoDS_Compound.

    Raises:
        DumpError: the binary layout is not the one known here.
    """
    from OCP.BinTools import BinTools, BinTools_FormatVersion

    stream = io.BytesIO()
    BinTools.Write_s(compound, stream, True, True, BinTools_FormatVersion.BinTools_FormatVersion_VERSION_4)
    try:
        return _parse(stream.getvalue())
    except (struct.error, IndexError, ValueError) as error:
        raise DumpError(str(error)) from error


def _parse(data: bytes) -> Tables:
    locations = _locations(data)
    polygons = _section(data, b"Polygon3D", 0, _polygons3d, b"PolygonOnTriangulations ")
    on_tri = _section(data, b"PolygonOnTriangulations", polygons[0], _polygons, b"Surfaces ")
    triangulations = _section(data, b"Triangulations", on_tri[0], _triangulations, b"\nTShapes ")
    _, count, at = _header(data, b"TShapes", triangulations[0])
    return _shapes(data, at, count, locations, polygons[1], on_tri[1], triangulations[1])


def _header(data: bytes, name: bytes, since: int) -> tuple[int, int, int]:
    """(where it stands, count, where its content begins) of the next header of this name."""
    label = name + b" "
    at = data.find(label, since)
    while at >= 0:
        found = _COUNT.match(data, at + len(label))
        if found and not data[at - 1 : at].isalpha():
            return at, int(found.group(1)), found.end()
        at = data.find(label, at + 1)
    raise DumpError(f"no section {name.decode()}")


def _section(data: bytes, name: bytes, since: int, parse: Any, follows: bytes) -> tuple[int, Any]:
    """Parse the section that ends at the header `follows`; a header by chance inside numbers does not."""
    while True:
        begin, count, at = _header(data, name, since)
        try:
            end, result = parse(data, at, count)
            if data.startswith(follows, end):
                return end, result
        except (struct.error, IndexError):
            pass
        since = begin + 1


def _locations(data: bytes) -> Locations:
    _, count, at = _header(data, b"Locations", 0)
    chains: list[Chain] = [()]
    datums: list[Floats] = []
    pair = struct.Struct("<ii")
    for _ in range(count):
        if data[at] == 1:
            chains.append(((len(datums), 1),))
            datums.append(np.frombuffer(data, dtype="<f8", count=12, offset=at + 1).reshape(3, 4))
            at += 97
        elif data[at] == 2:
            at += 1
            chain: list[tuple[int, int]] = []
            while True:
                (number,) = struct.unpack_from("<i", data, at)
                if number == 0:
                    at += 4
                    break
                number, power = pair.unpack_from(data, at)
                at += 8
                # Factors stand from the innermost to the outermost; each is an elementary location written earlier.
                ((datum, one),) = chains[number]
                if one != 1:
                    raise DumpError("a compound factor in a location")
                chain.insert(0, (datum, power))
            chains.append(tuple(chain))
        else:
            raise DumpError("unknown location")
    return Locations(chains, datums)


def _polygons3d(data: bytes, at: int, count: int) -> tuple[int, tuple[Ints, Floats]]:
    pieces: list[bytes] = []
    sizes: list[int] = []
    for _ in range(count):
        (size,) = struct.unpack_from("<i", data, at)
        has_parameters = data[at + 4]
        at += 13
        pieces.append(data[at : at + 24 * size])
        sizes.append(size)
        at += (32 if has_parameters else 24) * size
    return at, (starts(sizes), np.frombuffer(b"".join(pieces), dtype="<f8").reshape(-1, 3))


def _polygons(data: bytes, at: int, count: int) -> tuple[int, tuple[Ints, Ints]]:
    pieces: list[bytes] = []
    sizes: list[int] = []
    integer = struct.Struct("<i").unpack_from
    for _ in range(count):
        (size,) = integer(data, at)
        if size < 0:
            raise IndexError
        end = at + 4 + 4 * size
        pieces.append(data[at + 4 : end])
        sizes.append(size)
        at = end + 9
        if data[at - 1]:
            at += 8 * size
    return at, (starts(sizes), np.frombuffer(b"".join(pieces), dtype="<i4") - np.int32(1))


def _triangulations(data: bytes, at: int, count: int) -> tuple[int, tuple[Any, ...]]:
    nodes: list[bytes] = []
    uv: list[bytes] = []
    triangles: list[bytes] = []
    normals: list[bytes] = []
    node_counts: list[int] = []
    tri_counts: list[int] = []
    head = struct.Struct("<ii??").unpack_from
    for _ in range(count):
        node_count, tri_count, has_uv, has_normals = head(data, at)
        if node_count < 0 or tri_count < 0:
            raise IndexError
        at += 18
        end = at + 24 * node_count
        nodes.append(data[at:end])
        at = end
        end = at + 16 * node_count
        uv.append(data[at:end] if has_uv else _NO_NUMBER * (2 * node_count))
        at = end if has_uv else at
        end = at + 12 * tri_count
        triangles.append(data[at:end])
        at = end
        if has_normals:
            end = at + 12 * node_count
            normals.append(data[at:end])
            at = end
        else:
            normals.append(bytes(12 * node_count))
        node_counts.append(node_count)
        tri_counts.append(tri_count)
    return at, (
        starts(node_counts),
        np.frombuffer(b"".join(nodes), dtype="<f8").reshape(-1, 3),
        np.frombuffer(b"".join(uv), dtype="<f8").reshape(-1, 2),
        np.frombuffer(b"".join(normals), dtype="<f4").reshape(-1, 3),
        starts(tri_counts),
        np.frombuffer(b"".join(triangles), dtype="<i4").reshape(-1, 3) - np.int32(1),
    )


def _shapes(
    data: bytes, at: int, count: int, locations: Locations, lines: Any, polygons: Any, triangulations: Any
) -> Tables:
    spans = np.fromiter(
        (value for found in _RECORD.finditer(data, at) for value in found.span()), dtype=np.int64
    ).reshape(-1, 2)[:count]
    if len(spans) != count or count == 0 or spans[0, 0] != at or (spans[1:, 0] != spans[:-1, 1]).any():
        raise DumpError("a shape of unknown layout")
    buffer = np.frombuffer(data, dtype=np.uint8)
    kind = buffer[spans[:, 0]]
    # Where the sub-shapes begin; for edges it follows from their representations.
    begin = spans[:, 0] + 1 + 7
    edges = np.flatnonzero(kind == EDGE)
    degenerated = np.zeros(count, dtype=bool)
    degenerated[edges] = buffer[spans[edges, 0] + 11] != 0
    reps, rep_end = _representations(buffer, edges, spans[edges, 0] + 12)
    begin[edges] = rep_end + 1 + 7
    faces = np.flatnonzero(kind == FACE)
    face_tri = np.full(count, -1, dtype=np.int32)
    meshed = faces[buffer[spans[faces, 0] + 18] == 2]
    face_tri[meshed] = _int32(buffer, spans[meshed, 0] + 19) - 1
    begin[faces] = spans[faces, 0] + 19 + 7
    begin[meshed] += 4
    begin[kind > EDGE] = spans[kind > EDGE, 1] - 1
    sub_counts, odd = np.divmod(spans[:, 1] - 1 - begin, 9)
    if odd.any() or (sub_counts < 0).any():
        raise DumpError("sub-shapes of unknown layout")
    sub_start = starts(sub_counts)
    within = np.arange(sub_start[-1], dtype=np.int64) - np.repeat(sub_start[:-1].astype(np.int64), sub_counts)
    where = np.repeat(begin, sub_counts) + 9 * within
    smooth = np.full(count, -1, dtype=np.int32)
    regular = reps[4]
    np.maximum.at(smooth, regular[:, 0], buffer[regular[:, 1] + 1].astype(np.int32))
    single, double, free = reps[6], reps[7], reps[5]
    return Tables(
        kind=kind,
        degenerated=degenerated,
        face_tri=face_tri,
        smooth=smooth,
        sub_start=sub_start,
        sub_shape=count - _int32(buffer, where + 1),
        sub_orient=buffer[where],
        sub_loc=locations.first[_int32(buffer, where + 5)],
        rep_edge=np.concatenate((single[:, 0], double[:, 0])).astype(np.int32),
        rep_tri=np.concatenate((_int32(buffer, single[:, 1] + 5), _int32(buffer, double[:, 1] + 9))) - np.int32(1),
        rep_loc=locations.first[np.concatenate((_int32(buffer, single[:, 1] + 9), _int32(buffer, double[:, 1] + 13)))],
        rep_poly=_int32(buffer, np.concatenate((single[:, 1], double[:, 1])) + 1) - np.int32(1),
        rep_poly2=np.concatenate(
            (np.full(len(single), -1, dtype=np.int32), _int32(buffer, double[:, 1] + 5) - np.int32(1))
        ),
        free_edge=free[:, 0].astype(np.int32),
        free_loc=locations.first[_int32(buffer, free[:, 1] + 5)],
        free_poly=_int32(buffer, free[:, 1] + 1) - np.int32(1),
        poly_start=polygons[0],
        poly_nodes=polygons[1],
        line_start=lines[0],
        line_points=lines[1],
        node_start=triangulations[0],
        nodes=triangulations[1],
        uv=triangulations[2],
        normals=triangulations[3],
        tri_start=triangulations[4],
        triangles=triangulations[5],
        locations=locations,
    )


def _int32(buffer: Bytes, where: Any) -> Ints:
    """Little-endian integers at any byte positions."""
    value = buffer[where].astype(np.uint32)
    for k in (1, 2, 3):
        value |= buffer[where + k].astype(np.uint32) << np.uint32(8 * k)
    result: Ints = value.view(np.int32)
    return result


def _representations(buffer: Bytes, edges: Any, at: Any) -> tuple[dict[int, Any], Any]:
    """All edges step through their lists of representations together; {kind: (edge, position) rows}, list ends."""
    rows: dict[int, list[Any]] = {4: [], 5: [], 6: [], 7: []}
    ends = np.empty(len(edges), dtype=np.int64)
    active = np.arange(len(edges))
    position = at.copy()
    for _ in range(_STEPS_TOGETHER):
        kinds = buffer[position]
        done = kinds == 0
        ends[active[done]] = position[done]
        for kind, found in rows.items():
            hit = kinds == kind
            if hit.any():
                found.append(np.stack((edges[active[hit]], position[hit]), axis=1))
        active, position, kinds = active[~done], position[~done], kinds[~done]
        position = position + _REPRESENTATION_SIZE[kinds]
        if not len(active):
            break
    # A few edges carry hundreds of them (left behind by boolean operations): those are read one at a time.
    sizes = _REPRESENTATION_SIZE.tolist()
    for edge, start in zip(active.tolist(), position.tolist(), strict=True):
        where = start
        while (kind := int(buffer[where])) != 0:
            if kind in rows:
                rows[kind].append(np.array([[edges[edge], where]], dtype=np.int64))
            where += sizes[kind]
        ends[edge] = where
    none = np.empty((0, 2), dtype=np.int64)
    return {kind: np.concatenate(found) if found else none for kind, found in rows.items()}, ends
