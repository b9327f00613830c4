"""From a force spectrum to levels per band: insertion gain, specification, source."""
