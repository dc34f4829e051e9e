"""The classic visible-surface methods side by side: one scene, one camera, the same picture, different costs.

Two of them are z-buffers: one of a whole frame, one of a row at a time. They share no code with the z-buffer of the
preview, which is made for speed (tiles, single precision). Here depths are exact, so that all methods agree at every
pixel, and every step is counted. The depth pyramid of the visibility pass is not among the methods: it makes no
picture, and only tells which edges need no test.

>>> from hlr.lab.methods import SCREEN, render
>>> near, far = [(0, 0, 1), (4, 0, 1), (4, 4, 1)], [(0, 0, 2), (4, 0, 2), (4, 4, 2), (0, 4, 2)]
>>> ids, depth, statistics = render([near, far], SCREEN, (4, 4), method="z-buffer")
"""

from __future__ import annotations

from hlr.lab.methods.areas import Area, areas_table
from hlr.lab.methods.memory import frame_memory, method_memory, peak_memory
from hlr.lab.methods.painters import PaintersList, painters_list
from hlr.lab.methods.patch import Patch
from hlr.lab.methods.polygons import Polygons
from hlr.lab.methods.quadric import quadric_depths
from hlr.lab.methods.ray import Hit, ray_hits
from hlr.lab.methods.render import NotFinishedError, Rendering, Statistics, render
from hlr.lab.methods.rows import EdgeRecord, active_edges, crossing_pairs, edge_records, spans
from hlr.lab.methods.table import METHODS
from hlr.lab.methods.trace import trace_svg
from hlr.lab.methods.tree import BspTree
from hlr.lab.methods.viewport import SCREEN, Screen

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
