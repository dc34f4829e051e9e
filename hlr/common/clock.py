"""Clock: the seconds that each stage of one run has taken."""

from __future__ import annotations

from time import perf_counter

Clock = dict[str, float]


def lap(clock: Clock, stage: str, started: float) -> float:
    """Add the seconds since `started` to a stage; returns the present time (`perf_counter`)."""
    now = perf_counter()
    clock[stage] = clock.get(stage, 0.0) + now - started
    return now
