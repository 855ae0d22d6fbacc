"""The Runge-Kutta-Nystrom pair of crates/brinell/src/solver/tableau.rs: order conditions, dependent coefficients, stability.

    python3 validation/coefficients/nystrom.py        # needs mpmath

The thirteen free coefficients were found by a search (differential evolution) whose program was not kept. This program takes them
from the source, solves the order conditions for all others, compares these with the source, and computes what the documentation states.
"""

import re
import sys
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 40
SOURCE = Path(__file__).parents[2] / "crates/brinell/src/solver/tableau.rs"
ROUND_OFF = mpf("1e-15")
# Bogacki and Shampine's pair, for comparison: stages 2 and 3 and the weights.
BOGACKI_SHAMPINE = [[mpf(1) / 2], [mpf(0), mpf(3) / 4], [mpf(2) / 9, mpf(1) / 3, mpf(4) / 9]]


def listed(name):
    """The numbers of one field of DAMPED_CONTACT."""
    text = SOURCE.read_text().partition("pub const DAMPED_CONTACT")[2].partition(f"    {name}: ")[2]
    end = re.search(r"\],\n(?=    \w|\};)", text).start()
    return [mpf(x) for x in re.findall(r"-?\d+\.\d+", text[:end])]


def rows(flat):
    return [flat[4 * k : 4 * k + 4] for k in range(len(flat) // 4)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=False))


def product(*lists):
    return [mp.fprod(x) for x in zip(*lists, strict=True)]


def order_four(c, a, abar, b, bbar):
    """Residuals of the conditions of order 4 of q'' = f(t, q, q') (Hairer, Norsett, Wanner, Solving ODEs I, II.14)."""
    ac = [dot(row, c) for row in a]
    u = [sum(row) for row in abar]
    one = [
        (dot(b, product(c, c, c)), 4),
        (dot(b, product(c, ac)), 8),
        (dot(b, product(c, u)), 8),
        (dot(b, [dot(row, product(c, c)) for row in a]), 12),
        (dot(b, [dot(row, ac) for row in a]), 24),
        (dot(b, [dot(row, u) for row in a]), 24),
        (dot(b, [dot(row, c) for row in abar]), 24),
        (dot(bbar, product(c, c)), 12),
        (dot(bbar, ac), 24),
        (dot(bbar, u), 24),
    ]
    return [value - mpf(1) / under for value, under in one]


def stages(rates, positions):
    """c, a, abar of all stages but the shared one, and both rows of weights."""
    n = len(rates)
    a = [[mpf(0)] * n] + [list(r) + [mpf(0)] * (n - len(r)) for r in rates[:-1]]
    abar = [[mpf(0)] * n] + [list(r) + [mpf(0)] * (n - len(r)) for r in positions[:-1]]
    return [sum(r) for r in a], a, abar, list(rates[-1]), list(positions[-1])


def amplification(method, x, zeta):
    """Spectral radius of a step of q'' + 2 zeta w q' + w^2 q = 0, w h = x."""
    c, a, abar, b, bbar = method

    def step(q, v):
        f = []
        for i in range(len(c)):
            f.append(-x * x * (q + c[i] * v + dot(abar[i], f)) - 2 * zeta * x * (v + dot(a[i], f)))
        return q + v + dot(bbar, f), v + dot(b, f)

    (m00, m10), (m01, m11) = step(1.0, 0.0), step(0.0, 1.0)
    half, det = (m00 + m11) / 2, m00 * m11 - m01 * m10
    root = half * half - det
    return abs(half) + root**0.5 if root > 0 else det**0.5


def stability_limit(method, zeta):
    """Longest h |lambda| of the faster motion up to which every step of more than 1 damps, in steps of 0.01."""
    method = tuple([[float(x) for x in row] if isinstance(row, list) else float(row) for row in part] for part in method)
    fast = max(zeta, 1) + max(zeta * zeta - 1, 0) ** 0.5
    reach = 1.0
    while reach < 8 and amplification(method, reach / fast, zeta) <= 1:
        reach += 0.01
    return reach


def main():
    good = True

    def check(name, residual, limit=ROUND_OFF):
        nonlocal good
        good &= abs(residual) < limit
        print(f"{name:44} {mp.nstr(residual, 3)}")

    c, a, abar, b, bbar = stages(rows(listed("rates")), rows(listed("positions")))
    error, ends = listed("error"), listed("nodes")
    for k, node in enumerate([*c[1:], sum(b)]):
        check(f"node {k + 2}: sum of a - c", node - ends[k])

    print("Order 3, residuals")
    ac, u = [dot(row, c) for row in a], [sum(row) for row in abar]
    for name, value, under in (
        ("b = 1", sum(b), 1), ("b c = 1/2", dot(b, c), 2), ("b c c = 1/3", dot(b, product(c, c)), 3),
        ("b a c = 1/6", dot(b, ac), 6), ("b abar = 1/6", dot(b, u), 6),
        ("bbar = 1/2", sum(bbar), 2), ("bbar c = 1/6", dot(bbar, c), 6),
    ):  # fmt: skip
        check(name, value - mpf(1) / under)

    print("Dependent coefficients, solved from the thirteen free ones, less the source's")
    ones = [mpf(1)] * 4
    solved = mp.lu_solve(mp.matrix([ones, c, product(c, c), ac]), mp.matrix([1, mpf(1) / 2, mpf(1) / 3, mpf(1) / 6]))
    for k in range(4):
        check(f"b{k + 1}", solved[k] - b[k])
    first = (mpf(1) / 6 - dot(solved, u[:3])) / solved[3] - sum(abar[3][1:])
    check("abar41", first - abar[3][0])
    right = mp.matrix([mpf(1) / 2 - bbar[2] - bbar[3], mpf(1) / 6 - bbar[2] * c[2] - bbar[3] * c[3]])
    solved = mp.lu_solve(mp.matrix([[1, 1], [c[0], c[1]]]), right)
    for k in range(2):
        check(f"bbar{k + 1}", solved[k] - bbar[k])
    last = [[*ones, 1], [*c, 1], [*product(c, c), 1], [*ac, mpf(1) / 2], [*u, mpf(1) / 2]]
    solved = mp.lu_solve(mp.matrix(last), mp.matrix([0, 0, -mpf(1) / 24, -mpf(1) / 48, -mpf(1) / 48]))
    for k in range(5):
        check(f"error{k + 1}", solved[k] - error[k])

    pair = (c, a, abar, b, bbar)
    rates = BOGACKI_SHAMPINE
    plain = stages(rates, rates)
    square = [[dot(row, [plain[1][j][k] for j in range(3)]) for k in range(3)] for row in [*plain[1], plain[3]]]
    other = (plain[0], plain[1], square[:3], plain[3], square[3])
    print("Root of the sum of squares of the conditions of order 4, and stability limits h |lambda| at zeta 0, 0.1, 0.3, 0.6, 1, 1.4")
    for name, method in (("this pair", pair), ("Bogacki and Shampine", other)):
        size = mp.sqrt(sum(r * r for r in order_four(*method)))
        limits = [f"{stability_limit(method, z):.2f}" for z in (0, 0.1, 0.3, 0.6, 1, 1.4)]
        print(f"{name:44} {mp.nstr(size, 3)}; {', '.join(limits)}")
    sys.exit(not good)


main()
