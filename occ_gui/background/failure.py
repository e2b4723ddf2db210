"""What went wrong in the background, in a sentence."""

import logging

from occ_model.errors import OccError

_log = logging.getLogger(__name__)


def sentence_of(error: Exception, name: str, request: object) -> str:
    """Say why work has no result; a mistake of ours goes to the log with its traceback.

    Parameters
    ----------
    error
        What was raised, while it is being handled.
    name
        What the work is.
    request
        What was asked for.
    """
    if isinstance(error, OccError):
        return str(error)
    _log.error("%s failed for %r", name, request, exc_info=error)
    reason = f"{type(error).__name__}: {error}".rstrip(": .")
    return f"The {name} failed: {reason}."
