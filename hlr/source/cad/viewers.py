"""Viewers that scripts import. While a script runs, a stand-in is in the place of each: nothing is opened or sent.

`from ocp_vscode import show` or `from cadquery.vis import show` then work as the functions that every script finds:
what is shown is drawn. All else that a viewer has, such as ports, cameras and colour maps, takes any call and does
nothing, whether the viewer is installed or not.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from hlr.source.cad.colors import ColorOpacity, color_from_options

Shown = tuple[Any, str, ColorOpacity]
"""An object, the name it is shown under or "", and its colour and opacity."""

VIEWERS: dict[str, tuple[str, ...]] = {
    name: tuple(given.split())
    for name, given in {
        "ocp_vscode": """
            AnalysisTool Animation BaseColorMap Camera Collapse ColorMap GoldenRatioColormap ImageFace ListedColorMap
            MessageType Render SeededColormap SegmentedColorMap StudioBackground StudioEnvironment StudioTextureMapping
            StudioToneMapping UiTab VSCodeComms camera_keep_warning check_deprecated combined_config comms_warning
            default find_and_set_port get_colormap get_default get_defaults get_host get_port hex_to_rgb hsv_mapper
            ignore_camera_warnings is_pytest listener matplotlib_mapper none_filter port_check push_object
            random_rgb_mapper remove_object reset_defaults reset_show save_screenshot select_edge select_edges
            select_face select_faces select_vertex select_vertices send_backend send_command send_config send_data
            set_colormap set_defaults set_port set_viewer_config show show_all show_clear show_object show_objects
            status unset_colormap web_to_rgb workspace_config
        """,
        "jupyter_cadquery": "show show_object show_all set_defaults open_viewer close_viewer",
        "cq_vscode": "show show_object show_all set_defaults reset_show",
        "yacv_server": "show show_object show_all clear remove export_all",
        "cq_server": "ui",
        "cadquery.vis": "show show_object style ctrlPts",
    }.items()
}
"""By the name of its module or package: what `from ... import *` gives of a viewer."""


class Showing:
    """What a script shows, in the order of its calls: `shown`.

    drawable: gives the variables of the script that can be drawn
    """

    def __init__(self) -> None:
        self.shown: list[Shown] = []
        self.drawable: Callable[[], Mapping[str, Any]] = dict
        self._pushed: list[Shown] = []

    def show_object(self, obj: Any, name: str | None = None, options: Any = None, *_: Any, **more: Any) -> None:
        """As of CQ-editor and cq-cli. `alpha` is transparency."""
        self.shown.append((obj, str(name or ""), color_from_options(_options(options, more))))

    def show(self, *objects: Any, names: Any = (), colors: Any = (), alphas: Any = (), **_: Any) -> None:
        """As of viewers: any number of objects in place of earlier ones, with lists of names, colours, opacities."""
        self.reset_show()
        of_all = [[given] if isinstance(given, str) else given for given in (names, colors, alphas)]
        for i, obj in enumerate(objects):
            name, color, alpha = (_at(given, i) for given in of_all)
            self.shown.append((obj, str(name or ""), _opaque(color, alpha)))

    def display(self, *objects: Any, **_: Any) -> None:
        """As of notebooks, where each call has a picture of its own: the last one with shapes counts."""
        from hlr.source.cad.objects import is_shape_like

        shapes = [obj for obj in objects if is_shape_like(obj)]
        if shapes:
            self.show(*shapes)

    def reset_show(self, *_: Any, **__: Any) -> None:
        """Of viewers: forget what was shown."""
        self.shown.clear()

    def show_all(self, *_: Any, include: Any = None, exclude: Any = (), **__: Any) -> None:
        """As of viewers: the script's variables, under their names, in place of what was shown before."""
        self.reset_show()
        for name, obj in self.drawable().items():
            if (not include or name in include) and name not in (exclude or ()):
                self.shown.append((obj, name, (None, 1.0)))

    def push_object(self, obj: Any, name: str | None = None, color: Any = None, alpha: Any = None, **_: Any) -> None:
        """Of viewers: to be shown by `show_objects`."""
        self._pushed.append((obj, str(name or ""), _opaque(color, alpha)))

    def show_objects(self, *_: Any, **__: Any) -> None:
        """Of viewers: all that was pushed."""
        self.shown += self._pushed
        self._pushed = []

    def _show_object_of_viewer(
        self, obj: Any, name: str | None = None, options: Any = None, *_: Any, clear: bool = False, **more: Any
    ) -> None:
        """As of viewers. `alpha` is opacity; clear: in place of what was shown before."""
        if clear:
            self.reset_show()
        given = _options(options, more)
        self.shown.append((obj, str(name or ""), _opaque(given.get("color"), given.get("alpha"))))

    def of_viewers(self) -> dict[str, Callable[..., Any]]:
        """By name what viewers have that is more than nothing."""
        return {
            "show": self.show,
            "show_object": self._show_object_of_viewer,
            "push_object": self.push_object,
            "show_objects": self.show_objects,
            "show_all": self.show_all,
            "reset_show": self.reset_show,
            "show_clear": self.reset_show,
            "style": lambda obj, *_, **__: obj,
        }


