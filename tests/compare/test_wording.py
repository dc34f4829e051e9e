"""What a comparison says to those who meet it for the first time."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.overlay.table import rows
from hlr.errors import SourceError
from support.at_size import AT_SIZE


def test_what_cannot_be_compared_is_told_that_models_can(tmp_path):
    file = tmp_path / "a.txt"
    file.write_text("a drawing?")
    with pytest.raises(SourceError, match=r"a\.txt cannot be compared: give a drawing \(.*\.pdf\), or a model such as"):
        compare(file, file)


def test_the_table_says_where_the_rest_is():
    one, other = (hlr.draw(cq.Workplane().box(*size), "iso", **AT_SIZE) for size in ((10, 10, 10), (10, 20, 30)))
    found = compare(one, other)
    assert any(line.endswith("more; -o FILE.json or FILE.html has all of them") for line in rows(found, 1))
