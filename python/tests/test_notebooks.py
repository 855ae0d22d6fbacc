"""The notebooks run from top to bottom, and show what is stored in them.

With `python python/tests/test_notebooks.py [NAME]` the outputs are made anew and stored; look at them before they are committed.
"""

import os
import pathlib
import re
import sys

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples/notebooks").glob("*.ipynb"))

#: Run before the first cell, and stored nowhere. Warnings are errors, pictures small. On more than one thread numeric libraries sum in the order in
#: which threads end.
SETUP = """\
import contextlib, warnings
with contextlib.suppress(ImportError):
    import ross  # which prints at its first import what it does not find of other programs
warnings.filterwarnings("error", module="__main__")
import brinell
warnings.simplefilter("error", brinell.ScenarioWarning)
import matplotlib
matplotlib.rcParams["figure.dpi"] = 60
"""
#: Impacts amplify the round-off in which the other kernels differ.
ENVIRONMENT = {"BRINELL_KERNEL": "portable", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
#: Stored without outputs: what it shows comes of 320 runs, minutes of all cores, and the test makes a quarter of them.
BARE = "sim_to_real"


def of_fewer_runs(notebook, folder):
    """A quarter of the plan's 320 runs, which take minutes: what the notebook claims holds of these too."""
    plans = NOTEBOOKS[0].parents[1] / "plans"
    text = (plans / "ball-6205.toml").read_text(encoding="utf-8")
    assert text.count("runs = 320\n") == text.count('"../ball-6205.toml"') == 1
    fewer = folder / "ball-6205.toml"
    base = (plans.parent / "ball-6205.toml").as_posix()
    fewer.write_text(text.replace("runs = 320\n", "runs = 80\n").replace("../ball-6205.toml", base), encoding="utf-8")
    named = [cell for cell in notebook.cells if "../plans/ball-6205.toml" in cell.source and cell.cell_type == "code"]
    assert len(named) == 1
    named[0].source = named[0].source.replace("../plans/ball-6205.toml", fewer.as_posix())


def execute(notebook):
    """Fills in the outputs of a notebook."""
    import nbclient
    import nbformat

    notebook.cells.insert(0, nbformat.v4.new_code_cell(SETUP))
    place = {"metadata": {"path": str(NOTEBOOKS[0].parent)}}
    nbclient.NotebookClient(notebook, timeout=1200, kernel_name="python3", resources=place).execute()
    del notebook.cells[0]


def shown(cell):
    """What a reader sees of a cell's outputs: texts, and of each picture that there is one."""
    texts = []
    for output in cell.outputs:
        data = output.get("data", {})
        kinds = sorted(kind for kind in data if kind.startswith("image/"))
        text = "".join(output.get("text", "")) or "".join(data.get("text/plain", "")) or output.output_type
        # Of a picture its size and that there is one: the bytes are those of one version of matplotlib and its typeface.
        text = f"{kinds}{text}" if kinds else re.sub(r"/tmp/\S+", "TMP", text)
        texts.append(text)
    return texts


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_prop_a_notebook_shows_what_is_stored_in_it(path, tmp_path, monkeypatch, request):
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("nbclient")
    if path.stem in ("classifier", "sim_to_real"):
        pytest.importorskip("sklearn")
    if path.stem == "rotor":
        pytest.importorskip("ross")
        monkeypatch.setenv("BRINELL", request.getfixturevalue("command"))
    for name, value in ENVIRONMENT.items():
        # What is compared with nothing stored runs three times as fast with the processor's own kernel.
        if path.stem != BARE or name != "BRINELL_KERNEL":
            monkeypatch.setenv(name, value)
    monkeypatch.delenv("BRINELL_RECORDS", raising=False)
    stored, notebook = (nbformat.read(path, as_version=4) for _ in range(2))
    if path.stem == BARE:
        of_fewer_runs(notebook, tmp_path)
    execute(notebook)
    for old, new in zip(stored.cells, notebook.cells, strict=True):
        if new.cell_type == "code" and path.stem != BARE:
            assert shown(old) == shown(new), f"{path.name}, {old.id}: refresh it, as CONTRIBUTING.md says"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_prop_a_stored_notebook_is_small_and_warns_of_nothing(path):
    nbformat = pytest.importorskip("nbformat")
    notebook = nbformat.read(path, as_version=4)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert bool(outputs) == (path.stem != BARE) and path.stat().st_size < 400_000
    assert not [output for output in outputs if output.output_type == "error" or output.get("name") == "stderr"]


if __name__ == "__main__":
    import nbformat

    os.environ.update(ENVIRONMENT)
    os.environ.pop("BRINELL_RECORDS", None)
    for path in NOTEBOOKS:
        if path.stem in (sys.argv[1:] or [path.stem]) and path.stem != BARE:
            notebook = nbformat.read(path, as_version=4)
            execute(notebook)
            for cell in notebook.cells:
                cell.metadata.pop("execution", None)
            notebook.metadata.language_info = {"name": "python"}
            nbformat.write(notebook, path)
            print(f"{path}: {path.stat().st_size // 1000} kB")
