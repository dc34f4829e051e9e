"""`hlr methods`: tables, files, limits, refused options."""

import csv
import subprocess
import sys

import numpy as np
import pytest

from hlr.errors import OptionError
from hlr.lab.methods import SCREEN, render, report, testbed, textbook
from hlr.lab.methods.comparison import compare_methods
from hlr.lab.methods.plot import png
from hlr.lab.methods.timing import TRIALS, Timing, label


def run(*arguments, cwd):
    command = [sys.executable, "-P", "-m", "hlr", "methods", *arguments]
    done = subprocess.run(command, check=False, capture_output=True, text=True, cwd=cwd, timeout=120)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.slow
def test_tables_and_files(tmp_path):
    code, out, err = run("--polygons", "100", "--crossing", "40", "--size", "48x32", "-o", "figures", cwd=tmp_path)
    assert (code, err) == (0, "")
    for title in ("Relative cost", "Time", "Memory", "Comparisons", "Events of the active lists"):
        assert title in out
    folder = tmp_path / "figures"
    assert sorted(p.name for p in folder.iterdir()) == ["methods.csv", "methods.md", "methods.png"]
    rows = list(csv.DictReader((folder / "methods.csv").open()))
    assert len(rows) == 2 * len(TRIALS)
    assert {row["scene"] for row in rows} == {"100", "40 crossing"}
    assert {row["method"] for row in rows} == {label(t) for t in TRIALS}
    assert all(row["finished"] == "yes" and float(row["seconds"]) > 0 for row in rows)
    assert (folder / "methods.png").read_bytes().startswith(b"\x89PNG")
    assert "| z-buffer |" in (folder / "methods.md").read_text()


@pytest.mark.slow
def test_on_a_model(tmp_path):
    path = tmp_path / "one.stl"
    path.write_text(
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 3\nendloop\n"
        "endfacet\nendsolid a\n"
    )
    code, out, _ = run("one.stl", "--polygons", "5", "--size", "20x20", "--method", "z-buffer", cwd=tmp_path)
    assert code == 0 and "one.stl" in out and "warnock" not in out


def box(path):
    """A box of twelve triangles as an STL."""
    import trimesh

    trimesh.creation.box((3, 2, 1)).export(path)


@pytest.mark.slow
def test_a_model_alone(tmp_path):
    box(tmp_path / "box.stl")
    chosen = ["--method", "ray casting, flat", "--method", "scan-line z-buffer, per polygon", "--method", "scan line"]
    code, out, err = run("box.stl", "--size", "32x32", *chosen, "-o", "figures", cwd=tmp_path)
    assert (code, err) == (0, "")
    rows = list(csv.DictReader((tmp_path / "figures" / "methods.csv").open()))
    assert [row["method"] for row in rows] == chosen[1::2]
    assert {(row["scene"], row["polygons"]) for row in rows} == {("box.stl: 12", "12")}
    assert "box.stl: 12" in out and "1,000,000" not in out


def axes_of(timings, monkeypatch):
    """The plot as matplotlib has it."""
    from matplotlib.figure import Figure

    made = []
    add = Figure.add_subplot

    def kept(self, *args, **options):
        made.append(add(self, *args, **options))
        return made[-1]

    monkeypatch.setattr(Figure, "add_subplot", kept)
    png(timings, (32, 32))
    return made[0]


def test_the_plot_shows_models_and_what_is_not_finished(monkeypatch):
    statistics = render([], SCREEN, (1, 1)).statistics
    found = [
        Timing(report.scene_name(100), 100, "z-buffer", 0.01, statistics, 2.0),
        Timing(report.model_name("part.step", 1234), 1234, "z-buffer", 0.02, statistics, 2.0),
        Timing(report.model_name("part.step", 1234), 1234, "depth sort", None, None, 2.0),
    ]
    axes = axes_of(found, monkeypatch)
    points = {(float(x), float(y)) for line in axes.lines for x, y in zip(*line.get_data(), strict=True)}
    assert {(100.0, 0.01), (1234.0, 0.02), (1234.0, 2.0)} <= points
    assert "part.step: 1,234" in " ".join(text.get_text() for text in axes.texts)
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["z-buffer", "depth sort", "not finished"]


