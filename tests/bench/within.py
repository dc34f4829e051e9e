"""Whether `hlr draw --within` keeps its time: `python -m bench.within MODEL... [--seconds 2 5 10]`.

The whole command is timed, from its start to its end, loading of libraries and writing included. The table has the
time it took over the time asked for, medians, and the accuracy that was reached.
"""

from __future__ import annotations

import argparse
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

COMMAND = [sys.executable, "-P", "-c", "from hlr.cli import main; main()", "draw"]


def once(model: Path, seconds: float, target: Path) -> tuple[float, float, str]:
    """Seconds, the accuracy that the drawing states, and what was said."""
    begin = time.perf_counter()
    asked = [str(model), "-o", str(target), "--fit", "277x190", "--within", f"{seconds}s"]
    done = subprocess.run([*COMMAND, *asked], capture_output=True, text=True, check=True)
    took = time.perf_counter() - begin
    found = re.search(r' accuracy="([^"]*)"', target.read_text("utf-8"))
    assert found is not None
    excess = " ".join(re.findall(r"[\d.]+ s over", done.stderr))
    return took, float(found[1]), excess


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--seconds", type=float, nargs="+", default=[2.0, 5.0, 10.0])
    parser.add_argument("--runs", type=int, default=3)
    given = parser.parse_args()
    print("| model | asked, s | taken, s | taken / asked | accuracy, mm | |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for model in given.models:
            for seconds in given.seconds:
                runs = [once(model, seconds, Path(folder) / "a.svg") for _ in range(given.runs)]
                took = statistics.median(run[0] for run in runs)
                finest = sorted({run[1] for run in runs})
                told = " to ".join(f"{x:g}" for x in (finest if len(finest) == 1 else (finest[0], finest[-1])))
                note = next((run[2] for run in runs if run[2]), "")
                row = f"| {model.name} | {seconds:g} | {took:.1f} | {took / seconds:.2f} | {told} | {note} |"
                print(row, flush=True)


if __name__ == "__main__":
    main()
