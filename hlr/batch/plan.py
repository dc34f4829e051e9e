"""The plan of a batch: from a manifest to jobs, each with the files that it will write."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path, PurePosixPath
from typing import Any

from hlr.batch.arranged_page import FIELD, filled_in, printed_of
from hlr.batch.default_names import stems
from hlr.batch.discover import files_named, models_under, named, takes_parameters, without
from hlr.batch.job import Job
from hlr.batch.manifest import Manifest, Rule
from hlr.batch.request import files_of
from hlr.batch.schema import KEYS, as_list
from hlr.drawing.originals import SOURCE, Originals
from hlr.errors import OptionError

MOST_VARIANTS = 10_000
"""Of one source."""

MOST_NAMED = 5
"""Sources that one sentence names."""

REPORTS = ("manifest.json", "junit.xml", "summary.md", "code-quality.json")
"""Files of the report, in the folder of outputs."""


@dataclass(frozen=True, slots=True)
class Plan:
    """All jobs of a batch, in the order of the report.

    output  the folder that is written to, absolute
    silent  scripts in folders of sources that import CadQuery or build123d and show nothing: they are not drawn
    inside  models among the sources that lie in the folder of outputs: they are not drawn
    empty   why there is nothing to draw, where that is allowed; None: there is something
    """

    manifest: Manifest
    output: Path
    jobs: tuple[Job, ...]
    silent: tuple[Path, ...] = ()
    inside: tuple[Path, ...] = ()
    empty: OptionError | None = None


def plan(manifest: Manifest, output: Path, strict: bool = False, may_be_empty: bool = False) -> Plan:
    """The jobs that a manifest asks for. strict: warnings are errors, in every job.

    may_be_empty: all models may be gone. Raises OptionError where patterns name no file, a name of files has an unknown
    field, or two drawings would be written to one file.
    """
    jobs: list[Job] = []
    silent: list[Path] = []
    inside: list[Path] = []
    gone: list[OptionError] = []
    for rule in manifest.rules:
        try:
            sources = _sources(manifest, rule, output, silent, inside)
        except _NoModelError as error:
            gone.append(error)
            if may_be_empty and len(gone) == len(manifest.rules):
                return Plan(manifest, output, (), tuple(dict.fromkeys(silent)), tuple(dict.fromkeys(inside)), gone[0])
            continue
        if "parameters" in rule.own and not any(map(takes_parameters, sources)):
            raise manifest.error((*rule.where, "parameters"), "only scripts have parameters, and this names none")
        printed = printed_of(manifest, rule)
        depends = _depends(manifest, rule)
        if "template" in printed:
            depends = tuple(dict.fromkeys((*depends, printed["template"])))
        stem_of = stems(sources)
        for path in sources:
            options = {**rule.options, **({"strict": True} if strict else {})}
            found = _jobs(manifest, rule, path, options, stem_of[path], printed)
            jobs.extend(replace(job, depends=depends, is_shared=len(sources) > 1) for job in found)
    if gone:
        raise gone[0]
    _check_names(manifest, jobs, output)
    drawn = {os.path.join(job.root, job.source) for job in jobs}
    unshown = tuple(path for path in dict.fromkeys(silent) if str(path) not in drawn)
    return Plan(manifest, output, tuple(jobs), unshown, tuple(dict.fromkeys(inside)))


class _NoModelError(OptionError):
    """Names and patterns of a rule stand for no model."""


def _sources(manifest: Manifest, rule: Rule, output: Path, silent: list[Path], inside: list[Path]) -> list[Path]:
    """The sources of a rule.

    silent: gets the scripts that show nothing, as of `models_under`; inside: the models in the folder of outputs.
    """
    root, patterns, exclude = manifest.root, as_list(rule.values["files"]), as_list(rule.values["exclude"])
    unshown: list[Path] = []
    found = [] if patterns else list(models_under(root, unshown))
    for pattern in patterns:
        files = named(root, pattern, unshown)
        if not files:
            why = f"{pattern} names no model under {root}: mend it, or leave it out"
            raise _NoModelError(str(manifest.error((*rule.where, "files"), why)))
        found += files
    outside = [path for path in dict.fromkeys(found) if not path.is_relative_to(output)]
    inside += without([path for path in found if path.is_relative_to(output)], exclude, root)
    kept = without(outside, exclude, root)
    unshown = [path for path in without(unshown, exclude, root) if not path.is_relative_to(output)]
    silent += unshown
    if not kept:
        why = f"there is no model under {root}"
        if unshown:
            why += f"; {shows_nothing(unshown)}"
        if found and not outside:
            why = f"all models lie in the folder of outputs, {output}: give another one"
        elif outside:
            why = "all models are left out by exclude"
        raise _NoModelError(str(manifest.error((*rule.where, "files"), why)))
    return kept


def shows_nothing(silent: Sequence[Path]) -> str:
    """What is said of scripts that are not drawn."""
    return f"scripts that show nothing are left out ({_names(silent)}): name them to draw them"


def lies_inside(plan: Plan) -> str:
    """What is said of models in the folder of outputs."""
    return f"models in the folder of outputs, {plan.output}, are left out ({_names(plan.inside)}): give another folder"


def _names(paths: Sequence[Path]) -> str:
    return ", ".join(path.name for path in paths[:MOST_NAMED]) + (", ..." if len(paths) > MOST_NAMED else "")


def _depends(manifest: Manifest, rule: Rule) -> tuple[str, ...]:
    """Paths of the files that the sources of a rule depend on besides, seen from the root."""
    found = []
    for pattern in as_list(rule.values["depends"]):
        files = files_named(manifest.root, pattern)
        if not files:
            raise manifest.error((*rule.where, "depends"), f"{pattern} names no file under {manifest.root}")
        found += [Path(os.path.relpath(each, manifest.root)).as_posix() for each in files]
    return tuple(dict.fromkeys(found))


def _jobs(
    manifest: Manifest, rule: Rule, path: Path, options: Mapping[str, Any], stem: str, printed: Mapping[str, Any]
) -> Iterator[Job]:
    """A job for each variant of a source.

    stem: what stands for {stem} in the default name; printed: as of `printed_of`
    """
    values = rule.values
    views = tuple(tuple(view) if isinstance(view, list) else view for view in _views(values["views"]))
    formats = tuple(dict.fromkeys(as_list(values["formats"])))
    root, source = str(manifest.root), Path(os.path.relpath(path, manifest.root)).as_posix()
    template = values["name"]
    if template == KEYS["name"].default:
        template = template.replace("{stem}", stem)
    base = Job(root, source, views, formats, (), options, arrange=values["arrange"])
    base = replace(base, time_limit_s=values["time_limit_s"], memory_limit_mb=values["memory_limit_mb"])
    for variant in _variants(manifest, rule) if takes_parameters(path) else [{}]:
        more = {"parameters": variant} if variant else {}
        names = [
            _filled(manifest, rule, template, _fields(source, view, number, variant))
            for number, view in enumerate(base.drawings, 1)
        ]
        files = tuple(tuple(f"{name}.{format}" for format in formats) for name in names)
        on_page = filled_in(printed, _fields(source, base.drawings[0], 1, variant))
        yield replace(base, files=files, options={**options, **more}, rule=rule.where, printed=on_page)


def _views(value: Any) -> list[Any]:
    """A list of views; a single direction is three numbers."""
    return [value] if isinstance(value, str) else value


def _variants(manifest: Manifest, rule: Rule) -> list[dict[str, Any]]:
    """All combinations of the parameters' values; one without any where there are none."""
    matrix = {name: as_list(value) for name, value in rule.values["parameters"].items()}
    count = 1
    for each in matrix.values():
        count *= len(each)
    if count > MOST_VARIANTS:
        raise manifest.error((*rule.where, "parameters"), f"{count} variants of one source are too many")
    return [dict(zip(matrix, each, strict=True)) for each in product(*matrix.values())]


