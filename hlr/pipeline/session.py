"""A session: one source, opened once and meshed once, seen by any number of cameras.

The stages in order; on the right, what stops there because it needs no more::

    Session          source -> cameras, placements               info, within
      .scene_at      source meshed -> scene                      info, methods
      .drafts        scene -> one image per camera               preview, study
      .shown         image with outlines, clipped                plan, study
      .plan          what to decide                              plan
      .drawing       visibility -> lines -> drawing              draw
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from hlr.common.clock import Clock, lap
from hlr.common.types import Floats, Progress
from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import Note
from hlr.errors import StrictError
from hlr.image.camera import Camera, resolve
from hlr.image.clip import clipped
from hlr.image.image import Image, image_of
from hlr.image.outlines import outlined
from hlr.image.placement import Placement, check_size, of_one_scale, place
from hlr.image.transparency import glass_of, hiding, opacity_of, without_glass
from hlr.linework.curves import EdgeCurveLookup
from hlr.linework.lines import draw_lines
from hlr.pipeline.facts import note_meshing, note_reading, note_rescue, note_touching
from hlr.pipeline.finish import Solved, finished
from hlr.request.accuracy import ANGLE, REMESH, SMALL_DRAWING, SPHERE_MESH
from hlr.request.drawing_effects import drawing_effects, left_to_view
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options, Request, View
from hlr.scene.build import build
from hlr.scene.scene import Scene
from hlr.scene.scene_parts import OnCut
from hlr.source.bounds import diagonal
from hlr.source.model import Appearance, PartMesh, Source, Tessellation, mesh_finely
from hlr.source.selection import open_selected
from hlr.visibility.plan import Plan, decide
from hlr.visibility.segments import solve

Placing = Callable[[Camera, Options, Source, Floats], Placement]
"""Chooses a view's place on paper: as `hlr.image.placement.place`."""


MOST_MESHINGS = 3
"""A view whose outlines are smaller than was foreseen may get a larger scale, for which the source is meshed again."""


@dataclass(slots=True)
class Draft:
    """One view on its way to a drawing: its image, what was asked for (`by_view`), and what was decided so far."""

    image: Image
    options: Options
    planner: Planner


