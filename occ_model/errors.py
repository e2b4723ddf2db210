"""Errors whose message is a whole sentence for the person at the screen."""


class OccError(Exception):
    """Base of every error that this package raises on purpose."""


class ParameterError(OccError, ValueError):
    """A parameter is unknown, not of its kind, or outside its allowed range."""


class SceneFileError(OccError, ValueError):
    """A scene file or preset cannot be read as one."""


class PresetError(OccError, KeyError):
    """No preset has the name asked for."""

    def __str__(self) -> str:
        # KeyError would print the sentence as a quoted key.
        return str(self.args[0]) if self.args else ""


class ProjectionError(OccError, ValueError):
    """The panel has no picture in this pose, or the picture would be too large."""


class BandModelUndefined(OccError, ValueError):  # noqa: N818 - the name is public and older
    """The band model says nothing about this scene."""


class DecodeInputError(OccError, ValueError):
    """What was given to a decoder is not an image or a profile."""


class PhotoError(OccError):
    """A photo cannot be read."""


class MatchError(OccError):
    """A photo's stripes cannot be found, or no scene explains them."""


class OutputError(OccError):
    """A result cannot be written where it was asked for."""
