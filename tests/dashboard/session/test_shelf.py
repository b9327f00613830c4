"""A company's catalogue is opened whole or not at all, and its components become the design's."""

from pathlib import Path

import pytest

import trackig_core as tig
from dashboard.session.shelf import Shelf
from trackig_core.study import bundled_catalogue

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
COMPANY = (Path(__file__).parents[2] / "data" / "company_catalogue.toml").read_bytes()


def test_the_bundled_catalogue_is_there_at_first():
    shelf = Shelf()
    assert shelf.catalogue == bundled_catalogue()
    assert not shelf.is_own


@pytest.mark.parametrize("data", [b"", b"\xff\xfe", COMPANY[:-40], b"format = 'x'", b"#" * 300_000])
def test_what_is_no_catalogue_leaves_the_one_that_is_open(data):
    shelf = Shelf()
    shelf.open(COMPANY)
    with pytest.raises(tig.StudyError):
        shelf.open(data)
    assert shelf.catalogue.name == "Ours"
    shelf.close()
    assert not shelf.is_own


def test_components_are_fitted_to_a_design():
    shelf = Shelf()
    shelf.open(COMPANY)
    assert shelf.fitted("pad", "<b>Soft</b>", BLOCK) == BLOCK.replace(
        pad_stiffness=3e9, pad_loss_factor=0.15, pad_static_stiffness=60e6
    )
    assert shelf.fitted("rail", "worn", BLOCK).rail == tig.Rail("worn", 58.0, 210e9 * 2800e-8)
    assert shelf.fitted("boot", "worn", BLOCK) is None
    assert shelf.fitted("nothing", "", BLOCK) is None
    with pytest.raises(tig.DesignError, match="two-stage"):
        shelf.fitted("boot", "Measured", SLAB)
