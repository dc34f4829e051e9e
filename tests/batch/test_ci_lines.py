"""What CI services show of a failure: it stands beside the line of the script that it names."""

import json
from pathlib import Path

import pytest
from batch import reports

from hlr.batch.ci import code_quality, github


@pytest.mark.parametrize(
    ("message", "line"),
    [
        ("part.py, line 12: ValueError: no.", 12),
        ("src/part.py, line 3: SyntaxError: invalid syntax.", 3),
        ("part.py left with exit code 3.", None),
        ("other_part.py, line 5: this is no line of the script.", None),
        ("partypy, line 5: nor is this.", None),
    ],
)
def test_a_failure_stands_beside_the_line_that_it_names(message, line):
    found = reports.report(reports.source("src/part.py", error=message))
    (told,) = github(found, Path("/repo"), {"GITHUB_ACTIONS": "true", "GITHUB_WORKSPACE": "/repo"})
    place = "src/part.py" if line is None else f"src/part.py,line={line}"
    assert told == f"::error file={place},title=src/part.py::{message}"
    (row,) = json.loads(code_quality(found, {"GITLAB_CI": "true"}) or b"[]")
    assert row["location"] == {"path": "src/part.py", "lines": {"begin": line or 1}}
