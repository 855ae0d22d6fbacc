"""The notebooks run from top to bottom."""

import pathlib

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples/notebooks").glob("*.ipynb"))


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


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_prop_a_notebook_runs(path, tmp_path, monkeypatch, request):
    nbformat = pytest.importorskip("nbformat")
    client = pytest.importorskip("nbclient")
    if path.stem in ("classifier", "sim_to_real"):
        pytest.importorskip("sklearn")
    if path.stem == "rotor":
        pytest.importorskip("ross")
        monkeypatch.setenv("BRINELL", request.getfixturevalue("command"))
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.outputs for cell in notebook.cells if cell.cell_type == "code"), "kept without outputs"
    if path.stem == "sim_to_real":
        of_fewer_runs(notebook, tmp_path)
    client.NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}).execute()
