"""One model of a lamp's stripes, fitted to the profile of a place in a photo."""
