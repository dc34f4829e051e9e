"""Seconds of the stages of one run."""

from __future__ import annotations

from time import perf_counter

Clock = dict[str, float]


def lap(clock: Clock, stage: str, started: float) -> float:
    """Add the time since `started` to a stage's; returns now."""
    now = perf_counter()
    clock[stage] = clock.get(stage, 0.0) + now - started
    return now
