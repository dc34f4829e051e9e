"""The folder of entries: what is in it, what goes, what is nobody's business."""

import errno
import os
import random
import signal
import subprocess
import sys
import time

import pytest
from cache.entries import KEY, entry, key

from hlr.cache.entry import HEAD, MARK, DamagedError, unpacked
from hlr.cache.folder import folder, most_bytes
from hlr.cache.store import NotKeptError, Store
from hlr.errors import OptionError
from support.programs import environment


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path / "deep" / "cache", 10_000)


def test_what_was_written_is_read(store):
    store.write(KEY, entry(name="a", numbers=[1.5, None]))
    facts, data = unpacked(KEY, store.read(KEY))
    assert facts == {"name": "a", "numbers": [1.5, None], "key": KEY}
    assert len(data) == 500
    assert store.read(key(1)) is None


def test_only_its_owner_can_look_into_the_folder(store):
    store.write(KEY, entry())
    assert store.folder.stat().st_mode & 0o777 == 0o700
    assert store.path(KEY).stat().st_mode & 0o777 == 0o600


def test_a_change_of_any_byte_is_seen():
    whole = b"".join(entry(size=100, name="a"))
    assert unpacked(KEY, whole)
    for at in range(len(whole)):
        for change in (1, 0x80):
            damaged = bytearray(whole)
            damaged[at] ^= change
            with pytest.raises(DamagedError):
                unpacked(KEY, bytes(damaged))


def test_an_entry_that_is_cut_or_lengthened_is_damaged():
    whole = b"".join(entry(size=100))
    for length in range(len(whole)):
        with pytest.raises(DamagedError):
            unpacked(KEY, whole[:length])
    with pytest.raises(DamagedError):
        unpacked(KEY, whole + b"\0")


def test_an_entry_under_another_name_is_damaged():
    with pytest.raises(DamagedError, match="another model"):
        unpacked(key(1), b"".join(entry()))


def test_lengths_beyond_all_measure_take_no_memory():
    head = MARK + bytes(32) + b"\xff" * 12
    assert len(head) == HEAD
    with pytest.raises(DamagedError, match="length"):
        unpacked(KEY, head)


@pytest.mark.parametrize("text", [b"[" * 100_000, b"\xff\xfe", b"[]", b"1", b'{"key":1}', b"NaN"])
def test_json_that_is_none_is_damage(text, monkeypatch):
    import json

    class Text(str):
        def encode(self, *_):
            return text

    monkeypatch.setattr(json, "dumps", lambda *_, **__: Text())
    made = b"".join(entry())
    with pytest.raises(DamagedError):
        unpacked(KEY, made)


def test_the_least_recently_used_goes_first(store):
    size = sum(map(len, entry(size=3000)))
    assert 3 * size < store.most < 4 * size
    for number in range(3):
        store.write(key(number), entry(key(number), 3000))
        os.utime(store.path(key(number)), (1000 + number, 1000 + number))
    store.touch(key(0))
    store.write(key(3), entry(key(3), 3000))
    assert {kept.path for kept in store.entries()} == {store.path(key(n)) for n in (0, 2, 3)}


def test_an_entry_larger_than_the_cache_is_not_kept_and_drives_nobody_out(store):
    store.write(KEY, entry())
    with pytest.raises(NotKeptError, match="MB"):
        store.write(key(1), entry(key(1), 20_000))
    assert [kept.path for kept in store.entries()] == [store.path(KEY)]


def test_files_of_others_stay(store):
    store.write(KEY, entry())
    others = ["thesis.pdf", "x.model", f"{KEY}.model.bak", "A" * 40 + ".model"]
    for name in others:
        (store.folder / name).write_bytes(b"mine" * 5000)
    (store.folder / f"{'b' * 40}.model").mkdir()
    store.write(key(1), entry(key(1)))
    assert len(store.clear()) == 2
    assert sorted(path.name for path in store.folder.iterdir()) == sorted([*others, f"{'b' * 40}.model"])


def test_what_is_no_file_is_not_waited_for(store):
    store.write(KEY, entry())
    os.mkfifo(store.path(key(1)))
    store.path(key(2)).mkdir()
    os.symlink("/dev/zero", store.path(key(3)))
    assert all(store.read(key(n)) is None for n in (1, 2, 3))
    with pytest.raises(NotKeptError, match="directory"):
        store.write(key(2), entry(key(2)))


def test_halves_that_nobody_writes_any_more_go(store):
    store.write(KEY, entry())
    old, new = (store.folder / f"{KEY}.model.{name}.part" for name in ("old", "new"))
    for half in (old, new):
        half.write_bytes(b"half")
    os.utime(old, (1000, 1000))
    Store(store.folder, store.most).write(key(1), entry(key(1)))
    assert not old.exists()
    assert new.exists()
    store.clear()
    assert list(store.folder.iterdir()) == []


