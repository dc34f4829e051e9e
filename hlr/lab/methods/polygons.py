"""Polygons as the methods take them: from a scene, or from plain lists of points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.common.values import ByValue
from hlr.errors import OptionError
from hlr.lab.methods.limits import Limits, limits
from hlr.lab.methods.patch import Patch
from hlr.scene.scene import Scene

RULES = ("even-odd", "non-zero")


@dataclass(frozen=True, slots=True, eq=False)
class Polygons(ByValue):
    """Polygons, which may have holes, be concave or cross themselves; the id of a polygon is its number.

    points    (n, 3) coordinates
    corners   (c,) int32 into points
    loops     (l + 1,) int32 into corners: where each loop begins
    polygons  (p + 1,) int32 into loops: where each polygon begins
    cull      (p,) bool: leave the polygon out where it faces away; for faces of closed solids with normals outward
    rule      what is inside: "even-odd" or "non-zero"
    patches   (number, Patch), ascending: polygons that are outlines of curved patches
    """

    points: Floats
    corners: Ints
    loops: Ints
    polygons: Ints
    cull: npt.NDArray[np.bool_]
    rule: str = "even-odd"
    patches: tuple[tuple[int, Patch], ...] = ()

    def __len__(self) -> int:
        return len(self.polygons) - 1

    def chosen(self, which: npt.NDArray[np.int64]) -> Polygons:
        """Only these polygons, in this order, renumbered; points stay as they are."""
        curved = dict(self.patches)
        loops = np.concatenate(
            [np.zeros(0, np.int64), *[np.arange(self.polygons[p], self.polygons[p + 1]) for p in which]]
        )
        lengths = self.loops[loops + 1] - self.loops[loops]
        runs = [self.corners[self.loops[k] : self.loops[k + 1]] for k in loops]
        return Polygons(
            self.points,
            np.concatenate([np.zeros(0, np.int32), *runs]),
            np.append(0, np.cumsum(lengths)).astype(np.int32),
            np.append(0, np.cumsum(self.polygons[which + 1] - self.polygons[which])).astype(np.int32),
            self.cull[which],
            self.rule,
            tuple((k, curved[p]) for k, p in enumerate(which.tolist()) if p in curved),
        )

    def kernel(
        self, values: Floats | None = None, within: Limits | None = None, curved: bool = False
    ) -> _kernel.RasterScene:
        """The kernel's scene; values (n, 3), one row per point, are interpolated over the polygons.

        curved: whether patches can be drawn. Raises OptionError if they cannot and there are some, and for arrays that
        do not fit together or hold NaN or infinity; NotFinishedError.
        """
        if self.patches and not curved:
            raise OptionError(f"polygon {self.patches[0][0]} is a curved patch: only render draws those")
        within = within or limits()
        none = np.zeros((0, 3))
        try:
            with within.over("the scene"):
                return _kernel.RasterScene(
                    np.ascontiguousarray(self.points, np.float64),
                    np.ascontiguousarray(self.corners, np.int32),
                    np.ascontiguousarray(self.loops, np.int32),
                    np.ascontiguousarray(self.polygons, np.int32),
                    np.ascontiguousarray(self.cull, np.bool_),
                    none if values is None else np.ascontiguousarray(values, np.float64),
                    self.rule == "non-zero",
                    within.kernel(),
                    [patch.kernel(number) for number, patch in self.patches],
                )
        except (ValueError, TypeError) as error:
            raise OptionError(f"the polygons are not well formed: {error}") from None


def polygons_of(scene: Any, rule: str = "even-odd", cull: bool = False) -> Polygons:
    """Convert a Scene (its triangles), Polygons, or a sequence of polygons to Polygons.

    An item of the sequence is a loop of points (n, 3), a list of such loops, or a Patch. cull: leave out polygons that
    face away; of a Scene only in parts that are closed and have their normals outward.

    Raises OptionError for anything else.
    """
    if rule not in RULES:
        raise OptionError(f"no inside rule is called {rule!r}: use {' or '.join(RULES)}")
    if isinstance(scene, Polygons):
        return scene
    if isinstance(scene, Scene):
        n = len(scene.triangles)
        culled = scene.groups.cull[scene.triangle_group] if cull else np.zeros(n, np.bool_)
        offsets = np.arange(n + 1, dtype=np.int32)
        return Polygons(scene.points, scene.triangles.ravel(), 3 * offsets, offsets, culled, rule)
    return _plain(scene, rule, cull)


def _plain(given: Sequence[Any], rule: str, cull: bool) -> Polygons:
    points: list[Floats] = []
    loops, polygons = [0], [0]
    try:
        listed = list(given)
    except TypeError:
        raise OptionError(
            f"{type(given).__name__} is no scene: give a Scene, Polygons, or a list of polygons"
        ) from None
    patches = [(number, given) for number, given in enumerate(listed) if isinstance(given, Patch)]
    for number, polygon in enumerate(listed):
        for loop in _outline(polygon) if isinstance(polygon, Patch) else _loops(polygon, number):
            points.append(loop)
            loops.append(loops[-1] + len(loop))
        polygons.append(len(loops) - 1)
    flat = np.concatenate([np.zeros((0, 3)), *points])
    corners = np.arange(len(flat), dtype=np.int32)
    n = len(polygons) - 1
    return Polygons(
        flat,
        corners,
        np.array(loops, np.int32),
        np.array(polygons, np.int32),
        np.full(n, cull, np.bool_),
        rule,
        tuple(patches),
    )


def _outline(patch: Patch) -> list[Floats]:
    """Loops of a patch's outline as points (n, 3); their depth is constant and is not used."""
    level = patch.range()[0]
    return [np.array([(x, y, level) for x, y in loop]) for loop in patch.loops()]


def _loops(polygon: Any, number: int) -> list[Floats]:
    wrong = OptionError(f"polygon {number} needs loops of at least three finite points x, y, z")
    try:
        try:
            loops = [np.asarray(polygon, np.float64)]
            if loops[0].ndim == 3:
                loops = list(loops[0])
        except ValueError:  # loops of different lengths
            loops = [np.asarray(loop, np.float64) for loop in polygon]
    except (TypeError, ValueError):
        raise wrong from None
    if not loops or any(loop.ndim != 2 or loop.shape[1] != 3 or len(loop) < 3 for loop in loops):
        raise wrong
    if not all(np.isfinite(loop).all() for loop in loops):
        raise wrong
    return loops


def checked_values(values: Any, polygons: Polygons) -> Floats | None:
    """Colours or normals (points, 3), or None; raises OptionError for another shape."""
    wrong = OptionError(f"values need three finite numbers for each of the {len(polygons.points)} points")
    try:
        given = None if values is None else np.asarray(values, np.float64)
    except (TypeError, ValueError):
        raise wrong from None
    if given is not None and (given.shape != polygons.points.shape or not np.isfinite(given).all()):
        raise wrong
    return given
