"""What the dashes of a line say of it being visible."""

from __future__ import annotations

from collections.abc import Iterable

UNKNOWN, HIDDEN, VISIBLE, CENTRE = -1, 0, 1, 2
"""What is known of a line. CENTRE: it is no line of the model, but an axis."""


def by_dashes(lengths: Iterable[float]) -> int:
    """lengths: of the dashes, dots being 0, without the gaps. Of one length: hidden; of several: an axis."""
    several = len({round(length, 3) for length in lengths})
    return (UNKNOWN, HIDDEN)[several] if several < 2 else CENTRE
