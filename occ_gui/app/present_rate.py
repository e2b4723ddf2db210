"""Shows at the handles of the sliders what is read of the present scene, as the verdict says it."""

from PySide6.QtCore import QObject

from occ_gui.decoding.verdict import result_of, share_read
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.simulation.snapshot import Reading
from occ_model.receiver.decoders import PAPER_DECODER


class PresentRate(QObject):
    """The share of bits read of the scene shown, on the strips behind the sliders.

    The strips are means over pictures that begin at any time; near a limit the one picture that is
    shown may be read otherwise.

    Parameters
    ----------
    strips
        The strips.
    """

    def __init__(self, strips: SliderStrips) -> None:
        super().__init__()
        self._strips = strips
        self._decoder = PAPER_DECODER
        self._reading: Reading | None = None
        self._is_outdated = False

    def show_reading(self, reading: Reading) -> None:
        """Show what is read of another scene, or more surely of the same."""
        self._reading = reading
        self._show()

    def choose_decoder(self, decoder: str) -> None:
        """Show what this decoder reads."""
        self._decoder = decoder
        self._show()

    def show_failure(self) -> None:
        """Show nothing of a scene without a picture."""
        self._reading = None
        self._show()

    def show_outdated(self, outdated: bool) -> None:
        """Show nothing while the verdict is that of an earlier scene."""
        self._is_outdated = outdated
        self._show()

    def show_run(self, value: str, pictured: str) -> None:
        """Go on while a slider runs by itself: the verdict says of which value it is."""

    def _show(self) -> None:
        reading, share = self._reading, None
        if reading is not None and not self._is_outdated:
            share = share_read(result_of(reading, self._decoder), reading.sent)
        self._strips.show_present(share)
