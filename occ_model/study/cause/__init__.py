"""Why a picture is not read, found by taking what may be wrong out of its scene."""
