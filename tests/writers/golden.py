"""Compare with a file under tests/golden; HLR_GOLDEN=write makes it anew, to be read before it is committed."""

import os
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[1] / "golden" / "writers"


def check(name, text):
    path = GOLDEN / name
    if os.environ.get("HLR_GOLDEN") == "write":
        path.write_bytes(text.encode("utf-8"))
    assert text == path.read_bytes().decode("utf-8"), f"{name} differs from its golden file"
