"""Small models, and a pool that draws nothing."""

import math
import time

from hlr.batch.job import Outcome, failed
from hlr.batch.pool import Event

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"


def tetrahedron(path, size=10):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(TETRAHEDRON.format(size))
    return path


def drawn(job, text="drawn", notes=(), depends=()):
    """The outcome of a job as if it had been drawn: each file says what it is."""
    facts = tuple({"view": str(view), "notes": list(notes), "seconds": {}} for view in job.views)
    contents = tuple(tuple(f"{text} {name}".encode() for name in row) for row in job.files)
    return Outcome(None, facts, contents, depends, 0.001, 1.0)


class FakePool:
    """Ends jobs in the order that it is told to; those of sources whose name has "bad" in it fail."""

    def __init__(self, order=lambda numbers: numbers, text="drawn", **facts):
        self.order, self.text, self.facts, self.asked = order, text, facts, []

    def __call__(self):
        return self

    def run(self, jobs, deadline=math.inf):
        self.asked += [job.title for job in jobs]
        for number in self.order(list(range(len(jobs)))):
            if time.monotonic() >= deadline:
                return
            job = jobs[number]
            yield Event(number, stage="source")
            bad = "bad" in job.source
            yield Event(number, outcome=failed("SourceError", "no.") if bad else drawn(job, self.text, **self.facts))

    def close(self): ...


class Silent:
    """A listener that keeps what it is told."""

    def __init__(self):
        self.todo, self.told = [], []

    def planned(self, plan, todo):
        self.todo = [plan.jobs[number].title for number in todo]

    def begun(self, number, stage): ...

    def ended(self, number, outcome):
        self.told.append(number)

    def out_of_time(self, left):
        self.left = left
