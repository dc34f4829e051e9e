"""`hlr plan`: which steps a drawing needs, and why, without drawing it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError

from ..document_pages import names_a_page
from ..guard import start
from ..meter import meter
from ..section_options import SECTION, names_of_drawings, with_sections
from ..streams import result_only
from ..style_options import STYLE, style_from
from ..verb import Verb
from ..view_options import CAMERA, CARE, CHOICE, CIRCLES, RUN, SIZE, TIME_LIMIT, VIEW, WINDOW, options
from .draw import LINES, request_of

if TYPE_CHECKING:
    from hlr.request.options import View


@click.command(cls=Verb)
@click.argument("source")
@VIEW
@options(*CHOICE, *LINES, *SECTION, *SIZE, WINDOW, CIRCLES, *CARE, TIME_LIMIT, *CAMERA, *STYLE, *RUN)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@click.option("-q", "--quiet", is_flag=True, help="No progress on the terminal.")
def plan(*, source: str, views: tuple[View, ...], as_json: bool, quiet: bool, **chosen: Any) -> None:
    """Show which steps a drawing of SOURCE needs, and why.

    \b
      hlr plan part.step
      hlr plan part.step --view front --perspective --json
      hlr plan part.step --section front

    The model is read, cut for a section, and meshed; visibility is not computed and nothing is drawn. `hlr draw
    --explain` adds what each step has cost.
    """
    time_limit = chosen.pop("time_limit")
    sections = chosen["section"]
    chosen["section"] = sections or None
    views = with_sections(views, sections, chosen["eye"])
    names_of_drawings(views, sections, chosen["whole"], chosen["eye"])
    if names_a_page(source, page := chosen["page"]):
        raise OptionError(f"{page} is no sheet, and pages of a document have no plan: hlr draw draws them")
    views = views or ("iso",)
    request = request_of(style=style_from(chosen), **chosen)
    start(source, time_limit)
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            planned = hlr.plan_views(source, list(views), request, progress=progress)
        if as_json:
            import json

            from hlr.tables.documents import head

            entries = [{"view": p.view, "plan": [d.as_dict() for d in p.decisions]} for p in planned]
            text = json.dumps(head("hlr-plan") | {"plans": entries}, indent=2)
        else:
            from hlr.request.effect import explained

            several = len(planned) > 1
            text = "\n\n".join((f"{p.view}\n" if several else "") + explained(p.decisions) for p in planned)
        out.show(text.split("\n"))
