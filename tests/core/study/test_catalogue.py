"""A catalogue is read back as it was written, fits its components, and says what is wrong with a file."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.study import Catalogue, Component, bundled_catalogue
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

FILE = """\
format = "trackig catalogue"
version = 1
name = "Acme"

[[rail]]
name = "Grooved"
mass_kg_per_m = 59.0
second_moment_cm4 = 3300
source = "maker's sheet"

[[pad]]
name = "Soft pad"
stiffness_N_per_m = 60e6
loss_factor = 0.12
static_stiffness_N_per_m = 45e6
stiffness_frequency_Hz = 10.0
source = "report 12/345, EN 17495"

[[pad]]
name = "Measured pad"
stiffness_measured = [[1.0, 310.4e6, 0.151], [10.0, 605.7e6, 0.151], [30.0, 671.0e6, 0.151]]
preload_N = 30e3
static_stiffness_N_per_m = 277.6e6
source = "report 7"

[[block]]
name = "Light block"
mass_kg = 60.0
source = "drawing 8"

[[boot]]
name = "Boot"
stiffness_N_per_m = 20e6
loss_factor_measured = [[5.0, 0.1], [500.0, 0.3]]
source = "report 9"
"""
ACME = Catalogue.from_toml(FILE)


def test_what_is_written_is_what_is_read():
    for catalogue in (ACME, bundled_catalogue()):
        text = catalogue.to_toml()
        assert Catalogue.from_toml(text) == catalogue
        assert Catalogue.from_toml(text.encode()).to_toml() == text


def test_the_bundled_one_makes_the_presets_and_the_rails(preset):
    bundled = bundled_catalogue()
    rails = {name: component.values["rail"] for name, component in bundled.of_kind("rail").items()}
    assert rails == dict(tig.RAILS)
    design, made = tig.PRESETS[preset], []
    for kind in ("pad", "block", "boot") if design.two_stage else ("pad",):
        fitted = [component.fitted_to(design) == design for component in bundled.of_kind(kind).values()]
        made.append(any(fitted))
    assert all(made)
    assert all("Table 1" in each.source or "EN 13674-1" in each.source for each in bundled.components)


def test_components_are_fitted():
    design = ACME.of_kind("rail")["Grooved"].fitted_to(BLOCK)
    assert design.rail.bending_stiffness == pytest.approx(210e9 * 3300e-8)
    assert ACME.of_kind("block")["Light block"].fitted_to(BLOCK).block_mass == 60.0
    design = ACME.of_kind("boot")["Boot"].fitted_to(BLOCK)
    assert isinstance(design.boot_loss_factor, tig.LossFactorCurve)
    design = ACME.of_kind("pad")["Measured pad"].fitted_to(BLOCK)
    assert isinstance(design.pad_stiffness, tig.StiffnessCurve)
    assert (design.pad_loss_factor, design.pad_static_stiffness) == (None, 277.6e6)
    assert design.pad_stiffness.preload == 30e3
    back = bundled_catalogue().of_kind("pad")["Booted block pad, low mass"].fitted_to(design)
    assert back == BLOCK  # what the other pad had measured leaves with it


def test_a_stiffness_stated_elsewhere_is_restated_at_the_designs_frequency():
    pad = ACME.of_kind("pad")["Soft pad"]
    design = pad.fitted_to(BLOCK)
    assert design.pad_stiffness > 1.05 * 60e6
    there = pad.fitted_to(BLOCK.replace(stiffness_frequency=10.0))
    assert there.pad_stiffness == 60e6
    frequency = np.geomspace(5, 500, 20)
    np.testing.assert_allclose(
        laws(design)[0].dynamic_stiffness(frequency), laws(there)[0].dynamic_stiffness(frequency), rtol=1e-9
    )


@pytest.mark.parametrize(("kind", "name"), [("block", "Light block"), ("boot", "Boot")])
def test_a_single_stage_track_takes_no_block_or_boot(kind, name):
    with pytest.raises(tig.DesignError, match=f"{kind} = '{name}': give a two-stage track"):
        ACME.of_kind(kind)[name].fitted_to(SLAB)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"trackig catalogue"', '"trackig study"', "this is no catalogue"),
        ("version = 1", "version = 2", "version: 2: give 1"),
        ('name = "Acme"', "", "name: it is missing"),
        ('name = "Grooved"', 'name = " "', r"rail\[0\]\.name: ' ': give a name"),
        ("second_moment_cm4 = 3300", "second_moment_cm4 = true", r"rail\[0\]\.second_moment_cm4: True"),
        ("second_moment_cm4 = 3300", "", r"rail\[0\]\.bending_stiffness_N_m2: it is missing"),
        (
            "second_moment_cm4 = 3300",
            "second_moment_cm4 = 3300\nbending_stiffness_N_m2 = 6e6",
            r"rail\[0\]\.second_moment_cm4: give this or bending_stiffness_N_m2, not both",
        ),
        ("60e6", "60", r"pad\[0\]\.stiffness_N_per_m: 60: give a number from 100000 to 1e\+13 N/m"),
        ("loss_factor = 0.12\n", "", r"pad\[0\]\.loss_factor: it is missing"),
        ("stiffness_N_per_m = 60e6\n", "", r"pad\[0\]\.stiffness_N_per_m: it is missing"),
        ("[10.0, 605.7e6, 0.151]", "[1.0, 605.7e6, 0.151]", r"pad\[1\]\.stiffness_measured: row 2"),
        (
            "preload_N = 30e3",
            "preload_N = nan",
            r"pad\[1\]\.preload_N: preload = nan: give a number from 0 to",
        ),
        (
            "loss_factor = 0.12",
            "loss_factor = 0.12\npreload_N = 30e3",
            r"pad\[0\]\.preload_N: remove it, or give",
        ),
        (
            "static_stiffness_N_per_m = 277.6e6",
            "loss_factor = 0.2",
            r"pad\[1\]\.loss_factor: remove it",
        ),
        ('source = "drawing 8"', "", r"block\[0\]\.source: it is missing"),
        ("mass_kg = 60.0", "mass_kg = 0.6", r"block\[0\]\.mass_kg: 0.6: give a number from 1 to 10000 kg"),
        ("mass_kg = 60.0", "mass_t = 0.06\nmass_kg = 60.0", r"block\[0\]\.mass_t: there is no such key"),
        (
            'name = "Measured pad"',
            'name = "Soft pad"',
            "pad: 'Soft pad': there is a pad of that name",
        ),
        ("[[block]]", "[block]", r"block: .*write each block under \[\[block\]\]"),
    ],
)
def test_a_wrong_file_says_where_and_why(old, new, words):
    assert old in FILE
    with pytest.raises(tig.StudyError, match=words):
        Catalogue.from_toml(FILE.replace(old, new, 1))


def test_there_are_four_kinds():
    with pytest.raises(ValueError, match="kind = 'sleeper': give 'rail' or 'pad' or 'block' or 'boot'"):
        ACME.of_kind("sleeper")
    assert [type(each) for each in ACME.components] == [Component] * 5
