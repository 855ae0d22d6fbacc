"""The studio as an anywidget. It needs anywidget; `brinell.studio` says so where that is missing."""

from __future__ import annotations

import json
from typing import Any

import anywidget
import traitlets

from brinell import _brinell
from brinell.notebook import page, script
from brinell.result import Result
from brinell.runs import simulate
from brinell.scenario import Runnable, Scenario, given, template

__all__ = ["Studio"]

#: Pages of one studio that have an engine at a time; one more page gets that of the oldest.
_VIEWS = 4
#: Bearing A, whose scenario is the studio's.
_FIRST_SLOT = 0


def _json(message: bytes) -> dict[str, Any]:
    """What a message says, without its arrays."""
    length = int.from_bytes(message[:4], "little")
    read: dict[str, Any] = json.loads(message[4 : 4 + length])
    return read


def _text(scenario: Scenario) -> str:
    """What its author stated; with overrides or files of damage, everything, as the page has no folder to look into."""
    text, _, _, overrides, resolved = scenario._native.state()
    return scenario.to_toml() if overrides or resolved else text


class Studio(anywidget.AnyWidget):
    """The studio in a notebook: a bearing runs in the kernel while its scenario is edited on the page.

    Each page has an engine of its own in the kernel and starts with the studio's scenario. The kernel answers the page between cells: while a
    cell runs the page waits, and a page that is scrolled out of sight asks for nothing.

    Parameters
    ----------
    scenario : Scenario or path, optional
        Where to begin; the scenario of `template` by default.

    Raises
    ------
    ScenarioError
        With everything that is wrong, also where ``scenario`` is set.
    """

    _esm = script("widget.js")
    _css = script("widget.css")

    scenario = traitlets.Unicode(help="TOML of the bearing that the page shows as A. Setting it puts another one there.").tag(sync=True)
    indicators = traitlets.Dict(
        help="Indicators by name, SI, as the page has them: a `float`, or None. Of a live bearing those of the samples since the last edit."
    ).tag(sync=True)
    problems = traitlets.List(
        traitlets.Dict(), help="What the latest edit was refused for: dicts of key, line and message. The bearing before it runs on."
    ).tag(sync=True)

    def __init__(self, scenario: Runnable | None = None) -> None:
        self._engines: dict[str, _brinell.StudioEngine] = {}
        self._without: set[str] = set()
        self._from_page = False
        text = template() if scenario is None else _text(given(scenario))
        super().__init__(scenario=text)
        self.on_msg(self._hear)

    @traitlets.validate("scenario")
    def _readable(self, proposal: traitlets.Bunch) -> str:
        if not self._from_page:
            return _text(Scenario._of(_brinell.Scenario.parse(proposal.value), quiet=True))
        return str(proposal.value)

    @traitlets.observe("scenario")
    def _changed(self, change: traitlets.Bunch) -> None:
        if not self._from_page and self._engines:
            self.send({"load": change.new})

    def run(self) -> Result:
        """Runs the present scenario from t = 0 to its end: the bits of `simulate` and of ``brinell run``.

        Returns
        -------
        Result
            Signals and findings.

        Raises
        ------
        RunError
            Where the solver could not go on; ``partial`` is the `Result` until then.
        """
        return simulate(Scenario.from_toml(self.scenario))

    def close(self) -> None:
        """Takes the page away and frees its bearings."""
        self._engines.clear()
        super().close()

    def _hear(self, _widget: Any, content: Any, buffers: list[Any]) -> None:
        """A message of a page: it wants itself, an answer, or to be forgotten."""
        view = str(content.get("view"))
        match content.get("do"):
            case "page":
                self.send({"page": "here"}, [page().encode("utf-8")])
            case "ask":
                self._ask(view, content["id"], bytes(buffers[0]))
            case "close":
                self._engines.pop(view, None)
                self._without.discard(view)

    def _ask(self, view: str, number: int, request: bytes) -> None:
        if view in self._without:
            # Its page opens its bearing anew, in another engine.
            self._without.remove(view)
            self.send({"view": view, "lost": "the kernel gave its engine to a newer page"})
            return
        if view not in self._engines:
            if len(self._engines) >= _VIEWS:
                oldest = next(iter(self._engines))
                del self._engines[oldest]
                self._without.add(oldest)
            self._engines[view] = _brinell.StudioEngine()
        answer = self._engines[view].ask(request)
        self.send({"view": view, "id": number}, [answer])
        self._follow(_json(request), answer)

    def _follow(self, asked: dict[str, Any], answer: bytes) -> None:
        """Takes over what the page shows of bearing A."""
        if asked.get("do") not in ("open", "indicators") or asked.get("slot", 0) != _FIRST_SLOT:
            return
        got = _json(answer)
        if asked["do"] == "indicators":
            if got["ok"]:
                self.indicators = {quantity["name"]: quantity["value"] for quantity in got["quantities"]}
            return
        self.problems = [] if got["ok"] else got["problems"]
        if got["ok"]:
            self._from_page = True
            try:
                self.scenario = got["toml"]
            finally:
                self._from_page = False
