"""Studies: designs with names and looks, a specification and a source, as objects and as one TOML file."""

from trackig_core.study.studies import PinnedDesign, Study, StudyError, View

__all__ = ["PinnedDesign", "Study", "StudyError", "View"]
