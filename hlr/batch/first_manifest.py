"""The manifest that `hlr batch --init` writes: all keys, what they mean, and the models that are there."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from hlr.batch.discover import models_under
from hlr.batch.schema import KEYS

_HEAD = """\
# What `hlr batch` draws here. A key without # is set; the others show their defaults.
"""

_TAIL = """\

# Any option of a drawing may stand here as well, by its name in hlr.Options:
# accuracy = 0.05
# hide = ["bolt*"]

# What is different for some sources. The top then holds what all share, and names no files:
# [[source]]
# files = "scripts/bracket.py"
# views = ["iso"]
# parameters = { size = [10, 20] }
"""


def text_for(folder: Path) -> str:
    """The text of a manifest for the models under a folder: a pattern for each kind of file."""
    endings = sorted({path.suffix for path in models_under(folder)})
    found: dict[str, Any] = {"files": [f"**/*{ending}" for ending in endings if ending != ".py"]}
    # A script is run to be drawn: each is named.
    found["files"] += [
        Path(os.path.relpath(path, folder)).as_posix() for path in models_under(folder) if path.suffix == ".py"
    ]
    lines = [_HEAD]
    for name, key in KEYS.items():
        value, shown = found.get(name) or key.default, bool(found.get(name))
        lines.append(f"# {key.meaning}\n{'' if shown else '# '}{name} = {json.dumps(value)}\n")
    return "".join(lines) + _TAIL
