"""Numba's ``njit`` for kernels, with a cache on disk that no installation and no damaged file can break.

Numba keeps compiled code in ``NUMBA_CACHE_DIR``, beside the source, or in the user's cache folder. Where none
of these can be written to (another user's installation, a container without a home), it is kept in a private
folder of the temporary folder, else in memory only; which of the two is said once. A cache file that cannot
be read is compiled and written anew.
"""

import logging
import os
import stat
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numba
from numba.core import caching

_log = logging.getLogger(__name__)


class _TemporaryLocator(caching.UserProvidedCacheLocator):
    """A private folder of the temporary folder, where Numba finds no other."""

    def __init__(self, function: Callable[..., Any], file: str) -> None:
        self._py_file, self._lineno = file, function.__code__.co_firstlineno
        self._cache_path = str(_private_folder() / self.get_suitable_cache_subpath(file))

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> "_TemporaryLocator | None":
        """Return where to cache a function, or None if there is no place."""
        try:
            found = cls(function, file)
            found.ensure_cache_path()
        except OSError:
            return None
        _say(f"this installation cannot be written to; compiled code is kept in {_private_folder()}")
        return found


@cache
def _private_folder() -> Path:
    """Return a folder that no other user can write to: what is cached is executed."""
    user = os.getuid() if hasattr(os, "getuid") else None
    folder = Path(tempfile.gettempdir()) / f"trackig-{'cache' if user is None else user}"
    folder.mkdir(mode=0o700, exist_ok=True)
    status = folder.lstat()
    if user is not None and (
        status.st_uid != user or not stat.S_ISDIR(status.st_mode) or status.st_mode & 0o077
    ):
        raise PermissionError(f"{folder} is not this user's alone")
    return folder


class _KernelCacheImpl(caching.CompileResultCacheImpl):
    _locator_classes = [*caching.CompileResultCacheImpl._locator_classes, _TemporaryLocator]  # noqa: RUF012


class _KernelCache(caching.FunctionCache):
    """Numba's cache on disk, which is done without where it fails."""

    _impl_class = _KernelCacheImpl

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        # kernels are compiled into each other, and Numba looks at a function's own file only
        self._cache_file._source_stamp = (self._cache_file._source_stamp, _kernels_stamp())

    def load_overload(self, signature: Any, context: Any) -> Any:
        """Return compiled code, or None if there is none that can be read."""
        try:
            found = super().load_overload(signature, context)
            if found is None:
                _say_compiling()
            return found
        except Exception as error:  # a damaged file may be at fault in any way
            _say(
                f"compiled code in {self.cache_path} cannot be read and is made anew ({type(error).__name__})"
            )
            self._do_without(self.flush)
            return None

    def save_overload(self, signature: Any, data: Any) -> None:
        """Keep compiled code if it can be written."""
        self._do_without(lambda: super(_KernelCache, self).save_overload(signature, data))

    def _do_without(self, write: Callable[[], object]) -> None:
        try:
            write()
        except Exception as error:  # a full disk, a folder that went away, a damaged index
            _say(f"compiled code cannot be kept in {self.cache_path} ({error})")
            self.disable()


@cache
def _kernels_stamp() -> tuple[tuple[str, int, int], ...]:
    """Return name, time of change and size of every file of compiled code."""
    folder = Path(__file__).parent
    files = sorted([*folder.glob("*/*kernels.py"), *folder.glob("*/vectors.py")])
    return tuple((file.name, file.stat().st_mtime_ns, file.stat().st_size) for file in files)


@cache
def _say(words: str) -> None:
    _log.warning("%s", words)


@cache
def _say_compiling() -> None:
    _log.info("kernels are compiled, as at every first run: about a minute of one processor, once")


def njit(*, cache: bool = False, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that compiles a function as ``numba.njit`` does.

    Parameters
    ----------
    cache : bool
        Whether compiled code is kept on disk, if that is possible.
    **options
        As for ``numba.njit``.

    Returns
    -------
    callable
        The decorator.
    """

    def compiled(function: Callable[..., Any]) -> Any:
        dispatcher: Any = numba.njit(**options)(function)
        # with NUMBA_DISABLE_JIT the function stays as it is
        if cache and hasattr(dispatcher, "enable_caching"):
            dispatcher._cache = _cache_of(function)
        return dispatcher

    return compiled


def _cache_of(function: Callable[..., Any]) -> Any:
    try:
        return _KernelCache(function)
    except RuntimeError:  # Numba found no place
        _say("compiled code cannot be kept, and every start compiles anew; set NUMBA_CACHE_DIR to a folder")
        return caching.NullCache()
