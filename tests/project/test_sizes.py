"""Files end at 400 lines: what is longer is more than one concept."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST_LINES = 400
FOLDERS = ("hlr", "cli", "tests", "examples")
LONGER = {"hlr/_kernel.pyi"}
"""Files that are one concept all the same: one module has one stub."""


def long_files(root):
    """Files of Python and Rust with more lines: name and lines."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in (".py", ".pyi", ".rs") and "target" not in path.parts and name not in LONGER:
                lines = path.read_text("utf-8").count("\n")
                if lines > MOST_LINES:
                    yield f"{name}: {lines} lines"


def test_no_file_is_long():
    assert not list(long_files(ROOT))


def test_a_long_file_is_found(tmp_path):
    (tmp_path / "hlr").mkdir()
    for count in (400, 401):
        (tmp_path / "hlr" / f"of_{count}.py").write_text("pass\n" * count)
    assert list(long_files(tmp_path)) == ["hlr/of_401.py: 401 lines"]
