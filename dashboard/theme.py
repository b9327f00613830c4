"""Colours, sizes and number formats: the look of the dashboard, in one file.

No colour code and no number format stands anywhere else. Colours carry meaning by
quantity, are told apart by colour-blind readers (after Okabe and Ito, 2008), and hold a contrast
of at least 3 against the light and the dark paper (WCAG 2.2, 1.4.11), since figures keep their
colours when the theme is switched.
"""

LIGHT_PAPER = "#ffffff"
DARK_PAPER = "#121212"

THIS_DESIGN = "#2b83c6"
"""The current design: its insertion gain, its total force."""

LOADED_TRACK = "#d55e00"
"""All that concerns the loaded track: its frequency, the force under the wheel."""

COUPLED_BLOCK = "#00966e"
"""The block between pad and boot."""

PRESET_GHOST = "#808080"
"""The preset from which a modified design departs; also axes and zero lines."""

THEORY = "#9c5fb5"
"""What comes from theory: exact curves."""

SPECIFICATION = "#c2410c"
"""The limit of a specification, and where it is exceeded."""

DESIGN_COLOURS = (
    "#cc830e",
    "#9c3e88",
    "#21a869",
    "#817600",
    "#695be0",
    "#f55e3d",
    "#785f29",
    "#9e5248",
)
"""Pinned designs: the hues of Okabe and Ito, as light and as dark as both papers allow. Those that share a
dash, and the current design, differ for protanopes, deuteranopes and tritanopes too."""

DESIGN_COLOUR_NAMES = ("orange", "purple", "green", "olive", "violet", "vermilion", "brown", "russet")
"""What the colours of pinned designs are called."""

DESIGN_DASHES = ((), (9, 4), (3, 3), (10, 3, 2, 3)) * 2
"""Dash of each of them: the second cue."""

MOST_PINNED = len(DESIGN_COLOURS)
"""Designs that can be pinned at a time: one for each colour."""


def look(colour):
    """Return colour and dash of a design in every plot.

    Parameters
    ----------
    colour : int or None
        Number of a pinned design's colour, 0 to 7; None: the current design.

    Returns
    -------
    str, tuple of int
        Colour code, and dash [px]; an empty dash is a solid line.
    """
    return (THIS_DESIGN, ()) if colour is None else (DESIGN_COLOURS[colour], DESIGN_DASHES[colour])


FIGURE_COLOURS = (
    *(THEORY, THIS_DESIGN, LOADED_TRACK, COUPLED_BLOCK, PRESET_GHOST, SPECIFICATION),
    *DESIGN_COLOURS,
)

APP_BAR = "#17324d"

THEME = {
    "light": {
        "palette": {
            "primary": {"main": "#1b64a0"},
            "background": {"default": "#f3f5f7", "paper": LIGHT_PAPER},
        }
    },
    "dark": {
        "palette": {"primary": {"main": "#6db3e8"}, "background": {"default": "#0b0d0f", "paper": DARK_PAPER}}
    },
}
"""Material themes of the page by mode."""

FILL_ALPHA = 0.22
BAR_ALPHA = 0.8
LINE_WIDTH = 3
PINNED_LINE_WIDTH = 2.5
LIMIT_LINE_WIDTH = 3
THIN_LINE_WIDTH = 2
FAILING_SIZE = "18px"
NARROW_WINDOW = 1200
"""Width below which a window has no room for 21 bands in large figures [px]."""

TICK_SIZES, AXIS_SIZES = ("14px", "17px"), ("15px", "17px")
"""Text at the ticks and beside the axes, in narrow windows and in wide ones."""

LEGEND_LINE, LEGEND_ALPHA = 40, 0.75
"""Length of a legend's lines, long enough for any dash [px], and how little is seen through it."""

LEGEND_ROWS = 3
"""Entries of a legend in one column; more make two."""

LEGEND_NAME = 24
"""Characters of a name in a legend, so that the curves are seen beside it."""

SECOND_DASH = [7, 3]
"""Tells the second of two curves from the first without colour."""

DOT_SIZE = 9
FONT = "Roboto, Helvetica, Arial, sans-serif"
MARKER_LABEL_SIZE = "19px"
SIDE_VIEW_LABEL_SIZE = "16px"


BAND_LABEL_WIDTH = 40
"""Room that the label of a band needs on the frequency axis [px]."""


GROUP_HEADING = {"fontWeight": 700, "letterSpacing": "0.02em"}

HIDDEN_LABEL = {
    "& .MuiInputLabel-root": {"clipPath": "inset(50%)", "position": "absolute", "whiteSpace": "nowrap"},
    "& legend": {"display": "none"},
    "& fieldset": {"top": 0},
    "& .MuiFormHelperText-root": {"margin": "2px 0 0 4px", "whiteSpace": "nowrap"},
    "& input": {"padding": "5px 8px", "textAlign": "right", "fontVariantNumeric": "tabular-nums"},
}
"""A box whose label only screen readers meet, the slider beside it showing the same words."""

