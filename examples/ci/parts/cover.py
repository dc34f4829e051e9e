"""The cover: a shell with a window."""

import cadquery as cq

result = (
    cq.Workplane().box(70, 50, 25).edges("|Z").fillet(8).faces("<Z").shell(-2.5)
    .faces(">Z").workplane().slot2D(40, 12).cutThruAll()
)  # fmt: skip
