"""Licences, sources and version requirements of everything in Cargo.lock, as deny.toml has them: check_dependencies.py

What the first three of cargo-deny's checks are for, which takes minutes to build; `cargo deny check` reads the same file.
"""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

from license_expression import get_spdx_licensing

SPDX = get_spdx_licensing()
CRATES_IO = "registry+https://github.com/rust-lang/crates.io-index"


def held(expression: str, allowed: set[str], used: set[str]) -> bool:
    """Whether an SPDX expression can be met by allowed licences; `/` is an old `OR`."""
    parsed = SPDX.parse(expression.replace("/", " OR "))
    used |= {str(symbol) for symbol in parsed.symbols}
    return parsed.subs({symbol: SPDX.TRUE if str(symbol) in allowed else SPDX.FALSE for symbol in parsed.symbols}).simplify() == SPDX.TRUE


def shipped(told: dict) -> set[str]:
    """Packages by which others are built, not only tested: what their licences matter for."""
    needed = {node["id"]: [d["pkg"] for d in node["deps"] if any(k["kind"] != "dev" for k in d["dep_kinds"])] for node in told["resolve"]["nodes"]}
    open_, seen = list(told["workspace_members"]), set(told["workspace_members"])
    while open_:
        new = set(needed[open_.pop()]) - seen
        seen |= new
        open_ += new
    return seen


def problems(packages: list[dict], rules: dict, licensed: set[str]) -> list[str]:
    """What cargo-deny would refuse of packages as `cargo metadata` lists them."""
    known = {"graph", "licenses", "bans", "sources", "advisories"}, {"allow", "confidence-threshold"}
    if set(rules) - known[0] or set(rules["licenses"]) - known[1] or rules["bans"]["wildcards"] != "deny":
        return ["deny.toml has rules that this does not know"]
    allowed, used, found = set(rules["licenses"]["allow"]), set(), []
    for package in packages:
        name = f"{package['name']} {package['version']}"
        licence = package["license"]
        if package["id"] in licensed and not (licence and held(licence, allowed, used)):
            found.append(f"{name}: licence {licence}")
        if package["source"] not in (None, CRATES_IO):
            found.append(f"{name}: from {package['source']}")
        for needed in package["dependencies"]:
            if package["source"] is None and needed["req"] == "*":
                found.append(f"{name}: any version of {needed['name']}")
    return found + [f"{licence}: allowed and not there" for licence in sorted(allowed - used)]


def of_itself(rules: dict) -> None:
    """Each rule refuses what it is for."""
    kinds = ("build", "dev", None)
    nodes = [{"id": "root", "deps": [{"pkg": f"{kind}", "dep_kinds": [{"kind": kind}]} for kind in kinds]}, *({"id": f"{kind}", "deps": []} for kind in kinds)]
    assert shipped({"workspace_members": ["root"], "resolve": {"nodes": nodes}}) == {"root", "build", "None"}
    allowed = rules["licenses"]["allow"]
    sound = {"id": "a", "name": "a", "version": "1.0.0", "license": " AND ".join(allowed), "source": CRATES_IO, "dependencies": []}
    wild = {"source": None, "dependencies": [{"name": "b", "req": "*"}]}
    assert problems([sound], rules, {"a"}) == []
    for part in ({"license": "GPL-3.0-only"}, {"license": None}, {"license": "MIT AND (GPL-3.0-only OR X)"}, {"source": "git+https://github.com/a/a"}, wild):
        assert len(problems([sound, sound | part], rules, {"a"})) == 1, part
    for licence in ("GPL-3.0-only OR MIT", "GPL-3.0-only/MIT", "(MIT OR GPL-3.0-only) AND Apache-2.0", "GPL-3.0-only AND X OR Apache-2.0 WITH LLVM-exception"):
        assert problems([sound, sound | {"license": licence}], rules, {"a"}) == [], licence


rules = tomllib.loads(Path("deny.toml").read_text(encoding="utf-8"))
of_itself(rules)
command = ["cargo", "metadata", "--format-version", "1", "--locked", *(["--all-features"] if rules["graph"]["all-features"] else [])]
told = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
licensed = shipped(told)
if found := problems(told["packages"], rules, licensed):
    sys.exit("\n".join(found))
print(f"{len(told['packages'])} packages, licences of the {len(licensed)} that are shipped: as deny.toml has them")
