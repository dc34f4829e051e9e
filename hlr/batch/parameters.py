"""The parameters that a manifest gives to scripts, checked before any of them runs.

What a parameter is, the text of a script says. Where several scripts share a table, one that has the parameter is
enough: the others fail by themselves.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cache
from pathlib import Path

from hlr.batch.manifest import Where
from hlr.batch.plan import Plan
from hlr.errors import OptionError
from hlr.request.options import Parameter


def check_parameters(plan: Plan, rules: Collection[Where]) -> None:
    """Raise OptionError, with line and key, for a parameter or a value of these rules that none of its scripts takes.

    rules: keys that lead to their tables in the manifest.
    """
    if not rules:
        return
    tables = {rule.where: _table(rule.where, rule.own) for rule in plan.manifest.rules}
    asked = {tables[where] for where in rules}
    known = cache(_parameters)
    refused: dict[tuple[Where, str, str], str | None] = {}
    for job in plan.jobs:
        table = tables[job.rule]
        if table in asked:
            for name, value in job.parameters.items():
                key = (table, name, repr(value))
                if refused.get(key, "") is not None:
                    script = Path(job.root, job.source)
                    why = _refusal(script, name, value, known(script))
                    refused[key] = why and (refused.get(key) or why)
    for (table, name, _), why in refused.items():
        if why is not None:
            raise plan.manifest.error((*table, "parameters", name), why)


def _table(where: Where, own: Collection[str]) -> Where:
    """Where the parameters of a rule stand: in its own table, or at the top for all tables without any."""
    return where if "parameters" in own or not where or isinstance(where[-1], str) else where[:-2]


def _refusal(script: Path, name: str, value: Parameter, found: Mapping[str, Parameter] | None) -> str | None:
    """Why a script with these parameters does not take this value; None: it does, or only running it tells."""
    from hlr.source.cad.script_parameters import check_parameter

    if found is None:
        return None
    try:
        check_parameter(script, name, value, found)
    except OptionError as error:
        return str(error)
    return None


def _parameters(script: Path) -> dict[str, Parameter] | None:
    """The parameters of a script; None: it cannot be read."""
    from hlr.source.cad.script_parameters import parameters_of

    try:
        return parameters_of(script)
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return None
