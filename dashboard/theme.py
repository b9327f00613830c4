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

COMPLYING = "#56b4e9"
"""Designs of a search that comply and are beaten by another: no red, which would say that they fail."""

PRESET_GHOST = "#808080"
"""The preset from which a modified design departs; also axes and zero lines."""

THEORY = "#9c5fb5"
"""What comes from theory: exact curves."""

EXTRAPOLATED = "#808080"
"""Hatching of bands that rest on more than was measured."""

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
COPY_MORE_WIDTH = 6.5
"""By how much a pinned design's line below the current one's is wider: it is seen on both sides [px]."""

LIMIT_LINE_WIDTH = 3
THIN_LINE_WIDTH = 2
FAILING_SIZE = "18px"
NARROW_WINDOW = 1200
"""Width below which a window has no room for 21 bands in large figures [px]."""

TICK_SIZES, AXIS_SIZES = ("14px", "17px"), ("15px", "17px")
"""Text at the ticks and beside the axes, in narrow windows and in wide ones."""

SECOND_DASH = [7, 3]
"""Tells the second of two curves from the first without colour."""

DOT_SIZE = 9
FONT = "Roboto, Helvetica, Arial, sans-serif"
MARKER_LABEL_SIZE = "19px"
SIDE_VIEW_LABEL_SIZE = "16px"
CELL_SIZE = "12px"


BAND_LABEL_WIDTH = 40
"""Room that the label of a band needs on the frequency axis [px]."""


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

WHOLE_NAME = {
    **LEFT_ALIGNED,
    "& input": {
        **LEFT_ALIGNED["& input"],
        "fieldSizing": "content",
        "width": "auto",
        "flexGrow": 1,
        "textOverflow": "ellipsis",
    },
}
"""A box that grows with its words; where the browser cannot have it grow, dots say that it holds more."""

SIDEBAR_WIDTH = 330
STATUS_HEIGHT = 32
DESIGN_BAR_HEIGHT = 80
FRESH, STALE = {"opacity": "1"}, {"opacity": "0.45"}
"""How pictures look that are those of the inputs, or of earlier ones."""

SUBTITLE = {"color": "white", "opacity": 0.85, "textWrap": "balance"}
ANSWER_CSS = """
    p { margin: 2px 0; font-size: 1.05rem; color: var(--panel-on-surface-color, inherit); }
    p.problem { color: #c2410c; font-weight: 600; }
    p.note { opacity: 0.75; }
    h3 { margin: 4px 0 0 0; font-size: 15px; color: var(--panel-on-surface-color, inherit); }
"""
"""Answers that are read aloud."""

