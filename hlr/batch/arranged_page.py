"""What a manifest asks of pages with several views: the template, the texts in its fields, where views may lie."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hlr.batch.manifest import Manifest, Rule
from hlr.errors import OptionError, SourceError

FIELD = re.compile(r"\{(\w*)\}")
"""A field in a text or a file name, such as {stem}."""


def printed_of(manifest: Manifest, rule: Rule) -> dict[str, Any]:
    """Template (its path, seen from the root), texts and room of a rule, those that are given.

    Raises OptionError, with line and key, for what cannot be: before anything is drawn.
    """
    given = {name: rule.values[name] for name in ("template", "texts", "room") if rule.values[name]}
    if not rule.values["arrange"]:
        for name in given:
            if name in rule.own:
                raise manifest.error((*rule.where, name), "it is for pages with several views: give arrange as well")
        return {}
    if "texts" in given and "template" not in given:
        raise manifest.error((*rule.where, "texts"), "texts are for the fields of a template: give template as well")
    if "room" in given:
        given["room"] = tuple(given["room"])
    if "template" in given:
        _check_template(manifest, rule, given)
    return given


def filled_in(printed: Mapping[str, Any], fields: Mapping[str, str]) -> dict[str, Any]:
    """The same with the texts of one source: {stem} and the like stand for what they do in names of files."""
    texts = {
        key: FIELD.sub(lambda match: fields.get(match[1], match[0]), text)
        for key, text in printed.get("texts", {}).items()
    }
    return {**printed, "texts": texts} if texts else dict(printed)


def _check_template(manifest: Manifest, rule: Rule, given: dict[str, Any]) -> None:
    from hlr.source.page_template import read_page_template

    path = Path(os.path.join(manifest.root, given["template"]))
    given["template"] = Path(os.path.relpath(path, manifest.root)).as_posix()
    try:
        read = read_page_template(path)
    except SourceError as error:
        raise manifest.error((*rule.where, "template"), str(error)) from None
    try:
        read.check(given.get("texts", {}))
    except OptionError as error:
        raise manifest.error((*rule.where, "texts"), str(error)) from None
    if "page" in rule.options:
        raise manifest.error((*rule.where, "page"), "the template says how large the page is: leave one of them out")
