"""Numbers that share out the accuracy stand in `hlr/request/accuracy.py`, the kernel's in its crate `accuracy`.

Such a number is told by what is said of it ("Of the accuracy: ...", "In deflections: ..."), or by what is done with it:
a number of the module's own is multiplied with an accuracy, a deflection or a contact depth. Numbers below 1e-5 are
rounding, and 8 for the height of a chord's arc: its length squared over 8 radii.
"""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = "hlr/request/accuracy.py"
KERNEL = "hlr/kernel/accuracy/src/lib.rs"

SAID = re.compile(r"\s*(Of|In) (the )?(accuracy|accuracies|deflections?|contact|chord tolerances?)\b")
ALLOWED = {1.0, 8.0}
LENGTHS = {"accuracy", "deflection", "contact", "contact_planar", "tolerance"}


def numbers_in_python(text):
    """(line, what) of each number in a module that shares out the accuracy."""
    tree = ast.parse(text)
    own = {}
    for node, after in zip(tree.body, [*tree.body[1:], None], strict=True):
        if isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]
            own.update(dict.fromkeys((name for name in names if name.isupper()), node.lineno))
            said = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) and after.value.value
            if isinstance(said, str) and SAID.match(said):
                yield node.lineno, ", ".join(names)
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div):
            length, number = node.right, node.left
            if last_name(length) not in LENGTHS:
                length, number = node.left, node.right
            if last_name(length) in LENGTHS:
                literal = isinstance(number, ast.Constant) and shares(number.value)
                if literal or (isinstance(number, ast.Name) and number.id in own):
                    yield node.lineno, ast.unparse(node)


def shares(number):
    """Whether it is a number that shares out something."""
    return number not in ALLOWED and abs(number) >= 1e-5


def last_name(node):
    """`deflection` of `image.tolerances.deflection`."""
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ""


def numbers_in_rust(text):
    """The same of a file of the kernel; its tests may say what they like."""
    lines = text.split("#[cfg(test)]")[0].splitlines()
    own = {found[1] for line in lines if (found := re.match(r"(?:pub(?:\(\w+\))? )?const (\w+): f64 =", line))}
    number, length = r"(?<![\w.])(\d+[.e][\de-]*|[A-Z][A-Z_]+)", r"(?:\w+\.)*(?:accuracy|deflection|chord)"
    for i, line in enumerate(lines, 1):
        code = line.split("//")[0]
        if re.match(r"\s*///", line) and SAID.match(line.strip()[3:]):
            following = next((after for after in lines[i:] if not after.startswith("///")), "")
            if re.match(r"(pub(\(\w+\))? )?const ", following):
                yield i, following
        for found in re.finditer(rf"{number} \* {length}\b(?!\()", code):
            if found[1] in own or (found[1][0].isdigit() and shares(float(found[1]))):
                yield i, found[0]


def stray_numbers(root):
    """All of them outside the two files, as sentences."""
    for top in ("hlr", "cli"):
        for path in sorted((root / top).rglob("*.py")):
            name = path.relative_to(root).as_posix()
            if name != PYTHON:
                yield from (f"{name}:{line}: {what}" for line, what in numbers_in_python(path.read_text("utf-8")))
    for path in sorted((root / "hlr/kernel").glob("*/src/**/*.rs")):
        name = path.relative_to(root).as_posix()
        if name != KERNEL and "fuzz" not in path.parts and path.name != "tests.rs" and "tests" not in path.parts:
            yield from (f"{name}:{line}: {what}" for line, what in numbers_in_rust(path.read_text("utf-8")))


def test_the_accuracy_is_shared_out_in_one_place():
    stray = list(stray_numbers(ROOT))
    assert not stray, "\n".join(stray)


def test_the_two_places_are_not_empty():
    assert list(numbers_in_python((ROOT / PYTHON).read_text("utf-8")))
    assert list(numbers_in_rust((ROOT / KERNEL).read_text("utf-8")))


def test_a_number_elsewhere_is_found(tmp_path):
    python = (
        "FIT = 0.1\n"
        '"""How near is near."""\n'
        "GAP: float = 2.0\n"
        '"""In deflections: what is closed."""\n'
        "def f(tolerances, accuracy, DIGITS):\n"
        "    return FIT * tolerances.accuracy + accuracy / 4.0 + DIGITS * accuracy + 1.0 / accuracy\n"
    )
    rust = (
        "/// Of the chord tolerance: what is closed.\n"
        "/// And no more.\n"
        "const GAP: f64 = 0.5;\n"
        "const STEPS: f64 = 3.0;\n"
        "fn f(m: &Model, accuracy: f64) -> f64 {\n"
        "    STEPS * m.chord + 0.25 * accuracy + SHARED * accuracy\n"
        "}\n"
        "#[cfg(test)]\n"
        "mod tests { fn g() { 0.3 * accuracy } }\n"
    )
    for name, text in (("hlr/scene/bad.py", python), ("hlr/kernel/linework/src/bad.rs", rust)):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text(text)
    assert list(stray_numbers(tmp_path)) == [
        "hlr/scene/bad.py:3: GAP",
        "hlr/scene/bad.py:6: FIT * tolerances.accuracy",
        "hlr/scene/bad.py:6: accuracy / 4.0",
        "hlr/kernel/linework/src/bad.rs:1: const GAP: f64 = 0.5;",
        "hlr/kernel/linework/src/bad.rs:6: STEPS * m.chord",
        "hlr/kernel/linework/src/bad.rs:6: 0.25 * accuracy",
    ]