STATUS_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
div { font-size: 15px; line-height: 30px; font-variant-numeric: tabular-nums; }
[role="status"] { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
[role="status"]:focus {
    position: absolute; z-index: 3; width: 100%; padding: 4px 0; white-space: normal; line-height: 1.4;
    background: var(--panel-background-color); outline: none;
    box-shadow: 0 0 0 6px var(--panel-background-color), 0 0 0 8px var(--panel-primary-color);
}
.problem { color: var(--danger-bg-color); font-weight: 500; }
"""
OPENING_CSS = """
:host { color: var(--panel-on-background-color); font-size: 15px; }
:host::before { content: "Opening …"; margin: 12px; opacity: 0; animation: 0s 0.4s forwards late; }
@keyframes late { to { opacity: 1; } }
"""
"""What opens at once says nothing, so that nothing flickers."""

SELECT_CSS = """
select.bk-input { font-size: 15px; color: var(--panel-on-background-color); text-overflow: ellipsis; }
select:not([multiple]).bk-input.bk-input { padding-right: 28px; }
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

TOOLTIP_CSS = ".MuiTooltip-popper .MuiTooltip-tooltip { width: max-content; max-width: 250px; }"
"""What a button says of itself, in lines of several words however narrow the button is."""

CHECKS_CSS = """
.bk-input-group { flex-wrap: wrap; }
.bk-input-group.bk-inline > *:not(:first-child) { margin-left: 0; }
label { font-size: 15px; margin-right: 14px; color: var(--panel-on-background-color); }
"""
DRAWING_CSS = """
:host { color: var(--panel-on-background-color); }
svg { display: block; width: 100%; height: max(440px, calc(100vh - 200px)); }
"""
LEGEND_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
ul { display: flex; flex-wrap: wrap; gap: 1px 18px; list-style: none; margin: 0; padding: 0 12px 6px 24px; }
li { display: flex; align-items: baseline; gap: 7px; font-size: 14px; line-height: 19px; min-width: 0; }
svg { flex: none; align-self: center; }
span { overflow-wrap: anywhere; }
"""
"""What a figure draws, below it: as many rows as the names need."""

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
thead th { min-width: 76px; max-width: 150px; overflow-wrap: break-word; hyphens: auto; }
td, thead th { padding: 4px 8px; }
thead th:first-child, th[scope="row"] { position: sticky; left: 0; }
thead th:first-child, th[scope="row"] { background: var(--panel-surface-color); }
.group th { padding-top: 12px; }
.swatch { display: block; margin-left: auto; }
.name { display: block; }
.difference { display: block; font-size: 14px; font-weight: 400; opacity: 0.8; }
"""
SHARES_CSS = f"""
{TABLE_CSS}
.bar {{ display: inline-block; height: 9px; margin-right: 6px; background: {THIS_DESIGN}; }}
td {{ white-space: nowrap; }}
p {{ margin: 6px 0; font-size: 14px; }}
"""
"""Tables of parts of a whole, each drawn as a bar."""

PLAYER_CSS = """
:host { font-family: var(--bokeh-base-font); font-size: 15px; color: var(--panel-on-background-color); }
.bk-btn, select.bk-input { font-size: 15px; }
.bk-btn.bk-btn, select.bk-input.bk-input {
    color: var(--panel-on-background-color);
    background-color: var(--panel-background-color);
}
.noUi-target { background: color-mix(in srgb, var(--panel-on-background-color) 20%, transparent); }
.noUi-handle { border-color: currentColor; }
label[for] { position: absolute; clip-path: inset(50%); white-space: nowrap; }
"""
"""The controls beside a moving drawing, which run in the browser alone."""

TABS = {
    "& .MuiTab-root": {"minWidth": 0, "textTransform": "none", "fontSize": 16},
    f"@media (max-width: {NARROW_WINDOW}px)": {
        "& .MuiTab-root": {"padding": "12px 6px", "fontSize": 13.5, "letterSpacing": 0}
    },
    # once there, the arrows take the room for want of which they stay
    "@media (min-width: 1024px)": {"& .MuiTabs-scrollButtons": {"display": "none"}},
}
"""All ten tabs are in sight, in narrow windows too; where they do not fit, arrows lead to the others."""

PAGE = {".MuiAppBar-root": {"backgroundColor": APP_BAR, "color": "white"}}
PANEL = {"borderRadius": "8px", "height": "100%", "backgroundColor": "var(--panel-surface-color)"}
"""A panel takes its paper from the page's style, as its text does: both change at once with the theme."""

PANEL_CSS = ":host { background: var(--panel-surface-color); border-radius: 8px; }"
CAPTION_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
:host > div { display: flex; flex-wrap: wrap; align-items: baseline; column-gap: 10px; }
h2 { margin: 0; font-size: 16px; font-weight: 700; line-height: 28px; letter-spacing: 0.009em; }
p { margin: 0; font-size: 14px; line-height: 20px; }
p:empty { display: none; }
"""

BESIDE_CSS = """
:host { display: grid !important; grid-template-columns: minmax(0, 7fr) minmax(0, 5fr); gap: 8px; }
@media (max-width: 1199px) { :host { grid-template-columns: minmax(0, 1fr); } }
"""
"""Two panels side by side, or below each other where there is no room."""

FITTING_CSS = """
:host { display: grid !important; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); }
"""
"""As many figures side by side as there is room for."""


def _figure_css(height):
    icons = "--bokeh-icon-color: var(--panel-on-background-color);"
    return f":host {{ flex: none !important; height: {height} !important; {icons} }}"


TALL = _figure_css("max(340px, calc(53vh - 150px))")
LOW = _figure_css("max(250px, calc(47vh - 190px))")
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
.mains.statics {{ margin-top: 10px; }}
.figure small {{ display: block; font-size: 14px; font-weight: 500; line-height: 1.2; }}
.loaded-track .figure {{ color: {LOADED_TRACK}; }}
.coupled-block .figure {{ color: {COUPLED_BLOCK}; }}
dl {{ display: grid; grid-template-columns: max-content 1fr; gap: 2px 12px; }}
dl {{ margin: 12px 14px 10px 14px; font-size: 14px; }}
dt {{ font-weight: 700; text-align: right; font-variant-numeric: tabular-nums; }}
dd {{ margin: 0; }}
"""

