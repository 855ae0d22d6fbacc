#!/usr/bin/env python3
"""brinell beside what users write today: installs, checks, runs and plots everything.

    python3 benches/peers/run.py             about twelve minutes; writes docs/peers.md, docs/peers.csv, docs/pictures/work-precision.png
    python3 benches/peers/run.py --quick     about two minutes: fewer tolerances, not the slowest solvers; the same files, into the build folder

Needs Python 3.11 or later with venv, Rust, gcc, and for packages that are missing apt-get as root (or through sudo without a
password). A peer that cannot be had is a row with the reason. README.md beside this file says what is compared.
"""

import argparse
import array
import csv
import datetime
import hashlib
import json
import math
import os
import pathlib
import platform
import random
import re
import shutil
import statistics
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SCENARIO = ROOT / "examples" / "rectangle.toml"
sys.path.insert(0, str(ROOT / "validation" / "independent"))
import generate  # noqa: E402

RATE = 25600.0  # samples a second: the scenario's
FROM_S, WINDOW_S, WINDOWS = 1e-3, 2.5e-3, 8
CHANNELS = ["inner_ax", "inner_ay", "outer_ax", "outer_ay"]
MATCHED = 0.01
RHS_LIMIT = 1e-10
# Fixed steps of the trajectory that errors are measured against, and twice that to see how far it can be trusted.
REFERENCE_STEP = 1e-8
# What a tolerance of 1 means: 1 m on a surface and 1000 m/s; nothing relative, for angles grow without bound.
LENGTH, SPEED, RTOL = 1.0, 1e3, 0.0
TIME_LIMIT_S = 400.0
LONG_S = 0.2


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
    Peer("arkode-5", "C, ARKODE order 5 (Cash-Karp)", "c", "arkode-5", ladder(1.6e-7, 1e-11, 2), max_step=1e-5, long=True),
    Peer("arkode-5dp", "C, ARKODE order 5 (Dormand-Prince)", "c", "arkode-5dp", ladder(4e-8, 1e-11, 2), max_step=1.5e-5),
    Peer("arkode-3", "C, ARKODE order 3 (Bogacki-Shampine)", "c", "arkode-3", ladder(6.4e-8, 1e-10, 2), max_step=6e-6),
    Peer("cvode-bdf", "C, CVODE BDF with GMRES", "c", "cvode-bdf", ladder(5e-8, 1e-10, 2), max_step=6e-6, long=True),
    Peer("cvode-adams", "C, CVODE Adams", "c", "cvode-adams", ladder(4e-8, 1e-10, 2), long=True),
    Peer("diffsol", "Rust, diffsol Tsitouras 5(4) on brinell's equations", "diffsol", "tsit45", ladder(3.2e-8, 1e-11, 2), long=True),
    Peer("numba-RK45", "Numba, SciPy RK45", "python", "numba-RK45", ladder(3.2e-8, 1.25e-10, 2), long=True),
    Peer("numba-LSODA", "Numba, SciPy LSODA", "python", "numba-LSODA", ladder(2.4e-8, 7.5e-10, 32**0.5), max_step=1e-5, slow=True),
    Peer("numba-Radau", "Numba, SciPy Radau", "python", "numba-Radau", ladder(4e-7, 6.25e-9, 4), max_step=2e-5, slow=True),
    Peer("numpy-RK45", "NumPy, SciPy RK45", "python", "numpy-RK45", ladder(1.6e-8, 2.5e-10, 2)),
    Peer("numpy-LSODA", "NumPy, SciPy LSODA", "python", "numpy-LSODA", ladder(2.4e-8, 7.5e-10, 32**0.5), max_step=1e-5, slow=True, windows=3),
    Peer("numpy-Radau", "NumPy, SciPy Radau", "python", "numpy-Radau", ladder(4e-7, 6.25e-9, 4), max_step=2e-5, slow=True),
    Peer("octave-ode45", "GNU Octave, ode45", "octave", "ode45", ladder(1.6e-7, 1e-8, 2), max_step=1e-5),
    Peer("octave-ode15s", "GNU Octave, ode15s", "octave", "ode15s", ladder(1e-8, 2e-9, 5), max_step=1e-5, slow=True, windows=1),
]

