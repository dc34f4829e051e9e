"""The textbook's comparison of methods: relative cost, depth sort at 100 polygons = 1, estimated decades ago.

Its counts are 100, 250 (perhaps a misprint of 2,500) and 60,000 polygons. It says that a z-buffer costs the same for
every scene. Measurements refute this: every polygon has to be processed, and so has every pixel it covers.
"""

from __future__ import annotations

COUNTS = (100, 250, 60_000)

COST: dict[str, tuple[int, ...]] = {
    "depth sort": (1, 10, 507),
    "z-buffer": (54, 54, 54),
    "scan line": (5, 21, 100),
    "warnock": (11, 64, 307),
}
