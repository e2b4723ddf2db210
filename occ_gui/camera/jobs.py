"""What the dialog of the camera computes: the measurement, and small pictures to look at."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from occ_gui.background.task import TaskReporter
from occ_model.arrays import ByteArray
from occ_model.errors import MatchError
from occ_model.photo.camera.measure import measure_camera
from occ_model.photo.reading.load import load_photo
from occ_model.results.camera import CameraMeasurement

_MOST_PIXELS = 640  # longer side of a small picture


@dataclass(frozen=True, slots=True)
class CameraQuestion:
    """The files of one or two pictures, and the frequency of the mains in Hz."""

    paths: tuple[Path, ...]
    mains_frequency: float


@dataclass(frozen=True, eq=False, slots=True)
class CameraAnswer:
    """Small upright pictures in grey levels, and the measurement, or why there is none."""

    question: CameraQuestion
    pictures: tuple[ByteArray, ...]
    measured: CameraMeasurement | None
    refusal: str = ""


def answer_question(question: CameraQuestion, report: TaskReporter) -> CameraAnswer:
    first, *others = question.paths
    photos = [load_photo(first)]
    for path in others:
        report()
        channel = photos[0].channel
        photos.append(load_photo(path, channel="brightest" if channel == "grey" else channel))
    upright = [photo.image.T if photo.turned else photo.image for photo in photos]
    pictures = tuple(_shrink(picture) for picture in upright)
    try:
        measured = measure_camera(photos, question.mains_frequency, progress=report)
    except MatchError as error:
        return CameraAnswer(question, pictures, None, str(error))
    return CameraAnswer(question, pictures, measured)


def _shrink(picture: ByteArray) -> ByteArray:
    factor = min(1.0, _MOST_PIXELS / max(picture.shape))
    size = (max(1, round(picture.shape[1] * factor)), max(1, round(picture.shape[0] * factor)))
    small = cv2.resize(np.ascontiguousarray(picture), size, interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8)
