"""The kernel's own check on many models: how often the counts along an edge contradicted its end.

    python -m peers.checks FOLDER_OR_FILES... [--random 10]

Each model is drawn from the named views and from random ones, fitted into a sheet. Per model: drawn edges, edges whose
check failed (decided again polygon by polygon), edges where even that contradicted itself, and what is wrong with the
model's parts.
Exit code 1 if a model without defects has a failed check.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from peers.referee import files, random_views

from support.at_size import ALL_LINES

SHEET = (277.0, 190.0)
"""Millimetres: at full size a hammer of 39 metres would have millions of triangles."""

NAMED = ("front", "back", "left", "right", "top", "bottom", "iso", "iso-sw", "iso-ne", "iso-nw")


def main(arguments: Sequence[str] | None = None) -> int:
    import hlr
    from hlr.errors import HlrError

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, help="folders or model files")
    parser.add_argument("--random", type=int, default=10, metavar="N", help="random views beside the named ones")
    given = parser.parse_args(arguments)
    views = [*NAMED, *random_views(given.random)]
    bad = 0
    print("| model | views | drawn edges | failed checks | contradictions | defects |")
    print("| --- | --- | --- | --- | --- | --- |")
    for path in files(given.paths):
        try:
            drawings = hlr.draw_views(path, list(views), hlr.Options(fit=SHEET, **ALL_LINES))
        except HlrError as error:
            print(f"| {path.name} | | | | | refused: {error} |", flush=True)
            continue
        drawn, failed, torn = (
            sum(d.counters[k] for d in drawings) for k in ("drawn", "failed_checks", "contradictions")
        )
        defects = [note.text for note in drawings[0].notes if note.code in ("defects", "more-defects")]
        bad += failed > 0 and not defects
        print(f"| {path.name} | {len(drawings)} | {drawn} | {failed} | {torn} | {' '.join(defects)} |", flush=True)
    return int(bad > 0)


if __name__ == "__main__":
    raise SystemExit(main())
