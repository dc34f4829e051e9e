"""The bracket that carries the shaft."""

import cadquery as cq

result = (
    cq.Workplane("XZ").polyline([(0, 0), (50, 0), (50, 8), (8, 8), (8, 60), (0, 60)]).close().extrude(40)
    .faces("<X").workplane(centerOption="CenterOfBoundBox").center(0, 12).hole(20)
    .edges("|Y and (>X or >Z)").fillet(3)
)  # fmt: skip
