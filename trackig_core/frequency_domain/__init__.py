"""The frequency-domain solution: the same lattice in closed form, frequency by frequency."""
