"""The Rust kernel. Arrays are C-contiguous; int32 indices; every call may raise ValueError on a wrong shape.

A part of the visibility pass (triangle_part, edge_part, cull, sound, delta, cap, tight) is a scene's group. Parts share
no points.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]

def read_mesh(
    data: bytes, kind: str
) -> tuple[Floats, list[tuple[str, Ints]], npt.NDArray[np.uint8] | None, npt.NDArray[np.uint8] | None]:
    """A mesh file's points (n, 3), its parts (name, triangles (m, 3)), and the colours (k, 4) of points or triangles.

    kind: stl, obj, ply or off. EOFError: it ends too early; ValueError: it is broken; MemoryError: there is too little.
    Each says what is wrong as the end of a sentence. A corner that does not exist is out of range in the answer.
    """

def edge_table(triangles: Ints, n_points: int) -> tuple[Ints, Ints, Ints]: ...
def clean_mesh(
    points: Floats, triangles: Ints
) -> tuple[Floats, Ints, npt.NDArray[np.uint32] | None, tuple[int, int, int]]:
    """Points (n, 3) with equal ones joined, triangles (m, 3) without impossible ones, which of the given these are
    (None: all), and how many were left out: not finite, out of range, degenerate."""

def mesh_facts(
    points: Floats, triangles: Ints
) -> tuple[Ints, Ints, Ints, Ints, Floats, Floats, npt.NDArray[np.int64], bool]:
    """edges (e, 2), offsets (e+1,), incident (k,), balance (e,), fold (e,), normals (t, 3), flat (f,), repeated: the
    fields of `hlr.scene.topology.MeshFacts`."""

def group_facts(
    points: Floats, triangles: Ints, group: Ints, count: int
) -> tuple[Floats, Floats, npt.NDArray[np.uint32], Floats, Floats]:
    """Of each group its box, low (g, 3) and high (g, 3), its triangles, six times its volume, and twice its area."""

def bent_groups(
    points: Floats,
    triangles: Ints,
    edges: Ints,
    offsets: Ints,
    incident: Ints,
    normals: Floats,
    group: Ints,
    least: Floats,
) -> Bools:
    """(g,) whether a group bends inward at an edge by more than least (g,), or has an edge of not two triangles."""

def group_pieces(group: Ints, piece: Ints, count: int) -> npt.NDArray[np.uint32]:
    """(g,) connected pieces of each group; group (t,), piece (t,) as `components` numbers them."""

def needles(
    points: Floats, triangles: Ints, normals: Floats, part: Ints, least: Floats
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Triangles lower than least (p,) of their part, or without area, ascending; and which side (0..2) is longest."""

def edge_kinds(
    offsets: Ints, fold: Floats, edge_part: Ints, bare: Bools, sharp: float, near: float
) -> tuple[Bytes, npt.NDArray[np.int64]]:
    """(e,) EdgeClass of the edges of parts that are bare (p,), 255 for others; and which of these are nearly creases.

    sharp, near: cosines of folds, below which an edge is a crease, or nearly one.
    """

def stitched(points: Floats, triangles: Ints, reach: float) -> tuple[Ints, Ints, int]: ...
def components(triangles: Ints, n_points: int) -> Ints: ...
def edge_components(edges: Ints, n_points: int) -> Ints: ...
def clashes(points: Floats, triangles: Ints, triangle_part: Ints, itself: Bools) -> dict[str, Any]: ...
def reach(
    points: Floats,
    triangles: Ints,
    edges: Ints,
    offsets: Ints,
    incident: Ints,
    normals: Floats,
    pairs: Ints,
    at: Floats,
    most: Floats,
) -> Floats: ...
def boxes_meet(low: Floats, high: Floats) -> Bools: ...
def visibility(
    points: Floats,
    triangles: Ints,
    triangle_part: Ints,
    edges: Ints,
    offsets: Ints,
    incident: Ints,
    edge_part: Ints,
    role: Bytes,
    cull: Bools,
    sound: Bools,
    delta: Floats,
    cap: Floats,
    tight: Bools,
    threads: int = 0,
    arithmetic: str = "exact",
    crossings: bool = True,
    piercings: bool = True,
    pyramid: bool = False,
    own: tuple[npt.NDArray[Any], ...] | None = None,
) -> dict[str, Any]: ...
def curve_points(kind: Bytes, offsets: Ints, values: Floats, which: Ints, parameters: Floats) -> Floats: ...
def surface_points(kind: Bytes, offsets: Ints, values: Floats, which: Ints, uv: Floats) -> Floats: ...
def true_lines(
    kind: Bytes,
    ranges: Floats,
    offsets: Ints,
    values: Floats,
    places: Floats,
    projection: tuple[tuple[float, float, float, float], ...],
    line_curve: Ints,
    line_place: Ints,
    line_offsets: Ints,
    flat_points: Floats,
    space_points: Floats,
    line_chain: Ints,
    line_visible: Bools,
    line_border: Bytes,
    line_bulge: Floats,
    eye: tuple[float, float, float],
    away: tuple[float, float, float],
    accuracy: float,
    model: float,
    contact: float,
    threads: int,
) -> dict[str, Any]: ...
def arc_rows(arcs: Floats, ends: Floats, places: int, accuracy: float, cubic: bool) -> dict[str, Any]: ...