def _fields(source: str, view: Any, number: int, variant: Mapping[str, Any]) -> dict[str, str]:
    """What the fields of a name stand for."""
    path = PurePosixPath(source)
    words = ",".join(f"{name}={value}" for name, value in variant.items())
    return {
        **{name: _safe(str(value)) for name, value in variant.items()},
        "folder": "/".join(part for part in path.parent.parts if part not in ("..", "/")) or ".",
        "stem": path.stem,
        "ending": path.suffix.lstrip("."),
        "view": _safe(view if isinstance(view, str) else ",".join(f"{x:g}" for x in view)),
        "n": str(number),
        "variant": f"-{_safe(words)}" if words else "",
    }


def _filled(manifest: Manifest, rule: Rule, template: str, fields: Mapping[str, str]) -> str:
    """The name of a file, without its ending. Raises OptionError for an unknown field, or a way out of the folder."""
    unknown = [name for name in FIELD.findall(template) if name not in fields]
    if unknown:
        known = ", ".join(f"{{{name}}}" for name in fields)
        raise manifest.error((*rule.where, "name"), f"there is no field {{{unknown[0]}}}: use {known}")
    name = PurePosixPath(FIELD.sub(lambda match: fields[match[1]], template))
    if name.is_absolute() or ".." in name.parts or not name.name or "\\" in str(name):
        raise manifest.error((*rule.where, "name"), f"{name} leads out of the folder of outputs")
    return str(name)


