"""The catalogue against its sources, which stand beside the tests."""

import csv

import pytest

import trackig_core as tig
from tests.core.conftest import DATA


def test_presets_are_the_papers_table_1(golden, preset):
    design = tig.PRESETS[preset]
    for field in (
        "pad_stiffness",
        "pad_loss_factor",
        "block_mass",
        "boot_stiffness",
        "boot_loss_factor",
        "fastener_spacing",
        "wheel_mass",
    ):
        assert getattr(design, field) == golden["cases"][preset][field]
    assert design.contact_stiffness == golden["contact_stiffness_N_per_m"]
    assert design.rail.bending_stiffness == pytest.approx(golden["rail"]["bending_stiffness_N_m2"])
    assert set(tig.PRESETS) == set(golden["cases"])


def test_rails_are_those_of_their_sources():
    lines = [line for line in (DATA / "rails.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    assert [row["key"] for row in rows] == list(tig.RAILS)
    for row in rows:
        rail = tig.RAILS[row["key"]]
        assert rail.mass_per_metre == float(row["mass_kg_per_m"])
        assert rail.bending_stiffness == pytest.approx(210e9 * float(row["second_moment_cm4"]) * 1e-8)


def test_catalogues_cannot_be_changed():
    with pytest.raises(TypeError):
        tig.PRESETS["mine"] = tig.PRESETS["slab-track"]