class Session:
    """A source before its cameras.

    source, bounds (2, 3); cameras and placements, one per view; clock: seconds by stage. The scene, the curves of its
    edges and the looks of its parts are there once `drafts` was called; of a section, so are the meshes of its parts,
    but of those that repeat another one.
    """

    scene: Scene
    edge_curves: EdgeCurveLookup
    looks: Mapping[str, Appearance]
    remarks: Sequence[Note]
    parts: Sequence[PartMesh]

    def __init__(
        self,
        source: Any,
        views: Sequence[View],
        options: Options,
        progress: Progress | None = None,
        placing: Placing = place,
        on_cut: OnCut | None = None,
    ) -> None:
        """source: whatever `hlr.source.open_source` takes; views, options: checked; on_cut: of a section.

        Raises SourceError, ViewError, OptionError.
        """
        started = perf_counter()
        self.options, self._on_cut = options, on_cut
        self.clock: Clock = {}
        self.progress = progress or (lambda _stage, _done: None)
        self.progress("source", 0.0)
        self.source = open_selected(source, options)
        self.views = views
        self.bounds = self.source.bounds()
        self.cameras = [resolve(view, options, self.source.frame, self.bounds) for view in views]
        placements = [placing(camera, options, self.source, self.bounds) for camera in self.cameras]
        self.placements = of_one_scale(placements, options)
        lap(self.clock, "source", started)
        self.progress("tessellate", 0.0)

    def scene_at(
        self, deflection: float, angle: float = ANGLE, planner: Planner | None = None, coarser: float = 1.0
    ) -> tuple[Scene, Tessellation]:
        """The source meshed with this chord error (model units) and turning (radians), and the scene of the mesh.

        coarser: times the chord error of the mesh, where no tolerance depends on it.
        """

        def made(finer: Collection[str]) -> tuple[Scene, Tessellation]:
            started = perf_counter()
            meshed = mesh_finely(self.source, coarser * deflection, angle, self.progress, finer)
            started = lap(self.clock, "tessellate", started)
            self.progress("scene", 0.0)
            scene = build(meshed, self.options.crease, deflection, planner, self._on_cut, self.source.appearances)
            lap(self.clock, "scene", started)
            return scene, meshed

        # The light on a filled face is divided at its triangles.
        scene, meshed = made(self.source.names() if self.options.fill else ())
        # Where a part touches itself, its facets matter as where it touches another.
        through = scene.through_themselves if len(meshed.touching) else ()
        coarse = [i for i in through if (part := meshed.parts[i]).brep and meshed.touching[i] < len(part.face_planar)]
        return made({scene.parts.labels[i].name for i in coarse}) if coarse else (scene, meshed)

    def scene_by_size(self) -> Scene:
        """The scene for a purpose without a drawing: meshed at a two-thousandth of its size.

        Raises SourceError for a model without size.
        """
        check_size(self.source, self.bounds)
        return self.scene_at(diagonal(self.bounds) / SMALL_DRAWING)[0]

    def drafts(self, lines_alone: bool = False) -> list[Draft]:
        """One draft per view, of one scene, meshed finely enough for all.

        With a page or a size to fit into, the scale depends on the outlines: these are then traced here.
        lines_alone: nothing but lines is made of the drafts, so a sphere may be meshed coarsely.
        """
        started, meshing = perf_counter(), 0.0
        planner = Planner(drawing_effects(), self.options)
        note_reading(planner, self.source)
        with planner.deciding():
            # Sources need not tell this (`Source`).
            ask = getattr(self.source, "is_one_sphere", None) if lines_alone else None
            sphere = ask is not None and bool(ask())
            perspective = any([camera.eye is not None for camera in self.cameras])
        coarser = 1.0 if planner.on("fine mesh", Facts(sphere=sphere, perspective=perspective)) else SPHERE_MESH
        for _ in range(MOST_MESHINGS):
            finest, begun = self._finest(), perf_counter()
            self.scene, meshed = self.scene_at(finest, self.placements[0].tolerances.angle, planner, coarser)
            meshing += perf_counter() - begun
            note_meshing(planner, self.scene)
            pairs = zip(self.cameras, self.placements, strict=True)
            drafts = [self._draft(camera, placement, planner.fork()) for camera, placement in pairs]
            self._fit(drafts)
            if self._finest() > REMESH * finest:
                break
        for draft in drafts:
            note_touching(draft.planner, self.scene, meshed)
            note_rescue(draft.planner, self.scene, meshed)
        self.edge_curves = meshed.edge_curves
        self.parts = ()
        if self.options.section is not None:
            repeated = self.scene.parts.repeated
            self.parts = [part for i, part in enumerate(meshed.parts) if i not in repeated]
        self.looks = self.source.appearances() if self.source.transparent() else {}
        self.remarks = [] if self.options.see_through else hiding(self.scene, self.looks)
        # Images and the sizes of their outlines belong to all views, as the scene does.
        lap(self.clock, "scene", started + meshing)
        return drafts

    def _finest(self) -> float:
        """The deflection that the finest of the views needs, model units."""
        return min([placement.tolerances.deflection for placement in self.placements])

    def _draft(self, camera: Camera, placement: Placement, planner: Planner) -> Draft:
        return Draft(image_of(self.scene, camera, placement), by_view(self.options, camera, planner), planner)

    def _fit(self, drafts: Sequence[Draft]) -> None:
        """Give drafts their final scales. Outlines have to fit: they reach beyond the mesh, within the accuracy."""
        if all([placement.settled for placement in self.placements]):
            return
        surfaces = self.scene.true_surfaces
        bends = surfaces is not None and bool(surfaces.curved_faces or (np.diff(self.scene.walks.offsets) > 1).any())
        traced, fitted = [], []
        for draft in drafts:
            image = draft.image
            found = image if image.placement.settled else outlined(image, draft.planner)
            traced.append(found)
            fitted.append(image.placement.fitted(image.camera, draft.options, found.points, bends))
        self.placements = of_one_scale(fitted, self.options)
        for draft, found, placement in zip(drafts, traced, self.placements, strict=True):
            before = draft.image.placement
            if placement is not before:
                # At another scale the outlines are traced anew: finer, or less fine.
                same = placement.tolerances.deflection == before.tolerances.deflection
                draft.image = (found if same else draft.image).placed(placement)

    def shown(self, draft: Draft) -> Image:
        """The image as it is drawn: with outlines, clipped, and without glass where the viewer sees through it."""
        image, planner = draft.image, draft.planner
        least = min(map(opacity_of, self.looks.values()), default=1.0)
        if planner.on("seeing through glass", Facts(opacity=least)):
            glass = glass_of(self.scene, self.looks)
            planner.spent("seeing through glass", glass_triangles=int(glass.sum()))
            image = without_glass(outlined(image, planner), glass)
        return clipped(outlined(image, planner), planner)

    def plan(self, draft: Draft, image: Image) -> Plan:
        """The kernel's instructions for an image that `shown` gave."""
        return decide(image, draft.options, draft.planner)

    def drawing(self, draft: Draft, request: Request | None = None) -> Drawing:
        """The drawing of one view. request: what was asked for, which the drawing remembers."""
        options, clock = draft.options, dict(self.clock)
        started = perf_counter()
        image = self.shown(draft)
        plan = self.plan(draft, image)
        started = lap(clock, "plan", started)
        segments = solve(image, plan, image.lifted(plan.divide))
        started = lap(clock, "visibility", started)
        lines = draw_lines(image, self.edge_curves, plan, segments, bool(options.hidden))
        lap(clock, "linework", started)
        solved = Solved(image, plan, segments, lines)
        return finished(self.source, self.scene, solved, draft.planner, options, clock, request, self.remarks)


def by_view(options: Options, camera: Camera, planner: Planner) -> Options:
    """The options of one view: what was left to the kind of view is yes or no."""
    facts = Facts(pictorial=camera.pictorial)
    found: dict[str, Any] = {name: planner.on(effect, facts) for name, effect in left_to_view().items()}
    return options if all(getattr(options, name) is on for name, on in found.items()) else replace(options, **found)


def refuse_warnings(notes: Sequence[Note]) -> None:
    """Raise StrictError for the first warning among the notes."""
    for note in notes:
        if note.is_warning:
            raise StrictError(note.text)
