"""Example results of an accuracy study, for tests of its plots."""

from occ_model.results.accuracy import AccuracyPoint

EACH_WAY = (
    AccuracyPoint("integration", "1 sample", 1e-5, 50.0),
    AccuracyPoint("integration", "closed form", 1e-4, 1e-14),
    AccuracyPoint("effects", "paper's model", 1e-3, 15.0),
    AccuracyPoint("effects", "+ Vignetting", 1e-2, 1.0, effects=("vignetting",)),
    AccuracyPoint("effects", "this plan", 1e-2, 0.0, True, ("led-edges", "vignetting")),
    AccuracyPoint("path", "profile path", 1e-4, 0.4),
    AccuracyPoint("draft", "draft 1/16", 2e-3, 0.8),
)
