"""Whatever the library returns prints as a short text with units; the repr is for debugging."""

import dataclasses
import re

import numpy as np
import pytest

import trackig_core as tig
from trackig_core import words

BLOCK = tig.PRESETS["booted-block-low-mass"]
METRO = tig.VEHICLES["metro"]
WHOLE = BLOCK.replace(
    suspension=METRO.suspension,
    axle_positions=(0.0, 2.1),
    ground=tig.GROUNDS["rock"],
    pad_static_stiffness=60e6,
    boot_static_stiffness=14e6,
)
CURVE = tig.StiffnessCurve([(5, 22e6, 0.18), (50, 28e6, 0.2)], preload=30e3)
LOSS = tig.LossFactorCurve([(5, 0.15), (500, 0.25)])
LIMITS = tig.Specification([(40, 16), (63, -1)], name="Limits", rail_deflection_limit=3e-3)
SOURCE = tig.SourceSpectrum([(40, 60), (63, 62.5)], name="Metro")


@pytest.fixture(scope="module")
def run():
    return tig.solve(BLOCK, "live")


@pytest.fixture(scope="module")
def exact():
    return tig.solve(BLOCK, "exact")


def results(run, exact):
    """Return an object of each public class that has something to say, by the class's name."""
    analysis, study = tig.analysis, tig.study
    slopes = analysis.measured_slopes(BLOCK)
    ladder = analysis.ladder(BLOCK)
    catalogue = study.bundled_catalogue()
    made = [
        *(run, exact, exact.gain, exact.natural_frequencies, run.history, exact.spectrum),
        *(tig.solve_many(BLOCK, boot_stiffness=[20e6, 30e6]), tig.verify(run), tig.static_response(BLOCK)),
        *(slopes[0], slopes[0].asymptote, analysis.curve_fit(CURVE), ladder, ladder.rungs[1]),
        *(analysis.damping_curves(BLOCK, [5.0, 50.0, 500.0])[0], analysis.departure(BLOCK)),
        analysis.frequency_sweep(BLOCK, "boot_stiffness", [20e6, 30e6]),
        *(analysis.film(BLOCK), analysis.peer_receptances()["slab-track"]),
        *(analysis.steady_shape(BLOCK, [40.0]), analysis.stiff_references(BLOCK, [40.0, 60.0])),
        *(analysis.track_response(BLOCK, [40.0, 60.0]), analysis.compare_with_beam(BLOCK)),
        *(analysis.lumped_frequencies(analysis.track_model(BLOCK)), analysis.Lattice()),
        *(LIMITS, LIMITS.check(exact.insertion_gain, 2e-3), SOURCE, SOURCE.with_track(exact.insertion_gain)),
        SOURCE.with_track(exact.insertion_gain).relative_to(SOURCE.with_track(np.zeros(21))),
        tig.levels.MeasuredGain([(40, 12.5)], name="Site"),
        *(catalogue, catalogue.components[0], tig.PinnedDesign("Soft", BLOCK), tig.View(), tig.Study(BLOCK)),
        *(study.StaticLoad(), study.read_stiffness("Hz,kN/mm,loss factor\n5,22,0.1\n50,28,0.2\n")),
        *(BLOCK, WHOLE, BLOCK.rail, METRO, METRO.suspension, tig.GROUNDS["rock"], CURVE, LOSS),
    ]
    return {type(each).__name__: each for each in made}


def public_classes():
    names = {
        (part, name)
        for part in (tig, tig.analysis, tig.levels, tig.study, tig.results)
        for name in part.__all__
    }
    found = [getattr(part, name) for part, name in names]
    return {each.__name__ for each in found if isinstance(each, type) and not issubclass(each, Exception)}


def test_every_public_result_prints_short_and_without_raw_figures(run, exact):
    made = results(run, exact)
    assert public_classes() <= {*made}, "an object of each public class is printed here"
    for name, each in made.items():
        text = str(each)
        assert 0 < len(text) < 700, name
        assert not re.search(r"\w+\(\w+=|array\(|object at|\de[+-]?\d", text), (name, text)
        assert name in ("View", "Lattice") or re.search(r"dB|Hz|N/m|mm| m\b|kg|%|kN|supports|rail", text), (
            text
        )


