"""Filled drawings: visible faces in their parts' colours, flat-shaded, under the lines."""

from pathlib import Path

import hlr

here = Path(__file__).parent
models = here / "models"

drawing = hlr.draw(models / "as1-oc-214.stp", hidden=False, fill=True)
drawing.save(here / "filled.svg")

casting = hlr.draw(models / "nist_ctc_01_asme1_ap242-e1.stp", hidden=False, fill=True, scale=0.25)
casting.save(here / "filled_casting.svg")