COMPLIES, FAILS = COUPLED_BLOCK, SPECIFICATION
"""Of verdicts; a sign and words say the same."""

COMPLIES_TEXT, FAILS_TEXT = (
    f"color-mix(in srgb, {colour} 70%, var(--panel-on-background-color))" for colour in (COMPLIES, FAILS)
)
"""The same for words, which need a contrast of 4.5 (WCAG 2.2, 1.4.3): darker on light paper, else lighter."""

_TABLE_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); overflow-x: auto; }}
table {{ border-collapse: collapse; font-size: 15px; font-variant-numeric: tabular-nums; }}
caption {{ position: absolute; clip-path: inset(50%); white-space: nowrap; }}
th, td {{ padding: 1px 8px; text-align: right; border-bottom: 1px solid {PRESET_GHOST}40; }}
@media (max-width: {NARROW_WINDOW}px) {{
    table {{ font-size: 13.5px; }}
    th, td {{ padding: 1px 4px; }}
    input {{ max-width: 50px; }}
}}
th {{ font-weight: 600; }}
td {{ white-space: nowrap; }}
thead th {{ vertical-align: bottom; }}
svg {{ width: 34px; height: 6px; margin: 0 8px 3px 0; vertical-align: middle; }}
th {{ overflow-wrap: break-word; max-width: 220px; }}
.fails {{ color: {FAILS_TEXT}; font-weight: 700; }}
"""

BAND_GRID_CSS = f"""
{_TABLE_CSS}
thead th {{ border-bottom: none; }}
thead tr + tr th {{ font-weight: 400; border-bottom: 1px solid {PRESET_GHOST}40; }}
thead svg {{ display: block; margin: 0 0 2px auto; }}
tbody th, thead tr:first-child th:first-child {{ position: sticky; left: 0; }}
tbody th, thead tr:first-child th:first-child {{ background: var(--panel-surface-color); }}
input {{
    width: 64px; padding: 1px 6px; font: inherit; text-align: right; color: inherit; background: transparent;
    border: 1px solid {PRESET_GHOST}; border-radius: 4px;
}}
input:focus {{ outline: 2px solid {THIS_DESIGN}; outline-offset: 0; }}
input[aria-invalid] {{ border: 2px solid {FAILS}; }}
"""

LEVELS_CSS = f"""
{_TABLE_CSS}
table {{ font-size: 20px; }}
thead th {{ font-size: 15px; }}
thead th:not(:first-child) {{ min-width: 84px; max-width: 150px; overflow-wrap: anywhere; }}
tbody th {{ position: relative; max-width: 460px; padding-left: 46px; overflow-wrap: anywhere; }}
tbody th svg {{ position: absolute; left: 2px; top: calc(1px + 0.6lh - 6px); }}
th:first-child {{ text-align: left; }}
p {{ margin: 0; font-size: 16px; }}
@media (max-width: {NARROW_WINDOW}px) {{
    table {{ font-size: 17px; }}
    thead th {{ font-size: 14px; }}
}}
"""
"""Names stand beside the pieces of their lines, however many lines of text they take."""

VERDICT_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }}
p {{ margin: 0; font-size: 16px; }}
ul {{ display: grid; grid-template-columns: max-content minmax(min(10em, 30%), auto) auto; }}
ul {{ gap: 4px 12px; justify-content: start; list-style: none; margin: 0; padding: 0; }}
li {{ display: contents; font-size: 22px; line-height: 1.3; }}
@media (max-width: {NARROW_WINDOW}px) {{ li {{ font-size: 17px; }} }}
li svg {{ align-self: center; }}
.name {{ overflow-wrap: anywhere; }}
.part {{ white-space: nowrap; }}
.complies {{ color: {COMPLIES_TEXT}; font-weight: 700; }}
.fails {{ color: {FAILS_TEXT}; font-weight: 700; }}
.open {{ font-weight: 700; overflow-wrap: anywhere; }}
.refused {{ font-size: 20px; font-weight: 700; color: {FAILS_TEXT}; margin-bottom: 6px; }}
.before li {{ font-size: 15px; }}
"""

