"""FreeCAD documents (.FCStd) as sources: what they show, read without FreeCAD."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from hlr.drawing.notes import Note
from hlr.errors import SourceError, counted
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import without_opencascade
from hlr.source.cad.parts import Leaf
from hlr.source.freecad.document import Document, open_document
from hlr.source.freecad.properties import DamagedError
from hlr.source.freecad.shapes import Shapes
from hlr.source.freecad.tree import TooManyError, Tree
from hlr.source.joined import JoinedSource, source_of_both
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.objects import Meshes


def open_fcstd(path: Path, hidden_objects: bool = False) -> BrepSource | MeshSource | JoinedSource:
    """A FreeCAD document. hidden_objects: what it does not show is read as well.

    Raises:
        SourceError: it is no FreeCAD document, broken or hostile, or shows nothing that can be drawn.
    """

    def read(opencascade: bool) -> tuple[list[Leaf], list[Meshes], list[Note]]:
        with opened_document(path) as document:
            tree = Tree(document, Shapes(opencascade), hidden_objects, meshes=True)
            leaves, notes = _shown(tree, path.name)
            return leaves, tree.meshes, notes

    leaves, meshes, notes = without_opencascade(read)
    return source_of_both(path.name, "fcstd", leaves, meshes, notes)


def read_document(
    path: Path, opencascade: bool, hidden_objects: bool = False, only: Sequence[str] | None = None
) -> tuple[list[Leaf], list[Note]]:
    """What a document shows as leaves of an assembly, and what was left out, such as meshes.

    only: the names of objects, and no others.

    opencascade: it reads the shapes, not the kernel.

    Raises:
        SourceError: as `open_fcstd`. NeedsOpenCascadeError: the kernel cannot take some shape.
    """
    with opened_document(path) as document:
        return leaves_of(document, path.name, Shapes(opencascade), hidden_objects, only)


@contextmanager
def opened_document(path: Path) -> Iterator[Document]:
    """An open document; what is broken in it, wherever that shows, is an error in one sentence.

    Raises:
        SourceError: as `open_fcstd`.
    """
    with open_document(path) as document:
        try:
            yield document
        except TooManyError as error:
            raise SourceError(f"{path.name} {error}: it is refused.") from None
        except DamagedError as error:
            raise SourceError(f"{path.name} cannot be read as a FreeCAD document: {error}.") from None


def leaves_of(
    document: Document,
    name: str,
    shapes: Shapes,
    hidden_objects: bool = False,
    only: Sequence[str] | None = None,
    *,
    sketches: bool = False,
) -> tuple[list[Leaf], list[Note]]:
    """What an open document shows, and what was left out, as of `read_document`. name: of the file, for errors.

    sketches: they are drawn beside shapes that have faces, too.

    Raises:
        SourceError: there is nothing to draw. TooManyError, DamagedError: it is broken or hostile.
        NeedsOpenCascadeError: the kernel reads the shapes, and cannot take one of them.
    """
    return _shown(Tree(document, shapes, hidden_objects, only), name, sketches)


def _shown(tree: Tree, name: str, sketches: bool = False) -> tuple[list[Leaf], list[Note]]:
    notes = list(tree.notes)
    if tree.left_hidden:
        notes.append(_hidden_note(tree.left_hidden))
    if not tree.leaves and not tree.sketches and not tree.meshes:
        raise SourceError(f"{name} {_why_empty(tree)}.")
    if sketches:
        return tree.leaves + tree.sketches, notes
    faced = bool(tree.leaves or tree.meshes)
    if faced and tree.sketches:
        left_out = f"{counted(len(tree.sketches), 'sketch', 'sketches')} left out"
        notes.append(Note("free-edges-left-out", f"{left_out}: a hidden-line drawing needs faces."))
    return tree.leaves if faced else tree.sketches, notes


def _hidden_note(count: int) -> Note:
    what = f"{counted(count, 'object')} that the document hides left out"
    return Note("hidden-objects-left-out", f"{what}: --hidden-objects draws them (in Python, hidden_objects=True).")


def _why_empty(tree: Tree) -> str:
    if tree.notes:
        return f"shows no shapes that can be drawn, for {tree.notes[0].text.rstrip('.')}"
    if tree.left_hidden:
        return "hides all its objects (--hidden-objects draws them): there is nothing to draw"
    return "holds no shapes: there is nothing to draw"
