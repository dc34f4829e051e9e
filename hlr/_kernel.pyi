"""The Rust kernel. Arrays are C-contiguous, indices int32; every call raises ValueError on an array of wrong shape.

Lengths are in model units unless another unit is named. A group is a set of triangles that the visibility pass treats
as one surface (`Groups`); groups share no points.
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

def edge_table(triangles: Ints, n_points: int) -> tuple[Ints, Ints, Ints]:
    """Edges (e, 2) of triangles (t, 3), lower vertex first, ascending; and the triangles at edge i, ascending:
    incident[offsets[i]:offsets[i + 1]]."""

def clean_mesh(
    points: Floats, triangles: Ints
) -> tuple[Floats, Ints, npt.NDArray[np.uint32] | None, tuple[int, int, int]]:
    """Joins equal points and leaves out impossible triangles.

    Points (n, 3), triangles (m, 3), which of the given triangles these are (None: all), and how many were left out
    because they were not finite, out of range, or degenerate.
    """

def without_needles(
    points: Floats, triangles: Ints, low: float
) -> tuple[npt.NDArray[np.uint32], Ints, npt.NDArray[np.uint32], npt.NDArray[np.uint32]] | None:
    """Removes needles (triangles lower than `low`) from a mesh by edge flips; None if nothing changed.

    The triangles (k,) that changed, ascending; their new corners (k, 3); the old triangle (k,) whose face and colour
    each takes over; and where each corner (k, 3) was before, as three times a triangle plus 0..2.
    """

def needles(
    points: Floats, triangles: Ints, normals: Floats, part: Ints, least: Floats
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Needles: triangles lower than `least` (p,) of their part, or without area; and their longest side (0..2).

    normals (t, 3); part (t,). The triangles ascend.
    """

def stitched(points: Floats, triangles: Ints, reach: float) -> tuple[Ints, Ints, int]:
    """Joins borders of a mesh that run within `reach` of one another.

    Triangles (m, 3) among the given points, the given triangle (m,) of which each is or is a piece of, and how many
    pieces of borders were joined.
    """

def components(triangles: Ints, n_points: int) -> Ints:
    """(t,) the connected component of each triangle, numbered in order of appearance. Shared vertices connect."""

def edge_components(edges: Ints, n_points: int) -> Ints:
    """(e,) the connected component of each edge, numbered in order of appearance. Shared vertices connect."""

def clashes(points: Floats, triangles: Ints, triangle_group: Ints, itself: Bools) -> dict[str, Any]:
    """Every pair of triangles that cross, of different groups, or of one group where `itself` (g,) is set.

    points (n, 3) and edges (m, 2) of the common segments; per segment triangles (m, 2), depth (m,): how far they reach
    beyond each other, and sine (m,) of the angle between them; tests: pairs of triangles that were compared.
    """

def limit_threads(threads: int) -> int:
    """Set how many threads the calls of this thread use; 0: all cores.

    Returns the number that it was before.
    """

def boxes_near(corners: Floats, reach: float) -> Bools:
    """(p,) whether the box around the eight corners (p, 8, 3) of each part, `reach` wider on all sides, comes near that
    of another part; always True where it does, rarely where it does not.
    """

def faces_near(model: BrepModel, parts: Ints, places: Floats, whole: Bools, reach: float) -> tuple[Bools, Ints]:
    """(faces,) which underlying faces come near a face of another part, and (n,) how many faces of each part do.

    They do where their boxes, `reach` wider on all sides, meet. parts (n,): numbers in the model; places (n, 3, 4): the
    matrices that place them; whole (n,): parts of which all faces count as near.
    """

def placed_boxes(boxes: Floats, root: Ints, place: Floats) -> tuple[Floats, Floats]:
    """Corners (p, 8, 3) of the bounding boxes of parts, and the box (2, 3) around all of them.

    boxes (r, 2, 3): lower and upper corners; root (p,): the box of each part; place (p, 4, 4): the matrix that moves
    it. A box whose lower corner lies beyond its upper one is empty: its corners are 0 and do not count.
    """

class Mesh:
    """points (n, 3), triangles (t, 3), edges (e, 2) and, at edge i, triangles incident[offsets[i]:offsets[i + 1]].

    offsets (e + 1,); edges without triangles are lines. The arrays are not copied: they must stay as they are.
    ValueError where they do not fit.
    """

    def __new__(cls, points: Floats, triangles: Ints, edges: Ints, offsets: Ints, incident: Ints) -> Mesh: ...

class Groups:
    """Groups of a scene's triangles, each of which the visibility pass may treat as one surface.

    A group is a closed B-rep part, or a connected piece of anything else.

    closed   (g,): every edge is used as often in one direction as in the other
    cull     (g,): closed, and turned outward: faces turned away need not be looked at
    inward   (g,): closed, and turned inward, as a cavity is
    sound    (g,): does not pass through itself, as far as its source tells
    without_brep (g,): a piece of a mesh without B-rep
    tight    (g,): lines that lie exactly on other groups' triangles
    planar   (g,): only planar faces: exact, except for the rounding of the file
    extent   (g,): its thickness; the smallest side of its box if that is less or it is open; model units
    low, high (g, 3): its box; low is beyond high where it is empty
    """

    closed: Bools
    cull: Bools
    inward: Bools
    sound: Bools
    without_brep: Bools
    tight: Bools
    planar: Bools
    extent: Floats
    low: Floats
    high: Floats
    def __len__(self) -> int: ...
    def with_wires(self, points: Floats, wires: Ints, owner: npt.NDArray[np.int64], tight: bool) -> tuple[Groups, Ints]:
        """These groups, and an open one per distinct owner (m,) of edges without triangles, wires (m, 2) into points.

        tight: the edges lie exactly on triangles of other groups. Returns the groups, and that of each edge (m,).
        """

    def opened(self, which: Bools) -> Groups:
        """These groups after triangles of those in `which` (g,) were taken away: not closed, and not culled."""

    def unsound(self, which: Bools) -> Groups:
        """These groups where those in `which` (g,) pass through themselves: they are neither sound nor culled."""

    def with_crossing(self, pairs: Ints) -> Groups:
        """These groups, of which these pairs (n, 2) have intersection lines."""

    def meeting(self) -> int:
        """How many groups have a box that comes near that of another; no other group may touch one."""

