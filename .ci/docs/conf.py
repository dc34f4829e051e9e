"""The documentation site: the Markdown pages of the repository where they are, and the API from its docstrings.

    pip install '.[docs]'
    sphinx-build -W -c .ci/docs . build/site

The source folder is the repository itself, so the links between pages are the same on the site and in the repository.
"""

import re
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

project = "hlr"
author = "the authors of hlr"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
html_theme = "furo"
html_title = "hlr"

root_doc = "README"
include_patterns = ["*.md", "examples/**.md", "hlr/**.md", "tests/**.md"]
exclude_patterns = ["build", "**/target", "**/.*", "tests/data", "tests/fuzz/corpus"]

myst_enable_extensions = ["html_image"]
myst_heading_anchors = 4

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_class_signature = "separated"
# What docstrings put between single backticks is code.
default_role = "code"
python_use_unqualified_type_names = True
maximum_signature_line_length = 80
# Reports of single models are reached from the page that sums them up.
suppress_warnings = ["toc.not_included"]

CONTENTS = """
```{toctree}
:hidden:
:caption: Use
examples/README
hlr/docs/installation
hlr/docs/command_line
hlr/docs/batch
hlr/docs/python
hlr/docs/styles
hlr/docs/previews
hlr/docs/dxf
hlr/docs/drop_ins
hlr/docs/accuracy
hlr/docs/limits
```
```{toctree}
:hidden:
:caption: Look up
hlr/docs/api
hlr/docs/json
hlr/writers/PNG
hlr/docs/GLOSSARY
CHANGELOG
```
```{toctree}
:hidden:
:caption: Figures
hlr/docs/measurements
examples/study/README
hlr/lab/measure/README
hlr/kernel/methods/README
hlr/request/README
examples/stability/README
examples/outlines/README
examples/drop_ins/README
```
```{toctree}
:hidden:
:caption: Build
hlr/docs/ARCHITECTURE
hlr/docs/CONTRIBUTING
hlr/kernel/README
tests/hard/README
tests/properties/README
tests/fuzz/README
```
"""
"""The pages beside the text of the README, which is the first of them."""

LINK = re.compile(r"(?<!!)\[([^\]\[]*)\]\(([^)#:]+)\)")
FIELDS = re.compile(r"^(?P<names>\w+(?:, \w+)*)(?:  +|: )(?P<text>\S.*)$")


def with_contents(_app, docname, source):
    """The README with the list of pages; and no links to folders, for which a site has no page."""
    if docname == root_doc:
        source[0] += CONTENTS
    folder = (ROOT / docname).parent

    def told(match):
        return match[1] if (folder / match[2]).is_dir() else match[0]

    source[0] = LINK.sub(told, source[0])


def with_fields(_app, _what, _name, _thing, _options, lines):
    """Tables of names in docstrings, `name    what it is`, as lists of fields."""
    out, within = [], False
    for line in lines:
        found = FIELDS.match(line)
        if found and (within or not out or not out[-1]) and "  " in line:
            out.append(f":{found['names']}: {found['text']}")
            within = True
        else:
            ended = within and not line.startswith(" ")
            within = within and not ended
            out += [""] * (ended and bool(line)) + [f"    {line.strip()}" if within else line]
    lines[:] = out


def with_index(app, exception):
    """The README is the first page of the site."""
    if exception is None and app.builder.format == "html":
        out = Path(app.outdir)
        shutil.copy(out / f"{root_doc}.html", out / "index.html")


def setup(app):
    """Called by Sphinx."""
    app.connect("source-read", with_contents)
    app.connect("autodoc-process-docstring", with_fields)
    app.connect("build-finished", with_index)
