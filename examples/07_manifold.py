"""A solid made in Python with manifold3d: a cube with round holes, cut by a sphere."""

from pathlib import Path

from manifold3d import Manifold

import hlr

here = Path(__file__).parent

bar = Manifold.cylinder(height=120, radius_low=24, circular_segments=256, center=True)
holes = bar + bar.rotate((90, 0, 0)) + bar.rotate((0, 90, 0))
ball = Manifold.sphere(56, circular_segments=256)
solid = (Manifold.cube((84, 84, 84), center=True) ^ ball) - holes

drawing = hlr.draw(solid, fit=(120, 120))
drawing.save(here / "manifold.svg")
