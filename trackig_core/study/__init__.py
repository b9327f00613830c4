"""Studies: designs with names and looks, a specification and a source, as objects and as one TOML file."""

from trackig_core.study.catalogue import Catalogue, Component, bundled_catalogue
from trackig_core.study.records import PinnedDesign, StaticLoad, StudyError, View
from trackig_core.study.studies import Study
from trackig_core.track.measured_tables import StiffnessReading, read_stiffness

__all__ = [
    "Catalogue",
    "Component",
    "PinnedDesign",
    "StaticLoad",
    "StiffnessReading",
    "Study",
    "StudyError",
    "View",
    "bundled_catalogue",
    "read_stiffness",
]
