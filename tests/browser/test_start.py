"""The first start on a machine: pages are served while the kernels are compiled, and lose nothing by it."""

import numpy as np
import pytest

import trackig_core as tig
from tests.browser.conftest import wait_until_solved

pytestmark = pytest.mark.browser


def test_a_page_opened_while_kernels_are_compiled_shows_its_picture(
    serve, port, chromium, tmp_path, monkeypatch
):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "empty"))
    with serve(port, tmp_path / "log.txt") as url:
        context = chromium.new_context()
        page = context.new_page()
        page.set_default_timeout(180_000)
        page.goto(url)
        wait_until_solved(page, timeout=180_000)
        level = page.evaluate(
            "() => Array.from(Bokeh.documents[0].get_model_by_name('insertion_gain').data.level)"
        )
        context.close()
    np.testing.assert_allclose(level, tig.solve(tig.PRESETS["booted-block-low-mass"]).insertion_gain)
