"""Every class of exception that the model defines, and why some reach no user of the window.

The tests of the window have a case for each class that is not named here; those of the shell try
the same wrong values of each parameter.
"""

import inspect
import math
import pkgutil
from importlib import import_module

import occ_model
from occ_model.errors import DecodeInputError, OccError
from occ_model.parallel.job import Abandoned
from occ_model.scene.parameter_kinds import Choice, Count, OpenChoice, Parameter, Payload, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.teaching.lessons import MistakeError
from occ_model.video.file.decoder_process import DecoderStoppedError

ErrorClass = type[BaseException]

NOT_IN_THE_WINDOW: dict[ErrorClass, str] = {
    OccError: "the base: the model raises only its subclasses",
    Abandoned: "ends a job whose result is no longer wanted; do_job catches it",
    DecoderStoppedError: "ends a sentence that load_video begins, as a VideoError",
    MistakeError: "holds the key at fault until the lesson's reader names the line instead",
    DecodeInputError: "tells a caller in Python that an array is no picture; what the programs "
    "decode is their own picture, or a photo that was checked when it was read",
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


def hardly(limit: float) -> float:
    """A step beyond a limit that is kept when it is written and read, and too small to be seen."""
    return 1e-9 * (abs(limit) or 1.0)


def wrong_texts(declared: Parameter) -> list[str]:
    """Texts for a parameter that are below and above its range, and no value of it at all."""
    match declared:
        case Quantity():
            out_of_range = [declared.low - 1.0, declared.low - hardly(declared.low)]
            if declared.high < math.inf:
                out_of_range += [2.0 * declared.high, declared.high + hardly(declared.high)]
            unit = "V" if declared.unit.symbol else "m"
            texts = [declared.format(value, 17) for value in out_of_range]
            return [*texts, "nan", "inf", f"3 {unit}", "soon"]
        case Count():
            return [str(declared.low - 1), str(declared.high + 1), "nan", "1.5", "3 m"]
        case Choice():
            return ["nan", ""]
        case Payload():
            return ["hex:zz", "bits:2"]
        case _:
            return ["2", "nan"]


WRONG = [(name, text) for name, each in PARAMETERS.items() for text in wrong_texts(each)]


def check_sentence(sentence: str, declared: Parameter, text: str, begins: str) -> None:
    """See that a sentence names a parameter, the value with its unit, and what is allowed.

    Parameters
    ----------
    sentence
        The sentence.
    declared
        The parameter.
    text
        The value that was given.
    begins
        What stands before the value: the parameter's name, as it is called there, and a verb.
    """
    assert sentence.isprintable()
    assert sentence.startswith(begins), sentence
    value, _, allowed = sentence.removeprefix(begins).partition("; allowed: ")
    words = declared.allowed
    if isinstance(declared, OpenChoice):  # of which the names are given, those of plug-ins too
        words = ", ".join(declared.all_choices())
    assert allowed == f"{words}.", sentence
    number = declared.unit.parse(text) if isinstance(declared, Quantity) else None
    if number is None:
        assert repr(text) in value or value == text, sentence
        return
    assert isinstance(declared, Quantity)
    written = declared.unit.parse(value)
    assert written is not None, sentence
    assert math.isclose(written, number, rel_tol=1e-5), sentence
    assert not declared.low <= written <= declared.high, sentence
