"""Make helper modules beside the tests importable as `peers.x`, `bench.x`, `visibility.x`.

There is no `tests/__init__.py` on purpose: with one, pytest would import the source tree instead of the installed
package, which has no compiled kernel.
"""

import sys
from pathlib import Path

HERE = str(Path(__file__).resolve().parent)
if HERE not in sys.path:
    sys.path.append(HERE)
