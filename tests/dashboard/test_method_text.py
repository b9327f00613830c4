"""The method's text: equations that survive rendering, and figures that the solver confirms."""

import math
import re

import numpy as np
import pytest

import trackig_core as tig
from dashboard import assets
from dashboard.fields import FIELDS, GROUND, SUSPENDED
from dashboard.report.html_report import FREQUENCIES
from dashboard.session import surroundings
from dashboard.teaching.left_out import WHAT_IT_IS_NOT
from trackig_core.analysis.asymptotes import PER_RESONANCE
from trackig_core.track.viscoelastic_law import fit_loss_factor

TEXT = assets.read_text(assets.METHOD)
EQUATIONS = re.findall(r"^\$\$\n(.*?)\n\$\$$", TEXT, re.DOTALL | re.MULTILINE)


def test_every_equation_stands_between_its_own_signs():
    assert len(EQUATIONS) > 10
    assert TEXT.count("$$") == 2 * len(EQUATIONS)
    outside = re.sub(r"\$\$.*?\$\$", "", TEXT, flags=re.DOTALL)
    inline = re.sub(r"\$[^$\n]+\$", "", outside)
    assert len(outside) - len(inline) > 400
    assert "$" not in inline
    assert "\\" not in inline


def test_no_symbol_is_printed_as_it_is_typed():
    """A name with an underscore, or a lone italic letter, is a symbol: it belongs between dollar signs."""
    outside = re.sub(r"\$\$.*?\$\$|\$[^$\n]+\$", "", TEXT, flags=re.DOTALL)
    assert re.findall(r"\b\w_\w+|\*\w\*", outside) == []


def test_no_row_of_a_table_is_cut_by_a_formula():
    rows = re.findall(r"^\|.*\|$", TEXT, re.MULTILINE)
    assert rows
    for row in rows:
        assert row.count("|") == 3, row


@pytest.mark.parametrize("equation", EQUATIONS)
def test_markdown_leaves_equations_alone(equation):
    """Markdown eats a backslash before a sign, reads stars as stress, and paragraphs end at empty lines."""
    assert not re.search(r"\\[^A-Za-z]", equation)
    assert "*" not in equation
    assert "\n\n" not in equation
    assert equation.count("{") == equation.count("}")
    assert equation.count(r"\left") == equation.count(r"\right")


def test_the_method_and_the_controls_say_what_the_fullest_model_is_not():
    section = TEXT.split("## What the simplified model leaves out")[1].split("\n## ")[0]
    limits = section.split("What the fullest model is not:")[1]
    controls = " ".join(surroundings.WORDS.values())
    for limit in ("not feel each other", "tunnel", "receptor", "floating slab", "No load moves"):
        assert limit in limits
        assert limit in controls
        assert limit.lower() in WHAT_IT_IS_NOT.lower()
    for group in (SUSPENDED, GROUND):
        assert f"*{group}*" in section


def test_no_html_is_meant():
    assert not re.search(r"<[a-zA-Z/!]", TEXT)


def test_its_figures_are_those_of_the_model():
    law = fit_loss_factor(0.2)
    assert f"{law.stiffness(5.0):.2f} of the stated stiffness at 5 Hz" in TEXT
    assert f"{law.stiffness(500.0):.2f} of it at 500 Hz" in TEXT
    worst = max(fit_loss_factor(float(loss)).worst_error for loss in np.linspace(0.05, 0.5, 10))
    assert worst <= 0.051
    blocks = [
        math.sqrt((design.pad_stiffness + design.boot_stiffness) / design.block_mass) / (2 * math.pi)
        for design in tig.PRESETS.values()
        if design.two_stage
    ]
    assert "{:.0f}, {:.0f} and {:.0f} Hz".format(*blocks) in TEXT
    assert f"{math.sqrt(1000):.0f} times too low" in TEXT
    assert f"{-PER_RESONANCE:.0f} dB per octave down" in TEXT
    assert f"{-2 * PER_RESONANCE:.0f} dB per octave above the second" in TEXT
    wheel = tig.PRESETS["slab-track"]
    assert math.sqrt(wheel.contact_stiffness / wheel.wheel_mass) / (2 * math.pi) == pytest.approx(180, abs=2)


def test_its_polynomial_has_the_roots_of_the_lumped_model():
    design = tig.PRESETS["booted-block-low-mass"].replace(pad_loss_factor=0.0, boot_loss_factor=0.0)
    n = tig.effective_supports(design)
    upper = 1 / (1 / design.contact_stiffness + 1 / (n * design.pad_stiffness))
    coupled = tig.lumped_frequencies(design).coupled
    assert len(coupled) == 2
    for frequency in coupled:
        x = (2 * math.pi * frequency) ** 2
        left = (upper / design.wheel_mass - x) * (design.boot_stiffness / design.block_mass - x)
        assert left == pytest.approx(upper / (n * design.block_mass) * x)


TERMS = re.findall(r"^\| ([^|]*?) \|", TEXT.split("## Glossary")[1], re.MULTILINE)[1:]


def test_glossary_is_in_order():
    assert len(TERMS) > 30
    assert sorted(TERMS, key=str.casefold) == TERMS


def test_glossary_explains_the_labels_of_the_page():
    labels = [
        *(field.label for field in FIELDS.values()),
        *(name for name, _ in FREQUENCIES if not name.startswith("observed")),
        *("Insertion gain", "Receptance", "Loss factor", "Dynamic stiffness", "Lumped model", "Roughness"),
    ]
    heads = [term.split(",")[0].casefold() for term in TERMS]
    unexplained = [label for label in labels if not any(head in label.casefold() for head in heads)]
    assert unexplained == []


@pytest.mark.parametrize(
    "term",
    ["coherent sum", "energy sum", "Floquet wave", "frequency-domain solution", "insertion loss",
     "pinned-pinned frequency", "reference line", "reference, rigid", "reference, very stiff",
     "single-stage, two-stage", "track decay rate"],
)  # fmt: skip
def test_glossary_has_the_terms_of_the_field(term):
    assert term in TERMS


def test_the_glossary_s_pinned_pinned_frequency_is_that_of_the_rail():
    rail = tig.RAILS["60"]
    frequency = math.pi / (2 * 0.6**2) * math.sqrt(rail.bending_stiffness / rail.mass_per_metre)
    assert f"{frequency:.0f} Hz for a 60 kg/m rail at 0.6 m" in TEXT
    assert frequency > tig.BAND_EDGES[-1]
