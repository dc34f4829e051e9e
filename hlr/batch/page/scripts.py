"""Files of script that hold data: a page that is opened from disk may load scripts, and no other file."""

from __future__ import annotations

import base64
import json
import re
import zlib
from hashlib import blake2b
from typing import Any

_LITERAL = {ord(c): f"\\u{ord(c):04x}" for c in "<>&\u2028\u2029"}
"""Characters by which a text might end the script that it stands in."""


def data(value: Any) -> bytes:
    """A script that hands a value to the page."""
    return f"hlr.batch = {json.dumps(value).translate(_LITERAL)};\n".encode("ascii")


def drawing(key: str, svg: bytes) -> bytes:
    """A script that hands a drawing to the page, compressed. Its first line says of which content it is made."""
    content = base64.b64encode(zlib.compress(svg, 6)).decode("ascii")
    return f'{_head(svg)}hlr.unpack("{key}", "{content}");\n'.encode("ascii")


def is_of(script: bytes, svg: bytes) -> bool:
    """Whether a script hands over this drawing. script: its first line is enough."""
    return script.startswith(_head(svg).encode("ascii"))


HEAD_BYTES = 64
"""No first line is longer."""


def stamp(*contents: bytes) -> str:
    """A digest of contents, in 40 hexadecimal digits."""
    digest = blake2b(digest_size=20)
    for content in contents:
        digest.update(len(content).to_bytes(8, "little") + content)
    return digest.hexdigest()


def stamped(text: bytes) -> str:
    """The stamp that a page bears; empty where there is none."""
    match = re.search(rb'<meta name="made-of" content="([0-9a-f]{40})">', text)
    return match[1].decode("ascii") if match else ""


def _head(svg: bytes) -> str:
    return f"// {stamp(svg)}\n"
