"""Names and texts out of files, made fit for a terminal: whoever wrote the file must not control the screen."""

from __future__ import annotations


def printable(text: str) -> str:
    """The text as one line: line ends, control characters and all else that cannot be seen are escaped, as by `repr`.

    >>> print(printable("a" + chr(27) + "[2Jb" + chr(10)))
    a\\x1b[2Jb\\n
    """
    return text if text.isprintable() else "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
