"""Study six models of different kind anew: python examples/study/run.py FOLDER [NAME...]

FOLDER holds the models (README.md beside this file says where they are from); names are those of the folders here.
"""

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent

MODELS = {
    "screw": "M6-1x12-countersunk-screw.step",
    "motor": "Motor-c.brep",
    "nacelle": "nacelle.stp",
    "nist": "nist_ctc_02_asme1_ap242-e2.stp",
    "scan": "bunny.ply",
    "board": "Stamp_C6LoRa_SMD.step",
}
RUNS = {"board": 2}
"""The others are run three times."""


def main(arguments):
    folder, names = Path(arguments[0]), arguments[1:] or list(MODELS)
    for name in names:
        command = ["hlr", "study", str(folder / MODELS[name]), "-o", str(HERE / name), "--runs", str(RUNS.get(name, 3))]
        print(name, flush=True)
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
