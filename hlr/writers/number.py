"""The one number formatter: fixed decimals that follow from the drawing's accuracy.

All writers round to a decimal grid first and then print integers of that grid. So a point has the same digits in
every format, sums of relative coordinates are exact, and a million numbers cost a tenth of a second: the digits are
laid out as a byte matrix (one row per number, one column per character) and the characters that a number does not
need are masked away.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr.errors import WriteError
from hlr.tolerance import DIGITS

Ints = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]

MAX_DECIMALS = 12
# Beyond 2**53 a double no longer has a unit digit: more decimals would be invented.
_MAX_GRID = float(2**53)
NOT_FINITE = "the drawing has a point that is not finite; it cannot be written"
# Rows of the byte matrix made at once: small enough to stay in the cache.
_CHUNK = 1 << 15


def decimals(accuracy: float, extent: float = 0.0, share: float = DIGITS) -> int:
    """Fewest decimals whose rounding moves a plane point by less than `share` of `accuracy`.

    accuracy and extent (largest absolute coordinate) are in the unit of the numbers; at least 0, and never so many
    that `extent` would lose its last digit.
    """
    if not (math.isfinite(accuracy) and accuracy > 0.0):
        raise WriteError(f"the drawing states no usable accuracy ({accuracy!r}); it must be a positive length in mm")
    if not math.isfinite(extent):
        raise WriteError(NOT_FINITE)
    # Half a grid step in x and in y: the point moves by at most step / sqrt(2).
    step = accuracy * share * math.sqrt(2.0)
    wanted = math.ceil(-math.log10(step) + 1e-12)
    room = math.floor(math.log10(_MAX_GRID / max(extent, 1.0)))
    return max(0, min(wanted, room, MAX_DECIMALS))


def grid(values: npt.NDArray[np.float64], places: int) -> Ints:
    """Round to whole grid steps of 10**-places (same shape, int64). Raises WriteError for NaN or infinity."""
    if not np.isfinite(values).all():
        raise WriteError(NOT_FINITE)
    return np.rint(values * 10.0**places).astype(np.int64)


def number(value: float, places: int = 6) -> str:
    """One number, compact: ".5", "-12.25", "0"."""
    steps = np.array([round(value * 10**places)], dtype=np.int64)
    return encode(steps, places)[0].decode("ascii")


def encode(steps: Ints, places: int, before: Bytes | None = None, *, leading: bool = False) -> tuple[bytes, Ints]:
    """Print (n,) grid steps one after another; return the text and the (n + 1,) offsets of the numbers in it.

    before   (n, k) bytes put in front of each number; zeros are left out
    leading  True prints "0.5" where False prints ".5" (JSON asks for it)
    """
    prefix = np.zeros((len(steps), 0), np.uint8) if before is None else before
    largest = int(np.abs(steps).max(initial=0))
    digits = max(len(str(largest)), places + 1)
    texts: list[bytes] = []
    lengths: list[Ints] = [np.zeros(1, np.int64)]
    for start in range(0, len(steps), _CHUNK):
        part = slice(start, start + _CHUNK)
        characters, used = _layout(steps[part], places, digits, prefix[part], leading)
        texts.append(characters[used].tobytes())
        lengths.append(used.sum(axis=1))
    return b"".join(texts), np.cumsum(np.concatenate(lengths))


def _layout(steps: Ints, places: int, digits: int, prefix: Bytes, leading: bool) -> tuple[Bytes, npt.NDArray[np.bool_]]:
    """Characters (n, w) of prefix, sign, whole digits, point, decimals; and which of them are printed."""
    k = prefix.shape[1]
    width = k + 1 + digits + 1
    characters = np.empty((len(steps), width), np.uint8)
    used = np.empty((len(steps), width), np.bool_)
    characters[:, :k] = prefix
    used[:, :k] = prefix != 0
    characters[:, k] = ord("-")
    used[:, k] = steps < 0
    dot = width - 1 - places
    characters[:, dot] = ord(".")
    rest = np.abs(steps)
    small = digits <= 9
    if small:  # 32-bit division is twice as fast
        rest = rest.astype(np.int32)
    # From the last digit to the first. Once a decimal is not zero, all before it are printed.
    tail = np.zeros(len(steps), np.bool_)
    for power in range(digits):
        column = width - 1 - power - (1 if power >= places else 0)
        if power == places:
            used[:, dot] = tail
        if power >= places:
            # Whole part: digits from the first that is not zero; a lone zero only where nothing else is printed.
            used[:, column] = rest != 0
            if power == places:
                used[:, column] |= True if leading else ~tail
        quotient = rest // 10
        digit = rest - quotient * 10
        characters[:, column] = digit + ord("0")
        if power < places:
            tail |= digit != 0
            used[:, column] = tail
        rest = quotient
    return characters, used
