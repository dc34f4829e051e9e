"""What a script prints that fails stands in the report, and below its line; of what is drawn nothing is told."""

import json
import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from hlr.batch.script_output import MOST, ScriptOutput, last_lines

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="needs a file in memory")

SCRIPTS = {
    "fine.py": "print('all is well')\nimport cadquery as cq\nresult = cq.Workplane().box(1, 2, 3)\n",
    "asks.py": "import argparse\np = argparse.ArgumentParser()\np.add_argument('size')\np.parse_args()\n",
    "crashes.py": "import ctypes\nprint('on the way', end='')\nctypes.string_at(0)\n",
    "starts.py": "import os\nos.system('echo \"from <a> child | \\033[31mred\"')\n1 / 0\n",
    "endless.py": "print('still looking')\nwhile True: print('x' * 500)\n",
}


@pytest.mark.slow
def test_what_failing_scripts_print_is_found_in_the_report(tmp_path):
    for name, text in SCRIPTS.items():
        (tmp_path / name).write_text(text)
    command = [sys.executable, "-P", "-m", "hlr", "batch", *SCRIPTS, "--view", "top", "-o", "out", "--time-limit", "3s"]
    env = os.environ | {"HLR_CACHE": "off"}
    done = subprocess.run(command, cwd=tmp_path, env=env, check=False, capture_output=True, text=True, timeout=120)
    assert done.returncode == 1
    report = json.loads((tmp_path / "out/manifest.json").read_bytes())
    printed = {each["source"]: each["error"]["printed"] for each in report["sources"] if each["error"]}
    assert printed.keys() == SCRIPTS.keys() - {"fine.py"}
    assert "the following arguments are required: size" in printed["asks.py"]
    assert printed["crashes.py"] == "on the way"
    assert printed["starts.py"] == "from <a> child | \x1b[31mred"
    assert "still looking" not in printed["endless.py"] and 3000 < len(printed["endless.py"]) <= MOST
    cases = ElementTree.parse(tmp_path / "out/junit.xml").iter("testcase")
    errors = {case.get("name"): case.findtext("system-err") for case in cases}
    assert errors["crashes.py"] == "on the way" and errors["fine.py"] is None
    assert "    from <a> child | \\x1b[31mred\n" in done.stderr and "all is well" not in done.stderr
    assert max(map(len, done.stderr.split("\n"))) < 400
    summary = (tmp_path / "out/summary.md").read_text()
    assert "starts.py printed:\n\n    from <a> child | ?[31mred\n" in summary


def test_the_end_is_kept_however_much_is_printed():
    printed = ScriptOutput()
    child = os.fork()
    if not child:
        printed.take()
        for number in range(200_000):
            os.write(1, f"line {number}\n".encode())
        os._exit(0)
    largest = 0
    while not os.waitpid(child, os.WNOHANG)[0]:
        printed.shorten()
        largest = max(largest, len(printed._bytes()))
    text = printed.text()
    printed.close()
    assert largest <= 4 * MOST and len(text) <= MOST
    lines = text.split("\n")
    assert lines == [f"line {number}" for number in range(200_000 - len(lines), 200_000)]


def test_lines_for_people_are_short_and_none_is_empty():
    assert last_lines("a\n\nb\n  \nc\n", 2) == ["b", "c"]
    assert last_lines("", 5) == []
    (line,) = last_lines("x" * 1000, 5)
    assert len(line) == 200 and line.endswith(" ...")
