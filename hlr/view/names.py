"""Named views: the direction from the object toward the viewer and what points up on paper (z-up world).

Front looks along +y with x to the right, as in FreeCAD and ISO 5456-2; the isometrics are named by the compass corner
the viewer stands at, as in AutoCAD.
"""

from __future__ import annotations

from hlr.plan.options import Vector, ViewName

NAMED: dict[ViewName, tuple[Vector, Vector]] = {
    "front": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "back": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "left": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "right": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "bottom": ((0.0, 0.0, -1.0), (0.0, -1.0, 0.0)),
    "iso": ((1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-se": ((1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-sw": ((-1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-ne": ((1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-nw": ((-1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
}

EYE = "eye"
"""What a view is called whose eye was given: it looks from there, whatever other view was named."""
