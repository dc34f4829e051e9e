"""A verb of the command line: what is given twice is refused, where the first would be forgotten without a word."""

from __future__ import annotations

import click


class Verb(click.Command):
    """A command whose options are given once, but for flags and those that say otherwise."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """As click does it; raises UsageError for an option with a value that is there twice."""
        _, _, order = self.make_parser(ctx).parse_args(list(args))
        once: set[click.Parameter] = set()
        for option in order:
            if not isinstance(option, click.Option) or option.is_flag or option.multiple:
                continue
            if option in once:
                raise click.UsageError(f"{max(option.opts, key=len)} is given twice; give it once", ctx)
            once.add(option)
        return super().parse_args(ctx, args)
