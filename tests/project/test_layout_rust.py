"""The modules of each crate of the kernel use one another in one direction: no circles."""

import re
from pathlib import Path

import pytest

KERNEL = Path(__file__).resolve().parents[2] / "hlr/kernel"
CRATES = ("accuracy", "exact", "brep", "mesh", "visibility", "linework", "preview", "methods", "python", "fuzz")

WORD = re.compile(r"\w+")
USE = re.compile(r"(?m)^\s*(pub(?:\(\w+\))?\s+)?use\s+([^;]+);")
# A path in the text of a function or type: `crate::a::b`, `super::a`, or `child::f` of a module declared here.
PATH = re.compile(r"(?<![\w:])(?:[a-z_]\w*::)+\w*")


def without_tests(text):
    """The text of a Rust file without comments, strings and test modules."""
    text = re.sub(r"//[^\n]*", "", text)
    text = re.sub(r'"(?:\\.|[^"\\])*"', '""', text, flags=re.S)
    # rustfmt puts the brace that ends an item in the column where the item begins.
    text = re.sub(r"(?ms)^( *)#\[cfg\(test\)\]\n(?:\1#\[[^\n]*\n)*\1(?:pub(?:\(\w+\))? )?mod \w+ \{.*?^\1\}", "", text)
    return re.sub(r"(?ms)^( *)#\[cfg\(test\)\]\n\1[^\n]*(?:;|\{\n.*?^\1\})", "", text)


def split(text):
    """The parts of a list between its outermost commas."""
    depth, parts, start = 0, [], 0
    for at, letter in enumerate(text):
        depth += (letter == "{") - (letter == "}")
        if letter == "," and not depth:
            parts.append(text[start:at])
            start = at + 1
    return [part.strip() for part in [*parts, text[start:]] if part.strip()]


def names(tree):
    """Paths of a use tree, `a::{b, c::d as e}`: (path, name it has here)."""
    head, brace, rest = tree.partition("{")
    if brace:
        base = WORD.findall(head)
        for part in split(rest.rpartition("}")[0]):
            for path, name in names(part):
                yield [*base, *(path[1:] if path[:1] == ["self"] else path)], name if path != ["self"] else base[-1]
    else:
        path, _, other = tree.partition(" as ")
        found = re.findall(r"\w+|\*", path)
        yield found, other.strip() or found[-1]


def modules(crate):
    """Modules of a crate, as tuples of names from its root, and the text of each. Files of tests are left out."""
    found = {}
    for path in sorted((crate / "src").rglob("*.rs")):
        parts = path.relative_to(crate / "src").with_suffix("").parts
        if "tests" not in parts:
            found[parts[:-1] if parts[-1] in ("mod", "lib") else parts] = without_tests(path.read_text("utf-8"))
    return found


def absolute(path, here, known):
    """A path that begins at `crate`, `super`, `self` or a module declared here, from the root; None for others."""
    base = here
    if path[0] == "crate":
        base, path = (), path[1:]
    elif path[0] in ("self", "super"):
        while path and path[0] in ("self", "super"):
            base = base[:-1] if path[0] == "super" else base
            path = path[1:]
    elif (*here, path[0]) not in known:
        return None
    return (*base, *path)


def onward(crate):
    """The modules that each module uses. A name that is only handed on counts as used where it comes from."""
    known = modules(crate)
    handed_on, wanted = {}, {}
    for here, text in known.items():
        wanted[here] = []
        for public, tree in USE.findall(text):
            for path, name in names(tree):
                target = absolute(path, here, known)
                if target and public:
                    handed_on[*here, name] = target
                elif target:
                    wanted[here].append(target)
        for path in PATH.findall(USE.sub("", text)):
            target = absolute(WORD.findall(path), here, known)
            if target:
                wanted[here].append(target)

    def source(target):
        for length in range(len(target), 0, -1):
            if target[:length] in handed_on and target[:length] not in known:
                return source((*handed_on[target[:length]], *target[length:]))
        while target not in known:
            target = target[:-1]
        return target

    return {here: {source(target) for target in targets} - {here} for here, targets in wanted.items()}


def circles(crate):
    """Groups of modules of which each uses every other, directly or through others."""
    arrows = onward(crate)

    def all_from(start):
        met, todo = set(), [start]
        while todo:
            new = arrows[todo.pop()] - met
            met |= new
            todo += new
        return met

    reached = {name: all_from(name) for name in arrows}
    groups = {frozenset(other for other in reached[name] if name in reached[other]) for name in arrows}
    return sorted(sorted("::".join(one) or "lib" for one in group) for group in groups if group)


@pytest.mark.parametrize("crate", CRATES)
def test_no_modules_use_one_another(crate):
    assert not circles(KERNEL / crate)


def test_a_circle_is_found(tmp_path):
    files = {
        "lib.rs": "pub mod one;\npub use one::two::Two;\n",
        "one/mod.rs": "pub mod two;\nmod three;\nuse two::Two;\n",
        "one/two.rs": "use super::three::{\n    self, f as g,\n};\n",
        "one/three.rs": "fn f(x: crate::Two) {}\n",
        "four.rs": "use crate::one::Two;\n#[cfg(test)]\nmod tests {\n    use crate::five::f;\n}\n",
        "five.rs": "fn f() { super::four::g() }\n",
    }
    for name, text in files.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    assert circles(tmp_path) == [["one::three", "one::two"]]
    (tmp_path / "src/one/three.rs").write_text("// use super::two::Two;\n")
    assert not circles(tmp_path)