def _safe(text: str) -> str:
    """A text as a part of a file's name."""
    return re.sub(r"[^\w.+=,-]", "_", text)


def _check_names(manifest: Manifest, jobs: Sequence[Job], output: Path) -> None:
    """Raise OptionError where two drawings have one file, or one that the report needs, or a template or the like."""
    from hlr.batch.page.write import INDEX

    used = Originals(_read(manifest, jobs))
    for name in (*REPORTS, INDEX):
        if used.called(output / name) is not None:
            raise OptionError(
                f"the report would be written to {output / name}, which a drawing depends on: name another folder of "
                "outputs (-o), or move that file"
            )
    first: dict[str, tuple[str, str, Job | None]] = {name: ("the report", name, None) for name in REPORTS}
    for job in jobs:
        for row, view in zip(job.files, job.drawings, strict=True):
            for file in row:
                what = f"{job.title}, {view}"
                if used.called(output / file) is not None:
                    raise _clash(manifest, job, f"{what} would be written to {file}, which a drawing depends on")
                # As a file system sees it that takes large and small letters for the same.
                other, same, its = first.setdefault(file.casefold(), (what, file, job))
                if other is not what:
                    if its is job and other == what:
                        text = f"the view {view} is given twice: give it once, or put {{n}} into the name"
                        raise manifest.error((*job.rule, "views"), text)
                    if its is not None and other == what:
                        text = f"{job.source} is named twice: leave it out of one [[source]], or give that a name"
                        raise manifest.error((*job.rule, "files"), text)
                    where = "" if same == file else ", where large and small letters are the same"
                    raise _clash(manifest, job, f"{other} and {what} would both be written to {file}{where}")


def _read(manifest: Manifest, jobs: Sequence[Job]) -> Iterator[tuple[Path, str]]:
    """All files that the jobs are made of, and the manifest itself, as of `Originals`."""
    if manifest.file is not None:
        yield manifest.file, "the manifest"
    yield from ((path, SOURCE) for path in dict.fromkeys(Path(job.root, job.source) for job in jobs))
    named = (Path(job.root, name) for job in jobs for name in (*job.depends, *files_of(job.options, job.root).values()))
    yield from ((path, "a file that drawings depend on") for path in dict.fromkeys(named))


def _clash(manifest: Manifest, job: Job, message: str) -> OptionError:
    return manifest.error((*job.rule, "name"), f"{message}: choose another name for one of them")
