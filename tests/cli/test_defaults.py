"""Where an option is not given, the command asks for what the function does without the keyword."""

import inspect

import click
import pytest

import hlr
from hlr.cli.app import command
from hlr.lab.methods.comparison import compare_methods
from hlr.lab.study.sweep import study

FUNCTIONS = {
    "draw": hlr.Options,
    "preview": hlr.PreviewOptions,
    "info": hlr.info,
    "compare": hlr.compare.compare,
    "study": study,
    "methods": compare_methods,
}
OTHER_NAMES = {"tolerance": "tolerance_mm"}


@pytest.mark.parametrize("verb", FUNCTIONS)
def test_commands_and_functions_have_the_same_defaults(verb):
    keywords = inspect.signature(FUNCTIONS[verb]).parameters
    context = click.Context(command)
    compared = set()
    for option in command.get_command(context, verb).params:
        name = OTHER_NAMES.get(option.name, option.name)
        given = option.to_info_dict()["default"]
        # A flag that is not set says no; of other options without a value nothing is passed on.
        if name in keywords and given is not None and not option.multiple:
            # A flag that is not set is as good as None: --perspective.
            assert (option.type_cast_value(context, given) or None) == (keywords[name].default or None), name
            compared.add(name)
    assert compared
