"""The shape of the project: what is packaged, what imports what, and what stays unloaded."""

import ast
import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# The order in which a drawing passes through the stages: each imports only those before it.
STAGES = (
    "cache",
    "source",
    "scene",
    "view",
    "plan",
    "visibility",
    "surfaces",
    "linework",
    "shading",
    "window",
    "writers",
)

# What every stage may import: no stage, and none of them imports one.
COMMON = (
    "distinct",
    "endings",
    "process",
    "cache",
    "errors",
    "tolerance",
    "curve",
    "clock",
    "drawing",
    "lines",
    "picture",
    "_kernel",
)

# The crates of the kernel, and those of them that each may use.
CRATES = {
    "exact": set(),
    "brep": set(),
    "mesh": {"brep"},
    "visibility": {"exact", "mesh"},
    "linework": {"exact", "brep", "mesh", "visibility"},
    "preview": {"brep"},
    "methods": {"exact"},
    "python": {"exact", "brep", "mesh", "visibility", "linework", "preview", "methods"},
}

# Records without behaviour that say what is handed over; they import no stage, so any stage may read them.
RECORDS = ("hlr.notes", "hlr.values", "hlr.source.model", "hlr.plan.options", "hlr.plan.effect", "hlr.plan.table")


def folders():
    """Every folder of Python modules that is to be installed, as the package it becomes."""
    found = {path.parent.relative_to(ROOT) for top in ("hlr", "cli") for path in (ROOT / top).rglob("__init__.py")}
    return {".".join(("hlr", *path.parts) if path.parts[0] == "cli" else path.parts) for path in found}


