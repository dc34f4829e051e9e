"""Options of drawings whose lines are compared with lengths of the model: the kind of view decides nothing."""

ALL_LINES = {"hidden": True, "smooth": False, "details": True}
"""Hidden lines and no tangent edges, whatever the view, and those that no pen can show."""

AT_SIZE = {"scale": 1.0, **ALL_LINES}
"""The same at 1:1: millimetres on paper are millimetres of the model."""
