"""Jobs on a real Dask scheduler with worker processes, on the loopback interface."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import pytest
from batch.models import tetrahedron

from hlr.batch import cluster
from hlr.batch.carry_out import carry_out
from hlr.batch.job import Job
from hlr.batch.pulled_in import imported, needed
from hlr.batch.versions import difference, versions
from hlr.errors import ClusterError
from hlr.source.step_references import references

pytest.importorskip("distributed")

SLOW = "import time, lib.sizes\ntime.sleep(0.3)\nraise ValueError(f'{__file__} {lib.sizes.width}')\n"


def job(root, source, **more):
    files = ((f"{source}.svg", f"{source}.pdf"),)
    return Job(str(root), source, ("iso",), ("svg", "pdf"), files, {"threads": 1}, **more)


@pytest.fixture
def machines(tmp_path):
    """Processes of a scheduler and two workers: the address, and the processes. What they say goes to a file."""
    pytest.importorskip("psutil")
    place = tmp_path / "scheduler.json"
    common = ["--scheduler-file", place, "--no-dashboard"]
    rows = [["scheduler", "--host", "127.0.0.1", "--port", "0"], *[["worker", "--nthreads", "1", "--no-nanny"]] * 2]
    with (tmp_path / "log").open("wb") as log:
        processes = [
            subprocess.Popen(
                [sys.executable, "-P", "-m", f"distributed.cli.dask_{what}", *map(str, (*common, *more))],
                cwd=tmp_path, env=os.environ | {"DASK_TEMPORARY_DIRECTORY": str(tmp_path)}, stdout=log, stderr=log,
            )
            for what, *more in rows
        ]  # fmt: skip
        end = time.monotonic() + 20.0
        while not place.exists():
            assert time.monotonic() < end
            time.sleep(0.05)
        import json

        yield json.loads(place.read_text())["address"], processes
        for process in processes:
            process.kill()
            process.wait()


def told(outcome):
    """What does not differ from run to run."""
    notes = [drawing["notes"] for drawing in outcome.drawings]
    return outcome.failure, outcome.contents, outcome.depends, notes


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_the_same_outcomes_though_a_worker_is_killed_and_one_sentence_when_the_scheduler_is(
    machines, tmp_path, monkeypatch
):
    address, (scheduler, one, _) = machines
    models = tmp_path / "models"
    for number in range(4):
        tetrahedron(models / f"{number}.off", number + 1)
        (models / f"slow{number}.py").write_text(SLOW)
    (models / "lib").mkdir()
    (models / "lib/__init__.py").touch()
    (models / "lib/sizes.py").write_text("width = 20\n")
    (models / "endless.py").write_text("while True: pass\n")
    names = [f"slow{number}.py" for number in range(4)] + [f"{number}.off" for number in range(4)]
    jobs = [*(job(models, name) for name in names), job(models, "gone.off")]
    jobs.append(replace(job(models, "endless.py"), time_limit_s=0.5))

    # Other versions are found out before anything is sent.
    with monkeypatch.context() as patch, pytest.raises(ClusterError, match="there and 8 here: install the same"):
        patch.setattr(cluster, "versions", lambda: versions() | {"OpenCASCADE": "8"})
        cluster.DaskPool(address)

    pool, outcomes = cluster.DaskPool(address), {}
    for event in pool.run(jobs):
        outcomes[jobs[event.number].source] = event.outcome
        if len(outcomes) == 3:
            one.send_signal(signal.SIGKILL)
    assert outcomes["endless.py"].failure.kind == "TimeLimit", outcomes["endless.py"].failure
    for each in jobs[:-1]:
        assert told(outcomes[each.source]) == told(carry_out(each))
    assert str(models / "slow0.py") in outcomes["slow0.py"].failure.message
    left = list((tmp_path / "dask-scratch-space").rglob("hlr-*"))
    assert len(left) <= 1, "nothing is left, but for what the killed worker had in hand"

    running = pool.run([jobs[0], replace(job(models, "endless.py"), time_limit_s=60.0)])
    next(running)
    scheduler.send_signal(signal.SIGKILL)
    with pytest.raises(ClusterError, match="has gone: what was drawn is there"):
        list(running)
    pool.close()


@pytest.mark.slow
def test_at_the_deadline_jobs_that_are_out_are_ended(machines, tmp_path):
    models, (address, _) = tmp_path / "models", machines
    models.mkdir()
    names = [tetrahedron(models / f"{number}.off", number + 1).name for number in range(2)]
    (models / "endless.py").write_text("while True: pass\n")
    jobs = [job(models, name) for name in (*names, *["endless.py"] * 9)]
    pool = cluster.DaskPool(address)
    begun = time.monotonic()
    outcomes = {event.number: event.outcome for event in pool.run(jobs, begun + 8.0)}
    assert time.monotonic() - begun < 12.0
    assert outcomes.keys() == {0, 1} and all(outcome.failure is None for outcome in outcomes.values())
    # The workers are free again.
    (event,) = pool.run(jobs[:1], time.monotonic() + 60.0)
    assert event.outcome.failure is None
    pool.close()


def test_a_scheduler_that_does_not_answer_is_told_in_one_sentence(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE_S", 0.2)
    with pytest.raises(ClusterError, match=r"no scheduler answers at tcp://127.0.0.1:1 within 0.2 s"):
        cluster.DaskPool("tcp://127.0.0.1:1")
    with pytest.raises(ClusterError, match="is no address of a scheduler"):
        cluster.DaskPool("quantum://here")


def test_without_dask_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "dask.config", None)
    with pytest.raises(ClusterError, match=r"pip install 'hlr-drawing\[cluster\]'"):
        cluster.DaskPool("tcp://127.0.0.1:1")


def test_the_files_that_a_job_needs_are_known_beforehand(tmp_path):
    (tmp_path / "lib").mkdir()
    for name, text in {
        "part.py": "import cadquery, os, lib.sizes\nfrom near import hole\n1 / 0\n",
        "lib/__init__.py": "", "lib/sizes.py": "from . import more\n", "lib/more.py": "", "lib/unused.py": "",
        "near.py": "hole = 3\n", "wrong.py": "1 +\n", "look.toml": "", "table.csv": "",
        "all.step": "DOCUMENT_FILE('bolt.stp','');\nDOCUMENT_FILE( 'gone.stp' ,'')\nDOCUMENT_FILE('table.csv',)",
        "bolt.stp": "#1=DOCUMENT_FILE('all.step','')\n#2=DOCUMENT_FILE('lib/nut.stp','')",
    }.items():  # fmt: skip
        (tmp_path / name).write_text(text)
    assert {path.relative_to(tmp_path).as_posix() for path in imported(tmp_path / "part.py")} == {
        "lib/__init__.py", "lib/sizes.py", "lib/more.py", "near.py",
    }  # fmt: skip
    assert imported(tmp_path / "wrong.py") == []
    # A model may refer to models, there or not, and to nothing else.
    assert references(tmp_path / "all.step") == [tmp_path / name for name in ("bolt.stp", "gone.stp", "lib/nut.stp")]
    asked = replace(job(tmp_path, "near.py", depends=("table.csv",)), options={"style": "look.toml"})
    assert needed(asked) == [tmp_path / name for name in ("near.py", "table.csv", "look.toml")]


def test_versions_are_compared_but_for_the_kernel_of_another_system():
    here = {"hlr": "1", "the kernel of hlr for Linux": "a", "numpy": "2"}
    assert difference(here, dict(here)) == ""
    assert difference(here, {"hlr": "1", "the kernel of hlr for Darwin": "b", "numpy": "2"}) == ""
    assert difference(here, here | {"the kernel of hlr for Linux": "b"}).startswith("the kernel of hlr for Linux is b")
    assert difference(here, {"hlr": "2"}) == "hlr is 2 there and 1 here"
    assert difference(here, here | {"trimesh": "4"}) == "trimesh is 4 there and none here"
