"""Kernel against oracle for as long as you like.

    python tests/visibility/long_run.py --segments 1000000 --seed 7

Prints progress once a minute. A scene that fails is made small and printed as a literal for `test_regressions.py`;
exit code 1.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from visibility import compare, scenes


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--segments", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep-going", action="store_true", help="do not stop at the first failing scene")
    given = parser.parse_args(arguments)
    start = told = time.monotonic()
    done: Counter[str] = Counter()
    failures = 0
    seed = given.seed * 1_000_000_007
    while sum(done.values()) < given.segments:
        scene = scenes.scene(seed)
        for solids in (False, True) if scene.solids else (False,):
            problem = compare.difference(scene, solids=solids)
            if problem:
                failures += 1
                report(scene, seed, problem, solids)
                if not given.keep_going:
                    return 1
        done[scenes.kind(seed)] += len(scene.edges())
        seed += 1
        if time.monotonic() - told > 60:
            told = time.monotonic()
            print(f"{sum(done.values())} segments, {failures} failing scenes, {told - start:.0f} s", flush=True)
    kinds = ", ".join(f"{kind} {count}" for kind, count in sorted(done.items()))
    print(f"{sum(done.values())} segments in {time.monotonic() - start:.0f} s, {failures} failing scenes ({kinds})")
    return int(failures > 0)


def report(scene: scenes.Scene, seed: int, problem: str, solids: bool) -> None:
    small = compare.shrink(scene, lambda smaller: compare.difference(smaller, solids=solids) is not None)
    print(f"seed {seed} ({scenes.kind(seed)}, solids={solids}): {problem}")
    print(f"  made small: {compare.difference(small, solids=solids)}")
    print(f"  {small!r}", flush=True)


if __name__ == "__main__":
    raise SystemExit(main())
