"""The studio in a notebook: its engine, its page, its widget, and all of them in Chromium where there is one."""

import http.server
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from test_scenario import OPERATION

import brinell
from brinell import _brinell
from brinell.notebook import page, script

SHORT = {"simulation.duration_s": 0.05}
PADDING = 8


def encoded(**request):
    text = json.dumps(request).encode()
    return len(text).to_bytes(4, "little") + text + bytes(-(4 + len(text)) % PADDING)


def decoded(message):
    length = int.from_bytes(message[:4], "little")
    start = 4 + length + -(4 + length) % PADDING

    def array(node):
        if "$" not in node:
            return node
        kind, offset, count = node["$"]
        return np.frombuffer(message, {"f32": "<f4", "f64": "<f8", "u8": "u1"}[kind], count, start + offset)

    return json.loads(message[4 : 4 + length], object_hook=array)


def ask(engine, **request):
    return decoded(engine.ask(encoded(**request)))


@pytest.fixture
def studio(base):
    pytest.importorskip("anywidget")
    made = brinell.studio(base.replace(SHORT))
    sent = []
    made.send = lambda content, buffers=(): sent.append((content, list(buffers)))
    made.sent = sent
    yield made
    made.close()


def asked(studio, view="v", number=1, **request):
    studio._hear(studio, {"do": "ask", "view": view, "id": number}, [memoryview(encoded(**request))])
    return studio.sent[-1]


def test_xval_the_engine_of_the_page_gives_the_samples_of_a_run(base):
    engine = _brinell.StudioEngine()
    assert ask(engine, do="about")["engine"] == "native"
    scenario = base.replace(SHORT)
    opened = ask(engine, do="open", slot=0, toml=scenario.to_toml(), carry=False)
    assert opened["ok"] and not opened["live"]
    parts = []
    while not parts or not parts[-1]["done"]:
        parts.append(ask(engine, do="advance", slot=0, rows=500, frames=False))
    heard, run = np.concatenate([part["x"] for part in parts]), brinell.simulate(scenario)["sensor_ax"]
    np.testing.assert_array_equal(heard, run.astype(np.float32))
    spectra = ask(engine, do="spectra", slot=0, longest=1024)
    assert spectra["samples"] == 1024 and len(spectra["spectrum"]["values"]) == 513
    refused = ask(engine, do="open", slot=0, toml="bearing = 1", carry=False)
    assert not refused["ok"] and refused["problems"][0]["message"]
    assert not ask(engine, do="nothing")["ok"] and not decoded(engine.ask(b""))["ok"]


def test_prop_the_engine_gives_up_the_lock_while_it_works(base):
    engine, counted, stop = _brinell.StudioEngine(), [0], threading.Event()
    request = encoded(do="open", slot=0, toml=base.to_toml(), carry=False)

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.0001)

    def gave_up():
        before = counted[0]
        engine.ask(request)
        return counted[0] > before

    # Nobody is made to give it up, so the other thread counts within `ask` or not at all.
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    thread = threading.Thread(target=count)
    try:
        thread.start()
        assert any(gave_up() for _ in range(200))
    finally:
        stop.set()
        sys.setswitchinterval(before)
        thread.join()


def test_prop_the_page_holds_every_module_and_nothing_to_fetch():
    text, files = page(), {name: content.decode() for name, _, content in _brinell.studio_page()}
    found = re.search(r'<script type="importmap">(.*?)</script>', text, re.S)
    imports = json.loads(found[1])["imports"]
    assert set(imports) == {name for name in files if name.endswith((".js", ".mjs"))} and len(imports) > 30
    for name, address in imports.items():
        head, code = address.split(",", 1)
        assert head.startswith("data:text/javascript") and not re.search(r"[#\r\n\t]", code)
        plain = re.sub(r"%(23|25|0A|0D|09)", lambda c: chr(int(c[1], 16)), code)
        # Imports go by name, everything else is as it was.
        for target in re.findall(r"""(?:from|^import) ["']([^"']+)["']""", plain, re.M):
            assert target in imports, f"{name}: {target}"
        assert re.sub(r"""["'][^"'\n]*\.m?js["']""", "", plain) == re.sub(r"""["'][^"'\n]*\.m?js["']""", "", files[name]), name
    assert files["studio.css"] in text and 'src="' not in text and "stylesheet" not in text
    assert script("frame.js") in text and text.index("importmap") < text.index("brinellEngine") < text.index('import "src/main.js"')


