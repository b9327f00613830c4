"""Studies: designs, specification and source, as objects and as TOML."""
