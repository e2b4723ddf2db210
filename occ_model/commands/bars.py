"""Progress bars of commands, and the end of a long command after Ctrl-C."""

import argparse
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, TypeVar

from occ_model.errors import one_line

Study = TypeVar("Study")


def progress_bar(**options: Any) -> Any:
    """Return a tqdm bar, shown on a terminal."""
    from tqdm import tqdm  # slow to import, and needed only by long commands

    return tqdm(file=sys.stderr, **{"disable": None, **options})


@contextmanager
def fraction_bar() -> Iterator[Callable[[float], object]]:
    """Show a bar from 0 to 1; yield the function that sets it."""
    with progress_bar(total=1.0, bar_format="{l_bar}{bar}|", leave=False) as bar:
        yield lambda fraction: bar.update(fraction - bar.n)


def run_study(
    run: Callable[[Callable[..., None]], Study], options: argparse.Namespace
) -> Study | None:
    """Run a study that ``--out`` can continue, with a bar of its points; None after Ctrl-C."""
    outcome = "with --out FILE.csv the results would be kept."
    if options.out:
        out = one_line(str(options.out))
        outcome = f"the results are in {out}, and the same command continues from there."
    return run_with_bar(run, "point", outcome)


def run_with_bar(
    run: Callable[[Callable[..., None]], Study], unit: str, outcome: str, **bar_options: Any
) -> Study | None:
    """Run what reports its progress as the units done and their total; None after Ctrl-C.

    ``outcome`` says what Ctrl-C leaves.
    """
    progress_text = f"before the first {unit}"
    with ExitStack() as stack:
        bar: Any = None

        def progress(done: int, total: int, *_time_left: float) -> None:
            nonlocal bar, progress_text
            if bar is None:  # only after the first unit, so that a refused study shows no bar
                bar = stack.enter_context(progress_bar(total=total, unit=unit, **bar_options))
            progress_text = f"after {done} of {total} {unit}s"
            bar.update(done - bar.n)

        try:
            stack.enter_context(_print_warnings_as_sentences())
            return run(progress)
        except KeyboardInterrupt:
            pass
    print(f"occ-model: stopped {progress_text}; {outcome}", file=sys.stderr)
    return None


@contextmanager
def _print_warnings_as_sentences() -> Iterator[None]:
    """Print warnings as plain sentences, above the progress bar if there is one."""

    def show(message: Warning | str, *_others: object, **_options: object) -> None:
        from tqdm import tqdm

        tqdm.write(f"occ-model: {message}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.simplefilter("always", RuntimeWarning)
        warnings.showwarning = show
        yield
