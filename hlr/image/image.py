"""The image: a scene before one camera, with its outlines, at its place on paper."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.image.camera import Camera
from hlr.image.placement import Placement
from hlr.scene.scene import Geometry, Scene
from hlr.source.model import Curves

_geometry = attrgetter(*[each.name for each in fields(Geometry)])
"""What an image takes over from its scene: its first fields, in their order."""


@dataclass(frozen=True, slots=True)
class OwnFaces:
    """Edges whose own faces are seen nearly edge-on, divided into stretches where a face turns over.

    edge (s,) ascending: the edge of each stretch; range (s, 2): the stretch's parameters on the edge's image
    line (s,): the edge of the image that runs along the stretch, in its true place; the edge itself where the stretch
    is all of it, and for outlines, which are moved themselves, where no other body comes near
    beside (s,) uint8: the faces of a closed body show the stretch (1), hide it (2), or it is not known (0)
    dented (s,) bool: the edge's own triangles fold over there, though the faces do not
    offsets (s + 1,): where each stretch begins in face (k,), its faces, numbered through all parts, and in off (k,),
    the edges of the image that run along the stretch, moved off that face
    first (p,): number of each part's first face; sheet (f,): the same number for faces that join smoothly

    The edges of line and off have no triangles and are never drawn, except where line is the edge itself.
    """

    edge: Ints
    range: Floats
    line: Ints
    beside: npt.NDArray[np.uint8]
    dented: npt.NDArray[np.bool_]
    offsets: Ints
    face: Ints
    off: Ints
    first: Ints
    sheet: Ints

    @staticmethod
    def none() -> OwnFaces:
        """No own faces, as in a scene without curved faces."""
        no = np.zeros(0, np.int32)
        few, never = no.astype(np.uint8), no.astype(bool)
        return OwnFaces(no, np.zeros((0, 2)), no, few, never, np.zeros(1, np.int32), no, no, no, no)


@dataclass(frozen=True, slots=True)
class Silhouettes:
    """The outlines of true surfaces: edges of the image that have no triangles.

    lift (n, 3): how far points are moved before visibility is decided: an outline runs within the tolerance of its own
    facets, which must not hide it. hidden (e,) bool: the outline's own body hides it.
    number (e,): the outline to which an edge belongs, -1 for none
    curves: of the o outlines; of kind NONE where an outline is straight, or runs along an edge of the model
    source (o,) int32: the index of that edge of the model, else -1
    own: the faces that edges and outlines bound, where these are seen nearly edge-on
    """

    lift: Floats
    hidden: npt.NDArray[np.bool_]
    own: OwnFaces
    number: Ints
    curves: Curves
    source: Ints


@dataclass(frozen=True, slots=True)
class Image(Geometry):
    """What one camera sees of a scene: the scene's geometry with its outlines, cut off where the camera sees nothing.

    silhouettes: None where no outline was sought
    """

    camera: Camera = field(kw_only=True)
    placement: Placement = field(kw_only=True)
    silhouettes: Silhouettes | None = None

    def placed(self, placement: Placement) -> Image:
        """The same image at another place on paper."""
        return replace(self, placement=placement)

    def projected(self, divide: bool = False) -> Floats:
        """(n, 3) of all points, as `Camera.project` gives them."""
        return self.camera.project(self.points, divide)

    def lifted(self, divide: bool = False) -> Floats:
        """As `projected`, with the points of outlines moved off their own surface: visibility is decided on these."""
        if self.silhouettes is None:
            return self.projected(divide)
        return self.camera.project(self.points + self.silhouettes.lift, divide)


def image_of(scene: Scene, camera: Camera, placement: Placement) -> Image:
    """The scene before a camera, all of it, without its outlines."""
    return Image(*_geometry(scene), camera=camera, placement=placement)
