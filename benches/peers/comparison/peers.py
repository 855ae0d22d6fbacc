"""The programs and methods that are compared, with the settings found best for each."""

import math

from .settings import WINDOWS


def ladder(first, last, factor):
    count = round(math.log(first / last) / math.log(factor))
    return [first / factor**k for k in range(count + 1)]


class Peer:
    """A program and a method of it, with the settings found best for it."""

    def __init__(self, key, name, program, method, tolerances, **more):
        self.key, self.name, self.program, self.method, self.tolerances = key, name, program, method, tolerances
        self.max_step = more.get("max_step", 1e-4)
        self.windows = more.get("windows", WINDOWS)  # how many of the windows it runs through
        self.slow = more.get("slow", False)  # once, and not in a quick run
        self.long = more.get("long", False)  # a longer run too
        self.plain = more.get("plain", False)  # one run, not matched
        self.rungs, self.reason = [], None


# Largest steps and ranges of tolerances were searched by hand for the least work at 1 %; README.md says more.
PEERS = [
    Peer("brinell", "brinell, its solver", "brinell", "solver", ladder(32, 2**-8, 2), long=True),
    Peer("run", "brinell, a whole run at `standard`", "brinell", "run", [1.0], long=True, plain=True),
    Peer("arkode-5", "C, ARKODE order 5 (Cash-Karp)", "c", "arkode-5", ladder(1.6e-7, 1e-11, 2), max_step=1e-5,
         long=True),
    Peer("arkode-5dp", "C, ARKODE order 5 (Dormand-Prince)", "c", "arkode-5dp", ladder(4e-8, 1e-11, 2),
         max_step=1.5e-5),
    Peer("arkode-3", "C, ARKODE order 3 (Bogacki-Shampine)", "c", "arkode-3", ladder(6.4e-8, 1e-10, 2), max_step=6e-6),
    Peer("cvode-bdf", "C, CVODE BDF with GMRES", "c", "cvode-bdf", ladder(5e-8, 1e-10, 2), max_step=6e-6, long=True),
    Peer("cvode-adams", "C, CVODE Adams", "c", "cvode-adams", ladder(4e-8, 1e-10, 2), long=True),
    Peer("diffsol", "Rust, diffsol Tsitouras 5(4) on brinell's equations", "diffsol", "tsit45",
         ladder(3.2e-8, 1e-11, 2), long=True),
    Peer("numba-RK45", "Numba, SciPy RK45", "python", "numba-RK45", ladder(3.2e-8, 1.25e-10, 2), long=True),
    Peer("numba-LSODA", "Numba, SciPy LSODA", "python", "numba-LSODA", ladder(2.4e-8, 7.5e-10, 32**0.5), max_step=1e-5,
         slow=True),
    Peer("numba-Radau", "Numba, SciPy Radau", "python", "numba-Radau", ladder(4e-7, 6.25e-9, 4), max_step=2e-5,
         slow=True),
    Peer("numpy-RK45", "NumPy, SciPy RK45", "python", "numpy-RK45", ladder(1.6e-8, 2.5e-10, 2)),
    Peer("numpy-LSODA", "NumPy, SciPy LSODA", "python", "numpy-LSODA", ladder(2.4e-8, 7.5e-10, 32**0.5), max_step=1e-5,
         slow=True, windows=3),
    Peer("numpy-Radau", "NumPy, SciPy Radau", "python", "numpy-Radau", ladder(4e-7, 6.25e-9, 4), max_step=2e-5,
         slow=True),
    Peer("octave-ode45", "GNU Octave, ode45", "octave", "ode45", ladder(1.6e-7, 1e-8, 2), max_step=1e-5),
    Peer("octave-ode15s", "GNU Octave, ode15s", "octave", "ode15s", ladder(1e-8, 2e-9, 5), max_step=1e-5, slow=True,
         windows=1),
]

# What a table of ratios shows, and what it counts by.
TARGETS = [
    ("ARKODE's explicit order 5 in C", ["arkode-5", "arkode-5dp"], 25),
    ("Numba with SciPy", ["numba-RK45", "numba-LSODA", "numba-Radau"], 50),
    ("NumPy with SciPy", ["numpy-RK45", "numpy-LSODA", "numpy-Radau"], 1000),
    ("GNU Octave's ode45", ["octave-ode45"], 5000),
]
