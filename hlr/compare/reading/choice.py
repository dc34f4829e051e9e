"""Which parts of a model are compared, and where they come from: what `hlr.draw` calls so as well."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from hlr.errors import OptionError
from hlr.request.check import checked
from hlr.request.options import Options, Parameter
from hlr.tables.entry import listed
from hlr.tables.readers import of_ending

ACCURACY_SHARE = 0.2
"""Of the tolerance: how exactly a model or a page is drawn to be compared with the drawing of another program."""


@dataclass(frozen=True, slots=True)
class Choice:
    """What is chosen of a model; each field as of `hlr.Options`."""

    only: tuple[str, ...] = ()
    hide: tuple[str, ...] = ()
    var: str | None = None
    parameters: Mapping[str, Parameter] | None = field(default=None, hash=False)
    annotations: bool = False
    hidden_objects: bool = False

    def options(self, **others: Any) -> Options:
        """A request for a drawing with this choice. Raises OptionError for what is no choice."""
        chosen = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return checked(Options(**chosen | others))

    @property
    def given(self) -> list[str]:
        """The names of what is asked for."""
        usual = Choice()
        return [name for name in self.__dataclass_fields__ if getattr(self, name) != getattr(usual, name)]

    def check_of_models(self, drawn: tuple[bool, bool]) -> None:
        """Raise OptionError where something is chosen, and both sides are drawings. drawn: whether each is one."""
        if all(drawn) and self.given:
            names, them = listed([f"`{name}`" for name in self.given], "and"), "it" if len(self.given) == 1 else "them"
            raise OptionError(
                f"{names} {'is' if them == 'it' else 'are'} for a model, and both sides are drawings: leave {them} "
                "out, or name a model in place of one"
            )

    def of(self, model: Any, beside: Any) -> Choice:
        """The choice for one of two models: what is for scripts alone goes to the script, where just one is one."""
        if _is_script(beside) and not _is_script(model):
            return replace(self, var=None, parameters=None)
        return self


def _is_script(given: Any) -> bool:
    reader = of_ending(Path(given).suffix) if isinstance(given, str | os.PathLike) else None
    return reader is not None and reader.kind == "script"
