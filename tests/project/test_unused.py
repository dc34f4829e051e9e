"""Nothing is defined that is mentioned nowhere else: a function, class, constant or method without a use is removed."""

import ast
import re
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CALLED_BY_OTHERS = ("hlr/compat/", "hlr/testing/plugin.py")
"""Files whose functions another program calls by name."""

USERS = ("*.py", "*.rs", "*.html", "*.js", "*.toml")


def definitions(tree):
    """Names that a module defines: its own, and those of its classes without a base, which may demand a method."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Module | ast.ClassDef) or (isinstance(node, ast.ClassDef) and node.bases):
            continue
        for each in node.body:
            if isinstance(each, ast.FunctionDef | ast.ClassDef):
                yield each.name
            elif isinstance(each, ast.Assign | ast.AnnAssign):
                targets = each.targets if isinstance(each, ast.Assign) else [each.target]
                yield from (target.id for target in targets if isinstance(target, ast.Name))


def unused(root, folders=("hlr", "cli")):
    """File and name of each definition whose name stands nowhere else in the code and its tests."""
    files = {
        path.relative_to(root).as_posix(): path.read_text("utf-8")
        for folder in (*folders, "tests", "examples")
        for ending in USERS
        for path in (root / folder).rglob(ending)
        if "target" not in path.parts
    }
    files = {name: text for name, text in files.items() if not name.startswith("hlr/cli/")}
    mentioned = Counter(word for text in files.values() for word in re.findall(r"\w+", text))
    for name, text in sorted(files.items()):
        if name.endswith(".py") and name.startswith(folders) and not name.startswith(CALLED_BY_OTHERS):
            for defined in definitions(ast.parse(text)):
                if mentioned[defined] == 1 and not defined.startswith("__"):
                    yield name, defined


def test_everything_that_is_defined_is_used():
    # Python's import system calls the two.
    assert set(unused(ROOT)) <= {("hlr/source/cad/viewers.py", name) for name in ("create_module", "exec_module")}


def test_what_is_not_used_is_found(tmp_path):
    (tmp_path / "hlr").mkdir()
    (tmp_path / "hlr" / "a.py").write_text(
        "ALONE = 1\nSHARED = 2\n\nclass Own:\n    def lost(self):\n        return SHARED\n\n"
        "class Child(Own):\n    def asked_for_by_base(self):\n        return Child\n"
    )
    assert list(unused(tmp_path)) == [("hlr/a.py", "ALONE"), ("hlr/a.py", "lost")]