def test_the_limit_counts_what_the_table_shows():
    # Many limits of time that passes may end before the thread has worked as long.
    found = compare_methods(counts=(60_000,), size=(1024, 1024), limit=0.02, methods=["ray casting, flat"])
    assert found[0].seconds is None and found[0].limit == 0.02


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [
        ["--method", "raytrace"],
        ["--method", "warnock, fast"],
        ["--size", "0x4"],
        ["--size", "99999x4"],
        ["--polygons", "0"],
        ["--limit", "0"],
        ["no.stl"],
    ],
)
def test_refusals(tmp_path, arguments):
    code, out, err = run("--polygons", "3", *arguments, cwd=tmp_path)
    assert code == 2 and out == "" and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_folders_place(tmp_path):
    (tmp_path / "taken").write_text("")
    code, _, err = run("--polygons", "3", "-o", "taken", cwd=tmp_path)
    assert code == 2 and "not a folder" in err


def test_what_is_not_finished_is_said():
    found = compare_methods(counts=(20_000,), size=(256, 256), limit=1e-4, methods=["warnock"])
    assert found[0].statistics is None and found[0].seconds is None
    assert report.LATE in report.text(found) and ",no," in report.comma_separated(found)


@pytest.mark.slow
def test_the_textbooks_table_stands_beside_todays():
    assert textbook.COST["depth sort"] == (1, 10, 507) and textbook.COST["z-buffer"] == (54, 54, 54)
    assert textbook.COST["scan line"] == (5, 21, 100) and textbook.COST["warnock"] == (11, 64, 307)
    statistics = render([], SCREEN, (1, 1)).statistics
    found = [
        Timing(report.scene_name(count), count, method, 0.001 * count * (k + 1), statistics)
        for count in (100, 250, 2_500, 60_000)
        for k, method in enumerate(textbook.COST)
    ]
    title, rows = report.tables(found)[0]
    assert "textbook" in title
    assert rows[0] == ["method", "100", "250", "60,000", "|", "100", "250", "2,500", "60,000"]
    assert rows[2] == ["z-buffer", "54", "54", "54", "|", "2", "5", "50", "1.2e+03"]
    assert png(found, (4, 4)) == png(found, (4, 4))


def test_the_scenes_are_as_deep_whatever_their_number():
    for count in (250, 4_000):
        for crossing in (False, True):
            scene = testbed.polygons(count, (200, 150), crossing)
            assert len(scene) == count
            compared = render(scene, SCREEN, (200, 150), "z-buffer").statistics.comparisons / (200 * 150)
            assert 2.0 < compared < 5.0
            splits = render(scene, SCREEN, (200, 150), "scan line").statistics.splits
            assert (splits > 100) == crossing
    again = testbed.polygons(100, (200, 150))
    assert np.array_equal(again.points, testbed.polygons(100, (200, 150)).points)


def test_events_are_shown_of_methods_that_have_lists():
    found = compare_methods(counts=(30,), size=(32, 32), methods=["z-buffer", "span list"])
    title, rows = report.tables(found)[-1]
    own = found[1].statistics
    assert title.startswith("Events") and [row[0] for row in rows] == ["method", "span list"]
    total = own.edge_starts + own.edge_ends + own.span_starts + own.span_ends
    assert rows[1][1] == f"{total} + {own.swaps}" and own.edge_starts == own.edge_ends > 0 < own.span_starts
    assert not any(title.startswith("Events") for title, _ in report.tables(found[:1]))


def test_absurd_requests():
    for wrong in ({"counts": (0,)}, {"counts": (10**9,)}, {"limit": 0.0}, {"methods": ["x"]}, {"size": (0, 1)}):
        with pytest.raises(OptionError):
            compare_methods(**wrong)
