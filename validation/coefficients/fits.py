"""The polynomials of crates/brinell/src/lanes/functions.rs: Chebyshev's fits, computed anew, and the errors that they state.

    python3 validation/coefficients/fits.py        # needs mpmath and numpy

A fit interpolates at the zeros of a Chebyshev polynomial; its coefficients are then rounded to doubles.
"""

import re
import sys
from pathlib import Path

import numpy as np
from mpmath import mp, mpf

mp.dps = 60
SOURCE = Path(__file__).parents[2] / "crates/brinell/src/lanes/functions.rs"


def fit(f, reach, count, middle=0):
    """The polynomial of `count` coefficients (highest first) through f at Chebyshev's points of middle -+ reach."""
    points = [middle + reach * mp.cos(mp.pi * (2 * k + 1) / (2 * count)) for k in range(count)]
    rows = mp.matrix([[x ** (count - 1 - k) for k in range(count)] for x in points])
    return list(mp.lu_solve(rows, mp.matrix([f(x) for x in points])))


def worst(error, reach, points=4001):
    """Largest |error| on [-reach, reach]."""
    return max(abs(error(reach * mpf(2 * k - points + 1) / (points - 1))) for k in range(points))


def value(coefficients, x):
    return mp.polyval([mpf(c) for c in coefficients], x)


def listed(after):
    """The numbers of the first list of the source after a text."""
    text = SOURCE.read_text().partition(after)[2]
    body = text[text.index("[") + 1 : text.index("]")]
    return [float(fraction(item)) for item in body.split(",") if item.strip()]


def fraction(item):
    """A literal, or one over another."""
    above, _, below = item.replace("_", "").strip().partition("/")
    return mpf(above) / (mpf(below) if below else 1)


def report(name, used, found, error, most):
    apart = max(abs(u - f) / abs(f) for u, f in zip(used, found, strict=True))
    print(f"{name}: coefficients differ by {mp.nstr(apart, 3)} relative; error {mp.nstr(error, 3)}, stated {most}")
    return error <= mpf(most)


def main():
    good = True

    # (e^r - 1 - r) / r^2 on |r| <= 1.0001 ln 2 / 2.
    def tail(r):
        return sum(r**k / mp.factorial(k + 2) for k in range(40))

    reach = mpf("1.0001") * mp.log(2) / 2
    used = listed("// Chebyshev's fit of (e^r - 1 - r)")
    good &= report(
        "exp", used, fit(tail, reach, len(used)),
        worst(lambda r: r**2 * (value(used, r) - tail(r)) / mp.exp(r), reach), "2e-17",
    )  # fmt: skip

    # (1 - e)^(-1/9) over the errors e = 1 - x z^9 of the guess z, as they were measured; the whole range is computed below.
    def root(e):
        return (1 - e) ** (-mpf(1) / 9)

    low, high = mpf("-0.261679802753"), mpf("0.262648186247")
    used = listed("pub(crate) const FIT: [f64; 4] =")
    found = fit(root, (high - low) / 2, len(used), (high + low) / 2)
    good &= report("ninth root", used, found, worst(lambda e: value(used, e) - root(e), mpf("0.263")), "3e-5")
    low, high = guess_errors(float(origin()))
    print(f"ninth root, guess: e from {low:.6f} to {high:.6f}, stated 0.263")
    good &= max(-low, high) <= 0.263

    # Series for the e that is left.
    for name, power in (("ONE", -mpf(1) / 9), ("EIGHT", -mpf(8) / 9)):
        used = listed(f"pub(crate) const {name}: [f64; {4 if name == 'ONE' else 5}] =")
        series = [mp.binomial(power, k) * (-1) ** k for k in range(len(used))][::-1]
        error = worst(lambda e: value(used, e) / (1 - e) ** power - 1, mpf("3e-4"))
        good &= report(f"series {name}", used, series, error, "1e-14" if name == "ONE" else "5e-15")
    sys.exit(not good)


def origin():
    return mpf(re.search(r"ORIGIN: f64 = ([\d_.]+);", SOURCE.read_text())[1].replace("_", ""))


def guess_errors(start):
    """Smallest and largest 1 - x z^9 over all upper halves of x in nine octaves, z's upper half being `start` - upper / 9, rounded."""
    upper = np.arange(1023 << 20, (1023 + 9) << 20, dtype=np.int64)
    z = (np.rint(start - upper / 9.0).astype(np.int64) << 32).view(np.float64)
    cube = z * z * z
    lowers = (0, 0xFFFF_FFFF)
    errors = [1 - cube * cube * (cube * ((upper << 32) | lower).view(np.float64)) for lower in lowers]
    return min(e.min() for e in errors), max(e.max() for e in errors)


main()
