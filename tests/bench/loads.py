"""Meshes for the benchmarks of mesh files and of arrays, and what whole commands take: processor time and memory.

1. `hlr draw` from its start to the SVG on disk, as a multiple of `python -c "import numpy"` in the same run
2. `hlr.draw` of arrays in memory, with the share of each stage
"""

from __future__ import annotations

import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from bench.table import Table

from support.programs import environment

RINGS, SIDES = 293, 23
"""A torus of 13,478 triangles."""
FINE = (202, 200)
"""One of 80,800."""


def torus(rings: int, sides: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles; radii 30 and 10."""
    u, v = np.meshgrid(*(np.arange(n) * 2 * np.pi / n for n in (rings, sides)), indexing="ij")
    out = 30 + 10 * np.cos(v)
    points = np.stack([out * np.cos(u), out * np.sin(u), 10 * np.sin(v)], axis=2).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b, c, d = (((i + k) % rings) * sides + (j + m) % sides for k, m in ((0, 0), (1, 0), (1, 1), (0, 1)))
    triangles = np.stack([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)], axis=2)
    return points, triangles.reshape(-1, 3).astype(np.int32)


def tori(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """So many turned tori on a grid, in one pair of arrays."""
    one, triangles = torus(*FINE)
    rng = np.random.default_rng(seed)
    points = np.empty((count * len(one), 3))
    corners = np.empty((count * len(triangles), 3), np.int32)
    side = int(np.ceil(count ** (1 / 3)))
    for k in range(count):
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        turn[:, 0] *= np.sign(np.linalg.det(turn))
        place = np.array([k % side, k // side % side, k // side**2]) * 85.0
        points[k * len(one) : (k + 1) * len(one)] = one @ turn.T + place
        corners[k * len(triangles) : (k + 1) * len(triangles)] = triangles + k * len(one)
    return points, corners


def binary_stl(points: np.ndarray, triangles: np.ndarray) -> bytes:
    rows = np.zeros(len(triangles), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
    rows["corners"] = points[triangles]
    return bytes(80) + struct.pack("<I", len(triangles)) + rows.tobytes()


def text_stl(points: np.ndarray, triangles: np.ndarray) -> bytes:
    facet = "facet normal 0 0 0\nouter loop\n" + "vertex {:.6e} {:.6e} {:.6e}\n" * 3 + "endloop\nendfacet\n"
    facets = "".join(facet.format(*row) for row in points[triangles].reshape(-1, 9).tolist())
    return f"solid torus\n{facets}endsolid torus\n".encode()


def _rows(lead: str, table: np.ndarray) -> str:
    return "".join(lead + " ".join(map(repr, row)) + "\n" for row in table.tolist())


def obj(points: np.ndarray, triangles: np.ndarray) -> bytes:
    return (_rows("v ", points) + _rows("f ", triangles + 1)).encode()


def off(points: np.ndarray, triangles: np.ndarray) -> bytes:
    return f"OFF\n{len(points)} {len(triangles)} 0\n{_rows('', points)}{_rows('3 ', triangles)}".encode()


def ply(points: np.ndarray, triangles: np.ndarray) -> bytes:
    faces = np.zeros(len(triangles), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"], faces["corners"] = 3, triangles
    xyz = "".join(f"property double {axis}\n" for axis in "xyz")
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{xyz}element face {len(triangles)}\n"
    return f"{head}property list uchar int vertex_indices\nend_header\n".encode() + points.tobytes() + faces.tobytes()


FILES: dict[str, Callable[[np.ndarray, np.ndarray], bytes]] = {
    "binary.stl": binary_stl,
    "text.stl": text_stl,
    "torus.obj": obj,
    "torus.off": off,
    "torus.ply": ply,
}


def processor_seconds(command: Sequence[str], env: Mapping[str, str] = os.environ) -> tuple[float, float]:
    """Of a process and its children, and the largest memory of one of them, MB."""
    pid = os.spawnve(os.P_NOWAIT, command[0], list(command), env)
    _, status, used = os.wait4(pid, 0)
    if status:
        raise RuntimeError(f"{' '.join(command)} ended with {status}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def commands(repeat: int, model: Path | None = None) -> Table:
    """Whole commands, as multiples of `python -c "import numpy"`; model: a STEP file, drawn in four ways."""
    mesh = torus(RINGS, SIDES)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        off, kept = {**os.environ, "HLR_CACHE": "off"}, {**os.environ, "HLR_CACHE": str(Path(folder, "cache"))}
        jobs: dict[str, tuple[list[str], dict[str, str]]] = {"import numpy": (["-c", "import numpy"], off)}
        for name, write in FILES.items():
            path = Path(folder, name)
            path.write_bytes(write(*mesh))
            out = str(path.with_suffix(".svg"))
            jobs[name] = (["-m", "hlr", "draw", str(path), "-q", "-o", out], off)
        if model is not None:
            draw = ["-m", "hlr", "draw", str(model), "-q", "-o", str(Path(folder, "model.svg"))]
            read = f"from hlr.source import open_source; open_source({str(model)!r})"
            jobs[f"{model.name}, not from the cache"] = (draw, off)
            jobs[f"{model.name}, from the cache"] = (draw, kept)
            jobs[f"{model.name}, read alone"] = (["-c", read], off)
            jobs["import OCP"] = (["-c", "import OCP.STEPCAFControl"], off)
            processor_seconds([sys.executable, *draw], kept)
        # Side by side: whatever else the machine does falls on all of them.
        for _ in range(repeat):
            rows.append({name: processor_seconds([sys.executable, *job], env) for name, (job, env) in jobs.items()})
    plain = statistics.median(row["import numpy"][0] for row in rows)
    results = [
        {
            "what": name,
            "processor": statistics.median(row[name][0] for row in rows),
            "all": [row[name][0] for row in rows],
            "peak_mb": statistics.median(row[name][1] for row in rows),
        }
        for name in jobs
    ]
    cells = [
        [r["what"], f"{r['processor']:.2f} s", f"{r['processor'] / plain:.1f} x", f"{r['peak_mb']:.0f} MB"]
        for r in results
    ]
    return Table([f"{len(mesh[1]):,} triangles", "processor time", "import numpy", "memory"], cells, results)


ARRAYS = """
import json, resource, sys, time
from bench.loads import tori
points, triangles = tori(int(sys.argv[1]))
import hlr
began, used = time.perf_counter(), time.process_time()
drawing = hlr.draw((points, triangles))
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
stages = {name: value for name, value in drawing.timings.items() if isinstance(value, float)}
print(json.dumps({"triangles": len(triangles), "seconds": time.perf_counter() - began,
                  "processor": time.process_time() - used, "peak_mb": peak, "stages": stages}))
"""


def arrays(count: int) -> Table:
    """`hlr.draw` of so many tori as a pair of arrays, with the share of each stage."""
    command = [sys.executable, "-c", ARRAYS, str(count)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment())
    found = json.loads(done.stdout)
    stages = ", ".join(f"{name} {seconds:.2f}" for name, seconds in found["stages"].items() if seconds >= 0.01)
    row = [f"{found['triangles']:,}", f"{found['seconds']:.1f} s", f"{found['processor']:.1f} s"]
    headings = ["triangles", "time", "processor time", "memory", "stages, s"]
    return Table(headings, [[*row, f"{found['peak_mb']:.0f} MB", stages]], [found])