QUANTITIES_CSS = f"""
:host {{
    font-family: var(--bokeh-base-font); font-size: 15px; color: var(--panel-on-background-color);
    --accent: var(--panel-primary-color);
    --ink: var(--panel-on-background-color);
    --faint: color-mix(in srgb, var(--ink) 62%, transparent);
    --line: color-mix(in srgb, var(--ink) 28%, transparent);
}}
.panel {{ padding: 8px 12px 12px 16px; }}
[hidden] {{ display: none !important; }}
button, input, select {{ font: inherit; color: inherit; }}
:focus-visible {{ outline: 2px solid var(--accent); outline-offset: 2px; }}
summary {{
    display: flex; justify-content: space-between; align-items: center;
    margin-top: 10px; padding: 2px 0; font-size: 14px; font-weight: 700; letter-spacing: 0.02em;
    cursor: pointer;
}}
summary::-webkit-details-marker {{ display: none; }}
summary::after {{
    content: ""; width: 6px; height: 6px; margin: 0 5px 3px 0; opacity: 0.55;
    border: solid currentColor; border-width: 0 2px 2px 0; transform: rotate(45deg);
}}
details[open] > summary::after {{ transform: rotate(-135deg); margin-bottom: -3px; }}

.quantity {{ display: grid; grid-template-columns: 1fr 104px; column-gap: 10px; align-items: center; }}
.quantity {{ margin-top: 2px; }}
.name {{ grid-column: 1; display: flex; align-items: center; gap: 6px; line-height: 20px; }}
.label {{ color: var(--faint); overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }}
.help {{
    flex: none; width: 16px; height: 16px; padding: 0; font-size: 11px; line-height: 14px; text-align: center;
    border: 1px solid currentColor; border-radius: 50%; background: none; opacity: 0.35; cursor: pointer;
}}
.help:hover, .help:focus-visible, .help[aria-expanded="true"] {{ opacity: 1; }}
.track {{ grid-column: 1; position: relative; height: 22px; }}
.scale {{ position: absolute; inset: 0 7px; }}
.rail, .fill {{ position: absolute; top: 10px; height: 2px; border-radius: 1px; background: var(--accent); }}
.rail {{ left: -1px; right: -1px; opacity: 0.45; }}
.fill {{ left: -1px; }}
.mark {{
    position: absolute; top: 6px; width: 3px; height: 10px; margin-left: -1px; border-radius: 1px;
    background: {PRESET_GHOST};
}}
.track input {{
    appearance: none; position: absolute; inset: 0; width: 100%; height: 100%; margin: 0;
    background: none; cursor: pointer; touch-action: pan-y;
}}
.track input:focus-visible {{ outline: none; }}
.track input::-webkit-slider-thumb {{
    appearance: none; width: 14px; height: 14px; border: none; border-radius: 50%; background: var(--accent);
    transition: box-shadow 0.12s;
}}
.track input::-moz-range-thumb {{
    width: 14px; height: 14px; border: none; border-radius: 50%; background: var(--accent);
}}
.track input:hover::-webkit-slider-thumb {{
    box-shadow: 0 0 0 6px color-mix(in srgb, var(--accent) 18%, transparent);
}}
.track input:active::-webkit-slider-thumb, .track input:focus-visible::-webkit-slider-thumb {{
    box-shadow: 0 0 0 8px color-mix(in srgb, var(--accent) 30%, transparent);
}}
.track input:focus-visible::-moz-range-thumb {{
    box-shadow: 0 0 0 8px color-mix(in srgb, var(--accent) 30%, transparent);
}}
.quantity.blank .track {{ visibility: hidden; }}
.quantity.blank .unit {{ display: none; }}
.stretches {{
    position: absolute; inset: 7px -1px; border: 1px solid {FAILS}; border-radius: 2px;
    background: repeating-linear-gradient(135deg, {FAILS}a0 0 1.5px, var(--panel-background-color) 1.5px 6px);
}}
.stretch {{ position: absolute; top: -1px; bottom: -1px; background: {COMPLIES}; }}
.stretch.begins::before, .stretch.ends::after {{
    content: ""; position: absolute; top: -4px; bottom: -4px; width: 2px; background: {COMPLIES};
}}
.stretch.begins::before {{ left: 0; }}
.stretch.ends::after {{ right: 0; }}
.edges {{ grid-column: 1; position: relative; height: 18px; margin: 0 7px; }}
.edge {{
    position: absolute; transform: translateX(-50%); padding: 0 5px; font-size: 13px; line-height: 15px;
    border: 1px solid {COMPLIES}; border-radius: 9px; background: var(--panel-background-color);
    cursor: pointer;
    font-variant-numeric: tabular-nums;
}}
.edge:hover {{ background: color-mix(in srgb, {COMPLIES} 25%, var(--panel-background-color)); }}
.stale .stretches, .stale .edges {{ opacity: 0.35; transition: opacity 0.15s 0.25s; }}
.box {{
    grid-area: 1 / 2 / span 2; display: flex; align-items: baseline; box-sizing: border-box; height: 34px;
    border: 1px solid var(--line); border-radius: 4px;
}}
.box:hover {{ border-color: var(--ink); }}
.box:focus-within {{ border-color: var(--accent); box-shadow: inset 0 0 0 1px var(--accent); }}
.box:has([aria-invalid]) {{ border-color: {FAILS}; box-shadow: inset 0 0 0 1px {FAILS}; }}
.box input {{
    flex: 1; min-width: 0; height: 100%; box-sizing: border-box; padding: 0 4px 0 6px; font-size: 16px;
    text-align: right; font-variant-numeric: tabular-nums; border: none; outline: none; background: none;
}}
.unit {{ padding-right: 7px; font-size: 13px; color: var(--faint); }}
.unit.wide {{ padding-right: 5px; font-size: 11px; letter-spacing: -0.3px; white-space: nowrap; }}
.unit:empty {{ padding-right: 3px; }}
.words, .advice {{ grid-column: 1 / -1; margin: 2px 0 4px 0; line-height: 1.35; overflow-wrap: anywhere; }}
.words {{ font-size: 14px; }}
.advice {{ font-size: 14px; font-weight: 500; color: {FAILS_TEXT}; }}
.advice:empty {{ display: none; }}
.chip {{
    grid-column: 1 / -1; justify-self: start; max-width: 100%; margin: 2px 0 4px 0; padding: 3px 12px;
    text-align: left; border: 1px solid var(--accent); border-radius: 14px; background: none; cursor: pointer;
}}
.chip:hover {{ background: color-mix(in srgb, var(--accent) 15%, transparent); }}
.pick {{
    width: 132px; height: 24px; margin-left: auto; margin-right: 12px; padding: 0 20px 0 8px; font-size: 13px;
    font-weight: 400; letter-spacing: 0;
}}
.disabled .label, .disabled .box, .disabled .track {{ opacity: 0.45; }}
.disabled .track input {{ cursor: default; }}
.disabled .box {{ pointer-events: none; }}

.choice {{ position: relative; margin: 10px 0 4px 0; }}
.choice.explained {{ display: grid; grid-template-columns: 1fr auto; align-items: center; column-gap: 8px; }}
.choice .over {{
    position: absolute; top: -8px; left: 8px; padding: 0 5px; font-size: 12.5px; line-height: 16px;
    background: var(--panel-background-color);
}}
select {{
    appearance: none; box-sizing: border-box; width: 100%; height: 38px; padding: 0 28px 0 10px;
    border: 1px solid var(--line);
    border-radius: 4px; background: no-repeat linear-gradient(45deg, transparent 50%, currentColor 50%),
        no-repeat linear-gradient(135deg, currentColor 50%, transparent 50%);
    background-position: right 14px center, right 8px center; background-size: 6px 6px; cursor: pointer;
}}
select:hover {{ border-color: var(--ink); }}
option {{ color: var(--ink); background: var(--panel-background-color); }}
.departure {{ display: flex; justify-content: space-between; align-items: center; min-height: 30px; }}
.modified {{ font-weight: 500; }}
.back {{
    padding: 4px 8px; margin-right: -8px; font-size: 14px; font-weight: 500; color: var(--accent);
    border: none; border-radius: 4px; background: none; cursor: pointer;
}}
.back:hover {{ background: color-mix(in srgb, var(--accent) 10%, transparent); }}
.back:disabled {{ color: var(--ink); opacity: 0.35; cursor: default; background: none; }}
.switch {{ display: flex; align-items: center; gap: 8px; margin: 4px 0 2px 0; font-size: 16px; }}
.switch {{ cursor: pointer; }}
.switch input[role] {{
    appearance: none; flex: none; position: relative; width: 32px; height: 16px; margin: 0;
    border-radius: 8px;
    background: {PRESET_GHOST}; cursor: pointer; transition: background 0.15s;
}}
.switch input[role]::before {{
    content: ""; position: absolute; top: 2px; left: 2px; width: 12px; height: 12px; border-radius: 50%;
    background: white; transition: left 0.15s;
}}
.switch input[role]:checked {{ background: var(--accent); }}
.switch input[role]:checked::before {{ left: 18px; }}
"""
"""Where a design complies is told by colour, by hatching, and by the marks at the edges."""