class VisibilityInput:
    """What the visibility pass is told of edges and groups: decided for a view of a scene, or, by `of`, given.

    triangle (t,), edge (e,): the group of each, not copied; curved (e,), kind (e,): of the edges; hidden (e,): edges
    that their own body hides have no role; goes_on: by the class of an edge, whether a curved surface goes on across
    it, and may fold over there; drawn: per line class, whether edges of the source are drawn; contact: depths within
    which surfaces touch, of curved and of planar groups in model units, of meshes as a share of the scene's diagonal;
    rounding: the same for lines that lie on surfaces and for open sheets, model units. ValueError where these do not
    fit.
    """

    def __new__(
        cls,
        groups: Groups,
        triangle: Ints,
        edge: Ints,
        curved: Bools,
        kind: Bytes,
        hidden: Bools | None,
        goes_on: Bools,
        drawn: list[bool],
        camera: Camera,
        contact: tuple[float, float, float],
        rounding: float,
    ) -> VisibilityInput: ...
    @staticmethod
    def of(
        triangle: Ints,
        edge: Ints,
        role: Bytes,
        *,
        cull: Bools,
        sound: Bools,
        delta: Floats,
        cap: Floats,
        tight: Bools,
        drawn: list[bool],
    ) -> VisibilityInput:
        """An input that is decided already: role (e,), and the properties of each group (g,)."""

    role: Bytes
    """(e,) 1 drawn, 2 drawn where it is a contour, 3 both, 0 not drawn."""

    @property
    def delta(self) -> Floats:
        """(g,) contact tolerance in depth units of the view: what is hidden by less counts as touching."""

    @property
    def cap(self) -> Floats:
        """(g,) the most that anything is moved before it is compared with this group: half its thickness."""

    def coming_near(self, lift: float, spare: float) -> int:
        """How many groups come within the contact tolerance of another, or may.

        lift: how far lines may be off their surfaces, model units; spare: the factor of the tolerance that covers all
        rounding. ValueError where the input was given.
        """

    def counts(self) -> VisibilityCounts:
        """Of groups and edges. ValueError where the input was given."""

class VisibilityCounts:
    """Numbers of groups and edges that decide which steps the visibility pass takes.

    faced               groups that have triangles
    culled              groups whose faces are not looked at where they are turned away
    unsound             groups that may pass through themselves
    unsound_not_culled  those of them that are not culled
    edges               edges that have a role
    """

    faced: int
    culled: int
    unsound: int
    unsound_not_culled: int
    edges: int

class Stretches:
    """Edges whose own faces are seen nearly edge-on, divided into stretches where a face turns over.

    edge (s,) ascending: the edge of each stretch; range (s, 2): the stretch's parameters on the edge's image; line
    (s,): the edge that runs along it in its true place; beside (s,): the faces of a closed body show it (1), hide it
    (2), or it is not known (0); dented (s,): the edge's own triangles fold over there, though the faces do not; offsets
    (s + 1,): where each stretch begins in face (k,), its faces, numbered through all parts, and in off (k,), the edges
    that run along it, moved off that face; sheet (f,): the same number for faces that join smoothly. ValueError where
    they do not fit.
    """

    def __new__(
        cls,
        edge: Ints,
        range: Floats,
        line: Ints,
        beside: Bytes,
        dented: Bools,
        offsets: Ints,
        face: Ints,
        off: Ints,
        sheet: Ints,
    ) -> Stretches: ...
    def __len__(self) -> int: ...
    def opened(self, open: Bools) -> Stretches:
        """The same with beside 0 at edges of bodies that are closed no longer, open (e,). ValueError where an edge is
        none of these."""

    def renumbered(self, target: Ints) -> Stretches:
        """The same for edges with new numbers target (e,), -1 for one that is gone or was cut: such an edge, and one
        of whose places is gone, loses its stretches. ValueError where an edge is none of these."""

class Visibility:
    """Visible and hidden pieces of edges, as they are drawn, sorted by edge and parameter.

    edge (s,), t0 (s,), t1 (s,) from the edge's first to its second vertex on the image; state (s,): 0 visible, 1
    hidden, 2 hidden by less than the contact tolerance, 3 the same on the way to hidden; facing (t,): sign of each
    triangle's area on the image; counters of the work; seconds of each step, shared out where steps run side by side.
    Made of arrays: pieces that are known already. ValueError where these do not fit.
    """

    def __new__(cls, edge: Ints, t0: Floats, t1: Floats, state: Bytes, facing: npt.NDArray[np.int8]) -> Visibility: ...

    edge: Ints
    t0: Floats
    t1: Floats
    state: Bytes
    facing: npt.NDArray[np.int8]
    counters: dict[str, int]
    seconds: dict[str, float]

def visibility(
    mesh: Mesh,
    projected: Floats,
    input: VisibilityInput,
    own: tuple[Stretches, Ints] | None = None,
    hidden: Bools | None = None,
    *,
    contact: bool = True,
    crossings: bool = True,
    piercings: bool = True,
    pyramid: bool = False,
    arithmetic: str = "exact",
) -> Visibility:
    """Decides which pieces of the edges are visible; projected (n, 3): x right, y up, z away from the viewer.

    own: edges whose own faces are seen nearly edge-on, and the face of each triangle, numbered through all parts.
    hidden (e,): its own body hides it, so it has one hidden piece, whatever its role. contact: surfaces touch within
    the input's tolerance. crossings, piercings, pyramid: the steps to run, as in `hlr.visibility.plan.Plan`.
    arithmetic: exact, f64 or f32. ValueError where shapes do not fit or a coordinate is not finite, KeyboardInterrupt
    within milliseconds of Ctrl-C.
    """

