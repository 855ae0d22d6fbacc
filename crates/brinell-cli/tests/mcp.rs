//! `brinell mcp`: the commands as tools of an agent, and what keeps them in their folder.

use crate::common::{GIVEN, SHORT, brinell, column, command, files, folder_with, impacts, parsed};
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Stdio};

/// An agent's side of the protocol.
struct Agent {
    process: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    id: u64,
    /// Its instructions.
    told: String,
}

impl Agent {
    fn unknown_to(folder: &Path) -> Self {
        let mut process = command(folder, &["mcp", "."])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("brinell starts");
        let (input, output) = (process.stdin.take(), process.stdout.take().expect("it is piped"));
        Self { process, input, output: BufReader::new(output), id: 0, told: String::new() }
    }

    fn of(folder: &Path) -> Self {
        let mut agent = Self::unknown_to(folder);
        let client = json!({ "name": "test", "version": "1" });
        let hello = json!({ "protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": client });
        let server = agent.ask("initialize", &hello)["result"].clone();
        assert_eq!(server["serverInfo"]["name"], "brinell");
        agent.told = server["instructions"].as_str().unwrap().to_owned();
        agent.send(r#"{"jsonrpc":"2.0","method":"notifications/initialized"}"#);
        agent
    }

    fn send(&mut self, line: &str) {
        let input = self.input.as_mut().expect("it is open");
        writeln!(input, "{line}").and_then(|()| input.flush()).expect("the server reads");
    }

    /// The next line, without its end.
    fn line(&mut self) -> String {
        let mut line = String::new();
        self.output.read_line(&mut line).expect("the server writes");
        assert!(line.ends_with('\n'), "the server ended: {line:?}");
        line.trim_end().to_owned()
    }

    fn begin(&mut self, method: &str, params: &Value) -> u64 {
        self.id += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.id, "method": method, "params": params }).to_string());
        self.id
    }

    /// Nothing else comes before the answer.
    fn ask(&mut self, method: &str, params: &Value) -> Value {
        let id = self.begin(method, params);
        let answer = parsed(&self.line());
        assert_eq!(answer["id"], id, "{answer}");
        answer
    }

    fn call(&mut self, tool: &str, arguments: &Value) -> Value {
        let answer = self.ask("tools/call", &json!({ "name": tool, "arguments": arguments }));
        assert!(answer["error"].is_null(), "{answer}");
        answer["result"].clone()
    }

    /// The record of a call that succeeds.
    #[track_caller]
    fn record(&mut self, tool: &str, arguments: &Value) -> Value {
        let result = self.call(tool, arguments);
        assert_eq!(result["isError"], false, "{result}");
        let record = &result["structuredContent"];
        assert_eq!(&parsed(result["content"][0]["text"].as_str().unwrap()), record);
        record.clone()
    }

    /// What is said of a call that is refused.
    #[track_caller]
    fn refusal(&mut self, tool: &str, arguments: &Value) -> String {
        let result = self.call(tool, arguments);
        assert_eq!((&result["isError"], &result["structuredContent"]), (&true.into(), &Value::Null), "{result}");
        result["content"][0]["text"].as_str().unwrap().to_owned()
    }

    /// Standard input ends, and with it the server.
    fn leaves(mut self) {
        drop(self.input.take());
        let left: Vec<String> = (&mut self.output).lines().map(|line| line.expect("it is text")).collect();
        assert_eq!(left, [""; 0]);
        let ended = self.process.wait_with_output().expect("brinell ends");
        assert_eq!((ended.status.code(), String::from_utf8_lossy(&ended.stderr).as_ref()), (Some(0), ""));
    }
}

/// `[..]` is anything.
fn alike(shown: &str, line: &str) -> bool {
    let mut pieces = shown.split("[..]");
    let Some(mut rest) = line.strip_prefix(pieces.next().unwrap_or_default()) else {
        return false;
    };
    let mut last = None;
    for piece in pieces {
        let Some(at) = rest.find(piece) else { return false };
        rest = &rest[at + piece.len()..];
        last = Some(piece);
    }
    last.map_or(rest.is_empty(), |last| line.ends_with(last))
}

