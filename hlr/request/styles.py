"""The built-in styles: a row for each."""

from __future__ import annotations

from hlr.request.style import STANDARD, LineRule, Style

STYLES: dict[str, Style] = {
    # ISO 128: line group 0.5, on large sheets 0.7.
    "iso": Style(),
    # ASME Y14.2: thick lines of at least 0.6 mm, thin ones of at least 0.3 mm; dashes of about 3 mm.
    "asme": Style(lines=(*STANDARD, LineRule(visible=False, dash=(10.0, 3.0))), wide=0.6, narrow=0.3),
    # For small pictures and dense models: the narrowest line group of ISO 128.
    "thin": Style(wide=0.25, narrow=0.13),
    "dark": Style(
        lines=(*STANDARD, LineRule(color="#e8e8e8"), LineRule(visible=False, color="#9a9a9a")), background="#1e1e1e"
    ),
    "blueprint": Style(
        lines=(*STANDARD, LineRule(color="#ffffff"), LineRule(visible=False, color="#b9d3f0")), background="#1b4a8a"
    ),
}
"""All of them, by name."""
