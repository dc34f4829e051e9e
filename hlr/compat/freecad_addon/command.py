"""The command "Exact drawing" and its workbench, as FreeCAD's user interface knows them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hlr.errors import HlrError
from hlr.request.options import View

NAME, TITLE = "HLR_ExactDrawing", "Exact drawing"

HELP = (
    "Draws the selected TechDraw page, the one that is open, or the selected objects as they are seen, with exact "
    "hidden lines, on a page of its own"
)


class ExactDrawing:
    """The command."""

    def GetResources(self) -> dict[str, str]:
        """What FreeCAD shows of it."""
        return {"MenuText": TITLE, "ToolTip": HELP, "Pixmap": icon()}

    def IsActive(self) -> bool:
        """Whether it can be chosen."""
        import FreeCAD

        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
        """Draw; what cannot be drawn is said in a box."""
        run()


def icon() -> str:
    """The file of the command's icon, of the folder that FreeCAD loads the add-on from; empty where it is missing."""
    import FreeCAD

    file = Path(FreeCAD.getUserAppDataDir()) / "Mod" / "ExactDrawing" / "icon.svg"
    return str(file) if file.exists() else ""


def run() -> Any:
    """Draw what is selected in the user interface, and open its page; None where that cannot be drawn."""
    import FreeCAD
    import FreeCADGui

    from hlr.compat.freecad_addon.exact import PAGE, exact_drawing, exact_page

    chosen = FreeCADGui.Selection.getSelection() or _open_page(FreeCADGui)
    pages = [thing for thing in chosen if thing.isDerivedFrom(PAGE)]
    FreeCAD.ActiveDocument.openTransaction(TITLE)
    try:
        page = exact_page(pages[0]) if pages else exact_drawing(chosen, _seen(FreeCADGui))
    except HlrError as error:
        FreeCAD.ActiveDocument.abortTransaction()
        _tell(str(error))
        return None
    FreeCAD.ActiveDocument.commitTransaction()
    page.ViewObject.doubleClicked()
    return page


def _open_page(gui: Any) -> list[Any]:
    """The page whose window is in front."""
    view = _view(gui)
    return [view.getPage()] if hasattr(view, "getPage") else []


def _seen(gui: Any) -> View:
    """From where the model is seen in the window in front; isometric where that is none of the model."""
    view = _view(gui)
    if not hasattr(view, "getViewDirection"):
        return "iso"
    x, y, z = view.getViewDirection()
    return -x, -y, -z


def _view(gui: Any) -> Any:
    """The window in front; None where there is none."""
    return gui.ActiveDocument.ActiveView if gui.ActiveDocument else None


def _tell(text: str) -> None:
    from PySide import QtGui

    QtGui.QMessageBox.warning(None, TITLE, text)


def register() -> None:
    """Add the command and its workbench to FreeCAD's user interface."""
    import FreeCADGui

    class ExactDrawingWorkbench(FreeCADGui.Workbench):  # type: ignore[misc]
        """One command, in a toolbar and a menu."""

        MenuText, ToolTip, Icon = TITLE, HELP, icon()

        def Initialize(self) -> None:
            """Called by FreeCAD when it is opened for the first time."""
            import TechDrawGui  # noqa: F401  # pages need it

            self.appendToolbar(TITLE, [NAME])
            self.appendMenu(TITLE, [NAME])

        def GetClassName(self) -> str:
            """The class of workbenches in Python."""
            return "Gui::PythonWorkbench"

    FreeCADGui.addCommand(NAME, ExactDrawing())
    FreeCADGui.addWorkbench(ExactDrawingWorkbench())
