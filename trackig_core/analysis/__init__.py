"""What is learnt from a design beyond its insertion gain: checks, simpler models, motion, damping."""
