"""Load distribution and basic reference rating life of a single row cylindrical roller bearing after ISO/TS 16281 (equations 38 to 65).

Written from the standard's equations: rigid rings, (delta_r, psi) from force and moment by SciPy's root finder. Between the cage's symmetric positions the
ring shifts and tilts across the load too, which the standard leaves out: two more unknowns.
`crates/brinell/tests/lamina.rs` holds what it prints. N, mm, rad.
"""

import numpy as np
from scipy import optimize

Z, D, L, DM, NS, POSITIONS = 13, 9.0, 8.8, 46.5, 30, 16
GAMMA = D / DM
# ISO 281, f_c by ISO/TR 1281-1.
RINGS = 1.04 * ((1 - GAMMA) / (1 + GAMMA)) ** (143 / 108)
FC = 208 * 0.83 * GAMMA ** (2 / 9) * (1 - GAMMA) ** (29 / 27) / (1 + GAMMA) ** 0.25 * (1 + RINGS**4.5) ** (-2 / 9)
C = 1.1 * FC * L ** (7 / 9) * Z**0.75 * D ** (29 / 27)


def case(force, moment, clearance, logarithmic):
    x = (np.arange(NS) + 0.5) * L / NS - L / 2
    drop = 0.00035 * D * np.log(1 / (1 - (2 * x / L) ** 2)) if logarithmic else 0 * x
    stiffness = 35948 * L ** (8 / 9) / NS

    def loads(u, angles):
        along = np.array([np.cos(angles), np.sin(angles)])
        own = 1e-3 * u[:2] @ along - clearance / 2
        slope = 1e-3 * u[2:] @ along
        return stiffness * np.maximum(own[:, None] + slope[:, None] * x - 2 * drop, 0) ** (10 / 9)

    q, found = [], []
    for position in range(POSITIONS):
        angles = 2 * np.pi * (np.arange(Z) + position / POSITIONS) / Z

        def left(u):
            load = loads(u, angles)
            total, turning = load.sum(1), (load * x).sum(1)
            return [
                (np.cos(angles) * total).sum() / force - 1,
                (np.sin(angles) * total).sum() / force,
                ((np.cos(angles) * turning).sum() - moment) / (force * L),
                (np.sin(angles) * turning).sum() / (force * L),
            ]

        u = optimize.root(left, [20 + 500 * clearance, 0, moment / force * 5, 0], tol=1e-13)
        assert np.abs(u.fun).max() < 1e-10, u
        found.append(u.x[[0, 2]])
        q.append(loads(u.x, angles))
    q = np.concatenate(q)
    g = 1.038 * ((1 - GAMMA) / (1 + GAMMA)) ** (143 / 108)
    qci = C / (0.83 * 0.378 * Z) * (1 + g**4.5) ** (2 / 9) * NS ** (-7 / 9)
    qce = C / (0.83 * 0.364 * Z) * (1 + g**-4.5) ** (2 / 9) * NS ** (-7 / 9)
    k = np.arange(1, NS + 1)
    riser = 1 - 0.01 / np.log(1.985 * np.abs((2 * k - NS - 1) / (2 * NS - 2)))
    qkei = np.mean((riser * q) ** 4, 0) ** (1 / 4)
    qkee = np.mean((riser * q) ** 4.5, 0) ** (1 / 4.5)
    life = ((qkei / qci) ** 4.5 + (qkee / qce) ** 4.5).sum() ** (-8 / 9)
    delta, psi = np.mean(found, 0)
    return delta, psi, q.sum(1).max(), q.max() * NS / L, life


if __name__ == "__main__":
    print(f"C_r = {C:.6f} N")
    print("force_n moment_nm clearance_um logarithmic  delta_um psi_mrad largest_n line_n_per_mm life_1e6")
    for force, moment, clearance, logarithmic in [
        (5000, 0, 0.0, False),
        (5000, 4000, 0.0, False),
        (5000, 4000, 0.02, True),
        (8000, 10000, 0.02, True),
    ]:
        numbers = case(force, moment, clearance, logarithmic)
        print(force, moment / 1e3, 1e3 * clearance, logarithmic, *(f"{x:.9g}" for x in numbers))
