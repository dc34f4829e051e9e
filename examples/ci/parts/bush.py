"""The bush in the bracket."""

import cadquery as cq

body = cq.Workplane().circle(10).extrude(18).faces("<Z").workplane().circle(14).extrude(3)
result = body.faces(">Z").workplane().hole(14)
