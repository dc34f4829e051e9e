"""Options of drawings whose lines are compared with lengths of the model: the kind of view decides nothing."""

ALL_LINES = {"hidden": True, "smooth": False}
"""Hidden lines and no tangent edges, whatever the view."""

AT_SIZE = {"scale": 1.0, "details": True, **ALL_LINES}
"""The same at 1:1, and every detail: millimetres on paper are millimetres of the model."""
