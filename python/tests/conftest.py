"""What the tests share. `BRINELL` names the command to compare with; without it those tests are skipped."""

import os
import pathlib
import warnings

import matplotlib
import pytest

import brinell

matplotlib.use("Agg")
warnings.simplefilter("error")

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
def examples() -> pathlib.Path:
    return ROOT / "examples"


@pytest.fixture(scope="session")
def command() -> str:
    path = os.environ.get("BRINELL")
    if not path:
        pytest.skip("BRINELL does not name the command")
    return str(pathlib.Path(path).resolve())


@pytest.fixture(scope="session")
def base() -> brinell.Scenario:
    """A tenth of a second of the rectangle."""
    return brinell.Scenario.from_file(ROOT / "examples/rectangle.toml", {"simulation.duration_s": 0.1})


@pytest.fixture(scope="session")
def result(base: brinell.Scenario) -> brinell.Result:
    return brinell.simulate(base)


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    import matplotlib.pyplot as plt

    plt.close("all")
