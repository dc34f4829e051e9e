"""A build123d part with its hidden lines: a forked link."""

from pathlib import Path

from build123d import Align, Axis, Box, Cylinder, Pos, Rot, fillet

import hlr

here = Path(__file__).parent
low = (Align.CENTER, Align.CENTER, Align.MIN)

eye = Cylinder(26, 40, align=low)
arm = Pos(50, 0, 8) * Box(100, 24, 24, align=low)
fork = Pos(115, 0, 20) * (Rot(90, 0, 0) * Cylinder(20, 60) + Pos(-16, 0, 0) * Box(32, 60, 40))
link = fillet((eye + arm).edges().filter_by(Axis.Z), 10) + fork
link -= Cylinder(15, 40, align=low)
link -= Pos(115, 0, 20) * (Rot(90, 0, 0) * Cylinder(10, 60) + Pos(10, 0, 0) * Box(60, 28, 60))

drawing = hlr.draw(link, view=(1, -1.8, 1.1), fit=(170, 130), hidden=True)
drawing.save(here / "build123d.svg")