MESSAGE_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); }}
div {{ font-size: 15px; font-weight: 600; min-height: 20px; overflow-wrap: anywhere; color: {FAILS_TEXT}; }}
div[role=status] {{ font-weight: 400; color: var(--panel-on-background-color); }}
"""

WARNING_CSS = f"""
:host {{ font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }}
[role="alert"] {{ font-size: 15px; line-height: 1.4; padding-left: 12px; }}
[role="alert"] {{ border-left: 4px solid {SPECIFICATION}; }}
"""

PROSE_WIDTH = 900
WORDS_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
p { margin: 0; line-height: 1.5; }
"""
PROSE_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); font-size: 16px; }
p, li { line-height: 1.55; }
table { border-collapse: collapse; }
th, td { text-align: left; vertical-align: top; padding: 4px 16px 4px 0; font-size: 15px; }
"""
EQUATION_CSS = """
.katex .katex-html { display: none; }
.katex .katex-mathml { position: static; clip: auto; clip-path: none; }
.katex .katex-mathml { width: auto; height: auto; overflow: visible; }
math { font-family: "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre", math; }
math { font-size: 17px; }
.katex-display { margin: 12px 0; overflow: auto hidden; }
.katex-display math { font-size: 19px; }
"""
"""Formulas as the browser sets them (MathML): KaTeX's own setting needs fonts that nobody here serves."""

CATALOGUE_CSS = """
:host { font-family: var(--bokeh-base-font); color: var(--panel-on-background-color); }
.scroll { max-height: 320px; overflow: auto; }
table { border-collapse: collapse; font-size: 15px; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 500; padding-bottom: 4px; }
th, td { text-align: left; vertical-align: top; padding: 3px 18px 3px 0; overflow-wrap: anywhere; }
th { font-weight: 500; }
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

MARKERS = {
    "diamond": "M17 1L22 6L17 11L12 6Z",
    "square": "M12.5 1.5H21.5V10.5H12.5Z",
    "triangle": "M17 1L22.5 10.5H11.5Z",
    "inverted_triangle": "M17 11L22.5 1.5H11.5Z",
}
"""Outline of the marker of each curve from elsewhere, in their order, by what Bokeh calls it."""
