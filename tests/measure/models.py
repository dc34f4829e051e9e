"""Small models whose errors are known."""

import cadquery as cq


def pierced():
    """A plate with a hole, a bar on it and a ball behind it: arcs, outlines and visibility changes."""
    plate = cq.Workplane("XY").box(60, 40, 8).faces(">Z").workplane().hole(18)
    ball = cq.Workplane("XY").sphere(11).translate((22, 14, -17))
    bar = cq.Workplane("XY").box(7, 7, 30).translate((-17, -8, 19))
    return cq.Assembly().add(plate, name="plate").add(ball, name="ball").add(bar, name="bar")


def frame():
    """An assembly of a metre: two beams, six pins through them, a ring."""
    beam = cq.Workplane("XY").box(1000, 60, 40)
    pin = cq.Workplane("XY").circle(12).extrude(220)
    ring = cq.Workplane("XY").circle(90).circle(60).extrude(30)
    model = cq.Assembly().add(beam, name="beam").add(beam, name="upper", loc=cq.Location((0, 0, 160)))
    for i in range(6):
        model.add(pin, name=f"pin{i}", loc=cq.Location((-450 + 180 * i, 0, -20)))
    return model.add(ring, name="ring", loc=cq.Location((100, 150, 60)))