LEFT_ALIGNED = {
    "& input": {"padding": "5px 8px", "textAlign": "left"},
    "&& label + .MuiInputBase-formControl .MuiInputBase-input::placeholder": {"opacity": "0.7 !important"},
}
"""The same for words."""

SIDEBAR_WIDTH = 330
STATUS_HEIGHT = 32
FRESH, STALE = {"opacity": "1"}, {"opacity": "0.45"}
"""How pictures look that are those of the inputs, or of earlier ones."""

SUBTITLE = {"color": "white", "opacity": 0.85}
ANSWER_CSS = """
    p { margin: 2px 0; font-size: 1.05rem; color: var(--panel-on-surface-color, inherit); }
    p.problem { color: #c2410c; font-weight: 600; }
    p.note { opacity: 0.75; }
"""
"""Answers that are read aloud."""

STATUS_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
div { font-size: 15px; line-height: 30px; font-variant-numeric: tabular-nums; }
[role="status"] { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.problem { color: var(--danger-bg-color); font-weight: 500; }
"""
OPENING_CSS = """
:host { color: var(--panel-on-background-color); font-size: 15px; }
div { margin: 12px; opacity: 0; animation: 0s 0.4s forwards late; }
@keyframes late { to { opacity: 1; } }
"""
"""What opens at once says nothing, so that nothing flickers."""

SELECT_CSS = """
select.bk-input { font-size: 15px; color: var(--panel-on-background-color); }
select:not([multiple]).bk-input.bk-input {
    background-image: linear-gradient(45deg, transparent 50%, currentColor 50%),
        linear-gradient(135deg, currentColor 50%, transparent 50%);
    background-position: right 14px center, right 8px center;
    background-size: 6px 6px;
    background-repeat: no-repeat;
}
select.bk-input option { color: var(--panel-on-background-color); background: var(--panel-background-color); }
"""
"""The browser's own select, legible from afar; its arrow follows the theme."""

CHECKS_CSS = """
.bk-input-group { flex-wrap: wrap; }
label { font-size: 15px; margin-right: 14px; color: var(--panel-on-background-color); }
"""
DRAWING_CSS = """
:host { color: var(--panel-on-background-color); }
svg { display: block; width: 100%; height: max(440px, calc(100vh - 200px)); }
"""
SWATCH_CSS = ".swatch { display: block; }"

TABLE_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
.scroll { overflow-x: auto; padding: 0 12px 10px 12px; }
table { border-collapse: collapse; font-size: 15px; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-size: 14px; padding-bottom: 4px; }
th, td { padding: 4px 12px; text-align: right; vertical-align: top; }
td, tbody th { border-top: 1px solid rgba(128, 128, 128, 0.3); }
th[scope="row"], th[scope="rowgroup"], thead th:first-child { text-align: left; white-space: nowrap; }
th[scope="row"] { font-weight: 400; }
thead th { max-width: 150px; overflow-wrap: anywhere; }
.group th { padding-top: 12px; }
.swatch { display: block; margin-left: auto; }
.name { display: block; }
.difference { display: block; font-size: 14px; font-weight: 400; opacity: 0.8; }
"""
PLAYER_CSS = """
:host { font-family: var(--bokeh-base-font); font-size: 15px; color: var(--panel-on-background-color); }
.bk-btn, select.bk-input { font-size: 15px; }
.bk-btn.bk-btn, select.bk-input.bk-input {
    color: var(--panel-on-background-color);
    background-color: var(--panel-background-color);
}
.noUi-target { background: color-mix(in srgb, var(--panel-on-background-color) 20%, transparent); }
.noUi-handle { border-color: currentColor; }
"""
"""The controls beside a moving drawing, which run in the browser alone."""

SLIDER = {"& .MuiSlider-mark": {"width": 3, "height": 11, "borderRadius": 1, "backgroundColor": PRESET_GHOST}}
"""A slider marks the preset's value with a tick."""

PAGE = {".MuiAppBar-root": {"backgroundColor": APP_BAR, "color": "white"}}
PANEL = {"borderRadius": "8px", "height": "100%"}
PANEL_TITLE = {"fontWeight": 700}


def _figure_css(height):
    icons = "--bokeh-icon-color: var(--panel-on-background-color);"
    return f":host {{ flex: none !important; height: {height} !important; {icons} }}"


TALL = _figure_css("max(300px, calc(53vh - 150px))")
LOW = _figure_css("max(250px, calc(47vh - 165px))")
MEDIUM = _figure_css("300px")
HIGH = _figure_css("440px")
SHORT = _figure_css("180px")
"""Heights of the figures: together with their headings they fill the window, and no less than is legible."""

FREQUENCIES_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }}
.mains {{ display: flex; gap: 16px; padding: 2px 14px 0 14px; }}
.main {{ flex: 1; }}
h3 {{ margin: 0; font-size: 15px; font-weight: 500; }}
p {{ margin: 0; font-size: 14px; line-height: 1.35; }}
p.observed {{ font-weight: 500; margin-bottom: 4px; font-variant-numeric: tabular-nums; }}
p.figure {{ font-size: 38px; font-weight: 700; line-height: 1.2; font-variant-numeric: tabular-nums; }}
.loaded-track .figure {{ color: {LOADED_TRACK}; }}
.coupled-block .figure {{ color: {COUPLED_BLOCK}; }}
dl {{ display: grid; grid-template-columns: max-content 1fr; gap: 2px 12px; }}
dl {{ margin: 12px 14px 10px 14px; font-size: 14px; }}
dt {{ font-weight: 700; text-align: right; font-variant-numeric: tabular-nums; }}
dd {{ margin: 0; }}
"""

COMPLIES, FAILS = COUPLED_BLOCK, SPECIFICATION
"""Of verdicts; a sign and words say the same."""

_TABLE_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); overflow-x: auto; }}
table {{ border-collapse: collapse; font-size: 15px; font-variant-numeric: tabular-nums; }}
caption {{ position: absolute; clip-path: inset(50%); white-space: nowrap; }}
th, td {{ padding: 1px 10px; text-align: right; border-bottom: 1px solid {PRESET_GHOST}40; }}
th {{ font-weight: 600; }}
td {{ white-space: nowrap; }}
thead th {{ vertical-align: bottom; }}
svg {{ width: 34px; height: 6px; margin: 0 8px 3px 0; vertical-align: middle; }}
th {{ overflow-wrap: break-word; max-width: 220px; }}
.fails {{ color: {FAILS}; font-weight: 700; }}
"""

