"""Many quick cases of one law in one test: each test of its own takes longer than such a case."""

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any

import pytest


def each_case(cases: Iterable[Any]) -> Callable[[Callable[..., None]], Callable[[], None]]:
    """Call a test with each case in turn, and then fail with all the errors there were.

    A case of a test with several arguments is a tuple of them.
    """
    every = tuple(cases)

    def decorate(test: Callable[..., None]) -> Callable[[], None]:
        has_several = len(inspect.signature(test).parameters) > 1

        @wraps(test)
        def run() -> None:
            errors: list[BaseException] = []
            for case in every:
                try:
                    test(*case) if has_several else test(case)
                except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - told below
                    error.add_note(f"The case: {case!r}")
                    errors.append(error)
            assert every
            if errors:
                raise BaseExceptionGroup(f"{len(errors)} of {len(every)} cases", errors)

        del run.__wrapped__  # whose arguments pytest would look for
        return run

    return decorate
