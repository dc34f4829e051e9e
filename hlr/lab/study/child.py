"""A measuring process: reads one job from standard input and writes its answer to a file.

Usage: `python -m hlr.lab.study.child ANSWER`. It ends when the process that started it ends, and its memory is limited.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import signal
import sys

SHARE = 0.6
"""Share of the machine's memory that a job may use; a job that needs more fails."""


def main() -> int:
    """Do the job; returns exit code 0. The file holds the answer, or one sentence on the failure."""
    data = json.loads(sys.stdin.readline())
    _tie()
    _limit(data["limit"])
    os.environ["HLR_CACHE"] = "off"  # reading the file is a part of what is measured
    from hlr.errors import HlrError
    from hlr.lab.study.job import Job
    from hlr.lab.study.work import done

    if data["fit"] is not None:
        data["fit"] = tuple(data["fit"])
    try:
        answer = done(Job(**data))
    except HlrError as error:
        answer = {"failure": str(error)}
    except MemoryError:
        answer = {"failure": f"it needs more than {SHARE:.0%} of this machine's memory"}
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(answer, file, default=float)
    # Exit at once: the clean-up of libraries can take long, or crash.
    sys.stdout.flush()
    os._exit(0)


def _tie() -> None:
    """Have Linux kill this process when the study ends for any reason. Elsewhere only the study itself ends it."""
    if sys.platform == "linux":
        import ctypes

        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(1, int(signal.SIGKILL))  # PR_SET_PDEATHSIG


def _limit(seconds: float) -> None:
    """Limit memory, and processor time, which unlike clock time does not depend on other load on the machine."""
    with contextlib.suppress(ImportError, OSError, ValueError, AttributeError):
        import resource

        hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
        resource.setrlimit(resource.RLIMIT_CPU, (max(math.ceil(seconds), 1), hard))

        most = int(SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        resource.setrlimit(resource.RLIMIT_AS, (most, resource.getrlimit(resource.RLIMIT_AS)[1]))
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


if __name__ == "__main__":
    sys.exit(main())
