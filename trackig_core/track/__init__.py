"""The track: design, catalogue, measured curves, and the law of its pads and boots."""
