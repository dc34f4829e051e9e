"""Panics of the Rust kernel as Python exceptions.

When the kernel is loaded, it wraps every function that it exports in `guarded`.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from hlr.errors import KernelError

P = ParamSpec("P")
T = TypeVar("T")

PANIC = "PanicException"
"""Name of the class of Rust's panics in Python. It is no subclass of `Exception`."""


def guarded(function: Callable[P, T], told: Callable[[], str | None]) -> Callable[P, T]:
    """The function, its panics raised as KernelError. told: returns where and why the last panic happened."""

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
    """The error for a panic. what: its place and message."""
    return KernelError(
        f"internal error in the kernel at {what}; this is a fault of hlr, please report it with the call or command "
        "and, if you may share it, the model"
    )
