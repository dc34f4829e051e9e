"""What differs between two drawings, by their geometry: registered, matched by covered length, judged line by line.

>>> import hlr
>>> before, after = (hlr.draw("part.step", view="top", hidden=shown) for shown in (True, False))
>>> found = hlr.compare.compare(before, after)
>>> found.same, {each.kind for each in found.differences}
(True, set())
"""

from __future__ import annotations

from hlr.compare.compare import compare
from hlr.compare.comparison import Comparison
from hlr.compare.difference import Difference

__all__ = ["Comparison", "Difference", "compare"]
