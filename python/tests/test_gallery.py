"""The gallery's page that is Python: it prints and draws what it shows. The other pages are commands, which `docs/tool` runs."""

import os
import shlex
import subprocess
import sys

import pytest
from conftest import ROOT


def block(text: str, kind: str) -> str:
    """The one fenced block of a kind."""
    blocks = text.split(f"\n```{kind}\n")[1:]
    assert len(blocks) == 1, kind
    return blocks[0].split("\n```")[0] + "\n"


def test_regress_the_classifier_is_right_as_often_as_its_page_says(command, tmp_path):
    for name in ("sklearn", "scipy", "pandas", "pyarrow"):
        pytest.importorskip(name)
    text = (ROOT / "docs/src/gallery/classifier.md").read_text(encoding="utf-8")
    # Impacts amplify the round-off in which the other kernels differ; on more than one thread sums come in the order in which threads end.
    settings = {"BRINELL_KERNEL": "portable", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
    environment = os.environ | settings
    for line in block(text, "console").splitlines():
        if line.startswith("$ brinell ") and "--dry-run" not in line:
            subprocess.run([command, *shlex.split(line)[2:]], cwd=tmp_path, env=environment, check=True, capture_output=True)
    program = [sys.executable, "-c", block(text, "py")]
    printed = subprocess.run(program, cwd=tmp_path, env=environment, check=True, capture_output=True, text=True).stdout
    assert printed == block(text, "text")
    # Its places hang on the libraries' versions in the last digit: a point a run is there.
    shown, drawn = (ROOT / "docs/pictures/gallery-classes.svg").read_text(encoding="utf-8"), (tmp_path / "classes.svg").read_text(encoding="utf-8")
    assert shown.count("<use ") == drawn.count("<use ") > 60
