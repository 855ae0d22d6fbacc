"""What the tests share. `BRINELL` names the command to compare with; without it those tests are skipped."""

import os
import pathlib
import warnings

import matplotlib
import pytest

import brinell

matplotlib.use("Agg")
warnings.simplefilter("error")

# Results carry the date, and tests hold files against each other.
os.environ["SOURCE_DATE_EPOCH"] = "1700000000"

ROOT = pathlib.Path(__file__).resolve().parents[2]


def blocks(name: str) -> str:
    """Every block of Python in a Markdown file of the repository, as one program."""
    inside, lines = False, []
    for line in (ROOT / name).read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            inside = line == "```python"
        elif inside:
            lines.append(line)
    return "\n".join(lines)


@pytest.fixture(scope="session")
def examples(tmp_path_factory) -> pathlib.Path:
    """Copies of the examples with the paper's laws, which need no table for each damage and are the lumped model's too."""
    folder = tmp_path_factory.mktemp("examples")
    for path in (ROOT / "examples").iterdir():
        if path.suffix == ".toml":
            text = path.read_text(encoding="utf-8")
            stated = text if "\nlaws =" in text else text.replace("[simulation]\n", '[simulation]\nlaws = "li2023"\n')
            (folder / path.name).write_text(stated, encoding="utf-8")
        elif path.is_file():
            (folder / path.name).write_bytes(path.read_bytes())
    return folder


@pytest.fixture(scope="session")
def command() -> str:
    path = os.environ.get("BRINELL")
    if not path:
        pytest.skip("BRINELL does not name the command")
    return str(pathlib.Path(path).resolve())


@pytest.fixture(scope="session")
def base(examples) -> brinell.Scenario:
    """A tenth of a second of the rectangle."""
    return brinell.Scenario.from_file(examples / "rectangle.toml", {"simulation.duration_s": 0.1})


@pytest.fixture(scope="session")
def result(base: brinell.Scenario) -> brinell.Result:
    return brinell.simulate(base)


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    import matplotlib.pyplot as plt

    plt.close("all")
