"""Whatever is asked, the answer is a drawing or an HlrError in one sentence: the check of all tests that ask oddly."""

from __future__ import annotations

from typing import Any

import numpy as np

import hlr


def drawn_or_refused(source: Any, view: Any = "iso", *, longest: int = 300, **options: Any) -> bool:
    """True where it was drawn, False where refused in `longest` characters at most; another error escapes."""
    try:
        drawing = hlr.draw(source, view, **options)
    except hlr.HlrError as error:
        text = str(error)
        assert text
        assert "\n" not in text
        assert "Traceback" not in text
        assert len(text) < longest
        return False
    for line in drawing.lines:
        assert np.isfinite(line.points).all()
        assert np.isfinite(line.points3).all()
        assert len(line.points) >= 2
    return True
