"""Draw mutated files for as long as asked, and keep those that do what none may.

    cd tests && python -m fuzz.files --minutes 60 --seed 7 --jobs 2

Every file must end in a drawing (exit code 0) or one sentence (2), with the earlier output intact in the latter case.
What does not is saved under the folder `found`, one file for each way of failing: crash (a signal), hang, fault (exit
code 70 or a traceback), sentence (more or less than one), output (incomplete, or changed though refused), strays.
"""

from __future__ import annotations

import argparse
import hashlib
import multiprocessing
import random
import time
from collections import Counter
from pathlib import Path
from typing import Any

from fuzz.mutate import mutate
from fuzz.warm import Warm

HERE = Path(__file__).resolve().parent
DATA = HERE.parent / "data"


def seeds(only: str | None) -> dict[str, list[bytes]]:
    """Sound and broken files by their kind. Those of the tests' data are large, and drawn seldom."""
    found: dict[str, list[bytes]] = {}
    for path in sorted([*HERE.glob("corpus/seeds/*"), *HERE.glob("corpus/broken/*")]):
        kind = path.suffix[1:]
        if only in (None, kind):
            found.setdefault(kind, []).append(path.read_bytes())
    return found


def work(number: int, seed: int, minutes: float, only: str | None, folder: Path, results: Any) -> None:
    """Mutate, draw, judge, until the time is over."""
    rng = random.Random(f"{seed}/{number}")
    files, warm = seeds(only), Warm()
    kinds = sorted(files)
    end = time.monotonic() + 60.0 * minutes
    while time.monotonic() < end:
        kind = rng.choice(kinds)
        data = mutate(rng, kind, rng.choice(files[kind]), files[kind])
        result = warm.draw(f"case.{kind}", data)
        fault = result.fault(f"case.{kind}")
        if fault is not None:
            # Line numbers and values differ from case to case: the same words are the same failure.
            mark = hashlib.sha1("".join(c for c in fault if not c.isdigit()).encode()).hexdigest()[:8]
            place = folder / f"{fault.split()[0]}-{mark}.{kind}"
            if not place.exists() or place.stat().st_size > len(data):
                place.write_bytes(data)
                place.with_suffix(f".{kind}.txt").write_text(f"{fault}\n\n{result.err}")
        results.put((kind, "drawn" if result.code == 0 else "refused" if fault is None else fault.split()[0], fault))
    warm.close()
    results.put(None)


def main() -> None:
    """Run and report."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--kind", help="only this ending")
    parser.add_argument("--found", type=Path, default=Path("found"))
    asked = parser.parse_args()
    asked.found.mkdir(exist_ok=True)
    results: Any = multiprocessing.Queue()
    jobs = [
        multiprocessing.Process(target=work, args=(n, asked.seed, asked.minutes, asked.kind, asked.found, results))
        for n in range(asked.jobs)
    ]
    for job in jobs:
        job.start()
    counts: Counter[tuple[str, str]] = Counter()
    faults: Counter[str] = Counter()
    running = len(jobs)
    while running:
        result = results.get()
        if result is None:
            running -= 1
            continue
        kind, outcome, fault = result
        counts[kind, outcome] += 1
        if fault is not None:
            faults[f"{kind}: {fault[:160]}"] += 1
            if faults[f"{kind}: {fault[:160]}"] == 1:
                print(f"{kind}: {fault[:300]}", flush=True)
    for kind in sorted({kind for kind, _ in counts}):
        row = ", ".join(f"{n} {outcome}" for (k, outcome), n in sorted(counts.items()) if k == kind)
        print(f"{kind:5} {row}")
    print(f"{sum(counts.values())} files, {len(faults)} ways of failing, kept in {asked.found}")


if __name__ == "__main__":
    main()
