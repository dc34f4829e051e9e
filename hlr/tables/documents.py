"""Every JSON document that hlr writes: its format and version, which are its first two keys.

The page hlr/docs/json.md describes them key by key. A version becomes the next one where a key goes away or changes its
meaning; keys may be added within a version.
"""

from __future__ import annotations

from typing import Any

VERSIONS = {
    "hlr-drawing": 2,
    "hlr-page": 1,
    "hlr-summary": 1,
    "hlr-plan": 1,
    "hlr-info": 1,
    "hlr-cache": 1,
    "hlr-comparison": 1,
    "hlr-batch": 1,
    "hlr-error": 1,
}
"""The version of each format."""


def head(format: str) -> dict[str, Any]:
    """The keys that a document of this format begins with."""
    return {"format": format, "version": VERSIONS[format]}