def test_prop_the_scenario_goes_both_ways(studio, base):
    text = studio.scenario
    assert brinell.Scenario.from_toml(text) == base.replace(SHORT)
    faster = text.replace("speed_rpm = 1800", "speed_rpm = 1500")
    assert faster != text
    # From the page.
    content, buffers = asked(studio, do="open", slot=0, toml=faster, carry=False)
    assert content == {"view": "v", "id": 1} and decoded(buffers[0])["ok"]
    assert brinell.Scenario.from_toml(studio.scenario)["operation.speed_rpm"] == 1500.0 and studio.problems == []
    assert all("load" not in content for content, _ in studio.sent)
    kept = studio.scenario
    # Bearing B is not the studio's.
    asked(studio, do="open", slot=1, toml=text, carry=False)
    assert studio.scenario == kept
    # From the notebook.
    studio.scenario = text
    assert studio.sent[-1] == ({"load": text}, [])
    with pytest.raises(brinell.ScenarioError, match="speed_rpm"):
        studio.scenario = text.replace("speed_rpm = 1800", 'speed_rpm = "fast"')
    assert studio.scenario == text


def test_prop_what_was_refused_and_the_indicators_are_reported(studio):
    asked(studio, do="open", slot=0, toml=studio.scenario, carry=False)
    kept = studio.scenario
    asked(studio, do="open", slot=0, toml=kept.replace("depth_um = 20", "depth_um = -20"), carry=True)
    assert studio.problems[0]["key"] == "defects[1].depth_um" and studio.problems[0]["message"] and studio.scenario == kept
    asked(studio, do="advance", slot=0, rows=2000)
    asked(studio, do="indicators", slot=0)
    assert {"sensor_ax.rms", "RMS"} & set(studio.indicators)
    asked(studio, do="open", slot=0, toml=kept, carry=False)
    assert studio.problems == []


def test_prop_a_run_is_the_one_of_the_scenario_as_it_stands(studio, base):
    result = studio.run()
    np.testing.assert_array_equal(result["sensor_ax"], brinell.simulate(base.replace(SHORT))["sensor_ax"])
    asked(studio, do="open", slot=0, toml=studio.scenario.replace("speed_rpm = 1800", "speed_rpm = 1500"), carry=False)
    assert studio.run().scenario["operation.speed_rpm"] == 1500.0


def test_prop_each_page_has_an_engine_and_the_oldest_loses_it(studio):
    for view in "abcd":
        asked(studio, view, do="open", slot=0, toml=studio.scenario, carry=False)
    asked(studio, "a", do="advance", slot=0, rows=10)
    assert decoded(studio.sent[-1][1][0])["first"] == 0
    asked(studio, "b", do="advance", slot=0, rows=10)
    assert decoded(studio.sent[-1][1][0])["first"] == 0
    asked(studio, "e", do="about")
    content, _ = asked(studio, "a", do="advance", slot=0, rows=10)
    assert content["view"] == "a" and "lost" in content
    # Then its page opens its bearing in another.
    assert decoded(asked(studio, "a", do="open", slot=0, toml=studio.scenario, carry=False)[1][0])["ok"]
    studio._hear(studio, {"do": "close", "view": "a"}, [])
    assert "a" not in studio._engines


def test_prop_files_of_damage_go_with_the_scenario(examples):
    pytest.importorskip("anywidget")
    scenario = brinell.Scenario.from_file(examples / "scan.toml", SHORT)
    studio = brinell.studio(scenario)
    assert ask(_brinell.StudioEngine(), do="open", toml=studio.scenario, carry=False)["ok"]
    studio.close()


