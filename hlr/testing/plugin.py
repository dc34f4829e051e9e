"""The plugin of pytest: its flag, and where tests and temporary files lie. It is there wherever hlr is installed."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from hlr.testing.golden import UPDATE
from hlr.testing.session import SESSION


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the flag."""
    group = parser.getgroup("hlr", "drawings of hlr")
    group.addoption(UPDATE, action="store_true", help="Write golden drawings that are missing or differ.")


@pytest.fixture(scope="session", autouse=True)
def _hlr_session(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    SESSION.update = bool(request.config.getoption(UPDATE))
    SESSION.temporary = lambda: tmp_path_factory.mktemp("drawing")
    yield
    SESSION.update, SESSION.temporary = False, None


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Tell in which folder the test lies."""
    SESSION.beside = item.path.parent
    try:
        return (yield)
    finally:
        SESSION.beside = None
