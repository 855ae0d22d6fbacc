"""Whether a tag may be released: python3 .ci/check_tag.py v1.2.3 https://github.com/OWNER/REPOSITORY"""

import re
import sys
import tomllib
from pathlib import Path

tag, repository = sys.argv[1:]
version = tomllib.loads(Path("Cargo.toml").read_text())["workspace"]["package"]["version"]
named = tomllib.loads(Path("crates/brinell-cli/Cargo.toml").read_text())["package"].get("repository")
dated = re.search(rf"^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$", Path("CHANGELOG.md").read_text(), re.M)
problems = []
if tag != f"v{version}":
    problems.append(f"the tag is {tag}, the version in Cargo.toml {version}")
if not dated:
    problems.append(f"CHANGELOG.md has no line '## [{version}] - YYYY-MM-DD'")
if named != repository:
    problems.append(f"repository in crates/brinell-cli/Cargo.toml is {named}, not {repository}: cargo binstall would not find the archives")
sys.exit("\n".join(problems) or 0)