def imports(path, package):
    """Absolute names of all that a module imports, at its top or anywhere inside: (line, name)."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")
            start = base[: len(base) - node.level + 1] if node.level else []
            start += (node.module or "").split(".") if node.module else []
            yield from ((node.lineno, ".".join([*start, alias.name])) for alias in node.names)


def wrong_imports(path, stage, package):
    """Imports of a stage module that go against the order, as sentences."""
    allowed = tuple(f"hlr.{name}" for name in (*COMMON, *STAGES[: STAGES.index(stage) + 1])) + RECORDS
    for line, name in imports(path, package):
        ours = name == "hlr" or name.startswith(("hlr.", "cli."))
        if ours and not any(name == good or name.startswith(good + ".") for good in allowed):
            yield f"{path.name}:{line}: {stage} imports {name}"


def loaded_by(code, *arguments):
    """Top-level modules that a Python program has loaded when it ends."""
    program = f"import atexit, sys; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); {code}"
    command = [sys.executable, "-P", "-c", program, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {name.partition(".")[0] for name in done.stderr.split()}


HEAVY = {
    "numpy",
    "scipy",
    "OCP",
    "cadquery",
    "build123d",
    "trimesh",
    "manifold3d",
    "rich",
    "pydyf",
    "lxml",
    "networkx",
    "PIL",
    "matplotlib",
}
COMMAND = "from hlr.cli import main; main()"


@pytest.mark.parametrize(
    "arguments",
    [["--help"], ["--version"], ["draw", "--help"], ["preview", "--help"], ["info", "--help"], ["study", "--help"]],
)
def test_help_loads_nothing_heavy(arguments):
    loaded = loaded_by(COMMAND, *arguments)
    assert "click" in loaded
    assert not loaded & HEAVY


def test_import_hlr_loads_nothing_heavy():
    assert not loaded_by("import hlr") & HEAVY


def test_a_refused_option_loads_nothing_heavy():
    code = "import contextlib\nwith contextlib.suppress(SystemExit):\n    from hlr.cli import main; main()"
    assert not loaded_by(f"exec({code!r})", "draw", "a.step", "-o", "a.dwg") & HEAVY


def test_drawing_a_plain_mesh_loads_no_library_but_numpy(tmp_path):
    heavy = HEAVY - {"numpy"} | {"email", "http", "random"}
    (tmp_path / "one.off").write_bytes(b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    (tmp_path / "one.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    for path in (ROOT / "tests/data/soup.stl", ROOT / "tests/fuzz/corpus/seeds/box.ply", *tmp_path.glob("one.*")):
        # With arguments the command works in its own process.
        code = "from hlr.cli import main; main(sys.argv[1:])"
        loaded = loaded_by(code, "draw", str(path), "-q", "-o", str(tmp_path / "out.svg"))
        assert (tmp_path / "out.svg").exists()
        assert "numpy" in loaded
        assert not loaded & heavy
        (tmp_path / "out.svg").unlink()


def test_drawing_loads_no_masked_arrays(tmp_path):
    code = "import hlr, sys; hlr.draw(sys.argv[1]).to_svg(); print('numpy.ma' in sys.modules)"
    command = [sys.executable, "-P", "-c", code, str(ROOT / "tests/data/soup.stl")]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "False\n"


def test_the_loaded_modules_are_seen():
    assert "numpy" in loaded_by("import numpy")


def test_there_is_one_version():
    import hlr

    with open(ROOT / "pyproject.toml", "rb") as file:
        assert tomllib.load(file)["project"]["version"] == hlr.__version__ == version("hlr-drawing")


def test_what_build123d_needs_is_what_hlr_needs_but_cadquery():
    with open(ROOT / "pyproject.toml", "rb") as file:
        needed = tomllib.load(file)["project"]["dependencies"]
    lines = (ROOT / "hlr/compat/build123d.txt").read_text().splitlines()
    listed = [line for line in lines if not line.startswith("#")]
    assert listed[0].startswith("build123d>=")
    assert listed[1:] == [each for each in needed if not each.startswith("cadquery")]


def test_every_folder_is_packaged():
    with open(ROOT / "pyproject.toml", "rb") as file:
        setup = tomllib.load(file)["tool"]["setuptools"]
    listed = setup["packages"]
    assert len(listed) == len(set(listed))
    assert set(listed) == folders()
    folder = {name: name.removeprefix("hlr.").replace(".", "/") for name in listed if name.startswith("hlr.cli")}
    assert setup["package-dir"] == folder


def test_every_folder_with_modules_has_an_init():
    for top in ("hlr", "cli"):
        for path in (ROOT / top).rglob("*.py"):
            assert (path.parent / "__init__.py").exists(), f"{path.parent.relative_to(ROOT)} would not be packaged"


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_imports_only_the_stages_before_it(stage):
    paths = sorted((ROOT / "hlr" / stage).rglob("*.py"))
    assert paths
    wrong = [text for path in paths for text in wrong_imports(path, stage, f"hlr.{stage}")]
    assert not wrong, "\n".join(wrong)


def test_only_what_stands_above_the_pipeline_measures():
    allowed = {"measure", "study", "drawings.py"}
    paths = [path for path in (ROOT / "hlr").rglob("*.py") if path.relative_to(ROOT / "hlr").parts[0] not in allowed]
    names = [(path.name, name) for path in paths for _, name in imports(path, f"hlr.{path.parent.name}")]
    # What a drawing has reached is a record, which its type names.
    found = {name for _, name in names if name.startswith("hlr.measure") and name != "hlr.measure.reached.Reached"}
    assert not found


def test_measuring_knows_nothing_above_it():
    paths = sorted((ROOT / "hlr" / "measure").glob("*.py"))
    names = {name for path in paths for _, name in imports(path, "hlr.measure")}
    assert paths
    assert not [name for name in names if name.startswith(("hlr.study", "hlr.drawings", "hlr.within", "hlr.cli"))]


def test_a_plain_drawing_loads_no_measure():
    code = "import hlr, sys; hlr.draw(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))"
    program = f"{code}; print([name for name in sys.modules if name.startswith(('hlr.measure', 'hlr.within'))])"
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_only_the_command_line_knows_the_study():
    # It stands above everything else; what it imports itself may be anything below.
    # The package's face names it, for type checkers only.
    above = ("study", "__init__.py")
    paths = [path for path in (ROOT / "hlr").rglob("*.py") if path.relative_to(ROOT / "hlr").parts[0] not in above]
    package = {path: ".".join(("hlr", *path.relative_to(ROOT / "hlr").parent.parts)) for path in paths}
    names = [(path.name, name) for path in paths for _, name in imports(path, package[path])]
    assert ("pipeline.py", "hlr.linework.lines.draw_lines") in names
    assert not [(file, name) for file, name in names if name.startswith("hlr.study")]


def test_the_study_knows_nothing_of_the_command_line():
    paths = sorted((ROOT / "hlr" / "study").glob("*.py"))
    assert paths
    names = [name for path in paths for _, name in imports(path, "hlr.study")]
    assert not [name for name in names if name.startswith(("hlr.cli", "cli"))]


def manifest(crate):
    with open(ROOT / "hlr/kernel" / crate / "Cargo.toml", "rb") as file:
        return tomllib.load(file)


def test_crates_use_only_those_before_them():
    workspace = manifest(".")["workspace"]
    assert workspace["members"] == list(CRATES)
    for number, (crate, allowed) in enumerate(CRATES.items()):
        needed = manifest(crate)["dependencies"]
        assert {name.removeprefix("hlr-") for name in needed if name.startswith("hlr-")} == allowed
        assert allowed <= set(list(CRATES)[:number])
        # Python is known at the border alone.
        assert {"numpy", "pyo3"} & set(needed) == ({"numpy", "pyo3"} if crate == "python" else set())


@pytest.mark.parametrize("name", ["errors", "tolerance", "drawing", "picture"])
def test_what_is_common_imports_no_stage(name):
    path = ROOT / "hlr" / f"{name}.py"
    if not path.exists():
        pytest.skip(f"there is no hlr/{name}.py")
    # Only at the top: a method may reach for a stage when it is called.
    at_top = [node for node in ast.parse(path.read_text("utf-8")).body if isinstance(node, ast.ImportFrom)]
    assert not {node.module.split(".")[1] for node in at_top if node.module.startswith("hlr.")} & set(STAGES)


@pytest.mark.parametrize("name", RECORDS)
def test_records_import_no_stage(name):
    path = ROOT / f"{name.replace('.', '/')}.py"
    found = [found for _, found in imports(path, name.rpartition(".")[0]) if found.startswith("hlr")]
    # But one another.
    assert not [one for one in found if not one.startswith(tuple(f"{record}." for record in RECORDS))]


@pytest.mark.parametrize("path", sorted((ROOT / "cli").rglob("*.py")), ids=lambda path: path.stem)
def test_the_command_line_knows_itself_only_relatively(path):
    # It is installed as hlr.cli: an absolute `cli` would be another package.
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and not node.level:
            assert (node.module or "").split(".")[0] != "cli"
            assert not (node.module or "").startswith("hlr.cli")


def test_the_order_is_checked(tmp_path):
    path = tmp_path / "bad.py"
    path.write_text(
        "from hlr.errors import HlrError\n"
        "from hlr.source.model import PartMesh\n"
        "def f():\n"
        "    from ..writers import svg\n"
        "    import hlr.linework.chain\n"
        "    from hlr import draw\n"
    )
    assert list(wrong_imports(path, "scene", "hlr.scene")) == [
        "bad.py:4: scene imports hlr.writers.svg",
        "bad.py:5: scene imports hlr.linework.chain",
        "bad.py:6: scene imports hlr.draw",
    ]
