"""Models of each kind, and what their drawings are compared by."""

import json

import cadquery as cq
import trimesh

from hlr.drawing.saving import render
from support.models import box, parts

FORMATS = ("json", "svg", "pdf")


def bracket():
    return cq.Workplane().box(40, 30, 6).faces(">Z").workplane().hole(8).edges("|Z").fillet(3)


def clash():
    return cq.Assembly().add(cq.Workplane().box(20, 20, 20)).add(cq.Workplane().cylinder(40, 6))


MODELS = {
    "bracket": bracket,
    "clash": clash,
    "ball": lambda: cq.Workplane().sphere(9).translate((5, 6, 7)),
    "mesh": lambda: parts(trimesh.creation.icosphere(3, 10), box((30, 4, 4), (1, 2, 3))),
}
VIEWS = ("front", "iso", (2.0, 1.0, -3.0))


def bare(drawing, kind):
    """The drawing as bytes, without the times that differ from run to run."""
    if kind != "json":
        return render(drawing, kind)
    document = json.loads(render(drawing, kind))
    del document["timings"]
    return json.dumps(document).encode()