class Curves:
    """n curves: kind (n,), range (n, 2), and the numbers of record i, values[offsets[i]:offsets[i + 1]].

    As `hlr.source.curve_records` describes them. ValueError where they do not fit.
    """

    def __new__(cls, kind: Bytes, range: Floats, offsets: Ints, values: Floats) -> Curves: ...

def curve_points(curves: Curves, which: Ints, parameters: Floats) -> Floats:
    """(m, 3, 3) point, first and second derivative of the curves `which` (m,) at parameters (m,); NaN for unknown."""

class Surfaces:
    """n surfaces: kind (n,), and the numbers of record i, data[offsets[i]:offsets[i + 1]].

    As `hlr.source.model.SurfaceRecords` has them; ValueError where they do not fit.
    """

    def __new__(cls, kind: Bytes, offsets: Ints, data: Floats) -> Surfaces: ...
    def points(self, which: Ints, uv: Floats) -> Floats:
        """(m, 3, 3) point, du and dv of surfaces `which` (m,) at uv (m, 2); NaN for unknown."""

class TrueSurfaces:
    """Triangles on the surfaces of their faces, which are numbered through all parts.

    triangle_face (t,); corner (t, 3) into uv (k, 2), -1 for none; of each face number (f,) in surfaces, -1 for none,
    place (f, 12): rows of the matrix from the surface's frame into the model, inward (f,): the surface's normal points
    there, curved (f,): may show an outline. Arrays of triangles are not copied. ValueError where they do not fit.
    """

    def __new__(
        cls,
        triangle_face: Ints,
        corner: Ints,
        uv: Floats,
        surfaces: Surfaces,
        number: Ints,
        place: Floats,
        inward: Bools,
        curved: Bools,
    ) -> TrueSurfaces: ...

def chain(edges: Ints, key: Ints, points: Floats | None = None, turn: float = 0.0) -> tuple[Ints, Ints, Bools]:
    """Joins edges (e, 2) of equal key (e,) into chains: where exactly two meet, and where more meet, the one pair that
    turns by less than `turn` degrees, measured at points (n, 3).

    Chain c is edges[offsets[c]:offsets[c + 1]]: offsets, edges, and whether each is walked from second to first vertex.
    """

class IntersectionCurves:
    """The true curves of intersection lines.

    points (n, 3): the points of the lines, moved onto the curves; number (c,): the curve of each line, -1 for none;
    rise (k,): how far each curve rises above the chords between its points, model units; curve_*: records of the
    curves, as in `Curves`.
    """

    points: Floats
    number: Ints
    rise: Floats
    curve_kind: Bytes
    curve_range: Floats
    curve_offsets: Ints
    curve_values: Floats

def intersection_curves(
    points: Floats,
    triangles: Ints,
    on: TrueSurfaces,
    segments: tuple[Floats, Ints, Ints],
    lines: tuple[Ints, Ints, Bools],
    deflection: float,
) -> IntersectionCurves:
    """The curves in which the surfaces of faces pass through one another.

    points (n, 3), triangles (t, 3): the meshes; segments: points, segments (m, 2) between them, and the two triangles
    (m, 2) of each; lines: where each begins in the second, the segments, and whether they are walked backward, as
    `chain` gives them; deflection: chord error of the meshes. ValueError where they do not fit, KeyboardInterrupt
    within milliseconds of Ctrl-C.
    """

class Outlines:
    """Outlines: the curves where true surfaces are seen edge-on; and borders of faces that are seen nearly edge-on.

    source (o,): the source edge that it runs along, -1 for none; curve_*: records of their curves, as in `Curves`.
    """

    source: Ints
    curve_kind: Bytes
    curve_range: Floats
    curve_offsets: Ints
    curve_values: Floats

    def __len__(self) -> int: ...

def traced_faces(mesh: Mesh, face: Ints, kind: Bytes, tangent: Bools, curved: Bools) -> Bools:
    """(f,) the faces on which outlines are sought: curved ones, and those that a curved one joins smoothly.

    face (t,): of each triangle; kind (e,): the class of each edge; tangent: by class, whether two faces join smoothly
    there; curved (f,). ValueError where they do not fit.
    """

def silhouettes(
    mesh: Mesh,
    on: TrueSurfaces,
    kind: Bytes,
    goes_on: Bools,
    crossed: Ints,
    walks: Walks,
    camera: Camera,
    chord: float,
) -> Outlines:
    """The outlines of true surfaces.

    kind (e,): the class of each edge; goes_on: by class, whether the surface goes on smoothly across the edge; crossed
    (m, 2): the last m edges are intersection lines, and these the triangles that cross there; walks: over the mesh's
    edges; chord: how far chords may stay off an outline. ValueError where they do not fit,
    KeyboardInterrupt within milliseconds of Ctrl-C.
    """

class Outlined:
    """An image with its outlines, which are edges without triangles.

    points (n, 3), lift (n, 3): how far points are moved before visibility is decided; edges (e, 2), offsets (e + 1,),
    part, group, kind, curved, hidden and number (e,): the columns of `hlr.image.image.Image` and of its `Silhouettes`.
    """

    points: Floats
    lift: Floats
    edges: Ints
    offsets: Ints
    part: Ints
    group: Ints
    kind: Bytes
    curved: Bools
    hidden: Bools
    number: Ints

    def own(self) -> Stretches:
        """Edges and outlines whose own faces are seen nearly edge-on."""

    def walks(self, kind: int, first: int) -> Walks:
        """The outlines as walks of this class; first: how many edges the image had before."""

