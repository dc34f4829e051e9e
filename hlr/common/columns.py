"""Columns of text, as a terminal shows them."""

from __future__ import annotations


def columns(text: str) -> int:
    """How many columns a text takes: two for a letter of Chinese, Japanese or Korean, none for a combining accent."""
    if text.isascii():
        return len(text)
    from rich.cells import cell_len

    return cell_len(text)


def left(text: str, width: int) -> str:
    """The text at the left of so many columns."""
    return text + " " * (width - columns(text))


def right(text: str, width: int) -> str:
    """The text at the right of so many columns."""
    return " " * (width - columns(text)) + text
