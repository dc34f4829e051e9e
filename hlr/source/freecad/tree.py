"""The tree of a FreeCAD document: groups, bodies, links and arrays, as leaves placed as FreeCAD means it.

A leaf is named by the labels on the way to it: Trolley/Axle/Wheel. A link stands for what it refers to, and its own
label takes the place of that one's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from hlr.drawing.notes import Note
from hlr.errors import counted
from hlr.source.cad.parts import Leaf
from hlr.source.freecad.colors import Look, look_of, look_of_link
from hlr.source.freecad.document import Document, Object
from hlr.source.freecad.kept_mesh import KeptMeshes
from hlr.source.freecad.object_kinds import (
    AIDS,
    BODIES,
    SKETCHES,
    TARGETS,
    holds_shapes,
    ingredients,
    is_folder,
    is_link,
    leads_to,
    members,
    moves,
)
from hlr.source.freecad.properties import DamagedError, Properties
from hlr.source.freecad.rings import rings
from hlr.source.freecad.shapes import Shapes
from hlr.source.mesh.objects import Meshes
from hlr.source.transforms import IDENTITY, MatrixRows, compose

MAX_DEPTH = 100
"""Levels of a tree that are followed."""

MAX_LEAVES = 200_000
"""Instances of shapes in one document: arrays of arrays have no other end."""

MAX_VISITS = 1_000_000
"""Objects that are followed in one document, each as often as groups and links lead to it: almost any number of ways
may lead through a few of them."""

_MOST_NAMED = 5
"""Objects that one note names."""


class TooManyError(ValueError):
    """A document that holds more than can be drawn; the message says how many."""


@dataclass(frozen=True, slots=True)
class _Context:
    """What an object has from those above it.

    place   placement of all above
    placed  its own placement counts as well
    names   labels on the way to it
    above   the names of the objects on the way to it: a link to one of them would have no end
    look    a colour that a link gives
    label   a label that takes the place of its own
    path    the way on to the one object within it that a link asks for; empty: all that is in it
    beside  the names of the objects that were met in the group around it that places them, and in its folders
    ring    the number of the ring that it is in: objects that hold one another
    met     the names of the objects of that ring which were met since the way came into it: each is followed once
    """

    place: MatrixRows = IDENTITY
    placed: bool = True
    names: tuple[str, ...] = ()
    above: tuple[str, ...] = ()
    look: Look | None = None
    label: str = ""
    path: tuple[str, ...] = ()
    beside: set[str] = field(default_factory=set)
    ring: int = -1
    met: set[str] = field(default_factory=set)


class Tree:
    """The tree of a document, flattened into `leaves`. `notes`: what was left out, and why.

    hidden: objects that the document does not show count as well, unless others are made of them.
    only: the names of objects that are drawn, shown or not, where they lie in the document; None: all that it shows.
    meshes: they are read into `meshes`; FreeCAD's own pages show none.
    """

    def __init__(
        self,
        document: Document,
        shapes: Shapes,
        hidden: bool = False,
        only: Sequence[str] | None = None,
        *,
        meshes: bool = False,
    ) -> None:
        self.document, self.shapes = document, shapes
        self.leaves: list[Leaf] = []
        self.sketches: list[Leaf] = []
        self.meshes: list[Meshes] = []
        self._kept = KeptMeshes() if meshes else None
        self.left_hidden = 0
        self._left_out: dict[str, None] = {}
        self._without_colors: dict[str, None] = {}
        self._deep: dict[str, None] = {}
        self._visits = 0
        self._hidden = hidden
        self._made_of = set(ingredients(document))
        self._group: dict[str, list[str]] = {}
        self._rings = rings(document.objects, lambda name: leads_to(document.objects[name]))
        parents = {name: thing for thing in document.objects.values() for name in members(thing)}
        if only is None:
            for thing in document.objects.values():
                if thing.name not in parents and self._is_shown(thing):
                    self._visit(thing, _Context())
        for name in only or ():
            if name in document.objects:
                self._visit(document.objects[name], _Context(place=_place_around(name, parents)))
        self.notes = list(self._told())

    def _is_shown(self, thing: Object) -> bool:
        if thing.name in self._made_of and (self._hidden or not self.document.has_view):
            # Without the user interface FreeCAD calls everything visible.
            return thing.visible and self.document.has_view
        shown = thing.visible or self._hidden
        self.left_hidden += not shown and thing.name not in self._made_of and holds_shapes(thing)
        return shown

    def _visit(self, thing: Object, context: _Context) -> None:
        label = context.label or thing.label
        ring = self._rings[thing.name]
        if thing.name in context.above or (ring == context.ring and thing.name in context.met):
            self._leave_out(f'"{label}" leads back to itself and was left out.')
            return
        if len(context.above) >= MAX_DEPTH:
            self._deep[label] = None
            return
        self._visits += 1
        if self._visits > MAX_VISITS:
            return
        inner = replace(
            context, names=(*context.names, label), above=(*context.above, thing.name), placed=True, label=""
        )
        if ring != context.ring:
            inner = replace(inner, ring=ring, met=set())
        inner.met.add(thing.name)
        if is_link(thing):
            look = context.look or self._look(look_of_link, thing, "/".join(inner.names))
            self._link(thing, replace(inner, place=_own_place(thing, context), look=look))
        elif thing.type in AIDS:
            return
        elif (members := self._members_of(thing)) and (context.path or thing.type not in BODIES):
            if moves(thing):
                inner = replace(inner, place=_own_place(thing, context), beside=set())
            else:
                inner = replace(inner, place=context.place)
            self._members(members, inner)
        elif context.path:
            self._leads_nowhere(label)
        elif "Shape" in thing.values:
            self._shape(thing, context, "/".join(inner.names))
        elif "Mesh" in thing.values:
            self._mesh(thing, context, "/".join(inner.names))

    def _members(self, names: list[str], context: _Context) -> None:
        if context.path:
            self._follow(names, context)
            return
        in_folders = self._in_folders(names)
        for name in names:
            thing = self.document.objects.get(name)
            if thing is None or name in in_folders or (name in context.beside and name not in context.above):
                continue
            if self._is_shown(thing):
                context.beside.add(name)
                self._visit(thing, context)

    def _follow(self, names: list[str], context: _Context) -> None:
        """Go on to the one member that a link asks for, shown or not. The label of the link takes its label's place."""
        wanted, label = context.path[0], context.names[-1]
        for name in names:
            thing = self.document.objects.get(name)
            if thing is not None and wanted in (name, f"${thing.label}"):
                self._visit(thing, replace(context, names=context.names[:-1], label=label, path=context.path[1:]))
                return
        self._leads_nowhere(label)

    def _in_folders(self, names: list[str]) -> set[str]:
        """The members that lie in folders among them: a part lists what is in its folders beside these once more."""
        things = ((name, self.document.objects.get(name)) for name in names)
        folders = {
            name: self._members_of(thing)
            for name, thing in things
            if thing is not None and is_folder(thing) and (thing.visible or self._hidden)
        }
        inner = set[str]().union(*folders.values())
        # Folders that hold one another are in none that is followed.
        ahead, found = [name for name in folders if name not in inner], set[str]()
        while ahead:
            new = set(folders[ahead.pop()]) - found
            found |= new
            ahead += sorted(new & folders.keys())
        return found

    def _link(self, thing: Object, context: _Context) -> None:
        """A link, an array of links, or a group of links; context: that of what is in it."""
        values, label = thing.values, context.names[-1]
        elements = values.links("ElementList")
        shown = values.bits("VisibilityList")
        if elements and context.path:
            self._follow(elements, context)
            return
        if elements:
            for number, name in enumerate(elements):
                element = self.document.objects.get(name)
                if element is not None and (self._hidden or shown[number : number + 1] != "0"):
                    self._visit(element, replace(context, beside=set()))
            return
        target, path = self._target(thing, label)
        if target is None:
            return
        # The label of a link takes the place of that of its target.
        context = replace(context, names=context.names[:-1], label=label, placed=values.flag("LinkTransform", False))
        count = values.count("ElementCount") or values.count("Count")
        if not count:
            self._visit(target, replace(context, path=(*path, *context.path), beside=set()))
            return
        if context.path:
            self._leads_nowhere(label)
            return
        context = replace(context, path=path)
        places, scales = values.placements("PlacementList"), values.vectors("ScaleList")
        for number in range(count):
            if shown[number : number + 1] == "0" and not self._hidden:
                continue
            place = compose(context.place, places[number]) if number < len(places) else context.place
            if number < len(scales):
                place = compose(place, _scaling(*scales[number]))
            self._visit(target, replace(context, place=place, beside=set()))

    def _target(self, thing: Object, label: str) -> tuple[Object | None, tuple[str, ...]]:
        """What a link refers to, and the way on to what it shows of it; None, with a note, where it cannot be drawn."""
        for name in TARGETS:
            if name not in thing.values:
                continue
            if other := thing.values.other_document(name):
                self._leave_out(f'"{label}" is kept in another document, {other}, and was left out: draw that one too.')
                return None, ()
            # A dot follows each object: what stands after the last one is a face or an edge.
            subs = thing.values.sub_names(name)
            if len(subs) > 1 or not all(sub.endswith(".") for sub in subs):
                self._leave_out(f'"{label}" is a link to a part of an object and was left out.')
                return None, ()
            target = self.document.objects.get(thing.values.link(name))
            if target is not None:
                return target, tuple(subs[0].split(".")[:-1]) if subs else ()
        self._leave_out(f'"{label}" is a link to nothing and was left out.')
        return None, ()

    def _shape(self, thing: Object, context: _Context, name: str) -> None:
        self._check_count()
        # A body shows its tip, in the colours of the tip.
        tip = self.document.objects.get(thing.values.link("Tip")) if thing.type in BODIES else None
        try:
            if self.shapes.of(thing) is None:  # as of an empty body
                return
            look = context.look or self._look(look_of, tip or thing, name)
            leaf = self.shapes.leaf(thing, name, context.place, context.placed, look)
        except ValueError as error:
            self._leave_out(f'"{name}" was left out: its shape {error}.')
            return
        (self.sketches if thing.type in SKETCHES else self.leaves).append(leaf)

    def _mesh(self, thing: Object, context: _Context, name: str) -> None:
        if self._kept is None:
            self._leave_out(
                f'"{context.label or thing.label}" is a mesh and was left out: export it as STL, 3MF or OBJ to draw it.'
            )
            return
        self._check_count()
        look = context.look or self._look(look_of, thing, name)
        try:
            self.meshes.append(self._kept.placed(thing, name, context.place, context.placed, look))
        except ValueError as error:
            self._leave_out(f'"{name}" was left out: its mesh {error}.')

    def _check_count(self) -> None:
        if len(self.leaves) + len(self.meshes) >= MAX_LEAVES:
            raise TooManyError(f"places more than {MAX_LEAVES} shapes")

    def _leads_nowhere(self, label: str) -> None:
        self._leave_out(f'"{label}" is a link to what its target does not hold, and was left out.')

    def _look(self, read: Callable[[Properties], Look | None], thing: Object, name: str) -> Look | None:
        """The colours of an object, which the tree calls `name`; None, with a note, where they are damaged."""
        try:
            return read(thing.view)
        except DamagedError as error:
            self._without_colors[f'"{name}" is drawn without its colours: {error}.'] = None
            return None

    def _members_of(self, thing: Object) -> list[str]:
        """What is in a group; read once."""
        if thing.name not in self._group:
            self._group[thing.name] = members(thing)
        return self._group[thing.name]

    def _leave_out(self, text: str) -> None:
        self._left_out[text] = None

    def _told(self) -> Iterator[Note]:
        yield from (Note("part-left-out", text) for text in self._left_out)
        if self._deep:
            named = ", ".join(f'"{label}"' for label in list(self._deep)[:_MOST_NAMED])
            more = " and others" if len(self._deep) > _MOST_NAMED else ""
            what = f"{counted(len(self._deep), 'object')} at the end of more than {MAX_DEPTH} groups and links"
            yield Note("part-left-out", f"{what} left out: {named}{more}.")
        if self._visits > MAX_VISITS:
            text = f"Groups and links lead to more than {MAX_VISITS} objects: those that come later were left out."
            yield Note("part-left-out", text)
        yield from (Note("colors-left-out", text) for text in self._without_colors)


def _own_place(thing: Object, context: _Context) -> MatrixRows:
    """The placement of what is in a group or a link: its own after that of all above, then its scale."""
    values = thing.values
    own = values.placement("LinkPlacement" if "LinkPlacement" in values else "Placement")
    place = compose(context.place, own) if context.placed else context.place
    if not is_link(thing):
        return place
    even = values.number("Scale", 1.0)
    scale = values.vector("ScaleVector", (even, even, even))
    return place if scale == (1.0, 1.0, 1.0) else compose(place, _scaling(*scale))


def _place_around(name: str, parents: Mapping[str, Object]) -> MatrixRows:
    """The placement of all groups that an object is in. parents: the group of each object that is in one."""
    around: list[Object] = []
    while (parent := parents.get(name)) is not None and parent not in around:
        around.append(parent)
        name = parent.name
    place = IDENTITY
    for parent in reversed(around):
        if moves(parent):
            place = _own_place(parent, _Context(place))
    return place


def _scaling(x: float, y: float, z: float) -> MatrixRows:
    return (x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, z, 0.0)
