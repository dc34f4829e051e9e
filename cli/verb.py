"""A subcommand that refuses an option given twice, of which click would silently use the last."""

from __future__ import annotations

import click


class Verb(click.Command):
    """A command whose options are given once; flags and options marked `multiple` may be repeated."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse as click does. Raises UsageError where an option with a value is given twice."""
        _, _, order = self.make_parser(ctx).parse_args(list(args))
        once: set[click.Parameter] = set()
        for option in order:
            if not isinstance(option, click.Option) or option.is_flag or option.multiple:
                continue
            if option in once:
                raise click.UsageError(f"{max(option.opts, key=len)} is given twice; give it once", ctx)
            once.add(option)
        return super().parse_args(ctx, args)
