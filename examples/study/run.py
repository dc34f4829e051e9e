"""Study six models of different kind anew: python examples/study/run.py FOLDER [NAME...]

FOLDER holds the models (README.md beside this file says where they are from); names are those of the folders here. At
the end all plots are drawn from the tables, and one of them all, overview.png; `run.py` alone does only that.
"""

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


def tables():
    """Name and points of each study that there is."""
    from hlr.lab.study.table import points_of

    for name in MODELS:
        path = HERE / name / "study.csv"
        if path.exists():
            yield name, points_of(path.read_text())


def plots():
    from matplotlib.figure import Figure

    from hlr.lab.study.plot import error_plot, legend, panel, stage_plot

    figure = Figure(figsize=(12.0, 7.6), layout="constrained")
    panels = dict(zip(MODELS, figure.subplots(2, 3).flat, strict=True))
    for name, points in tables():
        panel(panels[name], points, "ink_p99")
        panels[name].set_title(TITLES[name], fontsize=10)
        (HERE / name / "error.png").write_bytes(error_plot(points, MODELS[name]))
        (HERE / name / "stages.png").write_bytes(stage_plot(points, MODELS[name]))
    for k in (0, 3):
        figure.axes[k].set_ylabel("99 % of visible ink is nearer than, mm", fontsize=9)
    legend(figure)
    figure.savefig(HERE / "overview.png", dpi=90, metadata={"Software": None})


def main(arguments):
    names = arguments[1:] or list(MODELS) if arguments else []
    for name in names:
        print(name, flush=True)
        subprocess.run(["hlr", "study", str(Path(arguments[0]) / MODELS[name]), "-o", str(HERE / name)], check=True)
    plots()


if __name__ == "__main__":
    main(sys.argv[1:])
