"""One sentence for users: which accuracy to choose, and what it costs."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.lab.study.job import HLR, Point
from hlr.request.accuracy import DEFAULT_ACCURACY

DEAR = 2.0
"""A finer accuracy is recommended freely up to this multiple of the cost of the default one."""


def advice(points: Sequence[Point]) -> str:
    """The advice, from the points of hlr; empty if there are fewer than two."""
    ours = sorted((p for p in points if p.who == HLR and p.failure is None and p.processor > 0.0), key=_setting)
    if len(ours) < 2:
        return ""
    usual = min(ours, key=lambda p: abs(p.setting - DEFAULT_ACCURACY))
    finest, coarsest = ours[0], ours[-1]
    default = " (the default)" if usual.setting == DEFAULT_ACCURACY else ""
    sentences = [f"{usual.setting:g} mm{default} costs {_seconds(usual.processor)} of processor time"]
    if coarsest is not usual:
        sentences[0] += f", the coarsest drawing ({coarsest.setting:g} mm) {_seconds(coarsest.processor)}"
    affordable = min((p for p in ours if p.processor <= DEAR * usual.processor), key=_setting)
    if affordable.setting < usual.setting:
        sentences.append(f"for at most twice that there is {affordable.setting:g} mm")
    if finest is not affordable and finest.setting < usual.setting:
        sentences.append(f"{finest.setting:g} mm costs {_seconds(finest.processor)}")
    return "; ".join(sentences) + "."


def _setting(point: Point) -> float:
    return point.setting


def _seconds(value: float) -> str:
    return f"{value * 1e3:.0f} ms" if value < 0.9995 else f"{value:.2g} s" if value < 99.5 else f"{value:.0f} s"
