"""The catalogue of components: what is in it, where it comes from, and how another is opened.

What is chosen from it is chosen in the sidebar, in each group.
"""

import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import opening
from dashboard.fields import FIELDS, RAIL_FIELDS
from dashboard.formats import quantity_text
from dashboard.persistence.exports import file_name
from dashboard.session.special import curve_text, is_curve
from dashboard.views.components import caption, panel

SHORT = {
    "stiffness": "",
    "loss_factor": "loss factor",
    "static_stiffness": "static",
}
"""What each number of a pad or boot is called beside the others, by the end of its field."""


class CatalogueView(Viewer):
    """The table of components, and the ways to open and save one.

    Parameters
    ----------
    shelf : Shelf
        The catalogue that is open.
    exchange : Exchange
        Opens and saves files.
    """

    def __init__(self, shelf, exchange):
        super().__init__()
        self._shelf, self._exchange = shelf, exchange
        self.load = _button("Open catalogue", "folder_open", js_on_click=opening("catalogue"))
        self.save = _button("Save catalogue", "save", on_click=self._save)
        self.close = _button("Back to the bundled one", "undo", on_click=self._close)
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(4, 12, 4, 12))
        self.table = pn.pane.HTML(
            "", stylesheets=[theme.CATALOGUE_CSS], sizing_mode="stretch_width", margin=(0, 12, 8, 12)
        )
        exchange.on_file("catalogue", self.open)
        shelf.param.watch(self._show, "catalogue")
        self._show()

    def open(self, data):
        """Take the catalogue of a file, or say why not and keep the one that is open."""
        try:
            self._shelf.open(data)
        except tig.StudyError as error:
            self._tell(f"Not opened, nothing has changed: {error}.")
        else:
            self._tell("The catalogue is open, and this browser remembers it.", "status")

    def _save(self, *_):
        catalogue = self._shelf.catalogue
        self._exchange.save(
            file_name(catalogue.name, "catalogue.toml"), catalogue.to_toml(), "application/toml"
        )

    def _close(self, *_):
        self._shelf.close()
        self._tell("")

    def _tell(self, words, role="alert"):
        self.message.object = f'<div role="{role}">{html.escape(words)}</div>'

    def _show(self, *_):
        self.table.object = table_html(self._shelf.catalogue)
        self.close.disabled = not self._shelf.is_own

    def __panel__(self):
        """Return what is put on the page."""
        return panel(
            caption("Catalogue", "components by name; choose from it in the sidebar, in each group"),
            pmui.FlexBox(self.load, self.save, self.close, margin=(0, 0, 0, 4)),
            self.message,
            self.table,
        )


def table_html(catalogue):
    """Return a catalogue as a table in a box that scrolls; whatever it holds is escaped."""
    rows = "".join(
        "<tr>"
        + "".join(
            f"<td>{html.escape(text)}</td>" for text in (each.kind, each.name, figures(each), each.source)
        )
        + "</tr>"
        for each in catalogue.components
    )
    heads = "".join(f'<th scope="col">{words}</th>' for words in ("Kind", "Name", "Figures", "Source"))
    name = html.escape(catalogue.name)
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="Catalogue"><table>'
        f"<caption>{name}</caption><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
    )


def figures(component):
    """Return the figures of a component in words."""
    if component.kind == "rail":
        rail = component.values["rail"]
        parts = [
            f"{quantity_text(field.to_display(getattr(rail, name)))} {field.unit}"
            for name, field in RAIL_FIELDS.items()
        ]
        return ", ".join(parts)
    if component.kind == "block":
        return f"{quantity_text(component.values['block_mass'])} kg"
    texts = [
        _figure(f"{component.kind}_{end}", words, component.values.get(f"{component.kind}_{end}"))
        for end, words in SHORT.items()
    ]
    return ", ".join(filter(None, [*texts, _frequency(component)]))


def _figure(name, words, value):
    if value is None:
        return ""
    field = FIELDS.get(name, FIELDS["pad_stiffness"])
    text = curve_text(value) if is_curve(value) else quantity_text(field.to_display(value))
    unit = "" if is_curve(value) else field.unit
    return f"{words} {text} {unit}".strip()


def _frequency(component):
    is_other = component.stiffness_frequency != tig.TrackDesign.stiffness_frequency
    return f"at {quantity_text(component.stiffness_frequency)} Hz" if is_other else ""


def _button(label, icon, **kind):
    return pmui.Button(label=label, icon=icon, size="small", variant="outlined", margin=(4, 8, 4, 8), **kind)
