"""The base plate: four holes, in two sizes."""

import cadquery as cq

size = 80

result = (
    cq.Workplane().box(size, size, 8).edges("|Z").fillet(6)
    .faces(">Z").workplane().rect(size - 20, size - 20, forConstruction=True).vertices().cboreHole(6.6, 11, 4)
)  # fmt: skip
