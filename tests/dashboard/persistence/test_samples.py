"""Production samples as they are pasted."""

import pytest

from dashboard.persistence.samples import MOST_SPECIMENS, SamplesError, read_samples


def test_columns_are_named_by_what_they_hold_in_their_own_units():
    text = "No.\tBoot stiffness [N/mm]\tboot_loss_factor\tBatch\n1\t26000\t0,19\tA\n2\t31000\t0,21\tB"
    found, notes = read_samples(text)
    assert found == {"boot_stiffness": [26e6, 31e6], "boot_loss_factor": [0.19, 0.21]}
    assert any("Batch" in note for note in notes)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "No column is a number of a design"),
        ("colour\nred", "No column is a number of a design: head each by one of pad stiffness"),
        ("boot stiffness [kN/mm]; block mass [kg]\n26; 45\n27;", "Line 3"),
        ("boot stiffness [kg]\n26\n27", "a unit of mass: give it in kN/mm"),
        ("boot stiffness\n26\n27", "Boot stiffness has no unit: head its column “Boot stiffness .kN/mm.”"),
        ("boot stiffness, N/mm\n26\n27", "Boot stiffness has no unit"),
        ("block mass [kg]\n" + "45\n" * (MOST_SPECIMENS + 1), f"give at most {MOST_SPECIMENS}"),
    ],
)
def test_what_is_no_table_of_samples_is_refused_in_words(text, says):
    with pytest.raises(SamplesError, match=says):
        read_samples(text)
