"""The report as Markdown, for the summary of a CI job: what failed, what was warned of, and the slowest sources."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from hlr.batch.junit import title
from hlr.batch.script_output import last_lines
from hlr.errors import counted

_MOST_ROWS = 200
"""Of a table: CI services refuse long summaries."""

_SLOWEST = 10

_MOST_PRINTED, _LINES_PRINTED = 20, 20
"""Of scripts that failed: how many have shown what they printed, and the last lines of each."""


_CONTROLS = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")


def document(found: dict[str, Any]) -> bytes:
    """Markdown."""
    counts, sources = found["counts"], found["sources"]
    head = (
        f"{counted(counts['drawings'], 'drawing')} of {counted(counts['sources'], 'source')}, "
        f"{counts['failed']} failed, {counts['warned']} with warnings."
    )
    failed = [(title(source), source["error"]["message"]) for source in sources if source["error"]]
    warned = [
        (title(source), text)
        for source in sources
        for text in dict.fromkeys(n["text"] for d in source["drawings"] for n in d["notes"] if n["warning"])
    ]
    begun = (source for source in sources if "cost" in source and source["cost"]["seconds"] > 0.0)
    slowest = sorted(begun, key=lambda source: -source["cost"]["seconds"])[:_SLOWEST]
    parts = [
        f"# Drawings\n\n{head}\n",
        _changed(found),
        _table(
            "Stale",
            ("drawing", "its source"),
            [(s["file"], s["source"]) for s in found.get("stale", ())],
        ),
        _table("Failed", ("source", "why"), failed),
        _printed(sources),
        _table("Warnings", ("source", "warning"), warned),
        _table(
            "Slowest",
            ("source", "seconds", "memory, MB"),
            [(title(s), f"{s['cost']['seconds']:.2f}", _memory(s)) for s in slowest],
        ),
    ]
    return "\n".join(filter(None, parts)).encode("utf-8", "replace")


def _printed(sources: Sequence[dict[str, Any]]) -> str:
    """The last lines that scripts have printed which failed."""
    parts = []
    for source in sources:
        lines = last_lines((source["error"] or {}).get("printed", ""), _LINES_PRINTED)
        if lines:
            # Indented by four, a text is shown as it is, whatever is in it.
            shown = "\n".join(f"    {_CONTROLS.sub('?', line)}" for line in lines)
            parts.append(f"{_cell(title(source))} printed:\n\n{shown}\n")
    return "\n".join(parts[:_MOST_PRINTED])


def _changed(found: dict[str, Any]) -> str:
    """What differs from the baseline, where there is one."""
    drawings = [drawing for source in found["sources"] for drawing in source["drawings"]]
    rows = [
        (next(iter(drawing["files"].values())), drawing["change"]["state"], drawing["change"]["summary"])
        for drawing in drawings
        if drawing.get("change", {}).get("state", "unchanged") != "unchanged"
    ]
    rows += [(name, "gone", "no longer drawn") for name in found.get("gone", ())]
    return _table("Changed", ("drawing", "state", "what"), rows)


def _memory(source: dict[str, Any]) -> str:
    """What a source took; of one that was ended, nobody knows."""
    taken = source["cost"]["peak_memory_mb"]
    return f"{taken:.0f}" if taken else "unknown"


def _table(heading: str, columns: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    if not rows:
        return ""
    lines = [f"## {heading}", "", f"| {' | '.join(columns)} |", "|" + " --- |" * len(columns)]
    lines += [f"| {' | '.join(map(_cell, row))} |" for row in rows[:_MOST_ROWS]]
    if len(rows) > _MOST_ROWS:
        lines += ["", f"{len(rows) - _MOST_ROWS} more stand in manifest.json."]
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    """A text as it is: names of files and parts may hold what Markdown or HTML would read."""
    plain = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"([\\`*_\[\]|~])", r"\\\1", plain)
