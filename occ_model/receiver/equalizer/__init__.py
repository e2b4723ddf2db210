"""The equalizer: undo the exposure's moving average, then read as the paper does."""
