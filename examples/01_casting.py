"""A casting: tangent edges as thin lines, hidden lines left out."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "nist_ftc_06_asme1_ap242-e2.stp"

drawing = hlr.draw(model, view="iso-ne", fit=(160, 180), hidden=False, smooth=True)
drawing.save(here / "casting.svg")
