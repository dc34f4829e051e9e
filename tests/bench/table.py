"""The table of a benchmark: Markdown for people, figures for programs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import exp, log
from typing import Any

from support.markdown import markdown


@dataclass
class Table:
    """Cells as text; results: all that was measured; remarks: lines below the table."""

    headings: list[str]
    rows: list[list[str]]
    results: list[dict[str, Any]]
    remarks: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        return "\n".join([markdown(self.headings, self.rows), *(f"\n{remark}" for remark in self.remarks)])


def geometric_mean(ratios: Iterable[float]) -> float:
    """The geometric mean; NaN if there are no ratios."""
    found = [log(ratio) for ratio in ratios]
    return exp(sum(found) / len(found)) if found else float("nan")
