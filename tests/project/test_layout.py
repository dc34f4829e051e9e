"""The shape of the project: what is packaged, what imports what, and what stays unloaded."""

import ast
import re
import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# The rooms of the package, from the ground up: each imports only those before it, whether at its top, inside a function
# or for a type checker.
FLOORS = (
    "errors",
    "common",
    "tables",
    "request",
    "drawing",
    "cache",
    "source",
    "scene",
    "image",
    "visibility",
    "linework",
    "window",
    "shading",
    "writers",
    "pipeline",
    "lab",
    "public",
    "compare",
    "testing",
    "compat",
    "batch",
    "cli",
)

# Consumers of what `import hlr` shows.
ABOVE = ("cli", "__main__")

# The crates of the kernel, and those of them that each may use.
CRATES = {
    "accuracy": set(),
    "exact": set(),
    "brep": {"accuracy", "exact"},
    "mesh": {"brep"},
    "visibility": {"accuracy", "exact", "mesh"},
    "linework": {"accuracy", "exact", "brep", "mesh", "visibility"},
    "preview": {"exact", "brep"},
    "methods": {"exact"},
    "python": {"exact", "brep", "mesh", "visibility", "linework", "preview", "methods"},
}


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


def modules(root):
    """Every module of the program: its name, and its file. The command line is installed as hlr.cli."""
    found = {}
    for path in [*(root / "hlr").rglob("*.py"), *(root / "cli").rglob("*.py")]:
        parts = path.relative_to(root).with_suffix("").parts
        parts = parts[:-1] if parts[-1] == "__init__" else parts
        found[".".join(parts if parts[0] == "hlr" else ("hlr", *parts))] = path
    return found


def arrows(root):
    """(module, line, module) for each import of one module by another."""
    known = modules(root)
    for name, path in known.items():
        package = name if path.name == "__init__.py" else name.rpartition(".")[0]
        for line, imported in imports(path, package):
            target = imported
            while target and target not in known:
                target = target.rpartition(".")[0]
            # The kernel is no module of Python; the bare package stands for what users see.
            if target and target != name and not imported.startswith("hlr._kernel"):
                yield name, line, target


def room(module):
    """The room of a module; empty for the package itself."""
    return module.split(".")[1] if "." in module else ""


def wrong_arrows(root):
    """Imports that lead upward, as sentences. The package's own face names everything, for type checkers."""
    for name, line, target in arrows(root):
        here, there = room(name), room(target)
        if here in ("", there) or (here in ABOVE and there in ("", "cli")):
            continue
        if here not in ABOVE and (there not in FLOORS or FLOORS.index(there) > FLOORS.index(here)):
            yield f"{name}:{line}: {here} imports {target}"


def circles(root):
    """Modules that import one another, directly or through others. An import for type checkers alone counts too."""
    onward = {}
    for name, _, target in arrows(root):
        if name != "hlr":
            onward.setdefault(name, set()).add(target)
    reached = {}

    def all_from(name):
        seen, todo = set(), [name]
        while todo:
            for one in onward.get(todo.pop(), ()):
                if one not in seen:
                    seen.add(one)
                    todo.append(one)
        return seen

    reached = {name: all_from(name) for name in onward}
    return sorted(name for name, seen in reached.items() if name in seen)


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


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.mark.slow
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


def test_every_room_stands_on_a_floor():
    rooms = {path.name for path in (ROOT / "hlr").iterdir() if (path / "__init__.py").exists()}
    assert rooms | {"errors", "cli"} == set(FLOORS)
    assert {path.stem for path in (ROOT / "hlr").glob("*.py")} == {"__init__", "__main__", "errors"}


def test_the_architecture_page_lists_the_rooms_in_their_order():
    page = (ROOT / "hlr/docs/ARCHITECTURE.md").read_text("utf-8")
    assert tuple(re.findall(r"^\| \[`(\w+)`\]\(\S+\) \| \S", page, re.MULTILINE)) == FLOORS


def test_the_page_of_the_kernel_lists_the_crates_and_what_they_use():
    page = (ROOT / "hlr/kernel/README.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)` \| .* \| (.*)\|$", page, re.MULTILINE)
    uses = {
        name: set(CRATES) - {name} if last.strip() == "all" else set(re.findall(r"`(\w+)`", last))
        for name, last in rows
    }
    assert [name for name in uses if name != "fuzz"] == list(CRATES)
    for crate, allowed in CRATES.items():
        assert allowed == uses[crate] or (crate == "python" and allowed <= uses[crate])


def test_no_import_leads_upward():
    wrong = list(wrong_arrows(ROOT))
    assert not wrong, "\n".join(wrong)


@pytest.mark.slow
def test_no_modules_import_one_another():
    assert not circles(ROOT)


def test_a_plain_drawing_loads_no_measure():
    code = "import hlr, sys; hlr.draw(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))"
    program = (
        f"{code}; print([name for name in sys.modules if name.startswith(('hlr.lab.measure', 'hlr.pipeline.within'))])"
    )
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


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


@pytest.mark.parametrize("path", sorted((ROOT / "cli").rglob("*.py")), ids=lambda path: path.stem)
def test_the_command_line_knows_itself_only_relatively(path):
    # It is installed as hlr.cli: an absolute `cli` would be another package.
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and not node.level:
            assert (node.module or "").split(".")[0] != "cli"
            assert not (node.module or "").startswith("hlr.cli")


def house(folder, files):
    """A small program of these modules and their texts."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        (path.parent / "__init__.py").touch()
    return folder


def test_an_import_that_leads_upward_is_found(tmp_path):
    text = (
        "from hlr.errors import HlrError\n"
        "from hlr.source.model import PartMesh\n"
        "def f():\n"
        "    from ..writers import svg\n"
        "    import hlr.linework.lines\n"
        "    from hlr import draw\n"
    )
    empty = ("errors", "source/model", "writers/svg", "linework/lines")
    root = house(tmp_path, {"hlr/scene/bad.py": text, **{f"hlr/{name}.py": "" for name in empty}})
    assert list(wrong_arrows(root)) == [
        "hlr.scene.bad:4: scene imports hlr.writers.svg",
        "hlr.scene.bad:5: scene imports hlr.linework.lines",
        "hlr.scene.bad:6: scene imports hlr",
    ]


def test_a_circle_is_found(tmp_path):
    files = {
        "hlr/scene/one.py": "from hlr.scene.two import f\n",
        "hlr/scene/two.py": "def f():\n    from hlr.scene import three\n",
        "hlr/scene/three.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import hlr.scene.one\n",
        "hlr/scene/four.py": "from hlr.scene.one import g\n",
    }
    root = house(tmp_path, files)
    assert circles(root) == ["hlr.scene.one", "hlr.scene.three", "hlr.scene.two"]
    (root / "hlr/scene/three.py").write_text("")
    assert not circles(root)
