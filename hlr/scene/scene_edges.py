"""The edges of a scene while it is built: those of the meshes, then those without triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr._kernel import Groups, PartTables
from hlr.common.types import Floats, Ints
from hlr.scene.clash import Clashes
from hlr.tables.line_classes import EdgeClass


@dataclass(slots=True)
class SceneEdges:
    """Columns of the edges (e,), and what they refer to.

    points (n, 3); edges (e, 2): points; part, group, kind (e,): an EdgeClass or INTERIOR
    """

    points: Floats
    edges: Ints
    part: Ints
    group: Ints
    kind: npt.NDArray[np.uint8]
    groups: Groups

    def add_free(self, loose: Ints, tables: PartTables) -> None:
        """Free edges of the parts: loose (m, 2). Those of a part are in a group of their own."""
        point_part = np.repeat(np.arange(len(tables), dtype=np.int32), np.diff(tables.point_start))
        part = point_part[loose[:, 0]]
        self._add(loose, part, part.astype(np.int64), tight=False)

    def add_intersections(self, met: Clashes, group_part: Ints) -> None:
        """The segments in which meshes cross, each in the part with the lower number. group_part (g,): of each mesh."""
        first = np.int32(len(self.points))
        self.points = np.concatenate([self.points, met.points])
        pair = met.group[:, 0].astype(np.int64) << 32 | met.group[:, 1]
        self.groups = self.groups.with_crossing(met.group)
        self._add(met.edges + first, group_part[met.group].min(axis=1), pair, tight=True)
        kinds = np.full(len(met.edges), EdgeClass.INTERSECTION, np.uint8)
        self.kind = np.concatenate([self.kind, kinds])

    def _add(self, edges: Ints, part: Ints, owner: npt.NDArray[np.int64], tight: bool) -> None:
        self.groups, group = self.groups.with_wires(self.points, edges, owner, tight)
        self.edges = np.concatenate([self.edges, edges])
        self.part = np.concatenate([self.part, part])
        self.group = np.concatenate([self.group, group])