_Layer = tuple[
    npt.NDArray[np.int64],
    Bytes,
    Ints,
    npt.NDArray[np.int64],
    npt.NDArray[np.int64],
    Bools,
]

def path_data(layer: _Layer, places: int, as_pdf: bool) -> tuple[bytes, npt.NDArray[np.int64]]: ...
def dashes(layer: _Layer, visible: list[_Layer], places: int, dash: float, gap: float) -> list[tuple[str, str]]: ...
def chain(edges: Ints, key: Ints, points: Floats | None = None, turn: float = 0.0) -> tuple[Ints, Ints, Bools]: ...
def linework(
    flat_points: Floats,
    space_points: Floats,
    perspective: bool,
    eye: tuple[float, float, float],
    away: tuple[float, float, float],
    edges: Ints,
    piece_edge: Ints,
    piece_t0: Floats,
    piece_t1: Floats,
    piece_state: Bytes,
    chain_offsets: Ints,
    chain_edges: Ints,
    chain_reversed: Bools,
    chain_rank: Bytes,
    chain_noisy: Bools,
    chain_bare: Bools,
    accuracy: float,
    short: float,
    flip: float,
    stub: float,
    width: float,
    under: float,
    flat_tolerance: float,
    space_tolerance: float,
    threads: int = 0,
) -> dict[str, Any]: ...
def silhouettes(
    points: Floats,
    triangles: Ints,
    triangle_face: Ints,
    edges: Ints,
    offsets: Ints,
    incident: Ints,
    smooth: Bools,
    source: Ints,
    corner: Ints,
    uv: Floats,
    face_surface: Ints,
    face_place: Floats,
    face_inward: Bools,
    face_curved: Bools,
    surface_kind: Bytes,
    surface_offsets: Ints,
    surface_data: Floats,
    perspective: bool,
    eye: tuple[float, float, float],
    away: tuple[float, float, float],
    chord: float,
    threads: int = 0,
) -> dict[str, Any]: ...

Lens = tuple[
    tuple[float, float, float],
    tuple[float, float, float],
    tuple[float, float, float],
    tuple[float, float, float],
    float,
    tuple[float, float],
    float,
    tuple[float, float],
    tuple[int, int],
]
"""right, up, ahead, origin, scale, centre, distance (0: parallel), range, size: `src/preview/lens.rs`."""

class BrepModel:
    """Parts, faces and edges of an OpenCASCADE dump of a compound, each underlying face and edge once.

    The parts are the compound's children: all of them, or those with the numbers `chosen`, in that order. Faces are
    numbered in the order in which an explorer meets them; a part's edges as in its TopExp edge map.
    """

    def __new__(cls, dump: bytes, chosen: Sequence[int] | None = None, threads: int = 0) -> BrepModel: ...
    @property
    def n_faces(self) -> int: ...
    @property
    def faces_of_parts(self) -> list[int]: ...
    def planar(self, tolerance: float) -> Bools: ...
    def surface_records(self, numbers: Ints) -> tuple[Bytes, Ints, Floats]: ...
    def edge_curves(self, part: Ints, edge: Ints) -> tuple[Bytes, Floats, Ints, Floats]: ...
    def mesh(
        self, deflection: float, angle: float, progress: Callable[[float], None] | None = None, threads: int = 0
    ) -> BrepMesh: ...

class BrepMesh:
    """The mesh of a model at one chord error (model units) and turning angle (radians)."""

    def faults(self) -> list[tuple[int, str]]: ...
    def turned(self) -> list[tuple[int, int]]: ...
    def replace(
        self, face: int, points: Floats, uv: Floats, triangles: Ints, borders: list[tuple[list[int], list[float]]]
    ) -> bool: ...
    def parts(self, planar: Bools, threads: int = 0) -> BrepParts: ...

