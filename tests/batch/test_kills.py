"""Runs that are killed; `kill_runs.py` beside this file does it a hundred times."""

import os

import pytest
from batch.kill_runs import killed

if not hasattr(os, "fork"):
    pytest.skip("needs POSIX signals", allow_module_level=True)


@pytest.mark.slow
def test_a_killed_run_leaves_whole_files_and_the_next_goes_on(tmp_path):
    assert len(killed(tmp_path, 3)) == 3
