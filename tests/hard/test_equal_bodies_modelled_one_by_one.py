"""Equal pins, each modelled in its own place, a hundredth of a pen apart: they take as long as one.

Copies of one pin have its parameters to the last bit. Those of pins modelled one by one differ by rounding, and each of
them was tried with all others.
"""

from __future__ import annotations

import cadquery as cq

import hlr
from support.at_size import AT_SIZE


def pins(count, apart):
    model = cq.Assembly()
    for k in range(count):
        at = (k * apart / count, 0.3 * k * apart / count, 0)
        pin = cq.Solid.makeCylinder(5, 20, cq.Vector(*at), cq.Vector(0, 0, 1))
        model.add(pin, name=f"pin{k}")
    return model


def test_they_take_the_work_of_one():
    # Two of them, in one place: parts that may touch others are meshed more finely than one alone.
    one = hlr.draw(pins(2, 0.0), **AT_SIZE)
    many = hlr.draw(pins(20, one.accuracy.used / 16), **AT_SIZE)
    assert many.counters["triangles"] == one.counters["triangles"]
    assert len(many.lines) == len(one.lines)
    assert len(many.parts) == 20