def outlined(
    outlines: Outlines,
    mesh: Mesh,
    on: TrueSurfaces,
    columns: tuple[Bytes, Ints, Ints, Bools, Ints],
    first: Ints,
    groups: Groups,
    convex: bool,
    kinds: tuple[Bools, Bools, int, int],
    camera: Camera,
    lengths: tuple[float, float, float],
) -> Outlined:
    """The image with these outlines.

    columns: class, part and group of each edge, and whether a curved surface may show its outline there; group of each
    triangle. first (p,): the first face of each part; convex: all is one convex body. kinds: (256,) by the class of an
    edge, whether it bounds faces, and whether they join smoothly there; the class of outlines, and that of edges inside
    faces. lengths, model units: how far points are moved beyond the triangles that stand out, at most, and off a face
    before a line is compared with it. ValueError where they do not fit.
    """

_Vector = tuple[float, float, float]

class Lens:
    """A view of the model as a picture in pixels, y down.

    right, up, ahead: unit vectors of the picture in the model; origin: the eye, or any point for parallel views; scale:
    pixels per model unit in the image plane; centre: where the origin is in the picture, pixels; distance: from the eye
    to the image plane, model units, 0 for parallel views; range: least and greatest distance ahead, model units; size:
    width and height, pixels. ValueError for a size, scale or range that no picture has.
    """

    def __new__(
        cls,
        *,
        right: _Vector,
        up: _Vector,
        ahead: _Vector,
        origin: _Vector,
        scale: float,
        centre: tuple[float, float],
        distance: float,
        range: tuple[float, float],
        size: tuple[int, int],
    ) -> Lens: ...
    @property
    def ahead(self) -> _Vector: ...
    @property
    def origin(self) -> _Vector: ...
    @property
    def scale(self) -> float: ...
    @property
    def centre(self) -> tuple[float, float]: ...
    @property
    def distance(self) -> float: ...
    @property
    def range(self) -> tuple[float, float]: ...

class Light:
    """The light on a picture.

    toward: unit vector from the model to the light; ambient: what a surface reflects whichever way it faces; diffuse:
    what it reflects in addition when it faces the light; specular: strength of highlights, 0 for none.
    """

    def __new__(cls, *, toward: _Vector, ambient: float, diffuse: float, specular: float = 0.0) -> Light: ...

class Camera:
    """Unit vectors in model coordinates, direction from the object toward the viewer; eye: of a perspective view, and
    the distance of the image plane from it; scale: millimetres on paper per model unit in the image plane."""

    def __new__(
        cls, direction: _Vector, right: _Vector, up: _Vector, eye: tuple[_Vector, float] | None, scale: float
    ) -> Camera: ...
    def reach(self, points: Floats) -> Floats:
        """(2, 2) from where to where points (n, 3) reach in the image, to the right and up, in model units.

        The lower end is beyond the upper one where there are none.
        """

    def image(self, points: Floats) -> Floats:
        """(n, 3) to the right, up, and away from the viewer, in model units, of points (n, 3)."""

class Walks:
    """Walks over mesh edges, sorted by part: edges of the source, creases and borders of meshes, intersection lines,
    outlines.

    offsets (w + 1,), edges (k,): walk i runs along edges[offsets[i]:offsets[i + 1]]; reversed (k,): from the second
    to the first vertex of the edge; kind (w,): EdgeClass; part (w,). Of these -1, the default, stands for none:
    index (w,): the edge in its part's TopExp edge map; other (w,): of an intersection line the second part; face (w,):
    of an outline the face in its part's TopExp face map; curve (w,): of an intersection line its curve in
    `hlr.scene.scene.IntersectionCurves`. straight (w,): two planar faces meet there at an angle, and two planes have a
    straight line in common. shallow (w,): along an intersection line one surface is nowhere deep in the other.
    ValueError where they do not fit.
    """

    def __new__(
        cls,
        offsets: Ints,
        edges: Ints,
        reversed: Bools,
        kind: Bytes,
        part: Ints,
        *,
        index: Ints | None = None,
        other: Ints | None = None,
        face: Ints | None = None,
        straight: Bools | None = None,
        curve: Ints | None = None,
        shallow: Bools | None = None,
    ) -> Walks: ...
    def __len__(self) -> int: ...

    offsets: Ints
    edges: Ints
    reversed: Bools
    kind: Bytes
    part: Ints
    index: Ints
    other: Ints
    face: Ints
    straight: Bools
    curve: Ints
    shallow: Bools

    def merged(self, other: Walks) -> Walks:
        """These walks and those of another, sorted by part; within a part these come first."""

    def moved(self, target: Ints, swapped: Bools) -> Walks:
        """The walks after edges got other numbers.

        target (e,): of each edge, -1 where it is gone; swapped (e,): its first vertex is now its second. A walk that
        lost an edge in between goes on as another. ValueError where they do not fit.
        """

    def bent(self) -> int:
        """How many run along edges of the source that are not known to be straight."""

class Chains:
    """Walks over mesh edges that become lines: those of the source, then contours of the mesh.

    Walks of the classes that are drawn. input: what the visibility pass was told, found: what it found; triangle_part,
    triangle_face (t,); has_faces (parts,). ValueError where they do not fit.
    """

    def __new__(
        cls,
        walks: Walks,
        input: VisibilityInput,
        mesh: Mesh,
        triangle_part: Ints,
        triangle_face: Ints,
        has_faces: Bools,
        found: Visibility,
    ) -> Chains: ...
    @property
    def offsets(self) -> Ints:
        """(c + 1,) into edges and reversed."""

    @property
    def edges(self) -> Ints:
        """(k,) mesh edges."""

    @property
    def reversed(self) -> Bools:
        """(k,) walked from second to first vertex."""

    @property
    def first(self) -> Ints:
        """(c,) the first mesh edge of each chain."""

    @property
    def kind(self) -> Bytes:
        """(c,) EdgeClass."""

    @property
    def part(self) -> Ints:
        """(c,)"""

    @property
    def edge(self) -> Ints:
        """(c,) in the part's TopExp edge map, -1 for none."""

    @property
    def straight(self) -> Bools:
        """(c,) known to be, so that no curve is looked for."""

    @property
    def all_straight(self) -> bool:
        """Whether all chains along edges of the source are."""

