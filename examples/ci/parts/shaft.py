"""The shaft: turned, with a keyway."""

import cadquery as cq

result = (
    cq.Workplane("XZ").polyline([(0, 0), (10, 0), (10, 30), (14, 30), (14, 40), (10, 40), (10, 90), (0, 90)]).close()
    .revolve(360, (0, 0), (0, 1)).faces(">Z").chamfer(1)
    .cut(cq.Workplane(origin=(0, -8.5, 70)).box(5, 4, 25))
)  # fmt: skip
