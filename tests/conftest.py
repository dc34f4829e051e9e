"""How the tests run: what they start from, and how Hypothesis searches.

Helpers of more than one folder live in `support`; tests/support/__init__.py says how they are imported.

There is no `tests/__init__.py` on purpose: with one, pytest would import the source tree instead of the installed
package, which has no compiled kernel.

The ordinary run tries the same examples every time, so that a red test means a changed program. To look for new
examples: pytest --hypothesis-profile=explore

The cache of models is a folder of this run, another one for each test: what one test reads, the next reads anew.

A suite started in the background of a shell ignores interrupts, and its children would as well: it no longer does.

Without CadQuery (build123d on OpenCASCADE 8 cannot share an environment with it) the tests that build their shapes with
it are left out.
"""

import ast
import os
import signal
from importlib.util import find_spec
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import Phase, settings

HERE = str(Path(__file__).resolve().parent)
# Failed assertions of helpers show their values, as those of tests do.
pytest.register_assert_rewrite("support")

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

CACHE = TemporaryDirectory(prefix="hlr-tests-")
os.environ["HLR_CACHE"] = CACHE.name
os.environ.pop("HLR_CACHE_SIZE", None)
NUMBERS = count()


@pytest.fixture(autouse=True)
def own_cache(monkeypatch):
    """The cache's folder, which is not there yet."""
    folder = Path(CACHE.name, str(next(NUMBERS)))
    monkeypatch.setenv("HLR_CACHE", str(folder))
    return folder


settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=1000)
# Without looking for the smallest example of what fails.
settings.register_profile("unshrunk", derandomize=True, deadline=None, phases=[Phase.explicit, Phase.generate])
settings.load_profile("same")


def imports(path: Path) -> set[str]:
    """Names of the modules that a file imports, and of what it takes from them."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found.update(name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
            found.update(f"{node.module}.{name.name}" for name in node.names)
    return found


def needing(package: str) -> list[str]:
    """Files under this folder that import a package, or another file here that does."""
    files = {path: imports(path) for path in Path(HERE).rglob("*.py")}
    wanted, found = {package}, set[Path]()
    while more := {path for path, names in files.items() if names & wanted} - found:
        found |= more
        wanted |= {".".join(path.relative_to(HERE).with_suffix("").parts) for path in more}
    return [str(path) for path in found]


collect_ignore = [] if find_spec("cadquery") else needing("cadquery")
