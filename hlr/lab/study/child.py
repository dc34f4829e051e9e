"""A measuring process: reads one job from standard input, writes its answer to the file that the arguments name.

`python -m hlr.lab.study.child ANSWER`. It ends with the process that started it, and leaves memory for others.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import signal
import sys

SHARE = 0.6
"""Of the machine's memory: where more is asked for, the point cannot be had."""


def main() -> int:
    """Exit code 0, and an answer or a failure in a sentence in the file."""
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
    # What libraries tidy up at the end can take long, or crash.
    sys.stdout.flush()
    os._exit(0)


def _tie() -> None:
    """End with the study, whatever ends that. (Where it is not Linux, the study's own tidying has to do.)"""
    if sys.platform == "linux":
        import ctypes

        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(1, int(signal.SIGKILL))  # PR_SET_PDEATHSIG


def _limit(seconds: float) -> None:
    """Of processor time, which does not depend on who else computes, and of memory."""
    with contextlib.suppress(ImportError, OSError, ValueError, AttributeError):
        import resource

        hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
        resource.setrlimit(resource.RLIMIT_CPU, (max(math.ceil(seconds), 1), hard))

        most = int(SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        resource.setrlimit(resource.RLIMIT_AS, (most, resource.getrlimit(resource.RLIMIT_AS)[1]))
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


if __name__ == "__main__":
    sys.exit(main())
