"""Builds and installs what is compared."""

import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tomllib

from .settings import HERE, ROOT
from .tools import Missing, capture, say


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
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        capture([*pip, "-r", HERE / "requirements.txt"])
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
