"""A request is checked before any work is done for it."""

from __future__ import annotations

import math

from hlr.errors import OptionError
from hlr.plan.options import Options


def checked(options: Options) -> Options:
    """The options, all within their ranges; raises OptionError with the range."""
    if not (math.isfinite(options.scale) and options.scale > 0.0):
        raise OptionError(f"scale {options.scale:g} cannot be drawn: give a positive number, such as 0.5 for 1:2")
    if options.fit is not None and not all(math.isfinite(f) and f > 0.0 for f in options.fit):
        raise OptionError("fit needs a positive width and height in millimetres, such as 277x190")
    if options.accuracy is not None and not (math.isfinite(options.accuracy) and options.accuracy > 0.0):
        raise OptionError(f"accuracy {options.accuracy:g} mm cannot be kept: give a positive length, such as 0.05")
    if not 0.0 <= options.crease <= 180.0:
        raise OptionError(f"crease {options.crease:g} is no fold: give 0 to 180 degrees")
    if options.threads < 0:
        raise OptionError(f"{options.threads} threads cannot work: give 0 for all cores, or a number")
    return options
