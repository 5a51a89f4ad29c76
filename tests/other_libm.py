"""A pytest plugin that rounds as another computer would, with another libm, BLAS and LAPACK.

The last digit of a sine or of an inverse is not the same everywhere: glibc, musl, Windows and macOS
have each a libm of their own, and each BLAS adds in its own order. Few of these computers are at
hand, so here a third of the results of such functions move by one unit in the last place. Which
ones, and whether up or down, follows from the bits of the arguments: the same arguments always give
the same result, and where all change their sign, so does the result, if at all.

What is exact everywhere stays: zeros, whole numbers (cos 0, hypot(3, 4)), whole quarters of pi
(arctan2(0, -1)), infinities, NaN; and so do integers, and views such as a diagonal. Square roots
are exact to the last digit everywhere. The operator ``@`` cannot be reached from here, but OpenBLAS
can be told its kernel: ``.ci/four_computers`` does both. This alone, for one folder:

    PYTHONPATH=tests python -m pytest -p other_libm tests/attitude
"""

import functools
import math
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.linalg

LIBM = (
    "sin cos tan arcsin arccos arctan arctan2 sinh cosh tanh arcsinh arccosh arctanh exp exp2 "
    "expm1 log log2 log10 log1p hypot power cbrt"
)
MATH = (
    "sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 "
    "log10 log1p hypot pow cbrt"
)
LAPACK = "inv pinv solve lstsq svd eigh eigvalsh eig eigvals qr cholesky det norm"
UFUNC = ("accumulate", "at", "nargs", "nin", "nout", "outer", "reduce", "reduceat", "types")
REAL = (np.float32, np.float64)


@np.errstate(over="ignore")
def scrambled(bits: Any) -> Any:
    """Integers of 64 bits that depend on all bits of others."""
    for shift in (29, 32):
        bits = (bits ^ (bits >> np.uint64(shift))) * np.uint64(0x9E3779B97F4A7C15)
    return bits ^ (bits >> np.uint64(31))


@np.errstate(all="ignore")
def moved(values: Any, seed: Any) -> Any:
    """Values of which a third is one unit in the last place farther from zero, or nearer."""
    size = np.abs(values)
    choice = scrambled(size.view(f"u{size.itemsize}").astype(np.uint64) ^ seed) % np.uint64(6)
    other = np.nextafter(size, np.where(choice == 0, math.inf, 0).astype(size.dtype))
    quarters = size / size.dtype.type(math.pi / 4)
    exact = ~np.isfinite(size) | (size == np.rint(size)) | (quarters == np.rint(quarters))
    return np.where(exact | (choice > 1), values, np.copysign(other, values))[()]


def elsewhere(result: Any, seed: Any, arguments: tuple[Any, ...], out: Any) -> Any:
    """What another computer would have found, in the same array if one was handed in."""
    if isinstance(result, tuple):  # of several results
        parts = [elsewhere(part, seed, arguments, out) for part in result]
        return type(result)(*parts) if hasattr(result, "_fields") else tuple(parts)
    if type(result) not in (np.ndarray, *REAL) or result.dtype.type not in REAL:
        return result
    if out is not None or any(result is each for each in arguments):
        result[...] = moved(result, seed)
        return result
    a_view = any(np.may_share_memory(result, each) for each in arguments)
    return result if a_view else moved(result, seed)


def of_libm(function: Callable[..., Any]) -> Callable[..., Any]:
    """A ufunc some of whose results are one unit off, each by its own arguments."""

    @functools.wraps(function)
    def call(*arguments: Any, **options: Any) -> Any:
        given = [np.asarray(each) for each in arguments[: function.nin]]
        if "where" in options or any(each.dtype.kind not in "bif" for each in given):
            return function(*arguments, **options)
        seed = np.uint64(1)
        for each in given:  # before they are overwritten
            seed = scrambled(seed ^ np.abs(each.astype(float)).view(np.uint64))
        result = function(*arguments, **options)
        return elsewhere(result, seed, arguments, options.get("out"))

    for name in UFUNC:
        setattr(call, name, getattr(function, name))
    return call


def of_math(function: Callable[..., float]) -> Callable[..., float]:
    """The same of a function of ``math``."""

    @functools.wraps(function)
    def call(*arguments: Any) -> float:
        result = function(*arguments)
        seed = np.uint64(hash(tuple(abs(each) for each in arguments)) % 2**64)
        return float(moved(np.float64(result), seed)) if type(result) is float else result

    return call


def of_arrays(function: Callable[..., Any]) -> Callable[..., Any]:
    """The same of a function of whole arrays, where each result depends on all arguments."""

    @functools.wraps(function)
    def call(*arguments: Any, **options: Any) -> Any:
        seed = 0
        for each in map(np.asarray, arguments):
            data = np.abs(each) if each.dtype.kind in "bifc" else np.asarray(repr(each))
            seed = zlib.crc32(data.tobytes(), seed)
        result = function(*arguments, **options)
        return elsewhere(result, np.uint64(seed << 20), arguments, options.get("out"))

    return call


def pytest_configure() -> None:
    """Put these functions in place before what uses them is imported."""
    for module, names, other in (
        (math, MATH, of_math),
        (np, LIBM, of_libm),
        (np, "einsum", of_arrays),
        (np.linalg, LAPACK, of_arrays),
        (scipy.linalg, f"{LAPACK} expm", of_arrays),
    ):
        for name in names.split():
            setattr(module, name, other(getattr(module, name)))


def pytest_report_header() -> str:
    """Say so above the tests."""
    return "rounding: a third of the results of libm, einsum and LAPACK are one unit off"