class LineTolerances:
    """Tolerances of linework, as in `Tolerances`: millimetres on paper, with four exceptions.

    thin_model, closed (a gap that closes a curve) and contact (a depth within which curves touch) are in model units;
    chord is the share of the accuracy that chords between points along circles may be off.
    """

    def __new__(
        cls,
        *,
        accuracy: float,
        short: float,
        flip: float,
        stub: float,
        width: float,
        under: float,
        thin_paper: float,
        thin_model: float,
        chord: float,
        closed: float,
        contact: float,
    ) -> LineTolerances: ...

class Cut:
    """Lines on paper: pieces joined along chains, coincident lines merged, short figures dropped, vertices thinned out.

    ranks (k,) uint8, by line class: of coincident lines the lower sixteen is drawn, of equal ones the nearer, then the
    lower; hidden: whether hidden lines are drawn; true_points (n, 3): those of the mesh, with the points of
    intersection lines on the true surfaces. ValueError where they do not fit, KeyboardInterrupt within milliseconds of
    Ctrl-C.
    """

    def __new__(
        cls,
        camera: Camera,
        mesh: Mesh,
        found: Visibility,
        chains: Chains,
        ranks: Bytes,
        tolerances: LineTolerances,
        hidden: bool,
        true_points: Floats | None = None,
    ) -> Cut: ...
    def __len__(self) -> int:
        """How many lines will be drawn."""

    @property
    def chain(self) -> Ints:
        """(lines,) the chain of each line; hidden lines that only bound others, and are not drawn, are included."""

    def finished(
        self, along: tuple[Curves, Floats, Ints, Ints, Floats] | None = None
    ) -> tuple[Lines, tuple[float, float]]:
        """The lines on their curves, sorted by part, kind, edge and face, and their lower left corner. Call it once.

        along: curves; places (p, 3, 4); of each chain its curve (c,), -1 for none, its place (c,), and its bulge (c,),
        millimetres on paper. None: no line has a curve.
        """

class Lines:
    """The lines of a drawing.

    kind (n,) uint8: line classes; visible (n,) bool; ties (n, 4) int32: part, edge, face, second part, -1 for
    none; offsets (n + 1,) int32 into points (p, 2), millimetres on paper with y up, and points3 (p, 3), of the model;
    form (n,) uint8: 0 polyline, 1 straight, 2 arc, 3 and 4 Bezier curves of degree 2 and 3; data_offsets (n + 1,) int32
    into data: of an arc centre, two axes and two angles, of curves their points. ValueError where they do not fit.
    """

    def __new__(
        cls,
        kind: Bytes,
        visible: Bools,
        ties: Ints,
        offsets: Ints,
        points: Floats,
        points3: Floats,
        form: Bytes,
        data_offsets: Ints,
        data: Floats,
    ) -> Lines: ...
    def __len__(self) -> int: ...
    def bounds(self) -> tuple[float, float, float, float] | None:
        """x0, y0, x1, y1 around all lines, millimetres; None where there are none."""

    def columns(self) -> dict[str, Any]:
        """What the constructor takes, by name."""

    def kinds(self) -> Bytes:
        """(n,) numbers of line classes."""

    def visible(self) -> Bools:
        """(n,)"""

    def counts(self, classes: int) -> tuple[int, list[int]]:
        """How many lines are visible, and how many there are of each of the first `classes` classes."""

    def circles(self) -> int:
        """How many creases and borders without an edge lie on a curve: those of meshes, on circles."""

    def chosen(self, chosen: Bools) -> Lines:
        """Those lines that are chosen (n,)."""

    def layers(self, order: Sequence[int], places: int, accuracy: float, cubic: bool) -> list[Layer]:
        """Layers of pen strokes, rounded to 10**-places millimetres; hidden ones first, of each the kinds in `order`.

        accuracy: millimetres. cubic: arcs and quadratic curves become cubic. ValueError where a point is not finite.
        """

    def rows(self, places: int, accuracy: float, cubic: bool) -> tuple[dict[str, Any], npt.NDArray[np.int64]]:
        """Rows of all lines, as `hlr.writers.strokes.Rows` has them, and how many each has. ValueError as in layers."""

class Ink:
    """What a pen can show of the lines of a drawing: which lie close together, and which only make a blot."""

    def __new__(cls, lines: Lines, reaches: tuple[float, float, float]) -> Ink:
        """reaches: how far is looked beside hidden lines, beside visible ones, and from hidden to visible ones; mm.

        ValueError for a bad length.
        """

    def spacings(
        self,
    ) -> tuple[
        tuple[Floats, float, float] | None, tuple[Floats, float, float] | None, tuple[Floats, float, float] | None
    ]:
        """How close the hidden lines run, the visible ones, and hidden ones beside visible ones.

        Of each: (k,) the share of ink whose nearest line alongside is less than 1/64, 2/64 ... mm away, of ink of less
        than a millimetre its length; the side of the square around the smallest line, infinite where there are none;
        all ink, millimetres. None where there are more than 2 km.
        """

    def left_out(self, pens: tuple[float, float], accuracy: float, order: Sequence[int]) -> Bytes:
        """(n,) what becomes of each line: 0 drawn, 1 smaller than the pen, 2 between others closer than the pen.

        pens: widths of hidden and visible lines, millimetres; accuracy: ends within it meet, millimetres; order: line
        classes, the least important first. ValueError for a bad length.
        """

