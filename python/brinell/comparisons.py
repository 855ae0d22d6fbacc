"""Runs side by side: every number of each, and its ratio to the baseline's."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from brinell import _brinell, tables
from brinell.result import Result
from brinell.runs import many
from brinell.scenario import Runnable, Scenario, given, plain, warn

if TYPE_CHECKING:
    import pandas
    import polars

__all__ = ["Comparison", "compare"]


@dataclass(frozen=True, eq=False)
class Comparison:
    """A row a number: its value and interval in each run, and its ratio to the baseline's, which is the first run."""

    baseline: str
    """Name of the first run."""
    results: dict[str, Result]
    """The runs by name."""
    columns: dict[str, npt.NDArray[Any]]
    """``quantity`` and ``unit`` (SI; 1 where there is none); of each run its value by the run's name, the ends of its
    95 % interval with ``.low`` and ``.high`` behind, and of all but the baseline ``.ratio``, ``.ratio.low``,
    ``.ratio.high``; NaN where there is none."""
    report: dict[str, Any] = field(repr=False)
    """Everything, as ``brinell compare --json`` writes it; there are no files."""
    _native: _brinell.Comparison | None = field(repr=False)

    @property
    def warnings(self) -> list[str]:
        """What ``brinell compare`` warns of, each kind once."""
        return [plain(text) for text in self.report["warnings"]]

    def __getitem__(self, quantity: str) -> dict[str, Any]:
        """A number by name (``sensor_ax.rms``): its ``unit``, its ``runs`` and its ``ratios``.

        Both are by run, each with ``value`` and, where it is known, ``low`` and ``high``.
        """
        quantities: dict[str, dict[str, Any]] = self.report["quantities"]
        if quantity not in self:
            raise KeyError(f"{quantity}: no such number of these runs{tables.meant(quantity, quantities)}")
        return quantities[quantity]

    def __contains__(self, quantity: object) -> bool:
        """Whether there is a number of this name."""
        return quantity in list(self)

    def __iter__(self) -> Iterator[str]:
        """Names of the numbers."""
        return iter(self.report["quantities"])

    def __len__(self) -> int:
        """Numbers."""
        return len(self.columns["quantity"])

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def to_pandas(self) -> pandas.DataFrame:
        """The columns as a data frame."""
        return tables.to_pandas(self.columns, {})

    def to_polars(self) -> polars.DataFrame:
        """The columns as a data frame."""
        return tables.to_polars(self.columns)

    def to_html(self) -> str:
        """The page that ``brinell compare`` writes as ``compare.html``: one file that needs no network.

        Write it as UTF-8. A comparison that came from another process has no page.
        """
        if self._native is None:
            raise RuntimeError("this comparison came from another process: its page is to be requested there")
        return self._native.to_html()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_native": None}

    def __repr__(self) -> str:
        return f"<brinell.Comparison: {', '.join(self.results)}; {len(self)} numbers>"


def compare(
    runs: Mapping[str, Runnable | Result],
    variants: Mapping[str, Mapping[str, Any]] | None = None,
    *,
    settings: Mapping[str, Any] | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Comparison:
    """Lays two to six runs side by side, the first of them the baseline. Ctrl-C stops those under way.

    Parameters
    ----------
    runs : mapping of str to Scenario, path or Result
        By the names that they shall have. A `Result` is not run again.
    variants : mapping of str to mapping, optional
        Further runs by name: the baseline with these values, by dotted path.
    settings : mapping, optional
        Values over those of every scenario, as in `Scenario.replace`.
    jobs : int, optional
        Runs at a time; as many as there are cores by default.
    progress : callable, optional
        Gets how many runs are over, and of how many.

    Returns
    -------
    Comparison
        The numbers of ``brinell compare``.

    Raises
    ------
    ValueError
        Where a name cannot head a column or comes twice, there are fewer than two runs or more than six, or one did not
        come to its end.
    RunError
        Where a run failed.

    Warns
    -----
    ScenarioWarning
        What ``brinell compare`` warns of: ``warnings`` of the comparison.

    Examples
    --------
    >>> import brinell
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> compared = brinell.compare({"deep": base}, {"shallow": {"defects.0.depth_um": 1.0}})
    >>> compared["sensor_ax.rms"]["unit"], sorted(compared["sensor_ax.rms"]["ratios"])
    ('m/s^2', ['shallow'])
    >>> list(compared.columns)[:4]
    ['quantity', 'unit', 'deep', 'deep.low']
    """
    if not isinstance(runs, Mapping):
        raise TypeError(f'runs: expected runs by name, such as {{"full": scenario}}, and it is {type(runs).__name__}')
    changes = variants or {}
    _brinell.check_names([*runs, *changes])
    if not runs:
        raise ValueError("variants of what? Give the baseline among the runs")
    for name, run in runs.items():
        if settings and isinstance(run, Result):
            raise ValueError(f"{name}: a result, which ran without these settings; give its scenario")
    chosen: list[Scenario | Result] = []
    for run in runs.values():
        chosen.append(run if isinstance(run, Result) else given(run).replace(settings) if settings else given(run))
    first = chosen[0].scenario if isinstance(chosen[0], Result) else chosen[0]
    chosen += [first.replace(change) for change in changes.values()]
    made, _ = many([run for run in chosen if isinstance(run, Scenario)], jobs, progress)
    new = iter(made)
    done = [run if isinstance(run, Result) else next(new) for run in chosen]
    results = dict(zip([*runs, *changes], done, strict=True))
    native = _brinell.Comparison([(name, result._native()) for name, result in results.items()])
    comparison = Comparison(next(iter(results)), results, tables.columns(native.columns()), native.report(), native)
    warn(comparison.warnings)
    return comparison
