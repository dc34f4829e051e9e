"""Help texts of the command line are whole sentences, and name what is in the tables."""

import subprocess
import sys

import pytest
from click.testing import CliRunner

from hlr.cli.app import VERBS, command
from support.programs import environment


def listing(*verbs):
    """The help text of the program or of a verb."""
    return CliRunner().invoke(command, [*verbs, "--help"]).output


@pytest.mark.parametrize("verb", [(), *((name,) for name in VERBS), ("cache", "info"), ("cache", "clear")])
def test_no_line_of_help_is_cut_off(verb):
    text = listing(*verb)
    assert text.startswith("Usage:")
    assert not [line for line in text.splitlines() if line.endswith("...") and not line.startswith("Usage:")]


def test_a_style_is_a_row():
    code = (
        "from hlr.request.style import Style; from hlr.request.styles import STYLES; STYLES['pencil'] = Style(); "
        "from hlr.cli import main; main(['draw', '--help'])"
    )
    program = [sys.executable, "-P", "-c", code]
    shown = subprocess.run(program, check=True, capture_output=True, text=True, env=environment())
    assert "iso, asme, thin, dark, blueprint, pencil, or a TOML file" in " ".join(shown.stdout.split())
