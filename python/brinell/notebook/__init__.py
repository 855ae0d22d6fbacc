"""The studio within Jupyter: its page in the notebook, its engine in the kernel."""

from __future__ import annotations

import json
import posixpath
import re
from importlib import resources
from typing import TYPE_CHECKING

from brinell import _brinell, tables
from brinell.scenario import Runnable

if TYPE_CHECKING:
    from brinell.notebook.widget import Studio

__all__ = ["page", "script", "studio"]

_ENTRY = re.compile(r'<script type="module" src="([^"]+)"></script>\n')
#: A frame has no address that could be shared.
_HIDDEN = "#share { display: none; }\n"
_STYLE = '<link rel="stylesheet" href="studio.css">\n'
_IMPORT = re.compile(r"""((?:^|\n|;)\s*(?:import|export)\b[^"';]*?["'])(\.{1,2}/[^"']+)(["'])""")
#: What the address of a module drops, or takes for something else.
_ESCAPED = re.compile(r"[%#\r\n\t]")


def studio(scenario: Runnable | None = None) -> Studio:
    """The studio in a notebook: damage is drawn on a running bearing, and the scenario comes back.

    Parameters
    ----------
    scenario : Scenario or path, optional
        Where to begin; the scenario of `template` by default.

    Returns
    -------
    Studio
        A widget. Its ``scenario`` is the present TOML text, ``run()`` a `Result` of it.

    Raises
    ------
    ImportError
        Without anywidget: ``pip install anywidget``.

    Examples
    --------
    >>> import brinell
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> studio = brinell.studio(scenario)
    >>> studio.run()["sensor_ax"].shape
    (25601,)
    """
    tables.need("anywidget")
    from brinell.notebook.widget import Studio

    return Studio(scenario)


def script(name: str) -> str:
    """A script of this folder.

    Examples
    --------
    >>> from brinell.notebook import script
    >>> "export default" in script("widget.js")
    True
    """
    return resources.files(__name__).joinpath(name).read_text(encoding="utf-8")


def _whole(name: str, source: str) -> str:
    """A module whose imports are by name: an address of its own has no folder."""

    def named(found: re.Match[str]) -> str:
        return found[1] + posixpath.normpath(posixpath.join(posixpath.dirname(name), found[2])) + found[3]

    return _IMPORT.sub(named, source)


def _within(text: str) -> str:
    """JSON within a script element, which nothing in it may end."""
    return text.replace("</", "<\\/").replace("<!--", "<\\u0021--")


def page() -> str:
    """The studio's page as one text, for an ``<iframe srcdoc>``: every module is a ``data:`` URL of an import map.

    Its engine is what the page around it passes messages to; ``frame.js`` says how.

    Examples
    --------
    >>> from brinell.notebook import page
    >>> page().count('<script type="importmap">')
    1
    """
    files = {name: content.decode("utf-8") for name, _, content in _brinell.studio_page()}
    html, style = files["index.html"], files["studio.css"]
    modules = {name: _whole(name, text) for name, text in files.items() if name.endswith((".js", ".mjs"))}
    escape = "data:text/javascript;charset=utf-8,"
    imports = {name: escape + _ESCAPED.sub(lambda c: f"%{ord(c[0]):02X}", text) for name, text in modules.items()}
    entries = _ENTRY.findall(html)
    start = "".join(f"import {json.dumps(name)};\n" for name in entries)
    head = (
        f"<style>\n{style}{_HIDDEN}</style>\n"
        f'<script type="importmap">{_within(json.dumps({"imports": imports}))}</script>\n'
        f"<script>\n{script('frame.js')}</script>\n"
    )
    html = _ENTRY.sub("", html).replace(_STYLE, head)
    return html.replace("</body>", f'<script type="module">\n{start}</script>\n</body>')
