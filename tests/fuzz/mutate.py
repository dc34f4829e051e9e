"""Broken files from sound ones: each mutation is one that storage, transfer, bad exporters or bad will make."""

from __future__ import annotations

import io
import json
import random
import re
import struct
import zipfile
from collections.abc import Callable, Sequence

EXTREMES = (
    b"0 -0 -1 1 1e308 -1e308 1e-320 nan inf 2147483647 2147483648 -2147483648 4294967295 9223372036854775807 1e9999 "
    b"1111111111111111111111111111111111111111 0.0 * $"
).split()
NUMBER = re.compile(rb"(?<![\w.#])-?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
REFERENCE = re.compile(rb"#\d+")
WORD = re.compile(rb"[A-Za-z_]{3,}")
PRINTABLE = frozenset(range(32, 127)) | frozenset(b"\t\r\n")


def mutate(rng: random.Random, kind: str, data: bytes, others: Sequence[bytes]) -> bytes:
    """One to four mutations of a file of this kind; others: what may be spliced in."""
    if kind == "3mf" and rng.random() < 0.7:
        return _within_zip(rng, data, others)
    if kind == "glb" and rng.random() < 0.6:
        return _within_glb(rng, data)
    ways: list[Callable[[], bytes]] = []
    for _ in range(rng.choice((1, 1, 2, 4))):
        text = all(byte in PRINTABLE for byte in data[:200])
        ways = [_number, _number, _reference, _reference, _word, _line] if text else [_word32, _word32, _number]
        ways += [_flip, _byte, _cut, _delete, _repeat]
        way = rng.choice(ways)
        data = _splice(rng, data, others) if rng.random() < 0.1 else way(rng, data)
    return data


def _at(rng: random.Random, data: bytes) -> int:
    return rng.randrange(len(data)) if data else 0


def _flip(rng: random.Random, data: bytes) -> bytes:
    at = _at(rng, data)
    return data[:at] + bytes(byte ^ 1 << rng.randrange(8) for byte in data[at : at + 1]) + data[at + 1 :]


def _byte(rng: random.Random, data: bytes) -> bytes:
    at = _at(rng, data)
    return data[:at] + bytes([rng.choice((0, 0xFF, 0x7F, 0x80, 10, 32, rng.randrange(256)))]) + data[at + 1 :]


def _cut(rng: random.Random, data: bytes) -> bytes:
    return data[: _at(rng, data)] if rng.random() < 0.5 else data[: max(0, len(data) - rng.randrange(1, 200))]


def _delete(rng: random.Random, data: bytes) -> bytes:
    at = _at(rng, data)
    return data[:at] + data[at + rng.choice((1, 2, 4, 16, 200)) :]


def _repeat(rng: random.Random, data: bytes) -> bytes:
    at, size = _at(rng, data), rng.choice((1, 4, 16, 200))
    return data[:at] + data[at : at + size] * rng.choice((2, 3, 100)) + data[at + size :]


def _splice(rng: random.Random, data: bytes, others: Sequence[bytes]) -> bytes:
    other = rng.choice(others)
    return data[: _at(rng, data)] + other[_at(rng, other) :]


def _word32(rng: random.Random, data: bytes) -> bytes:
    at = _at(rng, data) // 4 * 4
    if rng.random() < 0.4:
        at = rng.randrange(0, 100, 4)  # headers
    value = rng.choice((0, 1, 0xFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7FC00000, 0x7F800000, rng.getrandbits(32)))
    return data[:at] + struct.pack("<I", value) + data[at + 4 :]


def _swap(rng: random.Random, data: bytes, pattern: re.Pattern[bytes], more: Sequence[bytes] = ()) -> bytes:
    """One match replaced by another of the same file, or by one of `more`."""
    found = list(pattern.finditer(data))
    if not found:
        return _byte(rng, data)
    place = rng.choice(found)
    new = rng.choice(more) if more and rng.random() < 0.7 else rng.choice(found).group()
    return data[: place.start()] + new + data[place.end() :]


def _number(rng: random.Random, data: bytes) -> bytes:
    return _swap(rng, data, NUMBER, EXTREMES)


def _reference(rng: random.Random, data: bytes) -> bytes:
    return _swap(rng, data, REFERENCE)


def _word(rng: random.Random, data: bytes) -> bytes:
    return _swap(rng, data, WORD)


def _line(rng: random.Random, data: bytes) -> bytes:
    lines = data.splitlines(keepends=True)
    i, j = rng.randrange(len(lines)) if lines else 0, rng.randrange(len(lines)) if lines else 0
    if rng.random() < 0.3:
        del lines[i : i + 1]
    elif lines:
        lines[i] = lines[j] if rng.random() < 0.5 else lines[i] * rng.choice((2, 50))
    return b"".join(lines)


def _within_zip(rng: random.Random, data: bytes, others: Sequence[bytes]) -> bytes:
    """The archive stays whole, one of its files does not."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
    except Exception:  # a seed that is broken already
        return _flip(rng, data)
    name = rng.choice([name for name in files if name.endswith(".model")] or list(files))
    files[name] = mutate(rng, "xml", files[name], others)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content)
    return out.getvalue()


def _within_glb(rng: random.Random, data: bytes) -> bytes:
    """The JSON part is still JSON, and its length is right."""
    try:
        size = struct.unpack_from("<I", data, 12)[0]
        tree = json.loads(data[20 : 20 + size])
    except (struct.error, ValueError):
        return _flip(rng, data)
    for _ in range(rng.choice((1, 1, 3))):
        _change(rng, tree)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size :]
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


def _change(rng: random.Random, tree: object) -> None:
    """Another value somewhere in a tree of lists and dictionaries."""
    while True:
        keys: list[object] = list(tree) if isinstance(tree, dict) else list(range(len(tree)))  # type: ignore[arg-type]
        if not keys:
            return
        key = rng.choice(keys)
        inner = tree[key]  # type: ignore[index]
        if isinstance(inner, dict | list) and inner and rng.random() < 0.8:
            tree = inner
            continue
        values = [0, -1, 1, 3, 2**31, 2**53, 10**30, 1e308, float("nan"), None, [], {}, "x", True, [0] * 16, inner]
        tree[key] = rng.choice(values)  # type: ignore[index]
        return