# What a table of ratios shows, and what it counts by.
TARGETS = [
    ("ARKODE's explicit order 5 in C", ["arkode-5", "arkode-5dp"], 25),
    ("Numba with SciPy", ["numba-RK45", "numba-LSODA", "numba-Radau"], 50),
    ("NumPy with SciPy", ["numpy-RK45", "numpy-LSODA", "numpy-Radau"], 1000),
    ("GNU Octave's ode45", ["octave-ode45"], 5000),
]


def say(text):
    print(f"[{time.monotonic() - STARTED:5.0f} s] {text}", flush=True)


STARTED = time.monotonic()


class Missing(Exception):
    """Why a peer cannot be had."""


def capture(command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode:
        tail = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise Missing(f"{pathlib.Path(command[0]).name} ended with {done.returncode}: {' '.join(tail)}")
    return done.stdout


def one_thread():
    """Small vectors: threads of the linear algebra would only cost time, and they would blur CPU time."""
    return os.environ | {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


class Programs:
    """Everything that must be built or installed; what is missing holds a reason instead of a command."""

    def __init__(self, build, install):
        self.build, self.install = build, install
        self.commands, self.reasons, self.versions = {}, {}, {}
        self.venv = build / "venv"
        for name in ("brinell", "python", "c", "octave"):
            say(f"preparing {name}")
            try:
                getattr(self, name)()
            except (Missing, OSError) as why:
                self.reasons[name] = str(why)
                say(f"  cannot have {name}: {why}")
        if "brinell" in self.reasons:
            raise SystemExit("without brinell and a C compiler there is nothing to compare")

    def brinell(self):
        cargo = os.environ.get("CARGO", "cargo").split()
        packages = ["-p", "brinell-peers", "-p", "brinell-cli"]
        done = subprocess.run([*cargo, "build", "--release", "--locked", *packages], cwd=ROOT)
        if done.returncode:
            raise Missing("cargo build failed")
        release = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release"
        self.cli = release / "brinell"
        self.commands["brinell"] = [str(release / "brinell-peer")]
        self.commands["diffsol"] = [str(release / "diffsol-peer")]
        self.versions["brinell"] = capture([self.cli, "--version"]).split()[-1] + self.commit()
        lock = tomllib.loads((ROOT / "Cargo.lock").read_text())
        self.versions["diffsol"] = next(p["version"] for p in lock["package"] if p["name"] == "diffsol")
        self.versions["rustc"] = capture(["rustc", "--version"]).split()[1]

    def commit(self):
        try:
            return f" ({capture(['git', '-C', ROOT, 'describe', '--always', '--dirty']).strip()})"
        except (Missing, OSError):
            return ""

    def python(self):
        python = self.venv / "bin" / "python"
        if not python.exists():
            capture([sys.executable, "-m", "venv", self.venv])
        capture([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", HERE / "requirements.txt"])
        self.commands["python"] = [str(python), str(HERE / "python" / "solve.py")]
        self.versions["Python"] = platform.python_version()
        for line in (HERE / "requirements.txt").read_text().split():
            name, version = line.split("==")
            self.versions[{"numpy": "NumPy", "scipy": "SciPy", "numba": "Numba"}.get(name, name)] = version

    def packages(self, names):
        """Debian's packages, where this may install them."""
        if not self.install or not shutil.which("apt-get"):
            raise Missing(f"not installed: {' '.join(names)}")
        rights = [] if os.geteuid() == 0 else ["sudo", "-n"]
        quiet = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
        capture([*rights, "apt-get", "update", "-q"], env=quiet)
        capture([*rights, "apt-get", "install", "-q", "-y", "--no-install-recommends", *names], env=quiet)

    def c(self):
        header = pathlib.Path("/usr/include/arkode/arkode_erkstep.h")
        if not header.exists():
            self.packages(["libsundials-dev"])
        exe = self.build / "solve"
        flags = ["-std=gnu11", "-O3", "-march=native", "-Wall", "-Wextra"]
        libraries = ["-lsundials_cvode", "-lsundials_arkode", "-lsundials_nvecserial", "-lm"]
        capture(["gcc", *flags, "-o", exe, HERE / "c" / "solve.c", HERE / "c" / "bearing.c", *libraries])
        self.commands["c"] = [str(exe)]
        config = pathlib.Path("/usr/include/sundials/sundials_config.h").read_text()
        self.versions["SUNDIALS"] = re.search(r'SUNDIALS_VERSION "([^"]+)"', config)[1]
        self.versions["gcc"] = capture(["gcc", "-dumpfullversion"]).strip()

    def octave(self):
        if not shutil.which("octave-cli"):
            self.packages(["octave"])
        self.commands["octave"] = ["octave-cli", "--norc", "--quiet", str(HERE / "octave" / "solve.m")]
        self.versions["Octave"] = capture(["octave-cli", "--version"]).split("version ")[1].split()[0]


class Problem:
    """The scenario as plain numbers, the table of right-hand sides and the trajectory, all from the independent implementation."""

    def __init__(self, programs):
        self.build = programs.build
        # The peers know the paper's film only; the example says nothing of its cage.
        self.example = self.build / SCENARIO.name
        self.example.write_text(SCENARIO.read_text() + '\n[cage]\nguidance_film = "quasi-static"\n')
        text = capture([*programs.commands["brinell"], "resolve", self.example])
        scenario = tomllib.loads(text)
        scenario["simulation"] |= {"duration_s": FROM_S + WINDOWS * WINDOW_S, "sample_rate_hz": RATE}
        self.scenario = scenario
        self.file = self.build / "problem.txt"
        self.file.write_text(self.numbers())
        self.states = self.build / "states.txt"
        self.table = self.make_table()
        self.reference, self.trust = self.make_reference()

    def parameters(self, step):
        return generate.parameters(self.scenario, step, 0.0, ["t", *CHANNELS])

    def numbers(self):
        """One number to a name: what the peers read."""
        words = ("guidance", "guidance_film", "law", "roller_path", "edge_reaction", "slices", "load_on", "model", "start", "speed", "defect", "record", "step", "perturb")
        sc = self.scenario
        (defect,), o = sc["defects"], sc["operation"]
        expected = {
            "guidance": (sc["cage"]["guidance"], "outer-ring"),
            "guidance_film": (sc["cage"]["guidance_film"], "quasi-static"),
            "load_on": (o["load_on"], "outer-ring"),
            "on": (defect["on"], "outer-raceway"),
            "model": (sc["simulation"]["model"], "full"),
            "start": (sc["simulation"]["start"], "rolling"),
            "gravity": (o["gravity_m_per_s2"], [0.0, 0.0]),
            "drag": (sc["lubricant"]["drag_coefficient"], 0.0),
            "gap": (sc["bearing"]["outer_gap_um"], 0.0),
        }
        for name, (value, wanted) in expected.items():
            assert value == wanted, f"the peers know {name} = {wanted} only, not {value}"
        lines = [line for line in self.parameters(REFERENCE_STEP).splitlines() if line.split()[0] not in words]
        shape = defect["shape"]["rectangle"]
        more = {
            "speed": o["speed_rpm"] * math.pi / 30,
            "defect_row": defect["row"],
            "defect_angle": math.radians(defect["center_deg"]),
            "defect_depth": defect["depth_um"] * 1e-6,
            "defect_length": shape["length_mm"] * 1e-3,
            "defect_width": shape["width_mm"] * 1e-3,
        }
        return "\n".join([*lines, *(f"{name} {value!r}" for name, value in more.items())]) + "\n"

    def make_table(self):
        exe, parameters = self.build / "reference", self.build / "parameters.txt"
        capture(["gcc", "-std=c99", "-O2", "-o", exe, HERE / "c" / "reference.c", "-lm"])
        parameters.write_text(self.parameters(REFERENCE_STEP))
        states = list(self.random_states(24))
        lines = [str(len(states)), *(" ".join(map(repr, [t, *y])) for t, y in states)]
        self.states.write_text("\n".join(lines) + "\n")
        self.count = len(states)
        table = [float(x) for x in capture([exe, parameters, self.states]).split()]
        self.dof = len(table) // (self.count + 2)
        return table

    def random_states(self, count):
        """Contacts loaded, open, and pulled apart faster than their damper lets them push; rollers on the spall, over its floor and beside
        either edge, some turns on; pockets pressed on both sides, and grazed; slow and fast slip in them; a cage on its land.
        """
        b, c = self.scenario["bearing"], self.scenario["cage"]
        rows, rollers = b["rows"], b["rollers_per_row"]
        n = rows * rollers
        pitch = b["pitch_diameter_mm"] * 0.5e-3
        stagger, play = math.radians(b["row_stagger_deg"]), c["guide_clearance_mm"] * 1e-3
        side = c["pocket_clearance_mm"] * 1e-3 / pitch
        length = self.scenario["defects"][0]["shape"]["rectangle"]["length_mm"]
        edge = length / b["outer_raceway_diameter_mm"]
        orbit = self.scenario["operation"]["speed_rpm"] * math.pi / 30 * b["inner_raceway_diameter_mm"] * 0.5e-3 / (2 * pitch)
        rng = random.Random(3007)
        u = rng.uniform
        for k in range(count):
            grazing, land = k % 4 == 0, k == 3
            reach = 2e-6 if grazing else 5e-5
            speed = 0.5 if grazing else 2e-2
            turn = rng.choice([-1, 0, 0, 1]) * math.tau + u(-0.06, 0.06)
            theta = []
            for i in range(rows):
                for j in range(rollers):
                    off = rng.choice([-1, 1]) * side + u(-3e-5, 3e-5) if grazing else u(-1.5, 1.5) * side
                    theta.append(turn + i * stagger + math.tau * j / rollers + off)
            theta[0] = math.tau * rng.choice([-1, 0, 1]) + rng.choice([-1, 1]) * edge * rng.choice([0.997, 1.003])
            spin = (orbit - 15, orbit + 15) if k % 2 else (-700, -600)
            # Near the outer raceway's touch, or the inner one's.
            touch = [rng.choice([0.0, -b["radial_clearance_um"] * 1e-6]) for _ in range(n)]
            q = [x + u(-reach, reach) for x in touch] + theta + [u(-50, 50) for _ in range(n)]
            v = [u(-speed, speed) for _ in range(n)] + [orbit * u(0.9, 1.1) for _ in range(n)] + [u(*spin) for _ in range(n)]
            for row in range(rows):
                away = 1.1 * play if land and row else 1e-7 * u(0, 1) if grazing else u(0, 0.9) * play
                way = u(0, math.tau)
                q += [away * math.cos(way), away * math.sin(way), turn + (0.0 if grazing else u(-0.5, 0.5) * side)]
                v += [u(-1e-2, 1e-2), u(-1e-2, 1e-2), orbit * u(0.97, 1.03)]
            q += [u(-reach, reach) for _ in range(4)]
            v += [u(-speed, speed) for _ in range(4)]
            yield u(0, 0.04), q + v

    def groups(self):
        """Coordinates of one kind, within which errors are relative to the largest value."""
        b = self.scenario["bearing"]
        n, rows = b["rows"] * b["rollers_per_row"], b["rows"]
        cages = [3 * n + 3 * row + k for row in range(rows) for k in (0, 2)]
        bounds = [0, n, 2 * n, *cages, self.dof - 4, self.dof - 2, self.dof]
        return list(zip(bounds, bounds[1:]))

    def check(self, name, command, argument):
        """Stops everything where a peer's right-hand side or start is another."""
        got = [float(x) for x in capture([*command, argument, self.states], env=one_thread()).split()]
        if len(got) != len(self.table):
            raise SystemExit(f"{name}: {len(got)} values where {len(self.table)} were requested")
        worst = 0.0
        for block in range(self.count + 2):
            for a, b in self.groups():
                span = range(block * self.dof + a, block * self.dof + b)
                size = max(abs(self.table[k]) for k in span)
                gap = max(abs(got[k] - self.table[k]) for k in span)
                if not gap <= RHS_LIMIT * size:
                    what = f"state {block + 1}" if block < self.count else "start"
                    raise SystemExit(f"{name} SOLVES ANOTHER PROBLEM: {what}, coordinates {a} to {b}: off by {gap:g} of {size:g}")
                worst = max(worst, gap / size if size else 0.0)
        say(f"  {name}: right-hand side within {worst:.1e} of the table")
        return worst

    def make_reference(self):
        """Samples by classical Runge-Kutta at fixed steps, and the error of twice the step by the measure below. Cached."""
        source = (ROOT / "validation" / "independent" / "model.c").read_text()
        texts = {step: self.parameters(step) for step in (REFERENCE_STEP, 2 * REFERENCE_STEP)}
        key = hashlib.sha256((source + "".join(texts.values())).encode()).hexdigest()[:16]
        files = {step: self.build / f"trajectory-{key}-{step:g}.csv" for step in texts}
        if not all(path.exists() for path in files.values()):
            say("the trajectory to measure errors against (a minute)")
            exe = generate.build(self.build)
            running = []
            for step, path in files.items():
                text, part = path.with_suffix(".txt"), path.with_suffix(".partial")
                text.write_text(texts[step])
                running.append((subprocess.Popen([exe, text], stdout=part.open("w")), part, path))
            for process, part, path in running:
                if process.wait():
                    raise SystemExit("the independent implementation failed")
                part.rename(path)
        fine, coarse = ([[float(x) for x in row[1:]] for row in list(csv.reader(f.open()))[1:]] for f in files.values())
        self.reference = fine
        return fine, self.errors(coarse, WINDOWS)

    def errors(self, samples, windows):
        """Median over windows of the relative L2 error, for each channel."""
        result = {}
        for c, channel in enumerate(CHANNELS):
            each = []
            for w in range(windows):
                lo, hi = (math.ceil((FROM_S + (w + k) * WINDOW_S) * RATE - 1e-9) for k in (0, 1))
                num = sum((samples[k][c] - self.reference[k][c]) ** 2 for k in range(lo, hi))
                each.append(math.sqrt(num / sum(self.reference[k][c] ** 2 for k in range(lo, hi))))
            result[channel] = statistics.median(each)
        return result


def read_samples(path):
    values = array.array("d")
    values.frombytes(path.read_bytes())
    if sys.byteorder == "big":
        values.byteswap()
    return [values[k : k + 4] for k in range(0, len(values), 4)]


def launch(peer, programs, problem, tolerances, duration, budget, out):
    """Lines of JSON, one for each tolerance; fewer where time ran out or the solver gave up."""
    scenario = problem.example if peer.program in ("brinell", "diffsol") else problem.file
    settings = [duration, RATE, LENGTH, SPEED, RTOL, peer.max_step, budget, *tolerances]
    command = [*programs.commands[peer.program], peer.method, str(scenario), str(out), *map(repr, settings)]
    before = os.times()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=one_thread())
    reason = None
    try:
        stdout, stderr = process.communicate(timeout=TIME_LIMIT_S)
        if process.returncode:
            reason = (stderr.strip().splitlines() or ["?"])[-1][:200]
    except subprocess.TimeoutExpired:
        process.kill()
        stdout, _ = process.communicate()
        reason = f"stopped after {TIME_LIMIT_S:g} s"
    after = os.times()
    whole = after.children_user + after.children_system - before.children_user - before.children_system
    return [json.loads(line) for line in stdout.splitlines() if line.startswith("{")], reason, whole


def measure(peer, programs, problem, args, budget):
    if peer.program in programs.reasons or peer.program not in programs.commands:
        peer.reason = programs.reasons.get(peer.program, "not built")
        return
    duration = FROM_S + peer.windows * WINDOW_S + 1 / RATE
    tolerances = peer.tolerances[::2] if args.quick else peer.tolerances
    out = programs.build / f"out-{peer.key}"
    lines, reason, whole = launch(peer, programs, problem, tolerances, duration, budget, out)
    for i, line in enumerate(lines):
        if i < len(peer.rungs):
            rung = peer.rungs[i]
            rung["cpu"], rung["wall"] = min(rung["cpu"], line["cpu"]), min(rung["wall"], line["wall"])
            rung["repeats"] += line["repeats"]
        else:
            line["duration"] = duration
            line["errors"] = problem.errors(read_samples(pathlib.Path(f"{out}-{i}.f64")), peer.windows)
            peer.rungs.append(line)
    peer.reason = reason
    done = [f"{r['errors']['outer_ax']:.1e} at {r['cpu'] / r['duration']:.3g}" for r in peer.rungs]
    say(f"{peer.name}: {whole:.1f} s of CPU; {', '.join(done)}{'; ' + reason if reason else ''}")


def per_second(rung, key):
    return None if rung.get(key) is None else rung[key] / rung["duration"]


def match(peer):
    """Cost at the matched error: on the line (in logarithms) between the loosest tolerance that meets it and the next looser one."""
    previous = None
    for rung in peer.rungs:
        error = rung["errors"]["outer_ax"]
        if error <= MATCHED or peer.plain:
            row = {key: per_second(rung, key) for key in ("cpu", "wall", "rhs")}
            row |= {"error": error, "inner": rung["errors"]["inner_ax"], "tol": rung["tol"], "between": False}
            if previous and not peer.plain:
                old = previous["errors"]["outer_ax"]
                share = math.log(old / MATCHED) / math.log(old / error)
                for key in ("cpu", "wall", "rhs"):
                    if row[key] is not None:
                        row[key] = per_second(previous, key) ** (1 - share) * row[key] ** share
                row |= {"error": MATCHED, "between": True}
            return row
        previous = rung
    return None


def long_run(peer, programs, problem):
    """Cost of a simulated second over a longer run, at the tolerance that meets the matched error."""
    if peer.matched and peer.long:
        out = programs.build / f"long-{peer.key}"
        lines, _, _ = launch(peer, programs, problem, [peer.matched["tol"]], LONG_S, 0.0, out)
        for line in lines:
            peer.matched["long"] = line["cpu"] / LONG_S
            say(f"{peer.name} over {LONG_S:g} s: {peer.matched['long']:.3g} s of CPU a simulated second")


def command_line(programs):
    """The whole command on the whole scenario, files and report included: the best of three."""
    best = None
    for _ in range(3):
        before, started = os.times(), time.perf_counter()
        capture([programs.cli, "run", SCENARIO, "-o", programs.build / "cli", "-q"])
        wall, after = time.perf_counter() - started, os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        best = (cpu, wall) if best is None or cpu < best[0] else best
    return best


def figures(x):
    """Three of them."""
    if x is None:
        return ""
    return f"{x:.0f}" if x >= 99.95 else f"{x:.3g}"


def machine():
    cpu = platform.processor() or platform.machine()
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        names = [line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
        cpu = names[0] if names else cpu
    system = platform.freedesktop_os_release()["PRETTY_NAME"] if sys.platform == "linux" else platform.system()
    return f"{cpu}, {os.cpu_count()} cores, {system}"


def overhead(peers):
    """What a run adds to the solver at the same tolerance; above, the solver's is the looser one that meets the error."""
    solver, run = (next(p for p in peers if p.key == key) for key in ("brinell", "run"))
    alike = [r for r in solver.rungs if r["tol"] == run.matched["tol"]]
    if not alike:
        return []
    alone = per_second(alike[0], "cpu")
    return [
        f"At the same tolerance the solver alone takes {figures(alone)} s: the run costs {figures(run.matched['cpu'] / alone)} of that. Counted instructions:",
        "`benches/peers/README.md`.",
        "",
    ]


def page(peers, programs, problem, cli, args):
    base = next(p for p in peers if p.key == "brinell").matched
    whole = next(p for p in peers if p.key == "run").matched
    versions = ", ".join(f"{name} {v}" for name, v in programs.versions.items())
    trust = problem.trust["outer_ax"]
    lines = [
        "# Side by side",
        "",
        "The rectangle scenario (`examples/rectangle.toml`: NN3007, 248 states) in what users write today. Written by",
        "`python3 benches/peers/run.py`; `benches/peers/README.md` says what is compared and how, and what is not fair.",
        "",
        f"Run on {datetime.date.today().isoformat()}; {machine()}. {versions}.",
        "",
        f"CPU seconds of one thread for a simulated second, at a median error of {100 * MATCHED:g} % of `outer_ax` over windows of",
        f"{1e3 * WINDOW_S:g} ms from {1e3 * FROM_S:g} ms on, all from one run on one machine. \"Ratio\" is to brinell's solver, which delivers the same",
        "samples as the peers; \"to a run\" is to brinell's whole run at `accuracy = \"standard\"`, which also feeds its anti-alias filter, gathers",
        "statistics and keeps audits of energy and momentum.",
        "",
        f"| | CPU s per simulated s | ratio | to a run | wall s | right-hand sides per simulated s | CPU s over {LONG_S:g} s | |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |",
    ]
    for peer in peers:
        m = peer.matched
        if m is None:
            least = min((r["errors"]["outer_ax"] for r in peer.rungs), default=None)
            note = peer.reason or (f"{100 * MATCHED:g} % not reached: {100 * least:.2g} %" if least else "no run")
            lines.append(f"| {peer.name} | | | | | | | {note} |")
            continue
        notes = []
        if peer.plain:
            notes.append(f"error {100 * m['error']:.2g} %")
        elif not m["between"]:
            notes.append(f"loosest tolerance tried: error {100 * m['error']:.2g} %")
        if peer.windows < WINDOWS:
            windows = "the first window" if peer.windows == 1 else f"the first {peer.windows} windows"
            notes.append(f"{windows} only")
        if peer.reason:
            notes.append(peer.reason)
        cells = [
            figures(m["cpu"]),
            figures(m["cpu"] / base["cpu"]),
            figures(m["cpu"] / whole["cpu"]),
            figures(m["wall"]),
            f"{m['rhs']:,.0f}".replace(",", " ") if m["rhs"] else "",
            figures(m.get("long")),
            "; ".join(notes),
        ]
        lines.append(f"| {peer.name} | {' | '.join(cells)} |")
    lines += [
        "",
        f"The command `brinell run examples/rectangle.toml`, half a second with its files and report: {figures(cli[0])} s of CPU, {figures(cli[1])} s of wall",
        "time.",
        "",
        *overhead(peers),
        "Against what was aimed for, each time by the fastest of the kind:",
        "",
        "| | aimed for | found, by solvers | found, by a whole run |",
        "| --- | ---: | ---: | ---: |",
    ]
    for name, keys, target in TARGETS:
        costs = [p.matched["cpu"] for p in peers if p.key in keys and p.matched]
        found = [figures(min(costs) / m["cpu"]) for m in (base, whole)] if costs else ["", ""]
        lines.append(f"| {name} | {target} | {' | '.join(found)} |")
    lines += [
        "",
        "![Cost against error of every solver](pictures/work-precision.png)",
        "",
        f"Every run is in `peers.csv`. The trajectory that errors are measured against moves by {100 * trust:.1g} % itself when its step is doubled:",
        "points near that say no more.",
        "",
    ]
    return "\n".join(lines)


def write_results(folder, peers, programs, problem, cli, args):
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    (folder / "peers.md").write_text(page(peers, programs, problem, cli, args))
    with (folder / "peers.csv").open("w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["peer", "tolerance", *(f"error_{c}" for c in CHANNELS), "cpu_s_per_s", "wall_s_per_s", "rhs_per_s", "runs"])
        for peer in peers:
            for r in peer.rungs:
                cost = [per_second(r, key) for key in ("cpu", "wall", "rhs")]
                numbers = [*r["errors"].values(), *cost]
                table.writerow([peer.key, f"{r['tol']:.4g}", *("" if x is None else f"{x:.4g}" for x in numbers), r["repeats"]])
    curves = [{"key": p.key, "name": p.name.replace("`", ""), "points": [(r["errors"]["outer_ax"], per_second(r, "cpu")) for r in p.rungs]} for p in peers]
    plot = {"curves": curves, "matched": MATCHED, "floor": problem.trust["outer_ax"]}
    data = programs.build / "plot.json"
    data.write_text(json.dumps(plot))
    if "python" in programs.reasons:
        say(f"no picture: {programs.reasons['python']}")
        return
    capture([programs.venv / "bin" / "python", HERE / "python" / "plot.py", data, folder / "pictures" / "work-precision"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="fewer tolerances, no slow solvers; results stay in the build folder")
    parser.add_argument("--no-install", action="store_true", help="never call apt-get")
    parser.add_argument("--build", type=pathlib.Path, default=HERE / "build", help="folder for what is built and cached")
    parser.add_argument("--docs", type=pathlib.Path, help="folder for the results; default: docs/, or the build folder with --quick")
    parser.add_argument("--only", nargs="+", metavar="KEY", help="only these peers (with brinell): " + ", ".join(p.key for p in PEERS))
    args = parser.parse_args()
    build = args.build.resolve()
    build.mkdir(parents=True, exist_ok=True)
    docs = args.docs or (build / "docs" if args.quick or args.only else ROOT / "docs")

    programs = Programs(build, not args.no_install)
    problem = Problem(programs)
    say(f"the reference moves by {problem.trust['outer_ax']:.1e} when its step is doubled")
    checks = {
        "brinell": ("brinell", ["check", str(problem.example)]),
        "c": ("c", ["check", str(problem.file)]),
        "numpy": ("python", ["check-numpy", str(problem.file)]),
        "numba": ("python", ["check-numba", str(problem.file)]),
        "octave": ("octave", ["check", str(problem.file)]),
    }
    for name, (program, (how, argument)) in checks.items():
        if program in programs.commands:
            problem.check(name, [*programs.commands[program], how], argument)

    peers = [p for p in PEERS if not (args.quick and p.slow)]
    if args.only:
        peers = [p for p in peers if p.key in {"brinell", "run", *args.only}]
    fast = [p for p in peers if p.program in ("brinell", "c", "diffsol") or p.key == "numba-RK45"]
    # In turns, so that a busy moment of the machine falls on nobody alone; the shortest of all repeats counts.
    for turn in range(1 if args.quick else 3):
        for peer in fast:
            measure(peer, programs, problem, args, 0.25)
    for peer in peers:
        if peer not in fast:
            measure(peer, programs, problem, args, 0.0)
    for peer in peers:
        peer.matched = match(peer)
        if peer.rungs and min(r["errors"]["outer_ax"] for r in peer.rungs) > 0.5 and not peer.reason:
            raise SystemExit(f"{peer.name} SOLVES ANOTHER PROBLEM, or its tolerances are far too loose")
        if not args.quick:
            long_run(peer, programs, problem)
    say("the command line")
    cli = command_line(programs)
    write_results(docs, peers, programs, problem, cli, args)
    print((docs / "peers.md").read_text())
    say(f"written to {os.path.relpath(docs)}")


if __name__ == "__main__":
    main()
