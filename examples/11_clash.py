"""Solids that run into one another: the lines in which they meet are drawn, and know both parts."""

from pathlib import Path

import cadquery as cq

import hlr

here = Path(__file__).parent

plate = cq.Workplane().box(60, 60, 14)
bolt = cq.Workplane().cylinder(70, 11).rotate((0, 0, 0), (1, 0, 0), 20)
bar = cq.Workplane().box(16, 90, 10).rotate((0, 0, 0), (0, 0, 1), 25).translate((14, 0, 6))
shape = cq.Assembly().add(plate, name="plate").add(bolt, name="bolt").add(bar, name="bar")

drawing = hlr.draw(shape)
drawing.save(here / "clash.svg")
