"""The painter's list: polygons in the order in which they are drawn over one another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from hlr.common.types import Floats, Ints
from hlr.common.values import ByValue
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.lab.methods.limits import limits
from hlr.lab.methods.polygons import polygons_of
from hlr.lab.methods.viewport import Screen, Window, viewport

PAINTERS = ("depth sort", "bsp")


@dataclass(frozen=True, slots=True, eq=False)
class PaintersList(ByValue):
    """Pieces of polygons, far to near.

    ids (p,) int32: the polygon of each piece; polygons (p + 1,): where each piece begins in loops; loops (l + 1,):
    where each loop begins in points; points (n, 2): pixels, x right, y down; splits: how many polygons were cut
    """

    ids: Ints
    polygons: Ints
    loops: Ints
    points: Floats
    splits: int

    def __iter__(self) -> Iterator[tuple[int, list[Floats]]]:
        """Each piece as its id and loops."""
        for k, polygon in enumerate(self.ids.tolist()):
            runs = range(int(self.polygons[k]), int(self.polygons[k + 1]))
            yield polygon, [self.points[self.loops[r] : self.loops[r + 1]] for r in runs]


def painters_list(  # noqa: PLR0913 - one for each thing a user may ask
    scene: Any,
    camera: Camera | Screen,
    size: tuple[int, int],
    method: str = "depth sort",
    *,
    rule: str = "even-odd",
    cull: bool = False,
    window: Window | None = None,
    space: str = "image",
    time_limit: float | None = None,
    memory_limit: float | None = None,
) -> PaintersList:
    """The polygons of a scene in the order of drawing, split where they overlap in a cycle or pass through one another.

    method is "depth sort" or "bsp"; the other arguments are as in `render`. Raises OptionError, NotFinishedError.
    """
    if method not in PAINTERS:
        raise OptionError(f"{method!r} has no order of drawing: use {' or '.join(PAINTERS)}")
    within = limits(time_limit, memory_limit)
    polygons = polygons_of(scene, rule, cull)
    port = viewport(camera, polygons.points, size, window=window, space=space)
    with within.over(method):
        found = polygons.kernel(within=within).painters_list(port.kernel(), method, within.kernel())
    return PaintersList(
        found["ids"], found["polygons"], found["loops"], found["points"], int(found["statistics"]["splits"])
    )
