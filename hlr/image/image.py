"""The image: a scene before one camera, with its outlines, at its place on paper."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.camera import Camera
from hlr.image.placement import Placement
from hlr.scene.scene import Geometry, Scene
from hlr.source.model import Curves

_geometry = attrgetter(*[each.name for each in fields(Geometry)])
"""What an image takes over from its scene: its first fields, in their order."""


@dataclass(frozen=True, slots=True)
class Silhouettes:
    """The outlines of true surfaces: edges of the image that have no triangles.

    lift (n, 3): how far points are moved before visibility is decided: an outline runs within the tolerance of its own
    facets, which must not hide it. hidden (e,) bool: the outline's own body hides it.
    number (e,): the outline to which an edge belongs, -1 for none
    curves: of the o outlines; of kind NONE where an outline is straight, or runs along an edge of the model
    source (o,) int32: the index of that edge of the model, else -1
    own: the faces that edges and outlines bound, where these are seen nearly edge-on
    first (p,): number of each part's first face, as in `own`
    """

    lift: Floats
    hidden: npt.NDArray[np.bool_]
    own: _kernel.Stretches
    first: Ints
    number: Ints
    curves: Curves
    source: Ints

    def opened(self, edges: npt.NDArray[np.bool_]) -> Silhouettes:
        """The same where these edges (e,) bool are those of bodies that are closed no longer: one looks into them."""
        return replace(self, hidden=self.hidden & ~edges, own=self.own.opened(edges))


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
