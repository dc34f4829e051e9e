"""Runs each job in a process of its own with a time limit. A failed job is reported in one sentence.

Where all of this process is the command's, what a script has started ends with its job: it would be in the way of the
next one's time.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hlr.common.leftovers import Leftovers
from hlr.common.process import is_own
from hlr.lab.study.job import Job

WAIT = 20.0
"""Clock time allowed, as a multiple of the limit: other programs may keep the processors busy."""


def answer(job: Job) -> dict[str, Any]:
    """The answer of the job's process, or {"failure": sentence}.

    If this call is interrupted, it ends the process first.
    """
    left = Leftovers() if is_own() else None
    with tempfile.TemporaryDirectory(prefix="hlr-study-") as folder:
        path = Path(folder) / "answer.json"
        # -P: do not import modules from the folder in which hlr was started.
        command = [sys.executable, "-P", "-m", "hlr.lab.study.child", str(path)]
        child = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True
        )
        if left is not None:
            left.adopt()
        try:
            child.communicate(json.dumps(job.as_dict()) + "\n", timeout=WAIT * job.limit)
        except subprocess.TimeoutExpired:
            return {"failure": f"not finished in {WAIT * job.limit:g} s by the clock"}
        finally:
            if child.poll() is None:
                if left is not None:
                    left.look(child.pid)
                child.kill()
                child.wait()
            if left is not None:
                left.kill()
        if child.returncode != 0 or not path.exists():
            return {"failure": _end(child.returncode, job.limit)}
        found: dict[str, Any] = json.loads(path.read_text("utf-8"))
        return found


def _end(code: int, limit: float) -> str:
    if code < 0 and -code == getattr(signal, "SIGXCPU", 0):
        return f"not finished in {limit:g} s of processor time"
    if code < 0:
        name = signal.Signals(-code).name if -code in set(signal.Signals) else f"signal {-code}"
        return f"its process ended by {name}" + (" (out of memory?)" if name in ("SIGKILL", "SIGABRT") else "")
    return f"its process ended with code {code}"
