"""The command of this machine as an archive that `cargo binstall` finds, unpacked and started: python3 .ci/archive.py BINARY FOLDER

Its name, its kind and the place of the command in it are those of [package.metadata.binstall] in crates/brinell-cli/Cargo.toml.
"""

import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

BESIDE = ["README.md", "LICENSE-APACHE", "LICENSE-MIT", "crates/brinell-report/font/OFL.txt"]
# What shutil calls a kind of archive, and the endings that binstall tries for it.
KINDS = {"tgz": ("gztar", [".tgz", ".tar.gz"]), "zip": ("zip", [".zip"])}


def main(binary: Path, folder: Path) -> None:
    version = tomllib.loads(Path("Cargo.toml").read_text())["workspace"]["package"]["version"]
    package = tomllib.loads(Path("crates/brinell-cli/Cargo.toml").read_text())
    asked = subprocess.run(["rustc", "-vV"], check=True, capture_output=True, text=True).stdout
    target = re.search(r"^host: (.+)$", asked, re.M)[1]
    metadata = package["package"]["metadata"]["binstall"]
    metadata = metadata | metadata.get("overrides", {}).get(target, {})
    kind, endings = KINDS[metadata["pkg-fmt"]]
    values = {"repo": "REPO", "version": version, "target": target, "bin": package["bin"][0]["name"]}
    values |= {"archive-suffix": "", "binary-ext": ".exe" if "windows" in target else ""}
    # A word that has no value here is an error.
    url, command = (re.sub(r"{ ([a-z-]+) }", lambda word: values[word[1]], metadata[key]) for key in ("pkg-url", "bin-dir"))
    name = url.removeprefix(f"REPO/releases/download/v{version}/")
    assert "/" not in name, f"pkg-url {metadata['pkg-url']} is not a file of the release v{version}"
    top = Path(command).parts[0]

    with tempfile.TemporaryDirectory() as packed:
        place = Path(packed, command)
        place.parent.mkdir(parents=True)
        shutil.copy2(binary, place)
        for file in BESIDE:
            shutil.copy(file, Path(packed, top))
        folder.mkdir(parents=True, exist_ok=True)
        archive = Path(shutil.make_archive(str(folder / name), kind, packed, top))
    assert archive.name in [name + ending for ending in endings], archive
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    Path(f"{archive}.sha256").write_text(f"{digest}  {archive.name}\n", newline="\n")

    with tempfile.TemporaryDirectory() as unpacked:
        shutil.unpack_archive(archive, unpacked)
        told = subprocess.run([Path(unpacked, command), "--version"], check=True, capture_output=True, text=True).stdout
    assert told.split()[:2] == ["brinell", version], f"the archive's command says: {told}"
    print(archive)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
