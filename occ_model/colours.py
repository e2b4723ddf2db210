"""Colours of curves, on screen and in print, distinct with any colour vision (Okabe and Ito).

Thresholds and noise, which no figure shows together, have the same colour.
"""

SIMULATION = "#0072B2"
BAND = "#D55E00"
PHOTO = "#009E73"
THRESHOLD = "#CC79A7"
REGION = "#E69F00"
NOISE = "#CC79A7"

RIGHT = SIMULATION
WRONG = BAND
