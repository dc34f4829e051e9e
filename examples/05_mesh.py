"""A triangle mesh, seen from an eye given in millimetres; edges are drawn where the mesh folds."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "mengerSponge3.glb"

camera = hlr.Perspective(eye=(-900, -1500, 1000), target=(0, 0, -60), fov=50)
drawing = hlr.draw(model, fit=(180, 180), hidden=False, perspective=camera)
drawing.save(here / "mesh.svg")