class Layer:
    """The pen strokes of one line class and visibility, in grid steps, y up."""

    @property
    def kind(self) -> int:
        """Number of the line class."""

    @property
    def visible(self) -> bool: ...
    @property
    def starts(self) -> npt.NDArray[np.int64]:
        """(s + 1,) where each stroke starts in the rows; each but a whole circle has at least two."""

    @property
    def closed(self) -> Bools:
        """(s,); the last point of a loop of lines is left out."""

    @property
    def ties(self) -> Ints:
        """(s, 3) part, edge and second part of each stroke, -1 for none."""

    def rows(self) -> dict[str, Any]:
        """The rows, as `hlr.writers.strokes.Rows` has them."""

    def svg(self, pattern: tuple[float, float] | None = None, visible: Sequence[Layer] = ()) -> bytes:
        """One element per stroke; those of one part after another are one group.

        pattern: dash and gap in millimetres, fitted to each stroke; visible: layers that dashed lines may go on from.
        ValueError for a pattern that is not positive.
        """

    def pdf(self, pattern: tuple[float, float] | None = None, visible: Sequence[Layer] = ()) -> bytes:
        """One painted path per stroke, for a layer of cubic curves; arguments as in svg."""

    def moved(self, x: int, y: int) -> Layer:
        """The same, moved by grid steps."""

    def mirrored(self) -> Layer:
        """The same with y turned around."""

class BrepFile:
    """The shape of a BREP file. Its pieces are its solids, and what lies outside solids together.

    Raises ValueError where the file is broken, and NotImplementedError where the kernel does not take what it has.
    """

    def __new__(cls, data: bytes) -> BrepFile: ...
    @property
    def root(self) -> tuple[int, int]:
        """Number and orientation of the root shape."""

    @property
    def place(self) -> list[float]:
        """Placement of the root shape: twelve numbers, row by row."""

    @property
    def pieces(self) -> list[tuple[bool, tuple[int, int] | None, list[float]]]:
        """Without the placement of the root: whether it is a solid; number and orientation of the shape, None where
        several shapes are one piece; its placement."""

    def faces(self, piece: int | None = None) -> list[int]:
        """Numbers of the underlying faces of a piece, of the root where it is None, as an explorer meets them."""

def dump_of_pieces(files: Sequence[BrepFile], roots: Sequence[tuple[int, int]]) -> bytes:
    """OpenCASCADE's dump of a compound of pieces: for each its file, given once, and its number there."""

def square_placement(rows: Sequence[float]) -> list[float]:
    """A placement (twelve numbers, row by row) whose turn was rounded, with a turn that is none."""

class BrepModel:
    """Parts, faces and edges of an OpenCASCADE dump of a compound, each underlying face and edge once.

    The parts are the compound's children: all of them, or those with the numbers `chosen`, in that order. Faces are
    numbered in the order in which an explorer meets them; a part's edges as in its TopExp edge map.
    """

    def __new__(cls, dump: bytes, chosen: Sequence[int] | None = None) -> BrepModel: ...
    @staticmethod
    def divided(stream: bytes, alone: bool = False) -> tuple[BrepModel, tuple[list[list[tuple[int, bool]]], Floats]]:
        """The model of the distinct pieces of shapes in memory: of their solids, and of what lies outside solids.

        stream: OpenCASCADE's stream of a compound of the shapes, or of one shape `alone`. For each shape its pieces:
        number in the model, and whether a solid; then (n, 4, 4) where all of them stand, one shape after another.
        Raises ValueError where the stream is damaged, or holds triangles.
        """

    @property
    def n_faces(self) -> int: ...
    @property
    def faces_of_parts(self) -> list[int]: ...
    def counts(self) -> Ints:
        """(parts, 3) faces, edges and solids in the index maps of each part."""

    def boxes(self) -> Floats:
        """(parts, 2, 3) lower and upper corner of each part's box; the lower is beyond the upper where it has none."""

    def reach(self, parts: Ints, places: Floats, right: _Vector, up: _Vector) -> Floats:
        """(2, 2) how far placed parts reach along two directions of length 1: lower and upper end along each.

        The lower end is beyond the upper one where there is nothing. parts (n,): their numbers; places (n, 3, 4): the
        matrices that place them. Splines count by the control points of small pieces.
        """

    def planar(self, tolerance: float) -> Bools:
        """(faces,) whether each face departs from a plane by no more than the tolerance."""

    def surface_records(self, numbers: Ints) -> tuple[Bytes, Ints, Floats]:
        """kind, offsets and data of the surfaces of faces, as in `Surfaces`."""

    def spindles(self) -> list[tuple[int, float, float]]:
        """Faces on tori whose tube reaches beyond the axis: number, major and minor radius."""

    def folded(self) -> list[int]:
        """Faces that lie on another face beside a common edge, on one surface."""

    def is_one_sphere(self) -> bool:
        """Whether the model is one part, and that one whole sphere, turned outward; true only where it is certain."""

    def edge_curves(self, part: Ints, edge: Ints) -> tuple[Bytes, Floats, Ints, Floats]:
        """kind, range, offsets and values of edges' curves, as in `Curves`, in the frame of the part.

        edge: numbers in the parts' TopExp edge maps.
        """

    def mesh(
        self,
        deflection: float,
        angle: float,
        progress: Callable[[float], None] | None = None,
        shares: Floats | None = None,
        most_steps: int = ...,
    ) -> BrepMesh:
        """Meshes all faces. deflection: chord error; angle: turning angle, radians; progress: called with the share of
        faces that are done; shares (faces,): of the deflection, how much each face may use, above 0 and at most 1;
        most_steps: limit on the work on one face, half a billion but for tests. Raises MemoryError where there would be
        more than 8 million points."""

