"""Tests share helpers through `support`: none imports another test, a helper of another folder, or bends the path."""

import ast
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]


def imported(path):
    """(line, dotted name) of all that a module takes from elsewhere."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.lineno, f"{node.module}.{alias.name}") for alias in node.names)


def wrong_imports(root):
    """Imports of test modules, of another folder's helpers, and of neighbours by their bare name, as sentences."""
    modules = {path.relative_to(root).with_suffix("").as_posix().replace("/", ".") for path in root.rglob("*.py")}
    for path in sorted(root.rglob("*.py")):
        here = path.relative_to(root).parts[0]
        for line, name in imported(path):
            target = name
            while target and target not in modules:
                target = target.rpartition(".")[0]
            folder, _, module = target.rpartition(".")
            there = folder.partition(".")[0]
            bare = (path.parent / f"{name.partition('.')[0]}.py").exists() and path.parent != root
            foreign = there not in ("", "support", here)
            if bare or module.startswith("test_") or foreign:
                yield f"{path.relative_to(root)}:{line}: {name}"


def bends_the_path(text):
    """Whether a program changes `sys.path`, itself or in a program that it writes."""
    return any(f"sys.path.{word}(" in text for word in ("append", "insert", "extend"))


def test_tests_share_helpers_through_support():
    assert not list(wrong_imports(TESTS))


def test_no_test_bends_the_path():
    assert not [path.name for path in TESTS.rglob("*.py") if bends_the_path(path.read_text("utf-8"))]


def test_tests_lie_in_folders():
    assert not list(TESTS.glob("test_*.py"))


def test_wrong_imports_are_found(tmp_path):
    files = {
        "support/shapes.py": "",
        "hard/models.py": "from support.shapes import box\n",
        "hard/test_a.py": "from hard.models import box\nimport models\n",
        "scene/test_b.py": "import support.shapes\nfrom hard import models\nfrom hard.test_a import box\n",
        "scene/helper.py": "from scene.test_b import box\nimport numpy\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    assert [sentence.replace("\\", "/") for sentence in wrong_imports(tmp_path)] == [
        "hard/test_a.py:2: models",
        "scene/helper.py:1: scene.test_b.box",
        "scene/test_b.py:2: hard.models",
        "scene/test_b.py:3: hard.test_a.box",
    ]


def test_a_bent_path_is_found():
    assert bends_the_path("sys.path" + ".insert(0, 'tests')")
    assert not bends_the_path("before = list(sys.path)")
