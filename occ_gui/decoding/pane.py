"""The pane of decoding: what the decoders read, and the choice of one of them."""

from dataclasses import replace

from PySide6.QtCore import QSize

from occ_gui.core.store import Store
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.shell.feature import PiecesPane
from occ_gui.shell.results import of_reading
from occ_gui.widgets.building import ScrollPane
from occ_model.receiver.decode import decoders

_LEAST_SIZE = QSize(320, 264)


class DecodePane(PiecesPane):
    """Shows what the decoders read; the user chooses the decoder here or in the story."""

    def __init__(self, store: Store) -> None:
        self.view = view = DecodeView(decoders())
        super().__init__(ScrollPane(view, _LEAST_SIZE), view.show_reading, view.choose_decoder)
        self.made_of, self.verdicts = {view: of_reading}, (view,)
        view.decoder_chosen.connect(lambda name: store.put(replace(store.workspace, decoder=name)))
