"""The drawing in a real browser: large enough to read, and no word upon another."""

import pytest

import trackig_core as tig
from dashboard.figures.track_drawing import track_svg

pytestmark = pytest.mark.browser

LOW_MASS = tig.PRESETS["booted-block-low-mass"]

CROWDED = LOW_MASS.replace(
    pad_stiffness=1234.56e6,
    pad_loss_factor=0.123456,
    block_mass=123.456,
    boot_stiffness=123.456e6,
    boot_loss_factor=0.123456,
    fastener_spacing=0.212345,
    wheel_mass=1234.56,
    contact_stiffness=1234.56e6,
    rail=tig.RAILS["54E1"],
)
"""All numbers as long as a box takes them, and supports as close."""

BEYOND = LOW_MASS.replace(pad_stiffness=1.23457e12, contact_stiffness=1.23457e13, fastener_spacing=0.1)

WORDS = """() => {
    const picture = document.querySelector("svg").getBoundingClientRect()
    return [...document.querySelectorAll("svg text")].map(text => {
        const {left, right, top, bottom} = text.getBoundingClientRect()
        const size = parseFloat(getComputedStyle(text).fontSize) * picture.width / 728
        return {words: text.textContent, left, right, top, bottom, size,
            inside: left >= picture.left && right <= picture.right && bottom <= picture.bottom}
    })
}"""


@pytest.mark.parametrize("design", [*tig.PRESETS.values(), CROWDED, BEYOND])
def test_words_are_legible_and_apart(chromium, design):
    page = chromium.new_page(viewport={"width": 1024, "height": 768})
    try:
        page.set_content(f'<body style="margin: 0; width: 650px">{track_svg(design)}</body>')
        words = page.evaluate(WORDS)
    finally:
        page.close()
    assert len(words) > 6
    assert [each["words"] for each in words if not each["inside"] or each["size"] < 16] == []
    overlaps = [
        (a["words"], b["words"])
        for i, a in enumerate(words)
        for b in words[:i]
        if a["left"] < b["right"]
        and b["left"] < a["right"]
        and a["top"] < b["bottom"]
        and b["top"] < a["bottom"]
    ]
    assert overlaps == []
