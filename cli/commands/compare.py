"""`hlr compare`: what differs between two drawings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..outputs import Target, check, place
from ..verb import Verb

if TYPE_CHECKING:
    from hlr.compare import Comparison, Difference
    from hlr.compare.compare import Registration

DIFFERENT = 1
"""Exit code."""

_MOST_ROWS = 20


@click.command(cls=Verb)
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option(
    "-o", "--output", "outputs", metavar="FILE", multiple=True,
    help="Overlay as SVG or PNG, figures as JSON, by the ending; may be repeated.",
)  # fmt: skip
@click.option(
    "--tolerance",
    type=float,
    metavar="MM",
    default=0.1,
    help="How far apart on paper two lines may lie that count as the same. Default: 0.1.",
)
@click.option(
    "--register",
    type=click.Choice(["off", "translation"]),
    default="off",
    help="translation: B is first moved to where most of its lines match those of A. Default: off.",
)
@click.option("-q", "--quiet", is_flag=True, help="Print nothing; the exit code tells.")
def compare(
    before: str, after: str, outputs: tuple[str, ...], tolerance: float, register: Registration, quiet: bool
) -> int:
    """Tell what differs from drawing A to drawing B: SVG or JSON files of hlr.

    \b
      hlr compare old.svg new.svg
      hlr compare old.svg new.svg -o difference.svg --register translation

    Exit codes, as those of diff: 0 the same, 1 different, 2 a file or an option was refused.
    """
    from hlr.compare import compare as compared

    targets = [_target(output) for output in outputs]
    for source in (before, after):
        check(targets, source)
    found = compared(before, after, tolerance_mm=tolerance, register=register)
    place([(target, found.rendered(f".{target.format}")) for target in targets])
    if not quiet:
        click.echo(found.summary)
        for row in _table(found):
            click.echo(row)
    return 0 if found.same else DIFFERENT


def _target(output: str) -> Target:
    from hlr.compare.comparison import ending_of

    path = Path(output)
    return Target(path, ending_of(path)[1:])


def _table(found: Comparison) -> list[str]:
    """The longest differences, and how many there are besides."""
    if found.same:
        return []
    rows: list[tuple[str, ...]] = [("difference", "mm", "at x, y", "class", "part")]
    rows += [_row(each) for each in found.differences[:_MOST_ROWS]]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    lines = [
        "",
        *("  ".join([*(cell.ljust(width) for cell, width in zip(row, widths, strict=False)), row[4]]) for row in rows),
    ]
    more = len(found.differences) - _MOST_ROWS
    return [line.rstrip() for line in lines] + ([f"and {more} more"] if more > 0 else [])


def _row(each: Difference) -> tuple[str, ...]:
    from hlr.compare.difference import told

    what = f"moved by {told(each.moved_mm)} mm" if each.kind == "moved" else each.kind
    line = f"{'visible' if each.visible else 'hidden'} {each.line_class}"
    became = f", now {each.became}" if each.became else ""
    name = "".join(c if c.isprintable() else "?" for c in each.part or "")
    edge = "" if each.edge is None else f", edge {each.edge}"
    x, y = (f"{value:.2f}" for value in each.place)
    return what, told(each.length_mm), f"{x}, {y}", line + became, f"{name}{edge}"
