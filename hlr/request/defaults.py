"""What holds where nothing is asked for: the values that the functions and the command line both state.

The accuracy is in `hlr.request.accuracy`, beside the tolerances that follow from it.
"""

CREASE = 30.0
"""Degrees: the crease angle of meshes."""

DPI = 200.0
"""Pixels per inch of drawings as PNG, where no size is asked for either."""

PREVIEW_SIZE = (1920, 1080)
"""Of a shaded picture, pixels."""

PREVIEW_BACKGROUND = "white"
PREVIEW_LOOK = "shaded"

COMPARE_TOLERANCE_MM = 0.1
"""How far apart on paper two lines may lie that count as the same."""

STUDY_LIMIT_S = 30.0
"""Processor time for each point."""

STUDY_RUNS = 3
"""How often each program draws at each point."""

METHODS_SIZE = (1024, 1024)
"""Of the pictures that are timed, pixels."""

METHODS_LIMIT_S = 10.0
"""Processor time for each method and scene."""
