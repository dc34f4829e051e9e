"""Sheets and wings from nearly edge-on views: where a drawing lacks lines or draws hidden ones.

    python -m peers.edge_on [NAMES...] [--accuracy 0.1 0.05] [--sine 0.01 0.03] [--why 5]

What counts as missing or wrong: `support/edge_on.py`.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import hlr
from support import sheets
from support.at_size import AT_SIZE
from support.edge_on import Truth


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="sheets (default: all)")
    parser.add_argument("--accuracy", type=float, nargs="+", default=[0.5, 0.1, 0.05, 0.01])
    parser.add_argument("--sine", type=float, nargs="+", default=[0.005, 0.01, 0.02, 0.03, 0.05])
    parser.add_argument("--every", type=int, default=1, help="of the views only every so-manieth")
    parser.add_argument("--why", type=int, default=0, help="list the N worst gaps")
    given = parser.parse_args(arguments)
    chosen = given.names or list(sheets.SHEETS)
    bad = 0
    for name in chosen:
        shape = sheets.SHEETS[name]()
        truth = Truth(shape)
        views = list(sheets.views(truth.faces, given.sine))[:: given.every]
        for accuracy in given.accuracy:
            worst = total = 0.0
            wrong = judged = seen = broken = 0
            told: list[str] = []
            for label, view in views:
                drawing = hlr.draw(shape, view, accuracy=accuracy, **AT_SIZE)
                found = truth.judge(drawing)
                worst, total = max(worst, found.worst), total + found.total
                wrong, judged, seen = wrong + len(found.wrong), judged + found.judged, seen + found.seen
                broken += bool(found.gaps or found.wrong)
                for which, length, at in sorted(found.gaps, key=lambda g: -g[1])[:3]:
                    told.append(f"    {length:8.3f} mm missing of {which} at {at.round(3)}: {label} {view}")
                if found.wrong:
                    which, at = found.wrong[0]
                    told.append(f"    {len(found.wrong)} wrong samples, {which} at {at.round(3)}: {label} {view}")
            bad += broken
            print(
                f"{name:24} {accuracy:5} mm: {broken:3} of {len(views)} views bad; longest gap {worst:7.3f} mm, "
                f"{total:8.3f} in all; wrong visible {wrong} of {judged}; {seen} seen",
                flush=True,
            )
            for text in sorted(told, reverse=True)[: given.why]:
                print(text)
    return int(bad > 0)


if __name__ == "__main__":
    raise SystemExit(main())
