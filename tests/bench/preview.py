"""The shaded preview beside VTK's software renderer, off screen, in one run. Each side has a process of its own.

    python -m bench.preview                      asm4000, 1920x1080, eleven frames each, medians
    python -m bench.preview --scene asm1000 --antialias

Both start from the same triangles with the same normals in memory, light them by one light, and end with a frame in
memory; nothing is encoded. Each frame is seen from another direction. What is the same for all frames is made before on
both sides and not timed: ours checks and copies the arrays, VTK's mapper uploads them with its first frame.

VTK renders by Mesa's llvmpipe where there is no display (EGL or OSMesa). Its time is that of Render() and of waiting
for its end, without reading the pixels back.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from support.at_size import AT_SIZE

SIZE = (1920, 1080)
Arrays = dict[str, np.ndarray]
Run = Callable[[int], tuple[np.ndarray, float]]


def arrays(scene: str, path: Path) -> None:
    """Points, triangles, normals and colours of a benchmark scene into a file, by our own stages."""
    from bench import scenes

    from hlr.scene.build import build
    from hlr.shading.normals import corner_normals
    from hlr.source import open_source

    opened = open_source(scenes.make(scene))
    built = build(opened.mesh(scenes.deflection(scene), scenes.ANGLE), 30.0, scenes.deflection(scene))
    normals, corner = corner_normals(built)
    np.savez(
        path,
        points=built.points,
        triangles=built.triangles,
        normals=normals,
        corner=corner,
        part=built.triangle_part,
        cull=built.groups.cull[built.triangle_group],
    )


def clocks() -> np.ndarray:
    """Seconds on the wall, and of processors: the latter tell more where others are at work on the machine."""
    return np.array([time.perf_counter(), time.process_time()])


def peak_memory() -> int:
    """Peak memory in kilobytes. Not from getrusage if possible: there a child starts with its parent's peak."""
    status = Path("/proc/self/status")
    if status.exists():
        return next(int(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def direction(frame: int) -> tuple[float, float, float]:
    """The view direction of a frame: isometric first, then turned around the model."""
    angle = math.radians(-45.0 + 3.0 * frame)
    return (math.cos(angle), math.sin(angle), math.sqrt(0.5))


def ours(given: Arrays, antialias: bool, threads: int) -> Run:
    from hlr import _kernel
    from hlr.common.threads import at_most
    from hlr.image.camera import resolve
    from hlr.request.options import Options
    from hlr.request.picture_effects import AMBIENT, DIFFUSE, SHOULDER
    from hlr.shading.lens import lens, toward_light
    from hlr.source.model import Frame

    points = np.ascontiguousarray(given["points"])
    colours = np.full((1, 4), 0.5, np.float32)
    colours[:, 3] = 1.0
    paint = np.zeros_like(given["triangles"])
    model = _kernel.ShadedModel(
        points, given["triangles"], given["corner"], given["normals"], paint, colours, given["cull"]
    )
    bounds = np.stack([points.min(axis=0), points.max(axis=0)])
    scale = 0.92 * SIZE[1] / float(np.linalg.norm(bounds[1] - bounds[0]))
    frame_buffer = np.zeros((SIZE[1], SIZE[0], 4), np.uint8)  # VTK's window has one, too

    def run(frame: int) -> tuple[np.ndarray, float]:
        camera = resolve(direction(frame), Options(**AT_SIZE), Frame(), bounds)
        eye = lens(camera, points, scale, SIZE)
        light = _kernel.Light(toward=toward_light(camera, SHOULDER), ambient=AMBIENT, diffuse=DIFFUSE)
        started = clocks()
        with at_most(threads):
            pixels = model.picture(eye, light, (1.0, 1.0, 1.0, 1.0), antialias, out=frame_buffer)
        return clocks() - started, float((pixels[:, :, 0] < 255).mean())

    return run


def theirs(given: Arrays, antialias: bool, _threads: int, parts: bool = False) -> Run:  # noqa: PLR0915 - one scene, set up step by step
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    renderer = vtk.vtkRenderer()

    def add(rows: np.ndarray) -> None:
        # VTK wants one normal per point: a point per corner of the model's faces, as a GPU would have it.
        flat, corner = given["triangles"][rows].ravel(), given["corner"][rows].ravel()
        pairs, number = np.unique(np.stack([flat, corner], axis=1), axis=0, return_inverse=True)
        mesh, cells, place = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
        place.SetData(numpy_to_vtk(given["points"][pairs[:, 0]].astype(np.float32), deep=True))
        mesh.SetPoints(place)
        table = np.column_stack([np.full(len(flat) // 3, 3), number.reshape(-1, 3)]).astype(np.int64)
        cells.SetCells(len(table), numpy_to_vtkIdTypeArray(table.ravel(), deep=True))
        mesh.SetPolys(cells)
        mesh.GetPointData().SetNormals(numpy_to_vtk(given["normals"][pairs[:, 1]], deep=True))
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().BackfaceCullingOn()  # as ours
        renderer.AddActor(actor)

    part = given["part"]
    if parts:
        for rows in np.split(np.arange(len(part)), np.flatnonzero(np.diff(part)) + 1):
            add(rows)
    else:
        add(np.arange(len(part)))
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AutomaticLightCreationOff()
    light = vtk.vtkLight()
    light.SetLightTypeToHeadlight()
    renderer.AddLight(light)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8 if antialias else 0)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    low, high = given["points"].min(axis=0), given["points"].max(axis=0)
    centre, size = 0.5 * (low + high), float(np.linalg.norm(high - low))

    def run(frame: int) -> tuple[np.ndarray, float]:
        toward = np.array(direction(frame)) / np.linalg.norm(direction(frame))
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.5 * size / 0.92)
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*(centre + 2.0 * size * toward))
        camera.SetViewUp(0.0, 0.0, 1.0)
        renderer.ResetCameraClippingRange()
        started = clocks()
        window.Render()
        window.WaitForCompletion()
        seconds = clocks() - started
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ShouldRerenderOff()
        grab.Update()
        pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        return seconds, float((pixels[:, 0] < 255).mean())

    return run


def theirs_by_part(given: Arrays, antialias: bool, threads: int) -> Run:
    return theirs(given, antialias, threads, parts=True)


WHO = {"hlr": ours, "vtk": theirs, "vtk-parts": theirs_by_part}
"""VTK with all triangles in one actor, its best case, and with an actor per part, as a viewer has them."""


def measure(who: str, file: Path, frames: int, antialias: bool, threads: int) -> dict[str, Any]:
    given = dict(np.load(file))
    before = peak_memory()
    run = WHO[who](given, antialias, threads)
    run(0)  # VTK uploads, both warm up
    found = [run(frame) for frame in range(frames)]
    peak = peak_memory()
    seconds = [float(s[0]) for s, _ in found]
    return {
        "who": who,
        "triangles": len(given["triangles"]),
        "median": statistics.median(seconds),
        "best": min(seconds),
        "cpu": statistics.median(float(s[1]) for s, _ in found),
        "covered": statistics.mean(c for _, c in found),
        "grown_mb": (peak - before) / 1024,
        "peak_mb": peak / 1024,
    }


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default="asm4000")
    parser.add_argument("--frames", type=int, default=11)
    parser.add_argument("--rounds", type=int, default=3, help="how often both sides are run in turn")
    parser.add_argument("--antialias", action="store_true", help="sixteen samples a pixel; VTK eight")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--one", choices=WHO, help=argparse.SUPPRESS)
    parser.add_argument("--file", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    if given.one:
        print(json.dumps(measure(given.one, given.file, given.frames, given.antialias, given.threads)))
        return 0
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.npz"
        arrays(given.scene, file)
        results: dict[str, list[dict[str, Any]]] = {who: [] for who in WHO}
        for _ in range(given.rounds):
            for who in WHO:
                results[who].append(_apart(who, file, given))
    print(f"{given.scene}, {SIZE[0]}x{SIZE[1]}, {platform.machine()}, medians of {given.frames} frames")
    for who, rows in results.items():
        for row in rows:
            print(
                f"{who}: {row['triangles']} triangles, {1000 * row['median']:.1f} ms (best {1000 * row['best']:.1f}; "
                f"processors {1000 * row['cpu']:.1f}), "
                f"{100 * row['covered']:.1f} % covered, peak {row['peak_mb']:.0f} MB, of it {row['grown_mb']:.0f} MB "
                "for the renderer"
            )
    for what in ("median", "best", "cpu"):
        middle = {who: statistics.median(row[what] for row in rows) for who, rows in results.items()}
        for who in ("vtk", "vtk-parts"):
            print(f"{who} / hlr, {what}: {middle[who] / middle['hlr']:.1f}")
    return 0


def _apart(who: str, file: Path, given: argparse.Namespace) -> dict[str, Any]:
    command = [sys.executable, __file__, "--one", who, "--file", str(file), f"--frames={given.frames}"]
    command += [f"--threads={given.threads}", *(["--antialias"] if given.antialias else [])]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


if __name__ == "__main__":
    raise SystemExit(main())
