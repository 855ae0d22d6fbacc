"""Running scenarios, alone or side by side."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, TypeVar, overload

from brinell import _brinell
from brinell.arguments import jobs_of
from brinell.result import Result
from brinell.scenario import Runnable, Scenario, given, warn

__all__ = ["simulate", "simulate_many"]

T = TypeVar("T")


def _told(error: Exception, scenario: Scenario) -> Exception:
    """What was computed until then, as a `Result`."""
    if isinstance(error, _brinell.RunError) and isinstance(error.partial, _brinell.Run):
        error.partial = Result._of(error.partial, scenario)
    return error


def simulate(
    scenario: Runnable,
    *,
    settings: Mapping[str, Any] | None = None,
    progress: Callable[[float], object] | None = None,
) -> Result:
    """Runs one scenario to its end, on this thread, without holding Python's lock. Ctrl-C stops it.

    Parameters
    ----------
    scenario : Scenario or path
        What to run.
    settings : mapping, optional
        Values over the scenario's, as in `Scenario.replace`.
    progress : callable, optional
        Gets the simulated time reached, s, some times a second. What it raises stops the run.

    Returns
    -------
    Result
        Signals and findings: the bits of ``brinell run``.

    Raises
    ------
    RunError
        Where the solver could not go on; ``partial`` is the `Result` until then.

    Warns
    -----
    ScenarioWarning
        What ``brinell run`` warns of: loads, damage and durations that may not be meant, and what the run shows; ``warnings`` of the result.

    Examples
    --------
    >>> import brinell
    >>> scenario = brinell.Scenario.from_toml(brinell.template())
    >>> result = brinell.simulate(scenario, settings={"simulation.duration_s": 1.0})
    >>> result.complete, result.rate_hz
    (True, 25600.0)
    """
    chosen = given(scenario)
    if settings:
        chosen = chosen.replace(settings)
    try:
        result = Result._of(_brinell.simulate(chosen._native, progress), chosen)
    except _brinell.RunError as error:
        told = _told(error, chosen)
        if isinstance(error.partial, Result):
            error.partial._warn()
        raise told from None
    result._warn()
    return result


@overload
def simulate_many(
    scenarios: Iterable[Runnable],
    *,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    reduce: None = None,
    errors: Literal["raise"] = "raise",
) -> list[Result]: ...
@overload
def simulate_many(
    scenarios: Iterable[Runnable],
    *,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    reduce: Callable[[Result], T],
    errors: Literal["raise"] = "raise",
) -> list[T]: ...
@overload
def simulate_many(
    scenarios: Iterable[Runnable],
    *,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    reduce: Callable[[Result], Any] | None = None,
    errors: Literal["return"],
) -> list[Any]: ...
def simulate_many(
    scenarios: Iterable[Runnable],
    *,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    reduce: Callable[[Result], Any] | None = None,
    errors: Literal["raise", "return"] = "raise",
) -> list[Any]:
    """Runs scenarios side by side, one to a thread; each result is that of `simulate`, bit for bit. Ctrl-C stops all of them.

    Parameters
    ----------
    scenarios : iterable of Scenario or path
        What to run.
    jobs : int, optional
        Runs at a time; as many as there are cores by default.
    progress : callable, optional
        Gets how many runs are over, and of how many.
    reduce : callable, optional
        Gets each `Result` as it comes, on this thread; what it returns is in the list instead, and the result's memory is free again. Without
        it every signal is held until the end.
    errors : {"raise", "return"}
        Raise what the first failed run raises and stop the others, or put the exception in its place.

    Returns
    -------
    list
        In the order of the scenarios.

    Warns
    -----
    ScenarioWarning
        As of `simulate`, each kind once, with how many runs have it; what is known beforehand of the first 50 scenarios.

    Examples
    --------
    >>> import brinell
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> speeds = [base.replace({"operation.speed_rpm": rpm}) for rpm in (900.0, 1800.0)]
    >>> peaks = brinell.simulate_many(speeds, reduce=lambda result: abs(result.settled["sensor_ax"]).max())
    >>> bool(peaks[0] < peaks[1])
    True
    """
    if errors not in ("raise", "return"):
        raise ValueError(f'errors = "{errors}": not known\n  allowed: raise, return')
    if isinstance(scenarios, (Scenario, str, os.PathLike)):
        raise TypeError(f"scenarios: expected several, and it is one {type(scenarios).__name__}; give [scenario], or call simulate")
    results, warnings = many([given(scenario) for scenario in scenarios], jobs, progress, reduce, errors)
    warn(warnings)
    return results


def many(
    chosen: list[Scenario],
    jobs: int | None,
    progress: Callable[[int, int], object] | None,
    reduce: Callable[[Result], Any] | None = None,
    errors: Literal["raise", "return"] = "raise",
) -> tuple[list[Any], list[str]]:
    """`simulate_many`, and what it warns of."""
    results: list[Any] = [None] * len(chosen)
    over = 0

    def deliver(index: int, run: _brinell.Run | Exception) -> None:
        nonlocal over
        if isinstance(run, Exception):
            told = _told(run, chosen[index])
            if errors == "raise":
                raise told
            results[index] = told
        else:
            result = Result._of(run, chosen[index])
            results[index] = result if reduce is None else reduce(result)
        over += 1
        if progress is not None:
            progress(over, len(chosen))

    return results, _brinell.simulate_many([scenario._native for scenario in chosen], jobs_of(jobs), deliver)