def test_prop_without_anywidget_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(ImportError, match="pip install anywidget"):
        brinell.studio()


HOST = """<!doctype html><meta charset="utf-8"><style>STYLE</style><body><script type="module">
import widget from "/widget.js";
const heard = [], el = document.body;
const model = {
  get: () => SCENARIO,
  send: (content, _, buffers) => fetch("/send", { method: "POST", headers: { "X-Content": JSON.stringify(content) }, body: buffers[0] ?? "" }),
  on: (_, act) => heard.push(act), off: () => {},
};
widget.render({ model, el });
for (;;) {
  const got = await fetch("/next"), bytes = await got.arrayBuffer();
  for (const act of heard) act(JSON.parse(got.headers.get("X-Content")), bytes.byteLength ? [new DataView(bytes)] : []);
}
</script>"""


class Host:
    """A page that shows the widget, as a notebook would, with the messages over HTTP."""

    def __init__(self, studio):
        self.outbox, self.requests = queue.Queue(), []
        studio.send = lambda content, buffers=(): self.outbox.put((content, list(buffers)))
        scenario = json.dumps(studio.scenario)
        host = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def log_message(self, *_):
                pass

            def answer(self, body=b"", kind="text/html; charset=utf-8", content=None):
                self.send_response(200)
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", str(len(body)))
                if content is not None:
                    self.send_header("X-Content", json.dumps(content))
                self.end_headers()
                self.wfile.write(body)

            def do_GET(self):
                if self.path == "/next":
                    content, buffers = host.outbox.get()
                    return self.answer(buffers[0] if buffers else b"", "application/octet-stream", content)
                if self.path == "/widget.js":
                    return self.answer(script("widget.js").encode(), "text/javascript")
                text = HOST.replace("STYLE", script("widget.css")).replace("SCENARIO", scenario)
                return self.answer(text.encode())

            def do_POST(self):
                content, body = json.loads(self.headers["X-Content"]), self.rfile.read(int(self.headers.get("Content-Length") or 0))
                if content["do"] == "ask":
                    length = int.from_bytes(body[:4], "little")
                    host.requests.append(json.loads(body[4 : 4 + length]))
                studio._hear(studio, content, [memoryview(body)] if body else [])
                self.answer()

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server.server_port}/"

    def wait(self, until, limit_s=120.0):
        end = time.monotonic() + limit_s
        while not until():
            assert time.monotonic() < end, f"the page asked {[r['do'] for r in self.requests][-20:]}"
            time.sleep(0.05)

    def close(self):
        self.server.shutdown()
        self.server.server_close()


def test_prop_the_widget_lives_in_chromium(base, tmp_path):
    pytest.importorskip("anywidget")
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium:
        pytest.skip("no Chromium")
    studio = brinell.studio(brinell.Scenario(name="mine", bearing="NU205", operation=OPERATION, simulation={"duration_s": 0.1}))
    host = Host(studio)
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", f"--user-data-dir={tmp_path}", "--window-size=1400,1000"]
    browser = subprocess.Popen([chromium, *flags, "--remote-debugging-port=0", host.address], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        host.wait(lambda: studio.indicators)
        opened = [request for request in host.requests if request["do"] == "open" and request["slot"] == 0]
        assert 'name = "mine"' in opened[0]["toml"]
        assert brinell.Scenario.from_toml(studio.scenario).name == "mine" and studio.problems == []
        assert {"about", "advance", "damage", "spectra", "sound"} <= {request["do"] for request in host.requests}
        # The notebook puts another bearing there.
        studio.scenario = base.to_toml()
        host.wait(lambda: any(r["do"] == "open" and r.get("toml") == base.to_toml() for r in host.requests))
        seen = len(host.requests)
        host.wait(lambda: any(r["do"] == "spectra" for r in host.requests[seen:]))
        assert brinell.Scenario.from_toml(studio.scenario) == base
    finally:
        browser.terminate()
        browser.wait()
        host.close()
        studio.close()
