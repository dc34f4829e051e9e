"""The sentence a user needs: which accuracy to choose, and what it costs."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.study.job import HLR, Point
from hlr.tolerance import DEFAULT_ACCURACY

CHEAP = 1.5
"""Times the cost of the coarsest drawing: up to there accuracy is as good as free."""


def advice(points: Sequence[Point]) -> str:
    """In words, from our own points; empty where there are fewer than two."""
    ours = sorted((p for p in points if p.who == HLR and p.failure is None), key=lambda p: -p.setting)
    if len(ours) < 2:
        return ""
    base = ours[0].processor or 1e-9
    free = [p for p in ours if p.processor <= CHEAP * base]
    finest = ours[-1]
    usual = min(ours, key=lambda p: abs(p.setting - DEFAULT_ACCURACY))
    said = [
        f"{usual.setting:g} mm costs {_seconds(usual.processor)} of processor time here, "
        f"{_times(usual.processor / base)} the coarsest drawing ({ours[0].setting:g} mm)"
    ]
    if free[-1].setting < usual.setting:
        said.append(f"down to {free[-1].setting:g} mm accuracy is almost free")
    if finest is not usual:
        ratio = usual.setting / finest.setting
        said.append(
            f"{finest.setting:g} mm, {ratio:.3g} times finer, costs {_times(finest.processor / usual.processor)} that"
        )
    return "; ".join(said) + "."


def _seconds(value: float) -> str:
    return f"{value * 1e3:.0f} ms" if value < 1.0 else f"{value:.2g} s"


def _times(ratio: float) -> str:
    return f"{ratio:.2g} times" if ratio < 100.0 else f"{ratio:.0f} times"
