"""The report as JUnit XML, which CI services show as tests: a case for each source."""

from __future__ import annotations

from typing import Any


def document(found: dict[str, Any]) -> bytes:
    """JUnit XML. A source that could not be drawn is an error, what a script has printed stands beside it;
    warnings are its output."""
    from junitparser import Error, JUnitXml, TestCase, TestSuite

    cases = []
    for source in found["sources"]:
        case = TestCase(_text(title(source)), "hlr", source.get("cost", {}).get("seconds"))
        if source["error"] is not None:
            case.result = [Error(_text(source["error"]["message"]), source["error"]["kind"])]
            if source["error"].get("printed"):
                case.system_err = _text(source["error"]["printed"])
        told = [note["text"] for drawing in source["drawings"] for note in drawing["notes"]]
        if told:
            case.system_out = _text("\n".join(dict.fromkeys(told)))
        cases.append(case)
    suite = TestSuite("hlr batch")
    suite.add_testcases(cases)  # all at once: with each, the suite counts all that it has
    xml = JUnitXml("hlr batch")
    xml.add_testsuite(suite)
    return bytes(xml.tostring())  # type: ignore[no-untyped-call]


def title(source: dict[str, Any]) -> str:
    """What a source is called: its path, and the parameters of a variant."""
    parameters = source["options"].get("parameters") or {}
    return " ".join((source["source"], *(f"{name}={value}" for name, value in parameters.items())))


def _text(text: str) -> str:
    """A text without the characters that XML does not know."""
    return "".join(c for c in text if c in "\t\n" or (c >= " " and not "\ud800" <= c <= "\udfff" and c < "\ufffe"))
