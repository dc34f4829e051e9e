"""Make helper modules beside the tests importable as `peers.x`, `bench.x`, `visibility.x`; how Hypothesis searches.

There is no `tests/__init__.py` on purpose: with one, pytest would import the source tree instead of the installed
package, which has no compiled kernel.

The ordinary run tries the same examples every time, so that a red test means a changed program. To look for new
examples: pytest --hypothesis-profile=explore
"""

import sys
from pathlib import Path

from hypothesis import Phase, settings

HERE = str(Path(__file__).resolve().parent)
if HERE not in sys.path:
    sys.path.append(HERE)

settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=1000)
# Without looking for the smallest example of what fails.
settings.register_profile("unshrunk", derandomize=True, deadline=None, phases=[Phase.explicit, Phase.generate])
settings.load_profile("same")