#[test]
fn regress_the_transcript_of_the_book_is_what_happens() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/agents.md");
    let page = fs::read_to_string(page).unwrap();
    let block = |fence: &str| {
        let (_, from) = page.split_once(fence).expect(fence);
        from.split_once("```").expect("its end").0.to_owned()
    };
    let folder = folder_with("spall.toml", &block("```toml\n"));
    let transcript = block("```text\n");
    let mut agent = Agent::unknown_to(folder.path());
    let mut answers = 0;
    for shown in transcript.lines() {
        match shown.split_at(2) {
            ("> ", line) => agent.send(line),
            ("< ", shown) => {
                let line = agent.line();
                assert!(alike(shown, &line), "the book has\n{shown}\nand there is\n{line}");
                answers += 1;
            }
            _ => panic!("{shown:?} is nobody's"),
        }
    }
    assert!(answers > 5, "{transcript}");
    agent.leaves();
}

#[test]
fn prop_tools_answer_with_what_the_commands_print() {
    let folder = folder_with("short.toml", SHORT);
    column(&folder.path().join("signal.csv"), &impacts(6.0));
    let printed = |args: &[&str]| parsed(&brinell(folder.path(), args).exits(0).out);
    let mut agent = Agent::of(folder.path());
    assert_eq!(
        agent.record("frequencies", &json!({ "bearing": "NN3007", "speed_rpm": "30 Hz" })),
        printed(&["frequencies", "NN3007", "--speed", "1800", "--json"])
    );
    assert_eq!(
        agent.record(
            "frequencies",
            &json!({ "rollers": 13, "pitch_mm": 39, "diameter_mm": 7.5, "contact_angle_deg": null })
        ),
        printed(&["frequencies", "--rollers", "13", "--pitch", "39", "--diameter", "7.5", "--json"])
    );
    let set = json!({ "operation.load_n": [500, 0.0], "defects.0.shape": { "circle": { "diameter_mm": 3.0 } }, "simulation.model": "lumped" });
    assert_eq!(
        agent.record("check", &json!({ "scenario": "short.toml", "set": set })),
        printed(&[
            "check",
            "short.toml",
            "--set=operation.load_n=[500,0]",
            "--set=defects.0.shape={circle={diameter_mm=3}}",
            "--set=simulation.model=lumped",
            "--json"
        ])
    );
    let ran = agent
        .record("run", &json!({ "scenario": "short.toml", "output": "out", "signals": ["npz"], "no_report": true }));
    assert_eq!(ran, parsed(&fs::read_to_string(folder.path().join("out/summary.json")).unwrap()));
    assert_eq!(files(&folder.path().join("out")), ["scenario.toml", "signals.npz", "summary.json"]);
    let given = json!({ "files": "signal.csv", "rate_hz": 12000, "unit": "g", "bearing": ["6205"], "speed_rpm": 1800, "band_hz": [1500, 5000] });
    let words = [&["analyze", "signal.csv", "--json=-", "--band", "1500", "5000"], &GIVEN[..]].concat();
    assert_eq!(agent.record("analyze", &given), printed(&words));
    let vary = json!({ "operation.speed_rpm": [1500, 1600], "simulation.model": "full,lumped" });
    let swept = agent.record("sweep", &json!({ "scenario": "short.toml", "vary": vary, "output": "swept" }));
    let rows: Vec<_> = swept["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| (&row["operation.speed_rpm"], &row["simulation.model"]))
        .collect();
    let row = |rpm: f64, model: &str| (json!(rpm), json!(model));
    let expected = [row(1500.0, "full"), row(1500.0, "lumped"), row(1600.0, "full"), row(1600.0, "lumped")];
    assert!(
        rows.iter().map(|row| (row.0.as_f64(), row.1)).eq(expected.iter().map(|row| (row.0.as_f64(), &row.1))),
        "{swept}"
    );
    let only = json!(["rows.operation.speed_rpm", "points.complete", "none"]);
    let resumed = json!({ "scenario": "short.toml", "vary": vary, "output": "swept", "only": only });
    let parts = agent.call("sweep", &resumed);
    let expected =
        json!({ "rows.operation.speed_rpm": [1500.0, 1500.0, 1600.0, 1600.0], "points.complete": 4, "none": null });
    assert_eq!(parts["structuredContent"], expected);
    assert!(
        parts["content"][1]["text"].as_str().unwrap().contains("only: none is not in the record, which has brinell"),
        "{parts}"
    );
    agent.leaves();
}

#[test]
fn prop_each_tool_has_a_schema_with_words_for_each_key() {
    let folder = tempfile::tempdir().unwrap();
    let mut agent = Agent::of(folder.path());
    let tools = agent.ask("tools/list", &json!({}))["result"]["tools"].clone();
    let names: Vec<&str> = tools.as_array().unwrap().iter().map(|tool| tool["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["frequencies", "check", "run", "analyze", "sweep"]);
    for tool in tools.as_array().unwrap() {
        let schema = &tool["inputSchema"];
        assert_eq!((&schema["type"], &schema["additionalProperties"]), (&json!("object"), &json!(false)));
        assert!(
            schema["required"]
                .as_array()
                .unwrap()
                .iter()
                .all(|key| schema["properties"].get(key.as_str().unwrap()).is_some())
        );
        for (key, about) in schema["properties"].as_object().unwrap() {
            assert!(
                about["description"].as_str().is_some_and(|words| words.len() > 10) && about["type"] != Value::Null,
                "{key}"
            );
        }
    }
    // The example that it is told of is one.
    let (_, example) = agent.told.split_once("A scenario:\n").unwrap();
    fs::write(folder.path().join("example.toml"), example).unwrap();
    agent.record("check", &json!({ "scenario": "example.toml" }));
    let of = |k: usize| &tools[k]["inputSchema"];
    assert_eq!(of(3)["properties"]["rate_hz"]["type"], json!(["number", "string"]));
    assert_eq!(of(3)["properties"]["band_hz"]["minItems"], 2);
    assert_eq!(of(2)["properties"]["plots"]["items"]["enum"], json!(["svg", "png", "pdf"]));
    assert_eq!((&of(2)["required"], &of(3)["required"]), (&json!(["scenario"]), &json!(["files"])));
    agent.leaves();
}

#[test]
fn prop_bad_input_is_refused_with_words_and_the_server_goes_on() {
    let folder = folder_with("short.toml", SHORT);
    fs::write(folder.path().join("bad.toml"), SHORT.replace("depth_um = 20.0", "depth_um = -20.0")).unwrap();
    let mut agent = Agent::of(folder.path());
    let mut refuses = |tool: &str, input: Value, words: &[&str]| {
        let said = agent.refusal(tool, &input);
        for word in words {
            assert!(said.contains(word), "{tool} {input}: no {word:?} in {said}");
        }
    };
    refuses("frequencies", json!({ "bearing": "6205", "speed": 1800 }), &["speed = 1800: not a key", "speed_rpm"]);
    refuses(
        "frequencies",
        json!({ "bearing": "6205", "speed_rpm": 0 }),
        &["--speed 0: expected a speed other than 0, in r/min"],
    );
    refuses("frequencies", json!({ "bearing": "6205", "speed_rpm": [1] }), &["speed_rpm = [1]: expected a number"]);
    refuses("frequencies", json!({ "bearing": "none such" }), &["none such"]);
    refuses("frequencies", json!({ "rollers": 2.5 }), &["rollers = 2.5: expected a whole number"]);
    refuses("check", json!({}), &["scenario: missing"]);
    refuses("check", json!({ "scenario": "bad.toml" }), &["defects.0.depth_um = -20", "allowed"]);
    refuses("check", json!({ "scenario": "none.toml" }), &["cannot read none.toml"]);
    refuses("check", json!({ "scenario": "short.toml", "set": { "operation.speed": 1 } }), &["operation.speed"]);
    refuses("check", json!({ "scenario": "short.toml", "set": ["a=1"] }), &["set = [\"a=1\"]: expected an object"]);
    refuses("run", json!({ "scenario": ["short.toml", "short.toml"] }), &["expected a text"]);
    refuses("run", json!({ "scenario": "short.toml", "signals": ["mp3"] }), &["mp3", "parquet"]);
    refuses(
        "run",
        json!({ "scenario": "short.toml", "no_report": "yes" }),
        &["no_report = \"yes\": expected true or false"],
    );
    refuses("run", json!({ "scenario": "short.toml", "set": { "simulation.duration_s": 1e5 } }), &["most_steps"]);
    refuses("analyze", json!({ "files": ["short.toml"] }), &["is no file of signals"]);
    refuses("analyze", json!({ "files": ["x.csv"], "band_hz": ["--json=x", "--quiet"] }), &["expected two numbers"]);
    refuses("sweep", json!({ "scenario": "short.toml" }), &["nothing varies"]);
    // What looks like an option is a value.
    refuses("check", json!({ "scenario": "--help" }), &["cannot read --help"]);
    refuses("check", json!({ "scenario": "-" }), &["cannot read ./-"]);
    refuses(
        "check",
        json!({ "scenario": "short.toml", "only": [[]] }),
        &["only = [[]]: expected a list, each of its values a text"],
    );
    refuses("analyze", json!({ "files": ["--json=x.json"] }), &["--json=x.json"]);
    refuses("run", json!({ "scenario": "short.toml", "output": "a\u{0}b" }), &["error"]);
    assert_eq!(files(folder.path()), ["bad.toml", "short.toml"]);

    let unknown = agent.ask("tools/call", &json!({ "name": "studio", "arguments": {} }));
    assert!(
        unknown["error"]["message"].as_str().unwrap().contains("studio: no such tool; allowed: frequencies"),
        "{unknown}"
    );
    assert!(agent.ask("resources/list", &json!({}))["result"]["resources"].as_array().is_none_or(Vec::is_empty));
    agent.send("no JSON");
    agent.send(r#"{"jsonrpc":"2.0","id":"#);
    let id = agent.begin("ping", &json!({}));
    loop {
        let answer = parsed(&agent.line());
        if answer["id"] == id {
            break;
        }
        // What is no JSON may be answered, by no one's id.
        assert!(answer["error"]["code"].is_number(), "{answer}");
    }
    agent.leaves();
}

/// Every way out of the folder that an input, or a scenario in it, can name.
#[test]
fn prop_nothing_outside_the_folder_is_read_or_written() {
    const SECRET: &str = "a secret of somebody else";
    let all = tempfile::tempdir().unwrap();
    let (folder, outside) = (all.path().join("folder"), all.path().join("outside"));
    for made in [&folder, &folder.join("signals"), &outside] {
        fs::create_dir(made).unwrap();
    }
    let short = |path: &Path| fs::write(path, SHORT).unwrap();
    short(&folder.join("short.toml"));
    // Whose law takes tables.
    let half_space = SHORT.replace("laws = \"li2023\"\n", "");
    fs::write(folder.join("half-space.toml"), &half_space).unwrap();
    // Each would do, were it in the folder.
    short(&outside.join("short.toml"));
    fs::write(outside.join("secret.toml"), SECRET).unwrap();
    fs::write(outside.join("dates.csv"), "signal.csv,2024-01-01\nother.csv,2024-01-02\n").unwrap();
    for name in ["signal.csv", "other.csv"] {
        column(&outside.join(name), &impacts(6.0));
        column(&folder.join("signals").join(name), &impacts(6.0));
    }
    fs::write(
        outside.join("spall.svg"),
        r#"<svg xmlns="http://www.w3.org/2000/svg"><rect width="2" height="2"/></svg>"#,
    )
    .unwrap();
    fs::write(outside.join("depth.csv"), "0,0,0\n0,9,0\n0,0,0\n").unwrap();
    fs::write(outside.join("table.csv"), "s,delta,delta_eff\n").unwrap();
    let absolute = |name: &str| outside.join(name).display().to_string();
    let shape = |shape: &str| {
        let name = format!("{}.toml", files(&folder).len());
        let old = "shape = { rectangle = { length_mm = 2.0, width_mm = 4.0 } }";
        assert!(SHORT.contains(old));
        fs::write(folder.join(&name), half_space.replace(old, shape)).unwrap();
        name
    };
    let image = |file: &str| {
        format!("shape = {{ image = {{ file = \"{file}\", mm_per_pixel = 0.02, rolling_direction = \"right\" }} }}")
    };
    let named = [
        shape(&image("../outside/spall.png")),
        shape(&image(&absolute("spall.png"))),
        shape("shape = { svg = { file = \"../outside/spall.svg\" } }"),
        shape(
            "shape = { depth_map = { file = \"../outside/depth.csv\", ds_mm = 0.5, dz_mm = 0.5, rolling_direction = \"right\" } }",
        ),
        shape("shape = { rectangle = { length_mm = 2.0, width_mm = 4.0 } }\ntable = \"../outside/table.csv\""),
    ];
    let mut inputs: Vec<(&str, Value)> = Vec::new();
    for scenario in &named {
        inputs.extend(["check", "run", "frequencies"].map(|tool| {
            (tool, if tool == "frequencies" { json!({ "bearing": scenario }) } else { json!({ "scenario": scenario }) })
        }));
    }
    let mut ways = vec!["../outside".to_owned(), outside.display().to_string(), "signals/../../outside".into()];
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink("../outside", folder.join("link")).unwrap();
        symlink("../outside/secret.toml", folder.join("secret.toml")).unwrap();
        symlink("../outside/nothing", folder.join("nothing")).unwrap();
        fs::create_dir(folder.join("linked")).unwrap();
        symlink("../../outside/signal.csv", folder.join("linked/signal.csv")).unwrap();
        ways.push("link".into());
        inputs.push(("check", json!({ "scenario": "secret.toml" })));
        inputs.push(("check", json!({ "scenario": shape(&image("link/spall.png")) })));
        inputs.push(("run", json!({ "scenario": "short.toml", "output": "nothing" })));
        inputs.push(("run", json!({ "scenario": "short.toml", "output": "nothing/more" })));
        inputs.push(("analyze", json!({ "files": ["linked"] })));
        inputs.push(("analyze", json!({ "files": ["linked/signal.csv"] })));
    }
    for way in &ways {
        let to = |name: &str| format!("{way}/{name}");
        let signal = "signals/signal.csv";
        inputs.extend([
            ("frequencies", json!({ "bearing": to("short.toml") })),
            ("check", json!({ "scenario": to("short.toml") })),
            ("check", json!({ "scenario": to("secret.toml") })),
            ("run", json!({ "scenario": to("short.toml") })),
            ("run", json!({ "scenario": "short.toml", "output": to("new") })),
            ("run", json!({ "scenario": "short.toml", "output": to("new"), "overwrite": true })),
            // What lies there is not told either.
            ("run", json!({ "scenario": "short.toml", "output": way })),
            ("sweep", json!({ "scenario": "short.toml", "vary": { "operation.speed_rpm": [1500] }, "output": way })),
            ("check", json!({ "scenario": "half-space.toml", "set": { "defects.0.table": to("table.csv") } })),
            ("sweep", json!({ "scenario": to("short.toml"), "vary": { "operation.speed_rpm": [1500] } })),
            ("sweep", json!({ "scenario": "short.toml", "vary": { "operation.speed_rpm": [1500] }, "output": to("new") })),
            ("sweep", json!({ "scenario": "half-space.toml", "vary": { "defects.0.table": [to("table.csv")] } })),
            ("sweep", json!({ "scenario": "half-space.toml", "together": [{ "operation.speed_rpm": [1500], "defects.0.table": [to("table.csv")] }] })),
            ("analyze", json!({ "files": [to("signal.csv")] })),
            ("analyze", json!({ "files": [way] })),
            ("analyze", json!({ "files": [signal, to("signal.csv")] })),
            ("analyze", json!({ "files": [signal], "bearing": [to("short.toml")] })),
            ("analyze", json!({ "files": [signal], "against": to("signal.csv") })),
            ("analyze", json!({ "files": [signal], "against": way })),
            ("analyze", json!({ "files": ["signals"], "trend": true, "date": [to("dates.csv")] })),
            ("analyze", json!({ "files": [signal], "rate_hz": 12000, "unit": "g", "bearing": ["6205"], "speed_rpm": 1800, "output": to("new") })),
        ]);
    }
    let before = files(all.path());
    let mut agent = Agent::of(&folder);
    for (tool, input) in inputs {
        let said = agent.refusal(tool, &input);
        assert!(
            said.contains("outside of the folder that `brinell mcp` was given; allowed: paths that count from it"),
            "{tool} {input}: {said}"
        );
        assert!(!said.contains(SECRET), "{said}");
        // Of a folder of results not even the names.
        let told = files(&outside).into_iter().find(|name| input["output"].is_string() && said.contains(name));
        assert_eq!(told, None, "{tool} {input}: {said}");
    }
    assert_eq!(files(all.path()), before);
    // A path that stays within is taken, whatever it looks like.
    for path in ["short.toml", "signals/../short.toml", "../folder/short.toml"] {
        agent.record("check", &json!({ "scenario": path }));
    }
    agent.record("check", &json!({ "scenario": folder.canonicalize().unwrap().join("short.toml") }));
    agent.leaves();
}

/// A run of years does not keep the server from answering. It ends when it is cancelled, when the agent leaves, and when the server
/// is ended.
#[test]
fn prop_a_long_run_blocks_nothing_and_ends_with_its_call() {
    let folder = folder_with("short.toml", SHORT);
    let set = json!({ "simulation.duration_s": 1e4, "simulation.most_steps": 1e12 });
    let long = json!({ "scenario": "short.toml", "output": "out", "no_healthy": true, "set": set });
    let begun = || {
        let mut agent = Agent::of(folder.path());
        let id = agent.begin("tools/call", &json!({ "name": "run", "arguments": long }));
        while !folder.path().join("out/signals.parquet.partial").exists() {
            agent.ask("ping", &json!({}));
        }
        agent.record("frequencies", &json!({ "bearing": "6205" }));
        // As long as a run writes there, another one is refused.
        let busy = json!({ "scenario": "short.toml", "output": "out" });
        assert!(agent.refusal("run", &busy).contains("out/signals.parquet"));
        (agent, id)
    };
    let has_ended = || {
        brinell(folder.path(), &["run", "short.toml", "-o", "out", "--quiet"]).exits(0);
        fs::remove_dir_all(folder.path().join("out")).unwrap();
    };
    let (mut agent, id) = begun();
    agent.send(
        &json!({ "jsonrpc": "2.0", "method": "notifications/cancelled", "params": { "requestId": id } }).to_string(),
    );
    // The server takes one message after the other.
    agent.ask("ping", &json!({}));
    let again = json!({ "scenario": "short.toml", "output": "out" });
    while agent.call("run", &again)["isError"] == true {}
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    agent.leaves();

    let (agent, _) = begun();
    agent.leaves();
    has_ended();

    #[cfg(unix)]
    {
        let (mut agent, _) = begun();
        let kill = std::process::Command::new("kill").arg(agent.process.id().to_string()).status();
        assert!(kill.expect("kill starts").success());
        assert_eq!(agent.process.wait().expect("brinell ends").code(), Some(0));
        has_ended();
    }
}

#[test]
fn prop_what_is_no_folder_is_not_served() {
    let folder = folder_with("short.toml", SHORT);
    brinell(folder.path(), &["mcp", "none"]).exits(2).complains(&["cannot read none"]);
    brinell(folder.path(), &["mcp", "short.toml"]).exits(2).complains(&["short.toml: a file, expected a folder"]);
    brinell(folder.path(), &["mcp"]).exits(2).complains(&["FOLDER"]);
}
