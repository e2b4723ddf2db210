"""Every class of exception that the model defines, and why some reach no user of a program.

The tests of the shell and of the window have a case for each class that is not named here.
"""

import inspect
import pkgutil
from importlib import import_module

import occ_model
from occ_model.commands.cluster import ClusterError
from occ_model.errors import BandModelUndefined, DecodeInputError, OccError
from occ_model.parallel.job import Abandoned, WorkersLostError
from occ_model.teaching.lessons import _MistakeError
from occ_model.video.file.decoder_process import DecoderStoppedError

ErrorClass = type[BaseException]

_INSIDE: dict[ErrorClass, str] = {
    OccError: "the base: the model raises only its subclasses",
    Abandoned: "ends a job whose result is no longer wanted; do_job catches it",
    DecoderStoppedError: "ends a sentence that load_video begins, as a VideoError",
    _MistakeError: "holds the key at fault until the lesson's reader names the line instead",
    DecodeInputError: "tells a caller in Python that an array is no picture; what the programs "
    "decode is their own picture, or a photo that was checked when it was read",
}
"""Classes that only callers in Python meet, or that the model itself catches."""

NOT_IN_THE_SHELL: dict[ErrorClass, str] = {
    **_INSIDE,
    BandModelUndefined: "figures write it where the curve would be, animations leave the curve out",
    WorkersLostError: "sweeps and matches warn of it and do the rest in their own process",
}

NOT_IN_THE_WINDOW: dict[ErrorClass, str] = {
    **_INSIDE,
    ClusterError: "the window measures on this computer alone",
}


def error_classes() -> set[ErrorClass]:
    """Import all modules of the model and find the exceptions that they define."""
    found: set[ErrorClass] = set()
    for module in pkgutil.walk_packages(occ_model.__path__, "occ_model."):
        if module.name.endswith("__main__"):  # runs the program
            continue
        for _, each in inspect.getmembers(import_module(module.name), inspect.isclass):
            if issubclass(each, BaseException) and each.__module__.startswith("occ_model."):
                found.add(each)
    return found


def check_that_all_have_a_case(
    cases: dict[ErrorClass, object], without: dict[ErrorClass, str]
) -> None:
    """See that each class has either a case or a reason why it has none."""
    names = {each.__name__ for each in error_classes() ^ (cases.keys() | without.keys())}
    assert not names, f"neither a case nor a reason, or a class that is gone: {names}"
    assert not cases.keys() & without.keys()
