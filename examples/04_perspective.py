"""A flanged hub in perspective, with the field of view in degrees; the eye goes where the whole model fits."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "nist_ctc_05_asme1_ap242-e1.stp"

camera = hlr.Perspective(fov=50)
drawing = hlr.draw(model, view=(-0.5, -1, 0.6), fit=(180, 200), hidden=False, smooth=True, perspective=camera)
drawing.save(here / "perspective.svg")
