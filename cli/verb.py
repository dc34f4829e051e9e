"""A subcommand that ignores nothing in silence: neither an option given twice, nor one that has no effect."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any

import click

from hlr.errors import HlrError, respelled


class Verb(click.Command):
    """A command whose options are given once; flags and options marked `multiple` may be repeated."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse as click does.

        Raises UsageError where an option with a value is given twice or has none, or a name is one too many.
        """
        try:
            found, more, order = self.make_parser(ctx).parse_args(list(args))
        except click.NoSuchOption as error:
            raise click.NoSuchOption(error.option_name, None, self._near(error.option_name), ctx) from None
        self._check_values(ctx, found)
        taken = [each.human_readable_name for each in self.params if isinstance(each, click.Argument)]
        if more and taken:
            cure = "; hlr batch draws many" if self.name == "draw" else ""
            raise click.UsageError(
                f"{ctx.command_path} takes {' and '.join(taken)}, and {more[0]!r} is one more{cure}", ctx
            )
        once: set[click.Parameter] = set()
        for option in order:
            if not isinstance(option, click.Option) or option.is_flag or option.multiple:
                continue
            if option in once:
                raise click.UsageError(f"{max(option.opts, key=len)} is given twice; give it once", ctx)
            once.add(option)
        return super().parse_args(ctx, args)

    def _check_values(self, ctx: click.Context, found: dict[str, Any]) -> None:
        """Raise UsageError where the name of an option stands in the place of another one's value."""
        options = [each for each in self.params if isinstance(each, click.Option)]
        names = {name for each in options for name in (*each.opts, *each.secondary_opts)}
        for option in options:
            given = found.get(option.name or "")
            for value in given if isinstance(given, list) else [given]:
                if isinstance(value, str) and value in names:
                    raise click.UsageError(f"{max(option.opts, key=len)} takes a value, and {value} stands there", ctx)

    def _near(self, option: str) -> list[str]:
        """Options that are spelled nearly so. Their dashes, which all have, make none alike."""
        known = {name.lstrip("-"): name for param in self.params for name in (*param.opts, *param.secondary_opts)}
        return sorted(known[near] for near in get_close_matches(option.lstrip("-"), known))

    def invoke(self, ctx: click.Context) -> Any:
        """Carry out the command, and then say which options had no effect. Raises OptionError for those of no use.

        Messages of errors name options as they were typed.
        """
        from .without_effect import Asked, refuse, tell

        try:
            refuse(ctx)
            result = super().invoke(ctx)
        except HlrError as error:
            error.args = (respelled(str(error), Asked(ctx).as_typed),)
            raise
        tell(ctx)
        return result
