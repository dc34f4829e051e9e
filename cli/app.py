"""The `hlr` command and its list of subcommands."""

from __future__ import annotations

from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from hlr.tables.readers import endings, file_titles
from hlr.tables.writers import titles

VERBS = {
    "draw": f"Draw a model as {titles('or')}.",
    "batch": "Draw many models, only what has changed, with a report.",
    "plan": "Which steps a drawing needs, and why, without drawing it.",
    "compare": "What differs between two drawings, by their geometry.",
    "preview": "Shaded picture of a model as PNG.",
    "methods": "Time the visible-surface methods side by side.",
    "study": "Measure what accuracy costs, and compare with other programs.",
    "info": "Parts, faces, edges, triangles and defects of a model.",
    "cache": "Show or clear the cache of models that were read before.",
}


class Verbs(click.Group):
    """A group whose subcommands are imported when they are named: each import costs start-up time."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All subcommands, in the order of the help text."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The subcommand, or None."""
        if cmd_name not in VERBS:
            return None
        command: click.Command = getattr(import_module(f".commands.{cmd_name}", __package__), cmd_name)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As of click. Raises UsageError for a name that is none, with what may be meant."""
        name = args[0]
        if name not in VERBS and Path(name).suffix.lower() in endings():
            raise click.UsageError(f"{name!r} is a model, not a command: type hlr draw before it", ctx)
        near = get_close_matches(name, VERBS, 1)
        if near and name not in VERBS:
            raise click.UsageError(f"no such command {name!r}: did you mean {near[0]}?", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the subcommands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(VERBS.items()))


def _version(ctx: click.Context, parameter: click.Parameter, wanted: Any) -> None:
    if not wanted or ctx.resilient_parsing:
        return
    from importlib.metadata import version

    from .streams import show

    show(f"hlr {version('hlr-drawing')}")
    ctx.exit()


_HELP = f"""Hidden-line drawings of CAD models.

\b
  hlr draw motor.step -o motor.svg
  hlr preview motor.step -o motor.png --edges
  hlr info motor.step

Reads {file_titles()}. Writes {titles("and")}.
"""


@click.group(cls=Verbs, help=_HELP, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option("--version", is_flag=True, expose_value=False, is_eager=True, callback=_version, help="Show the version.")
def command() -> None:
    """Hidden-line drawings of CAD models."""
