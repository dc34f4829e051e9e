"""What the web pages of hlr share: colours and controls, light and dark, zoom and pan."""

from __future__ import annotations

from pathlib import Path

ASSETS = Path(__file__).parent
"""Where base.css, start.js, theme.js and zoom.js are."""


def shared() -> list[Path]:
    """The styles and scripts."""
    return sorted(path for path in ASSETS.iterdir() if path.suffix in (".css", ".js"))
