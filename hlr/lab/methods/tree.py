"""The BSP tree as an object: built once, drawn from any viewpoint, updated where a part moves."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.lab.methods.limits import limits
from hlr.lab.methods.polygons import Polygons, polygons_of
from hlr.lab.methods.render import Rendering, rendering
from hlr.lab.methods.viewport import Screen, Window, viewport

Node = tuple[list[int], int | None, int | None]


class BspTree:
    """A BSP tree over the polygons of a scene."""

    def __init__(
        self,
        scene: Any,
        *,
        rule: str = "even-odd",
        cull: bool = False,
        time_limit: float | None = None,
        memory_limit: float | None = None,
    ) -> None:
        """Build the tree. scene, rule, cull as in `polygons_of`; limits of each call as in `render`.

        Raises NotFinishedError.
        """
        self._limits = (time_limit, memory_limit)
        within = limits(*self._limits)
        self.polygons: Polygons = polygons_of(scene, rule, cull)
        self._scene = self.polygons.kernel(within=within)
        with within.over("the BSP tree"):
            self._scene.tree(within.kernel())

    @property
    def nodes(self) -> list[Node]:
        """Per node, the root first: polygons in its plane, number of the node behind it, of the node in front."""
        within = limits(*self._limits)
        with within.over("the BSP tree"):
            return self._scene.tree(within.kernel())

    def drawn(self) -> str:
        """The tree as text: each node's polygons, with its front subtree above it and its back subtree below."""
        lines: list[str] = []
        nodes = self.nodes

        def walk(number: int | None, depth: int) -> None:
            if number is None:
                return
            polygons, behind, front = nodes[number]
            walk(front, depth + 1)
            lines.append("    " * depth + ",".join(map(str, polygons)))
            walk(behind, depth + 1)

        walk(0 if nodes else None, 0)
        return "\n".join(lines)

    def order(self, camera: Camera | Screen, size: tuple[int, int] = (1024, 1024)) -> Ints:
        """(n,) int32: polygons in the order of drawing, far to near; a split polygon occurs once for each piece."""
        port = viewport(camera, self.polygons.points, size)
        within = limits(*self._limits)
        with within.over("the BSP tree"):
            found = self._scene.painters_list(port.kernel(), "bsp", within.kernel())
        return np.asarray(found["ids"], np.int32)

    def render(self, camera: Camera | Screen, size: tuple[int, int], *, window: Window | None = None) -> Rendering:
        """The picture from this viewpoint; the tree stays as it is."""
        port = viewport(camera, self.polygons.points, size, window=window)
        within = limits(*self._limits)
        with within.over("the BSP tree"):
            found = self._scene.render(port.kernel(), ("bsp", ""), within.kernel(), "", False)
        return rendering(found, port, camera, "", False)

    def moved(self, points: Floats) -> BspTree:
        """The tree after some of its points (n, 3) have moved; only polygons at moved points are inserted anew.

        The new tree takes over this tree's nodes. If this one is used again, it is built anew.
        """
        points = np.ascontiguousarray(points, np.float64)
        if points.shape != self.polygons.points.shape or not np.isfinite(points).all():
            raise OptionError(f"the moved points must be {len(self.polygons.points)} finite points, as before")
        other = BspTree.__new__(BspTree)
        other.polygons = replace(self.polygons, points=points)
        other._limits = self._limits
        within = limits(*self._limits)
        with within.over("the BSP tree"):
            other._scene = self._scene.moved(points, within.kernel())
        return other
