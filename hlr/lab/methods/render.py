"""`render`: the visible polygon and its depth at every pixel, by one of the methods, and what it cost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.common.values import ByValue
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.lab.methods.areas import Area, areas_of
from hlr.lab.methods.limits import NotFinishedError, limits
from hlr.lab.methods.patch import checked_patches
from hlr.lab.methods.polygons import Polygons, checked_values, polygons_of
from hlr.lab.methods.table import checked
from hlr.lab.methods.viewport import Screen, Viewport, Window, checked_size, viewport
from hlr.scene.scene import Scene

__all__ = ["SHADING", "NotFinishedError", "Rendering", "Statistics", "render", "rendering"]

SHADING = ("textbook", "correct")


@dataclass(frozen=True, slots=True)
class Statistics:
    """What a method did, counted in the same way for all methods.

    polygons: how many were given; culled, clipped, triangulated, edge_on: how many of them; facets: planar pieces drawn
    comparisons of depths; exact: how many of them were decided in integers
    spans: runs of pixels examined; written: pixels, some more than once; settled: near ties in a painter's order
    splits of polygons or spans; recursion: areas or nodes visited; deepest: the depth of the recursion
    early_stops: areas whose sorted list was not read to its end; passed_over: polygons not read because of that
    rays, box_tests, polygon_tests; swaps of neighbours in a sorted list of edges, spans or polygons
    edge_starts, edge_ends: events of the active edge list, over all rows; span_starts, span_ends: events of the active
              span list, over all columns; the third kind of event, a crossing, is counted as a swap
    memory: peak bytes of the method's own tables and buffers, its frame included
    prepared: seconds for projecting, clipping and rounding; seconds: for all else; setup: the share of `seconds` for
              sorting and trees. The three are the thread's processor time on Linux, clock time elsewhere; comparing
              statistics ignores them
    """

    polygons: int
    culled: int
    clipped: int
    triangulated: int
    edge_on: int
    facets: int
    comparisons: int
    exact: int
    spans: int
    written: int
    splits: int
    recursion: int
    deepest: int
    early_stops: int
    passed_over: int
    rays: int
    box_tests: int
    polygon_tests: int
    swaps: int
    edge_starts: int
    edge_ends: int
    span_starts: int
    span_ends: int
    settled: int
    memory: int
    prepared: float = field(compare=False)
    setup: float = field(compare=False)
    seconds: float = field(compare=False)


@dataclass(frozen=True, slots=True, eq=False)
class Rendering(ByValue):
    """A picture; unpacks as ids, depth, statistics.

    ids      (height, width) int32: the nearest polygon at each pixel's centre, -1 where there is none
    depth    (height, width) float64: along the view, growing away from the viewer; inf for the background. In
             perspective it is the projective depth -distance^2 / z, linear on the screen; `ahead` gives z. Where larger
             depths are nearer, all signs are reversed
    values   (height, width, 3) interpolated values, if values were given; NaN for the background
    trace    (w, 4) int32 row, from, to, id: the writes in their order, if a trace was asked for
    areas    the areas of Warnock's subdivision in their order, if a trace was asked for
    """

    ids: Ints
    depth: Floats
    statistics: Statistics
    viewport: Viewport
    values: Floats | None = None
    trace: npt.NDArray[np.int32] | None = None
    areas: tuple[Area, ...] = ()

    def __iter__(self) -> Iterator[Any]:
        return iter((self.ids, self.depth, self.statistics))

    def ahead(self, camera: Camera) -> Floats:
        """(height, width) distances from the eye's plane (perspective), or along the view."""
        if camera.eye is None or camera.distance is None:
            return self.depth
        there = np.isfinite(self.depth)
        ahead = np.full(self.depth.shape, np.inf)
        ahead[there] = camera.distance * camera.distance / np.abs(self.depth[there])
        return ahead


def render(  # noqa: PLR0913 - one for each thing a user may ask
    scene: Scene | Polygons | Any,
    camera: Camera | Screen,
    size: tuple[int, int],
    method: str = "z-buffer",
    *,
    variant: str | None = None,
    rule: str = "even-odd",
    cull: bool = False,
    window: Window | None = None,
    front: float | None = None,
    back: float | None = None,
    space: str = "image",
    values: Any = None,
    shading: str = "correct",
    trace: bool = False,
    time_limit: float | None = None,
    memory_limit: float | None = None,
) -> Rendering:
    """The visible polygon and its depth at every pixel's centre.

    scene    a Scene (its triangles), Polygons, or a list of polygons: (n, 3) points each, or loops of them, or curved
             patches (`Patch`), which need the camera SCREEN, without front and back planes
    camera   a camera of `hlr.view`, or SCREEN for polygons given in pixels
    size     width and height in pixels
    method   one of METHODS, variant one of its variants; all give the same picture
    rule, cull  as in `polygons_of`;  window, front, back, space  as in `viewport`
    values   (points, 3) colours or normals to interpolate; shading "correct" for perspective, or "textbook"
    trace    record all writes in their order
    time_limit, memory_limit  seconds and bytes; None: as in `hlr.lab.methods.limits`; math.inf: none

    Raises OptionError for options that are wrong or do not fit together, NotFinishedError beyond a limit.
    """
    method, variant = checked(method, variant)
    if shading not in SHADING:
        raise OptionError(f"no shading is called {shading!r}: use {' or '.join(SHADING)}")
    within = limits(time_limit, memory_limit)
    polygons = polygons_of(scene, rule, cull)
    given = checked_values(values, polygons)
    checked_patches(polygons.patches, method, variant, checked_size(size))
    if polygons.patches and not (isinstance(camera, Screen) and front is None and back is None):
        raise OptionError("curved patches are given in pixels: use SCREEN, without front and back planes")
    port = viewport(camera, polygons.points, size, window=window, front=front, back=back, space=space)
    with within.over(method):
        found = polygons.kernel(given, within, curved=True).render(
            port.kernel(), (method, variant), within.kernel(), shading if given is not None else "", trace
        )
    return rendering(found, port, camera, variant, trace)


def rendering(
    found: dict[str, Any],
    port: Viewport,
    camera: Camera | Screen,
    variant: str,
    trace: bool,
) -> Rendering:
    """The kernel's answer as a Rendering."""
    larger = variant == "larger" or (isinstance(camera, Screen) and camera.nearer == "larger")
    depth = found["depth"]
    return Rendering(
        ids=found["ids"],
        depth=-depth if larger else depth,
        statistics=Statistics(**found["statistics"]),
        viewport=port,
        values=found.get("values"),
        trace=found["trace"] if trace else None,
        areas=areas_of(found["areas"]),
    )