class CutParts:
    """What planes have left of parts: what lies beyond them is taken away, and bodies are closed there.

    cuts: for each cut a part of the model, the plane's normal of length 1 in the part's frame, how far the plane lies
    along it, and how close to it counts as on it.
    """

    def __new__(cls, model: BrepModel, cuts: Sequence[tuple[int, Sequence[float], float, float]]) -> CutParts: ...
    @property
    def found(self) -> list[tuple[str | None, bool, list[list[int]]]]:
        """For each cut: why the part cannot be cut here, whether it was cut, and its pieces.

        A piece is given as, for each of its faces, which face of the part it was; -1: the cut has made it.
        """

    def with_parts(self, parts: Sequence[tuple[BrepModel, int]]) -> BrepModel:
        """The model of whole parts, each given as its model and its number there, and of all pieces behind them.

        Raises NotImplementedError where a part cannot be written in its own frame.
        """

class BrepMesh:
    """The mesh of a model at one chord error (model units) and turning angle (radians)."""

    def is_sound(self) -> bool:
        """Whether each face has a mesh with which nothing is wrong: the four methods below name none."""

    def faults(self) -> list[tuple[int, str]]:
        """Faces without a mesh: number and reason."""

    def turned(self) -> list[tuple[int, int]]:
        """Faces with loops that run the wrong way: number, and how many loops."""

    def torn(self) -> list[tuple[int, float]]:
        """Faces whose surface folds over itself or jumps: number, and the chord error there (model units)."""

    def unfinished(self) -> list[tuple[int, float]]:
        """Faces that took too many steps: number, and the chord error of the mesh (model units), inf without a mesh."""

    def off_their_edges(self, most: float) -> list[tuple[int, float]]:
        """Faces whose edges are farther off their surface than `most` (model units): number, and how far."""

    def replace(
        self, face: int, points: Floats, uv: Floats, triangles: Ints, borders: list[tuple[list[int], list[float]]]
    ) -> bool:
        """Gives a face the triangles of another mesher; False if they do not fit the face.

        points (n, 3) in the face's frame; uv (n, 2); triangles (m, 3) counterclockwise in (u, v); borders: for each
        edge in each wire the numbers of its points and their parameters, in the direction of the edge.
        """

    def fill(self, face: int, deflection: float, angle: float) -> bool:
        """Meshes a face whose loops cross or lie upon one another, as far as they enclose it; False if it cannot.

        deflection: chord error, model units; angle: turning per chord, radians; both as for `BrepModel.mesh`.
        """

    def parts(self, planar: Bools) -> PartTables:
        """The meshes of all parts. planar (faces,): as `BrepModel.planar` gives it."""

class PartTables:
    """The meshes of all parts, one after another: part p owns points[point_start[p]:point_start[p + 1]] and so on.

    Triangles (t, 3) and edge_nodes count points (n, 3) of all parts; edge e of all is the polyline
    edge_nodes[edge_offsets[e]:edge_offsets[e + 1]]. Numbers of faces and edges (triangle_face, edge_index) are those of
    their own part. origin (t,): which triangle of its part each is, or is a piece of, as the source hands it over; it
    is given as None where each is that of its own number.

    Per part: brep, it has faces and edges; joined, no two of its points are in one place; transform (p, 3, 4);
    precision, what its coordinates may be off by (model units).

    corner (t, 3) counts uv (k, 2) of all parts, -1 where there is no surface; it may be empty where uv is. Per face:
    face_planar, face_shape (number of the underlying face, -1 for none), face_place (f, 3, 4, where it stands in its
    part), face_reversed (the surface's normal points inward).

    All arrays are read-only: they lie in the kernel.
    """

    def __new__(
        cls,
        *,
        point_start: Ints,
        points: Floats,
        triangle_start: Ints,
        triangles: Ints,
        triangle_face: Ints,
        origin: Ints | None,
        face_start: Ints,
        face_planar: Bools,
        edge_start: Ints,
        edge_offsets: Ints,
        edge_nodes: Ints,
        edge_index: Ints,
        edge_class: Bytes,
        brep: Bools,
        joined: Bools,
        transform: Floats,
        precision: Floats,
        node_start: Ints,
        corner: Ints,
        uv: Floats,
        face_shape: Ints,
        face_place: Floats,
        face_reversed: Bools,
    ) -> PartTables:
        """ValueError: a length or a number is out of range."""

    point_start: Ints
    points: Floats
    triangle_start: Ints
    triangles: Ints
    triangle_face: Ints
    origin: Ints
    face_start: Ints
    face_planar: Bools
    edge_start: Ints
    edge_offsets: Ints
    edge_nodes: Ints
    edge_index: Ints
    edge_class: Bytes
    brep: Bools
    joined: Bools
    transform: Floats
    precision: Floats
    node_start: Ints
    corner: Ints
    uv: Floats
    face_shape: Ints
    face_place: Floats
    face_reversed: Bools
    brep_parts: int
    planar_faces: int
    def __len__(self) -> int: ...
    def triangle_counts(self, part: Ints) -> tuple[int, int]:
        """The fewest triangles that one of these parts (m,) has, and how many all have together; without parts 0.

        ValueError: a number is out of range.
        """

    def placed(self, part: Ints, transform: Floats, precision: Floats) -> PartTables:
        """These parts (m,), any of them any number of times, each moved by its transform (m, 3, 4)."""

    def with_triangles(self, chosen: Bools, edge_nodes: Ints) -> PartTables:
        """These parts with the chosen (t,) triangles alone, and with other points as nodes of the edges.

        ValueError: a length or a number is out of range.
        """

    def repeats(self, near: float) -> tuple[Ints, Ints, Floats]:
        """The parts (m,) that have the mesh of an earlier one with no point farther away than `near`, ascending; that
        one (m,), which repeats no other; and the greatest distance of their points (m,).
        """

    def without_meshes(self, chosen: Bools) -> PartTables:
        """These parts without the triangles and edges of the chosen (p,) ones; their points and faces are kept.

        ValueError: a length is out of range.
        """

    def within(self, largest: float) -> bool:
        """Whether all coordinates are finite and nearer to the origin than this."""

    def triangles_in_one_place(self) -> list[bool]:
        """Whether each part is not joined and may hold two triangles, turned the same way, in one place.

        Yes where it does.
        """

    def facts(self) -> MeshFacts: ...

