"""Write pictures to files of every format that photos come in."""

from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image


def saved(folder: Path, picture: Image.Image | np.ndarray, name: str = "x.png", **how: Any) -> Path:
    """Write a picture in the format of its name's ending."""
    picture = Image.fromarray(picture) if isinstance(picture, np.ndarray) else picture
    if name.endswith(".heic"):
        # Without entering the format into Pillow's list, where the loader may not look.
        from pillow_heif import from_pillow

        exif = how.pop("exif", None)
        notes = {"exif": exif.tobytes()} if isinstance(exif, Image.Exif) else {}
        from_pillow(picture).save(folder / name, **notes, **how)
    else:
        picture.save(folder / name, **how)
    return folder / name