class BrepParts:
    """Part meshes one after another: part p owns points[point_start[p]:point_start[p + 1]] and so on.

    triangles, edge_nodes and corner count within the part; edge_offsets through all edges.

    corner (m, 3) of triangles counts nodes of faces, into uv (k, 2); face_shape, face_place (f, 3, 4) and face_reversed
    per face: number of the underlying face, where it stands in the part, whether its surface's normal points inward.
    """

    point_start: Ints
    points: Floats
    triangle_start: Ints
    triangles: Ints
    triangle_face: Ints
    face_start: Ints
    face_planar: Bools
    face_shape: Ints
    face_place: Floats
    face_reversed: Bools
    edge_start: Ints
    edge_offsets: Ints
    edge_nodes: Ints
    edge_index: Ints
    edge_class: Bytes
    node_start: Ints
    corner: Ints
    uv: Floats

class ShadedModel:
    """A triangle mesh with normals and colours, for any number of pictures."""

    def __new__(
        cls,
        points: Floats,
        triangles: Ints,
        corner: Ints,
        normals: npt.NDArray[np.float32],
        paint: Ints,
        colours: npt.NDArray[np.float32],
        cull: Bools,
    ) -> ShadedModel: ...
    def picture(
        self,
        lens: Lens,
        light: tuple[float, float, float],
        ambient: float,
        diffuse: float,
        specular: float,
        background: tuple[float, float, float, float],
        antialias: bool,
        shadow: Lens | None = None,
        occlusion: float = 0.0,
        threads: int = 0,
        out: Bytes | None = None,
    ) -> Bytes: ...
    def maps(self, lens: Lens, threads: int = 0) -> tuple[Floats, Ints]: ...

def stroke_picture(
    picture: Bytes, pieces: Floats, width: float, colour: tuple[int, int, int, int], threads: int = 0
) -> None: ...
def filled_areas(
    model: ShadedModel,
    lens: Lens,
    light: tuple[float, float, float],
    ambient: float,
    diffuse: float,
    label: Ints,
    fine: float,
    threads: int = 0,
) -> dict[str, Any]: ...
def surface_normals(
    points: Floats,
    triangles: Ints,
    triangle_face: Ints,
    corner: Ints,
    uv: Floats,
    face_surface: Ints,
    face_place: Floats,
    surface_kind: Bytes,
    surface_offsets: Ints,
    surface_data: Floats,
    threads: int = 0,
) -> npt.NDArray[np.float32]: ...
def nearest(
    points: Floats, point_key: Ints, segments: Floats, segment_key: Ints, most: float, threads: int
) -> tuple[Floats, Ints]: ...
def blocked(points: Floats, triangles: Ints, origins: Floats, ways: Floats, threads: int) -> Bools: ...
def quadric_row(coefficients: list[int], x0: int, y: int, count: int) -> tuple[npt.NDArray[np.int64], int]: ...

RasterCamera = tuple[tuple[tuple[float, float, float, float], ...], tuple[int, int], tuple[float, float, float], bool]

RasterLimits = tuple[float, bool, float]
"""Seconds, whether of the thread's work alone, and bytes."""

RasterRecord = tuple[int, int, list[float], list[float], list[list[float]] | None]
"""Polygon, edge, [x, dx], [z, dz], [values, their steps]."""

class RasterScene:
    """Polygons for the visible-surface methods. TimeoutError, MemoryError: a limit was too narrow."""

    def __new__(
        cls,
        points: Floats,
        corners: Ints,
        loops: Ints,
        polygons: Ints,
        cull: Bools,
        values: Floats,
        non_zero: bool,
        limits: RasterLimits,
        patches: list[tuple[int, list[list[float]], list[float], list[float]]] = ...,
    ) -> RasterScene: ...
    def render(
        self, camera: RasterCamera, method: tuple[str, str], limits: RasterLimits, shaded: str, traced: bool
    ) -> dict[str, Any]: ...
    def painters_list(self, camera: RasterCamera, method: str, limits: RasterLimits) -> dict[str, Any]: ...
    def scan_row(
        self, camera: RasterCamera, row: int, limits: RasterLimits
    ) -> tuple[list[RasterRecord], list[tuple[int, int, list[int]]]]: ...
    def pairs(self, camera: RasterCamera, limits: RasterLimits) -> Ints: ...
    def tree(self, limits: RasterLimits) -> list[tuple[list[int], int | None, int | None]]: ...
    def moved(self, points: Floats, limits: RasterLimits) -> RasterScene: ...

def take_fault() -> str | None: ...
def provoke_fault(on_worker: bool) -> int: ...
