"""The pane of decoding: what it shows, and the choice of the decoder."""

from dataclasses import replace

from PySide6.QtCore import QSize

from occ_gui.core.store import Store
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_reading
from occ_gui.simulation.snapshot import Reading
from occ_gui.widgets.building import ScrollPane
from occ_model.receiver.decode import decoders

_LEAST = QSize(320, 264)


class DecodePane(Pane[tuple[Reading | None, str]]):
    """Shows what the decoders read; the user chooses the decoder here or in the story."""

    def __init__(self, store: Store) -> None:
        self.view = view = DecodeView(decoders())
        super().__init__(ScrollPane(view, _LEAST))
        self.made_of, self.verdicts = {view: of_reading}, (view,)
        self._reading: Reading | None = None
        view.decoder_chosen.connect(lambda name: store.put(replace(store.workspace, decoder=name)))

    def show_part(self, part: tuple[Reading | None, str]) -> None:
        reading, decoder = part
        if reading is not None and reading is not self._reading:
            self._reading = reading
            self.view.show_reading(reading)
        self.view.choose_decoder(decoder)
