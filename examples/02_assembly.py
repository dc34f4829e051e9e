"""An assembly of 18 parts with its hidden lines. Names and colours of the parts go into the file."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "as1-oc-214.stp"

drawing = hlr.draw(model, hidden=True)
drawing.save(here / "assembly.svg")
