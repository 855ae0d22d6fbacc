"""The gallery's pages that are Python: they print and draw what they show. The other pages are commands, which `docs/tool` runs."""

import os
import shlex
import subprocess
import sys

import pytest
from conftest import ROOT


def blocks(text: str, kind: str) -> list[str]:
    """The fenced blocks of a kind."""
    return [block.split("\n```")[0] + "\n" for block in text.split(f"\n```{kind}\n")[1:]]


@pytest.mark.parametrize(("page", "picture", "points"), [("classifier", "classes", 60), ("severity", "severity", 3 * 45)])
def test_regress_what_a_page_of_python_shows_comes_of_it(command, tmp_path, page, picture, points):
    for name in ("sklearn", "scipy", "pandas", "pyarrow"):
        pytest.importorskip(name)
    text = (ROOT / f"docs/src/gallery/{page}.md").read_text(encoding="utf-8")
    # Impacts amplify the round-off in which the other kernels differ; on more than one thread sums come in the order in which threads end.
    settings = {"BRINELL_KERNEL": "portable", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
    environment = os.environ | settings
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    lines = [line.removeprefix("$ ") for kind in ("console", "sh") for block in blocks(text, kind) for line in block.splitlines()]
    for line in lines:
        if line.startswith("brinell ") and "--dry-run" not in line:
            subprocess.run([command, *shlex.split(line)[1:]], cwd=tmp_path, env=environment, check=True, capture_output=True)
    (code,), (shown,) = blocks(text, "py"), blocks(text, "text")
    printed = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True, capture_output=True, text=True).stdout
    assert printed == shown
    # Its places hang on the libraries' versions in the last digit: a point a run is there.
    shown, drawn = (ROOT / f"docs/src/pictures/gallery-{picture}.svg").read_text(encoding="utf-8"), (tmp_path / f"{picture}.svg").read_text(encoding="utf-8")
    assert shown.count("<use ") == drawn.count("<use ") > points
