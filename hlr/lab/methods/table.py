"""The methods by name, and the variants of each."""

from __future__ import annotations

from hlr.errors import OptionError

METHODS: dict[str, tuple[str, ...]] = {
    "z-buffer": ("smaller", "larger"),
    "scan-line z-buffer": ("merged", "per polygon"),
    "scan line": ("both ends", "naive", "leaving", "visible"),
    "span list": (),
    "warnock": (),
    "depth sort": (),
    "bsp": (),
    "ray casting": ("hierarchy", "flat", "grid", "partition"),
}
"""Method -> its variants, the first of which is the default.

z-buffer            smaller depths are nearer, or larger ones; initial value and comparison go together
scan-line z-buffer  one merged edge list, or one per polygon: the same effort
scan line           which depths are compared: at both ends of each span (right for polygons that pass through one
                    another); or, for those that do not, all in each span, none where an obscured one is left, only the
                    visible one
ray casting         what spares tests: a hierarchy of boxes, one box per polygon, a grid, an equal-count partition
"""


def checked(method: str, variant: str | None) -> tuple[str, str]:
    """Method and variant; raises OptionError where there is none of that name."""
    if method not in METHODS:
        raise OptionError(f"no visible-surface method is called {method!r}: use {', '.join(METHODS)}")
    if variant is None:
        return method, ""
    if variant not in METHODS[method]:
        known = ", ".join(METHODS[method]) or "it has none"
        raise OptionError(f"{method} has no variant {variant!r}: {known}")
    return method, variant
