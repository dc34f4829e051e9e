"""Kernel against oracle for as long as you like.

    cd tests && python -m visibility.long_run --segments 1000000 --seed 7

Prints progress once a minute. A scene that fails is made small and printed as a literal for `test_regressions.py`;
exit code 1.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Sequence

from visibility import compare

from support.visibility import adapter, scenes
from support.visibility.adapter import Way


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
        for way in ways(scene, seed):
            problem = compare.difference(scene, way)
            if problem:
                failures += 1
                report(scene, seed, problem, way)
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


def ways(scene: scenes.Scene, seed: int) -> list[Way]:
    """As one part; as many, mostly with a contact tolerance; and culled where that is allowed."""
    found = [adapter.ONE, Way(parts=True, bias=seed % 4)]
    return [*found, Way(parts=True, trusted=True, bias=seed % 3)] if scene.closed else found


def report(scene: scenes.Scene, seed: int, problem: str, way: Way) -> None:
    small = compare.shrink(scene, lambda smaller: compare.difference(smaller, way) is not None)
    print(f"seed {seed} ({scenes.kind(seed)}, {way}): {problem}")
    print(f"  made small: {compare.difference(small, way)}")
    print(f"  {small!r}", flush=True)


if __name__ == "__main__":
    raise SystemExit(main())
