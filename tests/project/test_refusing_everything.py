"""The tests of odd requests fail where every request is refused: none of them is content with a refusal."""

import re
import subprocess
import sys

import pytest

from support.programs import TESTS, environment

FILES = ("public/test_errors.py", "fuzz/test_entry.py")
# They ask for what cannot be drawn, or look at something else.
CONTENT = {
    "test_every_error_is_an_hlr_error",
    "test_another_error_would_be_noticed",
    "test_every_error_is_a_sentence",  # these two ask for the wording, and draw nothing
    "test_every_note_in_the_source_is_a_sentence",
    "test_any_arrays",  # hardly any is a model; test_arrays_of_each_kind has some of each
    "test_anything_as_a_source",  # nor here; test_a_pair_of_lists_as_a_source has one
}


@pytest.mark.slow
def test_no_test_is_content_with_refusals():
    command = [sys.executable, "-m", "pytest", "-p", "support.refuse_everything", "-rp", "--tb=no", "-o", "addopts="]
    command += ["--import-mode=importlib", "--hypothesis-profile=unshrunk", *FILES]
    ran = subprocess.run(
        command,
        check=False,
        cwd=TESTS,
        env=environment(),
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert ran.returncode == 1, ran.stdout[-2000:] + ran.stderr[-2000:]
    passed = {name.split("[")[0] for name in re.findall(r"^PASSED \S+::(\S+)", ran.stdout, re.MULTILINE)}
    assert passed <= CONTENT, f"content with refusals: {sorted(passed - CONTENT)}"
    assert int(re.findall(r"(\d+) failed", ran.stdout)[-1]) > 80
