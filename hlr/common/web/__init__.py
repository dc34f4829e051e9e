"""What the web pages of hlr share: colours and controls, light and dark, the stage with zoom and pan, templates."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Template

ASSETS = Path(__file__).parent
"""Where base.css, stage.css, start.js, theme.js, zoom.js and zoom.html are."""


def shared() -> list[Path]:
    """The styles and scripts."""
    return sorted(path for path in ASSETS.iterdir() if path.suffix in (".css", ".js"))


def template(folder: Path, name: str) -> Template:
    """A template of a folder, which may include those beside it and the shared ones."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    found = Environment(
        loader=FileSystemLoader([folder, ASSETS]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return found.get_template(name)