class MeshFacts:
    """Edges of the mesh of all parts, before any part or edge has a meaning.

    edges (e, 2) lower vertex first, ascending; their triangles incident[offsets[i]:offsets[i + 1]], ascending; balance
    (e,) triangles along minus triangles against the edge; fold (e,) cosine of the fold, NaN where there are not two
    triangles with area; normals (t, 3), zero without area; flat: the triangles without area.
    """

    edges: Ints
    offsets: Ints
    incident: Ints
    balance: Ints
    fold: Floats
    normals: Floats
    flat: npt.NDArray[np.int64]
    def triangles_repeated(self) -> list[bool]:
        """Whether each part has a triangle with the corners of another one."""

    def borders_without_brep(self) -> list[int]:
        """How many borders each part without B-rep has."""

    def edge_kinds(
        self, fold: Floats, edge_part: Ints, without_brep: Bools, sharp: float, near: float
    ) -> tuple[Bytes, npt.NDArray[np.int64]]:
        """(e,) EdgeClass of the edges of parts without B-rep (without_brep (p,)), 255 for others; and which of these
        are nearly creases.

        sharp, near: cosines of folds, below which an edge is a crease, or nearly one.
        """

    def scene(self) -> MeshScene: ...

class MeshScene:
    """All parts as one scene, closed surfaces that were inside out turned: `mesh` and triangles are those after it.

    triangle_part, triangle_group, curved (t,): the face may show an outline; turned (t,): None where none was
    loose (l, 2): edges of the source that no triangle has; their numbers follow those of `mesh`
    edge_part, edge_group, edge_curved (e,) of the edges with triangles; edge_kind (e + l,): EdgeClass, 255 for none
    group_part (g,); welded (g,): a mesh without B-rep with more than two triangles at an edge
    folded: how many groups are not surely one convex body; curved_faces: how many faces may show an outline
    face_*, corner: as in `TrueSurfaces`
    """

    mesh: MeshFacts
    triangles: Ints
    triangle_part: Ints
    triangle_group: Ints
    curved: Bools
    turned: Bools | None
    loose: Ints
    edge_part: Ints
    edge_group: Ints
    edge_kind: Bytes
    edge_curved: Bools
    group_part: Ints
    welded: Bools
    folded: int
    curved_faces: int
    corner: Ints
    face_place: Floats
    face_inward: Bools
    face_curved: Bools
    def reports(self) -> PartReports:
        """What was counted in each part."""

    def walks(self) -> Walks:
        """Along the edges of the source."""

    def groups(self) -> Groups:
        """Properties of its groups."""

    def crossings(
        self, groups: Groups, contact: tuple[float, float, float], deflection: float
    ) -> tuple[Floats, Ints, Ints, Ints, Bools, Bools, int]:
        """As in `hlr.scene.clash.Clashes`. contact: as in `Plan`; deflection: what the parts were meshed with."""

class PartReports:
    """Of each part whether it has a B-rep, its faces, and its counts.

    counts: border edges, edges of more than two triangles, edges between faces of opposite orientation, triangles
    without area, groups that are not closed, groups turned, triangles, edges of the source
    """

    def __len__(self) -> int: ...
    def of(self, part: int) -> tuple[bool, int, list[int]]:
        """Whether a part has a B-rep, its faces, and its counts."""

    def suspects(self) -> list[int]:
        """The numbers of parts of which anything was counted that may be a defect."""

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
        light: Light,
        background: tuple[float, float, float, float],
        antialias: bool,
        shadow: Lens | None = None,
        occlusion: float = 0.0,
        out: Bytes | None = None,
    ) -> Bytes:
        """(h, w, 4) RGBA, straight sRGB.

        background: linear light, premultiplied by opacity; antialias: sixteen samples per pixel instead of one; shadow:
        the view from the light, None for no shadows; occlusion: radius of ambient occlusion in pixels, 0 for none; out:
        a picture of that shape to draw over instead of a new one. ValueError where `out` does not fit,
        KeyboardInterrupt within milliseconds of Ctrl-C.
        """

    def maps(self, lens: Lens) -> tuple[Floats, Ints]:
        """At the centre of each pixel: distance ahead (h, w), model units, infinite for nothing; and the triangle (h,
        w) in front, -1 for none. Transparent triangles count as opaque."""

def stroke_picture(picture: Bytes, pieces: Floats, width: float, colour: tuple[int, int, int, int]) -> None: ...
def filled_areas(model: ShadedModel, lens: Lens, light: Light, label: Ints, fine: float) -> dict[str, Any]:
    """What `ShadedModel.picture` shows, as areas in the order of painting.

    label (t,): triangles of one number belong to one face; fine: least width of a band of equal light, pixels.

    points (n, 2) pixels, y down; loops (l + 1,) into points; areas (a + 1,) into loops; colours (a, 4) sRGB and
    opacity; triangle (a,): one of the face; gradient (a,): -1 for none; lines (g, 4): from x, y to x, y; stops (g + 1,)
    into shares (s,) and shades (s, 4). ValueError where labels are negative or a band is narrower than a pixel.
    """

def surface_normals(mesh: Mesh, on: TrueSurfaces) -> npt.NDArray[np.float32]:
    """(k, 3) unit normals at the places uv, on the outer side; nought where the surface has none."""

def nearest(
    points: Floats, point_key: Ints, segments: Floats, segment_key: Ints, most: float
) -> tuple[Floats, Ints]: ...
def blocked(points: Floats, triangles: Ints, origins: Floats, ways: Floats) -> Bools: ...
def first_hits(points: Floats, triangles: Ints, origins: Floats, ways: Floats) -> tuple[Floats, Ints]:
    """Of rays origin + t * way, t from 0 to 1: the least t (n,) at which each meets a triangle, and that triangle (n,);
    infinite and -1 where it meets none."""

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
