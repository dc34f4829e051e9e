"""A CadQuery script: a flanged bearing housing. Draw it with `hlr draw examples/part.py`."""

import cadquery as cq

ribs = cq.Workplane("XZ").polyline([(-50, 12), (50, 12), (20, 44), (-20, 44)]).close().extrude(4, both=True)
ribs = ribs.union(ribs.rotate((0, 0, 0), (0, 0, 1), 90))
result = (
    cq.Workplane("XY")
    .box(120, 120, 14, centered=(True, True, False))
    .edges("|Z")
    .fillet(18)
    .union(cq.Workplane("XY").circle(32).extrude(55))
    .union(ribs)
    .copyWorkplane(cq.Workplane("XY", origin=(0, 0, 14)))
    .rect(88, 88, forConstruction=True)
    .vertices()
    .cboreHole(11, 18, 6)
    .faces(">Z")
    .workplane()
    .cboreHole(30, 42, 15)
    .faces(">Z")
    .chamfer(1.5)
)
