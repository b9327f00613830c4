"""The first start on a machine: pages are served while the kernels are compiled, and lose nothing by it."""

import shutil

import numpy as np
import pytest
from numba.core.caching import UserProvidedCacheLocator

import trackig_core as tig
from tests.browser.conftest import wait_until_solved
from trackig_core.frequency_domain import batch_kernels
from trackig_core.time_domain import kernels as time_kernels

pytestmark = pytest.mark.browser


def keep_exact_kernels(folder):
    """Put compiled code of exact solutions where Numba looks for it in a folder; that of runs is missing.

    The latter alone takes longer to compile than a page to open; all of it takes as long as ten pages.
    """
    shutil.copytree(batch_kernels.solve_rows.stats.cache_path, folder_of(batch_kernels, folder))


def folder_of(kernels, folder):
    """Return where below a folder Numba keeps the compiled code of a module."""
    return folder / UserProvidedCacheLocator.get_suitable_cache_subpath(kernels.__file__)


def test_a_page_opened_while_kernels_are_compiled_shows_its_picture(
    serve, port, chromium, tmp_path, monkeypatch
):
    keep_exact_kernels(tmp_path / "cache")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
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
    # the server did compile them: it found none elsewhere
    assert [*folder_of(time_kernels, tmp_path / "cache").glob("*.advance-*.nbc")]
    np.testing.assert_allclose(level, tig.solve(tig.PRESETS["booted-block-low-mass"]).insertion_gain)
