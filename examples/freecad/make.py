"""Draw the page of spring.FCStd, and compare it with FreeCAD's own export of it, spring_freecad.svg."""

from pathlib import Path

import hlr

here = Path(__file__).parent
(page,) = hlr.draw_pages(here / "spring.FCStd")
page.save(here / "spring_hlr.svg")
found = hlr.compare.compare(here / "spring_freecad.svg", here / "spring.FCStd", page="Page")
found.save(here / "difference.svg")
print(found.summary)
