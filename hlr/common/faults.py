"""Faults of the kernel: a panic of Rust becomes an error like any other.

The kernel puts all that it exports behind `guarded` when it is loaded.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from hlr.errors import KernelError

P = ParamSpec("P")
T = TypeVar("T")

PANIC = "PanicException"
"""What Rust's panics are called in Python. They are no `Exception`, so that nobody catches them."""


def guarded(function: Callable[P, T], told: Callable[[], str | None]) -> Callable[P, T]:
    """The function, whose panics are KernelErrors; told: where and why the last one happened."""

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return function(*args, **kwargs)
        except BaseException as error:
            if type(error).__name__ != PANIC:
                raise
            raise fault(told() or str(error)) from None

    return call


def fault(what: str) -> KernelError:
    """The error for a panic."""
    return KernelError(
        f"internal error in the kernel at {what}; this is a fault of hlr, please report it with the call or command "
        "and, if you may share it, the model"
    )
