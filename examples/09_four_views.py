"""Four views of one part on one page: the model is read and meshed once."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "nist_ctc_01_asme1_ap242-e1.stp"

drawing = hlr.draw_arranged(model, "third-angle", options=hlr.Options(page="A3"))
drawing.save(here / "four_views.svg")
