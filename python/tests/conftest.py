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


#: Of a data set, half of it with damage from a photo.
PLAN = """
name = "spalls"
base = "base.toml"
runs = {runs}
seed = 804613592207415
design = "sobol"
runs_per_file = {per_file}
held_out = 0.25
secret = "9f86d081884c7d659a2feaa0c55ad015"
signals = ["sensor_a*"]

[vary]
simulation.duration_s = {duration}
operation.speed_rpm = {{ uniform = [900, 3000] }}

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "photo"
[[classes.defects]]
on = "outer-raceway"
depth_um = {{ log = [3, 40] }}
shape.image = {{ file = "photo-spall.png", mm_per_pixel = 0.02 }}
"""


@pytest.fixture
def plan(tmp_path, examples):
    """Sixteen short runs in eight files, half of them with damage from a photo."""

    def make(**values):
        (tmp_path / "plan").mkdir(exist_ok=True)
        for name in ("rectangle.toml", "photo-spall.png"):
            target = "base.toml" if name.endswith("toml") else name
            (tmp_path / "plan" / target).write_bytes((examples / name).read_bytes())
        text = PLAN.format(**({"runs": 15, "per_file": 2, "duration": 0.05} | values))
        (tmp_path / "plan" / "plan.toml").write_text(text)
        return brinell.Plan(tmp_path / "plan" / "plan.toml")

    return make
