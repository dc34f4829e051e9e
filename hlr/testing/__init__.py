"""For tests of your own parts: a drawing is compared by its geometry with one that was looked at and kept.

>>> import hlr
>>> from hlr.testing import assert_same_drawing
>>> drawing = hlr.draw("part.step", view="front", scale=1)
>>> path = drawing.save("golden.svg")
>>> assert_same_drawing("part.step", "golden.svg", view="front", scale=1)
"""

from __future__ import annotations

from hlr.testing.golden import assert_same_drawing

__all__ = ["assert_same_drawing"]
