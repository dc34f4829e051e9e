"""Entries of a cache, made up."""

from hlr.cache.entry import packed

KEY = "a" * 40


def entry(key=KEY, size=500, **facts):
    return packed(key, facts, [bytes(range(256)) * (size // 256), bytes(size % 256)])


def key(number):
    return f"{number:040x}"
