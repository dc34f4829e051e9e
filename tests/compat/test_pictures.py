"""The page that shows the drop-ins beside the originals."""

import re
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "drop_ins"


def test_the_page_shows_every_picture():
    text = (FOLDER / "README.md").read_text("utf-8")
    shown = set(re.findall(r"\]\(([^)]+)\)", text))
    assert {path.name for path in FOLDER.glob("*.png")} <= shown
    assert all((FOLDER / name).exists() for name in shown)
    assert len(re.findall(r"!\[", text)) == 5


def test_the_pictures_stay_small():
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 1e6
