"""Study six models of different kind anew: python examples/study/run.py FOLDER [NAME...]

FOLDER holds the models (README.md beside this file says where they are from); names are those of the folders here. At
the end all of them go into one picture, overview.png; `run.py` alone makes only that.
"""

import csv
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent

MODELS = {
    "motor": "Motor-c.brep",
    "nist": "nist_ctc_02_asme1_ap242-e2.stp",
    "nacelle": "nacelle.stp",
    "scan": "bunny.ply",
    "screw": "M6-1x12-countersunk-screw.step",
    "board": "Stamp_C6LoRa_SMD.step",
}


TITLES = {
    "motor": "motor, 17 parts",
    "nist": "NIST test case 2",
    "nacelle": "nacelle, splines",
    "scan": "bunny, scanned",
    "screw": "M6 screw, thread",
    "board": "board, 474 solids",
}


def points(path):
    """The points of a study, as far as the picture needs them."""
    from hlr.study.job import Cost, Point

    with path.open() as file:
        for row in csv.DictReader(file):
            if not row["failure"]:
                cost = Cost(float(row["wall_s"]), float(row["cpu_s"]), float(row["mb"]))
                errors = {"ink_usual": float(row["ink_usual"])} if row["ink_usual"] else {}
                yield Point(row["who"], float(row["setting"]), stages={"visibility": cost}, errors=errors)


def overview():
    from matplotlib.figure import Figure

    from hlr.study.plot import legend, panel

    figure = Figure(figsize=(12.0, 7.6), layout="constrained")
    for axes, (name, title) in zip(figure.subplots(2, 3).flat, TITLES.items(), strict=True):
        if (HERE / name / "study.csv").exists():
            panel(axes, list(points(HERE / name / "study.csv")), "ink_usual")
        axes.set_title(title, fontsize=10)
    for k in (0, 3):
        figure.axes[k].set_ylabel("99 % of visible ink is nearer than, mm", fontsize=9)
    legend(figure)
    figure.savefig(HERE / "overview.png", dpi=90, metadata={"Software": None})


def main(arguments):
    names = arguments[1:] or list(MODELS) if arguments else []
    for name in names:
        print(name, flush=True)
        subprocess.run(["hlr", "study", str(Path(arguments[0]) / MODELS[name]), "-o", str(HERE / name)], check=True)
    overview()


if __name__ == "__main__":
    main(sys.argv[1:])
