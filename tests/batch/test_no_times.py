"""With --no-times two runs write the same folder, byte for byte, though each has drawn everything."""

import json
import os
import subprocess
import sys

import pytest
from batch.models import tetrahedron


def run(folder, *arguments):
    line = [sys.executable, "-P", "-m", "hlr", "batch", "-j", "1", "--view", "front", *arguments]
    env = os.environ | {"HLR_CACHE": "off"}
    done = subprocess.run(line, check=False, capture_output=True, text=True, timeout=120, cwd=folder, env=env)
    assert done.returncode == 1, done.stderr
    found = {path.relative_to(folder / "drawings"): path for path in (folder / "drawings").rglob("*")}
    return {name: path.read_bytes() for name, path in found.items() if path.is_file()}


@pytest.mark.slow
def test_the_report_without_times_is_the_same_each_time(tmp_path):
    tetrahedron(tmp_path / "a.off")
    (tmp_path / "broken.off").write_text("OFF\n1 1 1\n")
    first = run(tmp_path, "--no-times")
    for path in sorted((tmp_path / "drawings").rglob("*"), reverse=True):
        path.unlink() if path.is_file() else path.rmdir()
    assert run(tmp_path, "--no-times") == first
    text = b"".join(first.values())
    assert b'"cost"' not in text and b'"peak_memory_mb"' not in text
    assert b"Slowest" not in first[next(name for name in first if name.name == "summary.md")]
    sources = json.loads((tmp_path / "drawings/manifest.json").read_bytes())["sources"]
    assert not any("cost" in source or "seconds" in json.dumps(source["drawings"]) for source in sources)
    run(tmp_path)
    sources = json.loads((tmp_path / "drawings/manifest.json").read_bytes())["sources"]
    assert all("cost" in source for source in sources) and "seconds" in sources[0]["drawings"][0]