def _options(given: Any, more: Mapping[str, Any]) -> Mapping[str, Any]:
    """Options as a dict, or as the JSON text of one; more: those given by name, where there is neither."""
    if isinstance(given, str):
        with suppress(ValueError, RecursionError):
            given = json.loads(given)
    return given if isinstance(given, Mapping) else more


def _at(given: Any, i: int) -> Any:
    """The item with this index of what should be a list; None where there is none."""
    return given[i] if isinstance(given, Sequence) and i < len(given) else None


def _opaque(color: Any, alpha: Any) -> ColorOpacity:
    """Colour and opacity as viewers have them: `alpha` is 1 for what hides all behind it."""
    clear = {"alpha": 1.0 - alpha} if isinstance(alpha, int | float) else {}
    return color_from_options({"color": color, **clear})


class _Nothing:
    """Takes any call, attribute and index, and is itself what they give; holds nothing."""

    def __call__(self, *_: Any, **__: Any) -> _Nothing:
        return self

    def __getattr__(self, name: str) -> _Nothing:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __getitem__(self, _: Any) -> _Nothing:
        return self

    def __iter__(self) -> Iterator[Any]:
        return iter(())

    def __bool__(self) -> bool:
        return False

    def __enter__(self) -> _Nothing:
        return self

    def __exit__(self, *_: object) -> None: ...


class _StandIn(ModuleType):
    """A module of a viewer, or one inside it."""

    def __init__(self, name: str, functions: Mapping[str, Callable[..., Any]]) -> None:
        super().__init__(name)
        self.__path__: list[str] = []
        self.__all__ = [*VIEWERS.get(name, ())]
        vars(self).update(functions)

    def __getattr__(self, name: str) -> _Nothing:
        if name.startswith("__"):
            raise AttributeError(name)
        return _Nothing()


def is_viewer(name: str) -> bool:
    """A viewer's own module, or one inside it."""
    return any(name == viewer or name.startswith(f"{viewer}.") for viewer in VIEWERS)


class _Finder(MetaPathFinder, Loader):
    """Finds stand-ins where a viewer is imported."""

    def __init__(self, functions: Mapping[str, Callable[..., Any]]) -> None:
        self._functions = functions

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        """As of MetaPathFinder."""
        return ModuleSpec(fullname, self, is_package=True) if is_viewer(fullname) else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """As of Loader."""
        return _StandIn(spec.name, self._functions)

    def exec_module(self, module: ModuleType) -> None:
        """As of Loader: it is complete."""


@contextmanager
def stand_ins(showing: Showing) -> Iterator[None]:
    """Within this block a viewer that is imported is a stand-in, which shows to `showing`."""
    before = {name: sys.modules.pop(name) for name in list(sys.modules) if is_viewer(name)}
    finder = _Finder(showing.of_viewers())
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in [name for name in sys.modules if is_viewer(name)]:
            _forget(name, sys.modules.pop(name))
        sys.modules.update(before)
        for name, module in before.items():
            parent, _, own = name.rpartition(".")
            if parent in sys.modules:
                setattr(sys.modules[parent], own, module)


def _forget(name: str, module: ModuleType) -> None:
    """Take a stand-in out of the package that it was imported into."""
    parent, _, own = name.rpartition(".")
    package = sys.modules.get(parent)
    if package is not None and vars(package).get(own) is module:
        delattr(package, own)