def test_a_folder_that_cannot_be_made_is_a_reason(tmp_path):
    (tmp_path / "file").write_bytes(b"")
    store = Store(tmp_path / "file" / "cache", 10_000)
    with pytest.raises(NotKeptError, match="not a directory"):
        store.write(KEY, entry())
    assert store.read(KEY) is None
    assert store.entries() == store.clear() == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_is_read_only_is_a_reason(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(NotKeptError, match="permission denied"):
        Store(tmp_path, 10_000).write(KEY, entry())
    with pytest.raises(NotKeptError, match="permission denied"):
        Store(tmp_path / "deeper", 10_000).write(KEY, entry())


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EROFS, errno.EACCES, errno.EDQUOT])
def test_a_disk_that_does_not_take_it_is_a_reason_and_keeps_no_half(store, monkeypatch, number):
    store.write(KEY, entry())

    def refuse(*_):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(NotKeptError, match=os.strerror(number).lower()):
        store.write(key(1), entry(key(1)))
    assert list(store.folder.iterdir()) == [store.path(KEY)]


def test_a_full_disk_leaves_the_old_entry(store, tmp_path):
    """The limit on a file's size stands for it: the write itself fails half-way."""
    store.write(KEY, entry(size=100))
    program = (
        "import resource, signal, sys; from pathlib import Path; from hlr.cache.store import Store, NotKeptError\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN); resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
        "try: Store(Path(sys.argv[1]), 10**6).write('a' * 40, [bytes(100)] * 1000)\n"
        "except NotKeptError as error: print(error)"
    )
    said = subprocess.run(
        [sys.executable, "-P", "-c", program, str(store.folder)], capture_output=True, text=True, check=True
    ).stdout
    assert "file too large" in said
    assert list(store.folder.iterdir()) == [store.path(KEY)]
    assert unpacked(KEY, store.read(KEY))


WRITER = """
import sys
from pathlib import Path
from cache.entries import entry, key
from hlr.cache.store import Store
store = Store(Path(sys.argv[1]), 200_000)
print("ready", flush=True)
for turn in range(int(sys.argv[2])):
    number = turn % 5
    store.write(key(number), entry(key(number), 30_000 + turn))
"""


def writer(store, turns):
    command = [sys.executable, "-P", "-c", WRITER, str(store.folder), str(turns)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment())


@pytest.mark.slow
def test_two_may_write_and_a_third_may_read_at_once(store):
    store.most = 200_000
    writers = [writer(store, 300) for _ in range(2)]
    seen = 0
    while any(process.poll() is None for process in writers):
        found = store.read(key(seen % 5))
        if found is not None:
            unpacked(key(seen % 5), found)
            seen += 1
    assert [process.wait() for process in writers] == [0, 0]
    assert seen
    assert all(process.stdout.read() == "ready\n" for process in writers)
    assert [kept.path.suffix for kept in store.entries()] == [".model"] * 5
    assert len(list(store.folder.iterdir())) == 5


@pytest.mark.slow
def test_whoever_is_killed_while_writing_leaves_no_damage(store):
    store.most = 200_000
    waits = random.Random(1)
    for _ in range(8):
        process = writer(store, 1_000_000)
        process.stdout.readline()
        time.sleep(waits.uniform(0.0, 0.05))
        process.send_signal(signal.SIGKILL)
        process.wait()
        for kept in store.entries():
            name = kept.path.name.removesuffix(".model")
            unpacked(name, store.read(name))


def test_the_folder_is_that_of_the_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("HLR_CACHE", str(tmp_path / "mine"))
    assert folder() == tmp_path / "mine"
    monkeypatch.setenv("HLR_CACHE", "~/mine")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert folder() == tmp_path / "mine"
    for word in ("off", " OFF ", "0", "no", "none"):
        monkeypatch.setenv("HLR_CACHE", word)
        assert folder() is None
    for word in (None, ""):
        monkeypatch.setenv("HLR_CACHE", word) if word is not None else monkeypatch.delenv("HLR_CACHE")
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "usual"))
        assert folder().name == "hlr"
        if sys.platform == "linux":
            assert folder() == tmp_path / "usual" / "hlr"


@pytest.mark.parametrize(
    ("text", "size"),
    [("", 10**9), ("1gb", 10**9), ("500 MB", 5 * 10**8), ("0.5GiB", 1 << 29), ("1000", 1000), ("0", 0), ("2k", None)],
)
def test_the_size_is_that_of_the_environment(monkeypatch, text, size):
    monkeypatch.setenv("HLR_CACHE_SIZE", text)
    if size is not None:
        assert most_bytes() == size
        return
    with pytest.raises(OptionError, match="HLR_CACHE_SIZE is '2k': give a size such as 500MB or 2GB"):
        most_bytes()


@pytest.mark.parametrize("text", ["-1", "nan", "1e9", "inf", "GB", "1PB", "１GB", "9" * 40])
def test_what_is_no_size_is_refused(monkeypatch, text):
    monkeypatch.setenv("HLR_CACHE_SIZE", text)
    with pytest.raises(OptionError):
        most_bytes()


def test_a_thousand_entries_are_written_without_looking_at_all_of_them_each_time(store, monkeypatch):
    looks, look = [], store.entries
    monkeypatch.setattr(store, "entries", lambda: looks.append(1) or look())
    for number in range(1000):
        store.write(key(number), [b"x" * 10])
    assert len(looks) < 20
    # Another process fills the folder: that is noticed before long.
    store.most = 100_000
    (store.folder / f"{'c' * 40}.model").write_bytes(b"x" * 200_000)
    os.utime(store.folder / f"{'c' * 40}.model", (1000, 1000))
    for number in range(40):
        store.write(key(1000 + number), [b"x" * 1000])
    assert sum(kept.size for kept in store.entries()) <= 100_000
