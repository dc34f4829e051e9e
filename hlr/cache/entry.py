"""One entry of the cache as bytes: a header, JSON, then arrays. No pickle: nothing in it is executed.

    bytes    what
    8        MARK
    32       BLAKE2b of all that follows
    4, 8     lengths of the JSON and of the data, little-endian
    ...      JSON, an object; its "key" is the entry's own name
    ...      data, which the JSON describes

An entry in any other form is damaged and is not used.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from hashlib import blake2b
from typing import Any

MARK = b"hlr\x00brp1"
_DIGEST = 32
_LENGTHS = struct.Struct("<IQ")
HEAD = len(MARK) + _DIGEST + _LENGTHS.size


class DamagedError(Exception):
    """An entry cannot be used; says why."""


def packed(key: str, facts: dict[str, Any], data: Sequence[bytes]) -> list[bytes]:
    """The bytes of an entry, in pieces. facts: what becomes JSON: text, numbers, lists and dictionaries."""
    text = json.dumps({**facts, "key": key}, separators=(",", ":"), allow_nan=False).encode("ascii")
    lengths = _LENGTHS.pack(len(text), sum(map(len, data)))
    return [MARK, _digest(lengths, text, *data), lengths, text, *data]


def unpacked(key: str, entry: bytes) -> tuple[dict[str, Any], memoryview]:
    """The facts and the data of an entry.

    Raises:
        DamagedError: the bytes are no entry, are damaged, or belong to another key.
    """
    if len(entry) < HEAD or not entry.startswith(MARK):
        raise DamagedError("it is of another kind")
    view = memoryview(entry)
    text_length, data_length = _LENGTHS.unpack_from(entry, HEAD - _LENGTHS.size)
    if HEAD + text_length + data_length != len(entry):
        raise DamagedError("its length is not what it says")
    if _digest(view[HEAD - _LENGTHS.size :]) != entry[len(MARK) : len(MARK) + _DIGEST]:
        raise DamagedError("its checksum does not fit")
    try:
        facts = json.loads(bytes(view[HEAD : HEAD + text_length]))
    except (ValueError, RecursionError):
        raise DamagedError("its JSON is broken") from None
    if not isinstance(facts, dict) or facts.get("key") != key:
        raise DamagedError("it is another model's")
    return facts, view[HEAD + text_length :]


def _digest(*pieces: bytes | memoryview) -> bytes:
    found = blake2b(digest_size=_DIGEST)
    for piece in pieces:
        found.update(piece)
    return found.digest()