def test_what_is_printed_is_what_was_computed(run, exact):
    levels, natural = exact.insertion_gain, exact.natural_frequencies
    most = f"{levels.max():.1f} dB at {tig.BAND_LABELS[levels.argmax()]} Hz"
    assert str(exact.gain).startswith("insertion gain (reference line, summation energy) from ")
    assert str(exact.gain).endswith(f" to {most}")
    assert f"loaded track {natural.loaded_track:.3g} Hz, coupled block " in str(natural)
    verification = tig.verify(run)
    own = np.flatnonzero(np.isclose(verification.time_steps, run.grid.dt))[0]
    assert f"within {verification.run_errors[own]:.2g} dB of continuous time" in str(verification)
    comparison = tig.analysis.compare_with_beam(BLOCK)
    count, at = int(comparison.good_enough.sum()), int(np.abs(comparison.difference).argmax())
    assert f"in {count} of 21 bands" in str(comparison)
    assert f"{comparison.difference[at]:+.1f} dB at {tig.BAND_LABELS[at]} Hz" in str(comparison)
    statics = tig.static_response(BLOCK)
    assert f"rail deflection at least {1e3 * statics.rail_deflection:.3g} mm under one wheel of 85 kN" in str(
        statics
    )
    assert "no static stiffness is stated of the pad and the boot" in str(statics)
    assert "at least" not in str(tig.static_response(WHOLE, wheelbase=2.5))
    assert str(tig.analysis.ladder(BLOCK)) == tig.analysis.ladder(BLOCK).sentence


def test_designs_print_all_that_they_have():
    assert str(BLOCK) == (
        "pad stiffness 100 kN/mm, pad loss factor 0.2, block mass 45 kg, boot stiffness 28 kN/mm, boot loss "
        "factor 0.2, fastener spacing 0.6 m, wheel mass 880 kg, rail 60 (60 kg/m and 6.38 MN m2), contact "
        "stiffness 1200 kN/mm, stiffness frequency 50 Hz"
    )
    assert "axles at 0 and 2.1 m" in str(WHOLE)
    assert "suspension (primary stiffness 1.2 kN/mm, primary damping 10 kN s/m, bogie mass 750 kg" in str(
        WHOLE
    )
    assert "ground (stiffness 3200 kN/mm, " in str(WHOLE)
    measured = BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None, pad_loss_factor=LOSS)
    assert "boot stiffness (measured at 2 frequencies, 5 Hz to 50 Hz: 22 kN/mm to 28 kN/mm" in str(measured)
    assert "preload 30 kN" in str(measured)
    assert "pad_stiffness=100000000.0" in repr(BLOCK)


def test_limits_print_with_their_units():
    assert str(LIMITS) == "Limits: 16 dB at 40 Hz, -1 dB at 63 Hz; rail deflection at most 3 mm under 85 kN"
    assert str(SOURCE) == "Metro: 60 dB at 40 Hz, 62.5 dB at 63 Hz"


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (28e6, "N/m", "28 kN/mm"),
        (1.23456e10, "N/m", "12346 kN/mm"),
        (5e4, "N/m", "0.05 kN/mm"),
        (500.0, "N/m", "500 N/m"),
        (-85e3, "N", "-85 kN"),
        (0.0, "N", "0 N"),
        (0.0012856, "m", "1.286 mm"),
        (0.6, "m", "0.6 m"),
        (45.0, "kg", "45 kg"),
        (0.2, "", "0.2"),
        (1.7e-8, "m/N", "17 nm/N"),
    ],
)
def test_quantities_have_the_unit_of_the_field(value, unit, text):
    assert words.quantity(value, unit) == text


def test_a_digest_depends_on_every_figure_of_a_curve():
    from trackig_core.decide.questions import digest

    @dataclasses.dataclass
    class Result:
        curve: tig.StiffnessCurve

        def to_dataframe(self):
            import pandas as pd

            return pd.DataFrame({"boot_stiffness": pd.Series([self.curve], dtype=object)})

    near = tig.StiffnessCurve([(5, 22e6 + 1, 0.18), (50, 28e6, 0.2)], preload=30e3)
    assert str(near) == str(CURVE)
    assert digest(Result(near)) != digest(Result(CURVE))
