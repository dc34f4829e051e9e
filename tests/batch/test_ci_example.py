"""The repository of examples/ci: its files say what CI services and the command line understand."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from hlr.batch.plan import REPORTS
from hlr.cli.commands.batch import batch

CI = Path(__file__).resolve().parents[2] / "examples/ci"
WORKFLOWS = (".github/workflows/drawings.yml", ".gitlab-ci.yml", ".pre-commit-config.yaml")


def texts(value):
    """All texts of a YAML document."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list):
        for each in value.values() if isinstance(value, dict) else value:
            yield from texts(each)


@pytest.mark.parametrize("name", WORKFLOWS)
def test_the_command_line_takes_what_a_workflow_says(name):
    document = yaml.safe_load((CI / name).read_text())
    lines = [line.split() for text in texts(document) for line in text.splitlines() if line.startswith("hlr ")]
    assert lines
    for _, verb, *arguments in lines:
        assert verb == "batch"
        batch.make_context(verb, arguments)  # raises where an option is unknown


def test_the_reports_of_the_workflows_are_files_of_the_report():
    gitlab = yaml.safe_load((CI / ".gitlab-ci.yml").read_text())
    reports = gitlab["drawings"]["artifacts"]["reports"].values()
    assert {Path(path).name for path in reports} <= set(REPORTS)


@pytest.mark.slow
def test_the_repository_can_be_planned(tmp_path):
    folder = tmp_path / "ci"
    shutil.copytree(CI, folder)
    run = [sys.executable, "-P", "-m", "hlr", "batch", "--dry-run"]
    done = subprocess.run(run, cwd=folder, capture_output=True, text=True, check=True)
    titles = re.findall(r"^to draw    (.*)$", done.stdout, re.MULTILINE)
    assert len(titles) == 9 and "assembly.py" in titles and "parts/plate.py size=120" in titles
