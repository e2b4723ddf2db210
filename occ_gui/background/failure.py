"""Failure of work in the background, as a sentence."""

import logging

from occ_model.errors import OccError
from occ_model.scene.refusal import labelled

_log = logging.getLogger(__name__)


def sentence_of(error: Exception, name: str, request: object) -> str:
    """Say why work has no result; an unexpected error goes to the log with its traceback."""
    if isinstance(error, OccError):
        return labelled(error)
    _log.error("%s failed for %r", name, request, exc_info=error)
    reason = f"{type(error).__name__}: {error}".rstrip(": .")
    return f"The {name} failed: {reason}."