BAND_GRID_CSS = f"""
{_TABLE_CSS}
thead th {{ border-bottom: none; }}
thead tr + tr th {{ font-weight: 400; border-bottom: 1px solid {PRESET_GHOST}40; }}
thead svg {{ display: block; margin: 0 0 2px auto; }}
input {{
    width: 76px; padding: 1px 6px; font: inherit; text-align: right; color: inherit; background: transparent;
    border: 1px solid {PRESET_GHOST}; border-radius: 4px;
}}
input:focus {{ outline: 2px solid {THIS_DESIGN}; outline-offset: 0; }}
input[aria-invalid] {{ border: 2px solid {FAILS}; }}
"""

LEVELS_CSS = f"""
{_TABLE_CSS}
table {{ font-size: 20px; }}
thead th {{ font-size: 15px; }}
th:first-child {{ text-align: left; }}
p {{ margin: 0; font-size: 16px; }}
"""

VERDICT_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }}
p {{ margin: 0; font-size: 16px; }}
ul {{ display: grid; grid-template-columns: max-content minmax(0, max-content) 1fr; gap: 4px 12px; }}
ul {{ list-style: none; margin: 0; padding: 0; }}
li {{ display: contents; font-size: 22px; line-height: 1.3; }}
li svg {{ align-self: center; }}
.name {{ overflow-wrap: anywhere; }}
.complies {{ color: {COMPLIES}; font-weight: 700; }}
.fails {{ color: {FAILS}; font-weight: 700; }}
"""

MESSAGE_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); }}
div {{ font-size: 15px; font-weight: 600; min-height: 20px; overflow-wrap: anywhere; color: {FAILS}; }}
div[role=status] {{ font-weight: 400; color: var(--panel-on-background-color); }}
"""

PROSE_WIDTH = 900
PROSE_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); font-size: 16px; }
p, li { line-height: 1.55; }
table { border-collapse: collapse; }
th, td { text-align: left; vertical-align: top; padding: 4px 16px 4px 0; font-size: 15px; }
"""
EQUATION_CSS = """
:host { color: var(--panel-on-background-color); font-size: 16px; overflow-x: auto; }
"""

SLOPES_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
table { border-collapse: collapse; font-size: 15px; font-variant-numeric: tabular-nums; margin: 6px 0; }
caption { text-align: left; font-weight: 500; padding-bottom: 4px; }
th, td { text-align: right; padding: 3px 18px 3px 0; }
th { font-weight: 500; }
"""

REPORT_INK = "#1b2733"
REPORT_FAINT = "#5b6773"
REPORT_RULE = "#d5dbe1"
REPORT_SHADE = "#f3f5f7"
REPORT_GOOD = "#00704f"
REPORT_BAD = "#b3261e"
"""A report is printed: dark ink on white paper, whatever the theme of the page."""
