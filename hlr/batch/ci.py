"""Failures and warnings in the forms of CI services: lines that GitHub shows beside a file, GitLab's code quality."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from hashlib import sha256
from pathlib import Path, PurePosixPath
from typing import Any

from hlr.batch.junit import title


def _told(found: dict[str, Any]) -> Iterator[tuple[str, str, str, str]]:
    """(level, path, title, message) for each failure and each warning."""
    for source in found["sources"]:
        if source["error"] is not None:
            yield "error", source["source"], title(source), source["error"]["message"]
        notes = [note["text"] for drawing in source["drawings"] for note in drawing["notes"] if note["warning"]]
        for text in dict.fromkeys(notes):
            yield "warning", source["source"], title(source), text


def github(found: dict[str, Any], root: Path, environment: Mapping[str, str]) -> list[str]:
    """Lines for standard output, by which GitHub shows failures and warnings; none elsewhere.

    root: of the batch; GitHub takes paths as seen from the repository.
    """
    if environment.get("GITHUB_ACTIONS") != "true":
        return []
    home = environment.get("GITHUB_WORKSPACE") or os.getcwd()
    lines = []
    for level, path, name, message in _told(found):
        file = Path(os.path.relpath(root / path, home)).as_posix()
        place = f"file={_property(file)}" + (f",line={line}" if (line := _line(path, message)) else "")
        lines.append(f"::{level} {place},title={_property(name)}::{_data(message)}")
    return lines


def code_quality(found: dict[str, Any], environment: Mapping[str, str]) -> bytes | None:
    """GitLab's report of code quality; None where GitLab does not run the batch."""
    if environment.get("GITLAB_CI") != "true":
        return None
    rows = [
        {
            "description": message,
            "check_name": f"hlr-{level}",
            "fingerprint": sha256(f"{level}\0{name}\0{message}".encode("utf-8", "replace")).hexdigest(),
            "severity": "major" if level == "error" else "minor",
            "location": {"path": path, "lines": {"begin": _line(path, message) or 1}},
        }
        for level, path, name, message in _told(found)
    ]
    return json.dumps(rows, indent=1).encode("ascii") + b"\n"


def _line(path: str, message: str) -> int | None:
    """The line of the source that a message begins with; None: it names none."""
    found = re.match(rf"(?:{re.escape(path)}|{re.escape(PurePosixPath(path).name)}), line (\d+)\b", message)
    return int(found[1]) if found else None


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
