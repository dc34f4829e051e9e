"""Points on triangles, to measure distances at."""

import numpy as np


def samples(points, triangles):
    """Points spread over triangles."""
    steps = [(i / 6, j / 6) for i in range(7) for j in range(7 - i)]
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.concatenate([(1 - u - v) * a + u * b + v * c for u, v in steps])
