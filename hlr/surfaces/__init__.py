"""The classic visible-surface methods side by side: one scene, one camera, the same picture, different costs.

>>> from hlr.surfaces import SCREEN, render
>>> near, far = [(0, 0, 1), (4, 0, 1), (4, 4, 1)], [(0, 0, 2), (4, 0, 2), (4, 4, 2), (0, 4, 2)]
>>> ids, depth, statistics = render([near, far], SCREEN, (4, 4), method="z-buffer")
"""

from __future__ import annotations

from hlr.surfaces.areas import Area, areas_table
from hlr.surfaces.memory import frame_memory, method_memory, peak_memory
from hlr.surfaces.methods import METHODS
from hlr.surfaces.painters import PaintersList, painters_list
from hlr.surfaces.patch import Patch
from hlr.surfaces.polygons import Polygons
from hlr.surfaces.quadric import quadric_depths
from hlr.surfaces.ray import Hit, ray_hits
from hlr.surfaces.render import NotFinishedError, Rendering, Statistics, render
from hlr.surfaces.rows import EdgeRecord, active_edges, crossing_pairs, edge_records, spans
from hlr.surfaces.trace import trace_svg
from hlr.surfaces.tree import BspTree
from hlr.surfaces.viewport import SCREEN, Screen

__all__ = [
    "METHODS",
    "SCREEN",
    "Area",
    "BspTree",
    "EdgeRecord",
    "Hit",
    "NotFinishedError",
    "PaintersList",
    "Patch",
    "Polygons",
    "Rendering",
    "Screen",
    "Statistics",
    "active_edges",
    "areas_table",
    "crossing_pairs",
    "edge_records",
    "frame_memory",
    "method_memory",
    "painters_list",
    "peak_memory",
    "quadric_depths",
    "ray_hits",
    "render",
    "spans",
    "trace_svg",
]
