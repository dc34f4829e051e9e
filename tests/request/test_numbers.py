"""Numbers that no float holds, and places too far away, are refused in one sentence."""

from __future__ import annotations

import pytest

import hlr
from hlr.batch.manifest import read
from hlr.errors import HlrError, OptionError
from support.models import box

HUGE = 10**400


@pytest.mark.parametrize(
    "options",
    (
        {"scale": HUGE},
        {"accuracy": HUGE},
        {"crease": HUGE},
        {"within": HUGE},
        {"fit": (HUGE, 10)},
        {"page": (HUGE, 10)},
        {"window": (0, 0, HUGE, 10)},
        {"up": (HUGE, 0, 0)},
        {"view": (HUGE, 1, 1)},
        {"perspective": hlr.Perspective(eye=(HUGE, 0, 0))},
        {"perspective": hlr.Perspective(eye=(1e160, 0, 0))},
        {"perspective": hlr.Perspective(eye=(20, 0, 0), target=(1e300, 0, 0))},
    ),
)
def test_of_options(options):
    with pytest.raises(HlrError):
        hlr.draw(box((3.0, 2.0, 1.0)), **options)


def test_an_eye_may_be_very_far_away():
    far = hlr.draw(box((3.0, 2.0, 1.0)), perspective=hlr.Perspective(eye=(-1e12, 0, 0)), hidden=False)
    assert len(far.lines) == 4


@pytest.mark.parametrize("line", ("time_limit_s = 1", "memory_limit_mb = 1"))
def test_of_manifests(tmp_path, line):
    file = tmp_path / "hlr.toml"
    file.write_text(f"hidden = true\n{line}{'0' * 400}\n")
    with pytest.raises(OptionError, match="line 2"):
        read(file)


@pytest.mark.parametrize("line", ("wide = 1", "dpi = 1", "dash = [3.0, 1"))
def test_of_styles(tmp_path, line):
    file = tmp_path / "own.toml"
    file.write_text(f"{line}{'0' * 400}{']' if '[' in line else ''}\n")
    with pytest.raises(OptionError, match=r"own\.toml"):
        hlr.draw(box((3.0, 2.0, 1.0)), style=file)
