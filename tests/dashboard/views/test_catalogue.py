"""The catalogue on the page: what it holds is text, and what cannot be read changes nothing."""

from pathlib import Path

import pytest

import trackig_core as tig
from dashboard.session.shelf import Shelf
from dashboard.views.catalogue import CatalogueView, figures
from trackig_core.study import Catalogue

COMPANY = (Path(__file__).parents[2] / "data" / "company_catalogue.toml").read_bytes()


class FakeExchange:
    def __init__(self):
        self.saved = []

    def on_file(self, purpose, callback):
        """Take no file."""

    def save(self, *parts):
        """Note what is saved."""
        self.saved.append(parts)


@pytest.fixture
def view():
    return CatalogueView(Shelf(), FakeExchange())


def test_a_catalogue_is_listed_with_its_sources(view):
    assert view.close.disabled
    view.open(COMPANY)
    table = view.table.object
    assert "<caption>Ours</caption>" in table
    assert "&lt;b&gt;Soft&lt;/b&gt;" in table
    assert "<b>" not in table
    assert table.count("<tr>") == 4
    assert "test report 8" in table
    view.close.clicks += 1
    assert "Table 1 and rail sections" in view.table.object


def test_figures_are_in_the_sidebar_s_units(view):
    view.open(COMPANY)
    assert [figures(each) for each in view._shelf.catalogue.components] == [
        "58 kg/m, 5.88 MN m²",
        "3000 kN/mm, loss factor 0.15, static 60 kN/mm",
        "measured at 2 frequencies, 5 to 500 Hz",
    ]


def test_what_cannot_be_read_is_told_and_changes_nothing(view):
    view.open(COMPANY)
    view.open(b"<script>")
    assert "Not opened, nothing has changed" in view.message.object
    assert "<script>" not in view.message.object
    assert view._shelf.catalogue.name == "Ours"


def test_a_saved_catalogue_is_read_back(view):
    view.open(COMPANY)
    view.save.clicks += 1
    ((name, text, _),) = view._exchange.saved
    assert name.endswith("catalogue.toml")
    assert Catalogue.from_toml(text) == view._shelf.catalogue


def test_every_bundled_component_has_figures():
    assert all(figures(each) for each in tig.study.bundled_catalogue().components)
