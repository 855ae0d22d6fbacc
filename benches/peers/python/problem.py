"""The bearing's numbers, tolerances and start, shared by the NumPy and Numba programs. SI units.

State y = [q, dq/dt], q = [r of every roller | theta | phi | x, y, theta of each cage | inner x, y | outer x, y]; roller j of
row i has index i * rollers + j.
"""

from types import SimpleNamespace

import numpy as np


def read(path):
    p = SimpleNamespace()
    with open(path) as lines:
        for line in lines:
            name, value = line.split()
            setattr(p, name, float(value))
    p.rows, p.rollers, p.defect_row = int(p.rows), int(p.rollers), int(p.defect_row) - 1
    p.total = p.rows * p.rollers
    p.dof = 3 * p.total + 3 * p.rows + 4
    p.inner_radius, p.outer_radius = p.inner_raceway_diameter / 2, p.outer_raceway_diameter / 2
    p.roller_inertia = 0.5 * p.roller_mass * p.roller_radius**2
    p.cage_inertia = 0.5 * p.cage_mass * (p.cage_inner_radius**2 + p.cage_outer_radius**2)
    p.intact_share = ((p.roller_length - p.defect_width) / p.roller_length) ** (8 / 9)
    p.alpha = (2 * np.pi * np.arange(p.rollers) / p.rollers + p.stagger * np.arange(p.rows)[:, None]).ravel()
    return p


def scales(p, length, speed):
    """What `length` and `speed` on a surface mean for every entry of the state."""
    lever = np.ones(p.dof)
    lever[p.total : 2 * p.total] = p.pitch_radius
    lever[2 * p.total : 3 * p.total] = p.roller_radius
    lever[3 * p.total + 2 : 3 * p.total + 3 * p.rows : 3] = p.pitch_radius
    return np.concatenate([length / lever, speed / lever])


def start(p):
    """Pure rolling, cages centred, both rings 1 um aside in x and y and at rest."""
    n = p.total
    orbit = p.speed * p.inner_radius / (2 * p.pitch_radius)
    q, v = np.zeros(p.dof), np.zeros(p.dof)
    q[n : 2 * n] = p.alpha
    q[-4:] = 1e-6
    v[n : 2 * n] = orbit
    v[2 * n : 3 * n] = -(p.speed * p.inner_radius - p.pitch_radius * orbit) / p.roller_radius
    v[3 * n + 2 : 3 * n + 3 * p.rows : 3] = orbit
    return np.concatenate([q, v])


def sparsity(p):
    """Which derivative depends on which entry: rollers on themselves, their cage and the rings; cages on the outer ring."""
    n, dof = p.total, p.dof
    part = np.zeros((dof, dof), dtype=int)
    for k in range(n):
        own = [k, n + k, 2 * n + k, *range(3 * n + 3 * (k // p.rollers), 3 * n + 3 * (k // p.rollers) + 3)]
        rings = list(range(dof - 4, dof))
        part[np.ix_(own, own + rings)] = 1
        part[np.ix_(rings, own + rings)] = 1
    pattern = np.zeros((2 * dof, 2 * dof), dtype=int)
    pattern[:dof, dof:] = np.eye(dof, dtype=int)
    pattern[dof:, :dof] = pattern[dof:, dof:] = part
    return pattern


