//! What the tests of the command share: calling it, and scenarios that run in a moment.

use brinell::random::Random;
use std::f64::consts::TAU;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A scenario on every line of which a test may rely; 20 ms, so that a run takes a tenth of a second. It has the paper's laws,
/// which the numbers and words of the tests are about, and which need no table for damage.
pub(crate) const SHORT: &str = r#"name = "short"

[bearing]
preset = "NU206"
profile = "straight"
[operation]
speed_rpm = 1500.0
load_n = [300.0, 0.0]

[[defects]]
on = "outer-raceway"
center_deg = 0.0
depth_um = 20.0
shape = { rectangle = { length_mm = 2.0, width_mm = 4.0 } }

[simulation]
laws = "li2023"
duration_s = 0.02
sample_rate_hz = 25600.0
"#;

/// What one call did.
#[derive(Debug)]
pub(crate) struct Call {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Call {
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        // A panic would leave by code 101, but a thread's panic need not.
        assert!(!self.err.contains("panicked"), "{self:#?}");
        self
    }

    #[track_caller]
    pub(crate) fn complains(self, parts: &[&str]) -> Self {
        for part in parts {
            assert!(self.err.contains(part), "no {part:?} in {self:#?}");
        }
        self
    }

    #[track_caller]
    pub(crate) fn says(self, parts: &[&str]) -> Self {
        for part in parts {
            assert!(self.out.contains(part), "no {part:?} in {self:#?}");
        }
        self
    }

    #[track_caller]
    pub(crate) fn keeps_quiet(self) -> Self {
        assert_eq!(self.err, "");
        self
    }

    /// Of [`SHORT`], which ends before it has settled: that on standard error, and nothing else.
    #[track_caller]
    pub(crate) fn warns_of_the_short_run_alone(self) -> Self {
        let told = |line: &&str| {
            let short =
                line.starts_with("warning: simulation.duration_s = 0.0") && line.contains("too short to settle");
            short || *line == "  advised: >= 0.160 s" || line.ends_with(".toml:")
        };
        let (told, rest): (Vec<&str>, Vec<&str>) = self.err.lines().partition(told);
        assert!(!told.is_empty() && rest.is_empty(), "{self:#?}");
        self
    }
}

impl From<Output> for Call {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).expect("standard output is UTF-8"),
            err: String::from_utf8(output.stderr).expect("standard error is UTF-8"),
        }
    }
}

/// The words of a line as it is typed, none of which holds a space.
pub(crate) fn typed(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// The command, to be run in `folder`.
pub(crate) fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_brinell"));
    // Results carry the date, and tests hold files against each other.
    command.env("SOURCE_DATE_EPOCH", "1700000000");
    command.current_dir(folder).args(args).stdin(Stdio::null());
    command
}

pub(crate) fn brinell(folder: &Path, args: &[&str]) -> Call {
    command(folder, args).output().expect("brinell starts").into()
}

/// With `input` on standard input.
pub(crate) fn brinell_reading(folder: &Path, args: &[&str], input: &[u8]) -> Call {
    let mut child = command(folder, args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("brinell starts");
    // Bad arguments end the command before it reads.
    let _ = child.stdin.take().expect("standard input is piped").write_all(input);
    child.wait_with_output().expect("brinell ends").into()
}

/// Names of the files in a folder and its subfolders, in order.
pub(crate) fn files(folder: &Path) -> Vec<String> {
    fn walk(root: &Path, folder: &Path, names: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).expect("the folder is there") {
            let path: PathBuf = entry.expect("the entry is readable").path();
            if path.is_dir() {
                walk(root, &path, names);
            } else {
                let name = path.strip_prefix(root).expect("it is inside");
                names.push(name.display().to_string());
            }
        }
    }
    let mut names = Vec::new();
    walk(folder, folder, &mut names);
    names.sort();
    names
}

/// A folder with one file.
pub(crate) fn folder_with(name: &str, text: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), text).expect("it is written");
    folder
}

/// SHORT, four turns of the shaft long, so that there are blocks for intervals, as `name` in a folder of its own.
pub(crate) fn with_blocks(name: &str) -> TempDir {
    let text =
        SHORT.replace("speed_rpm = 1500.0", "speed_rpm = 3000.0").replace("duration_s = 0.02", "duration_s = 0.18");
    folder_with(name, &text)
}

/// A file of the examples.
pub(crate) fn example(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    root.join(name).display().to_string()
}

/// The command where no file may grow beyond so many blocks of 512 bytes.
#[cfg(target_os = "linux")]
pub(crate) fn limited(folder: &Path, blocks: usize, args: &str) -> Call {
    let limited = format!("ulimit -f {blocks}; exec \"$0\" {args}");
    let mut sh = Command::new("sh");
    sh.args(["-c", &limited, env!("CARGO_BIN_EXE_brinell")]).current_dir(folder);
    sh.output().expect("sh starts").into()
}

/// Whole lines of a journal; 0 where there is none yet.
pub(crate) fn lines(journal: &Path) -> usize {
    std::fs::read_to_string(journal).map_or(0, |text| text.lines().count())
}

/// The journal of one folder's results in another, new one, as if killed while it wrote the line after these.
pub(crate) fn cut_journal(from: &Path, whole_lines: usize, to: &Path) {
    let journal = std::fs::read(from.join("journal.jsonl")).unwrap();
    let whole: usize = journal.split_inclusive(|b| *b == b'\n').take(whole_lines).map(<[u8]>::len).sum();
    std::fs::create_dir(to).unwrap();
    std::fs::write(to.join("journal.jsonl"), &journal[..whole + 100]).unwrap();
}

/// A call that gets Ctrl-C once its journal has so many lines.
pub(crate) fn interrupted(folder: &Path, args: &[&str], journal: &Path, at: usize) -> Call {
    let child = command(folder, args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("brinell starts");
    let begin = std::time::Instant::now();
    while lines(journal) < at {
        assert!(begin.elapsed().as_secs() < 60, "no point is finished");
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.expect("kill starts").success());
    child.wait_with_output().expect("brinell ends").into()
}

/// Every file of the results but the journal, whose lines come in the order of completion.
pub(crate) fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = files(folder).into_iter().filter(|n| n != "journal.jsonl");
    names
        .map(|name| {
            let bytes = std::fs::read(folder.join(&name)).expect("it is readable");
            (name, bytes)
        })
        .collect()
}

/// The results in both folders are the same, byte for byte.
#[track_caller]
pub(crate) fn same(a: &Path, b: &Path) {
    let (a, b) = (results(a), results(b));
    let names = |r: &[(String, Vec<u8>)]| r.iter().map(|f| f.0.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for ((name, a), (_, b)) in a.iter().zip(&b) {
        assert!(a == b, "{name} differs");
    }
}

/// A CSV file of numbers: names and rows.
pub(crate) fn csv(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = std::fs::read_to_string(path).expect("the file is there");
    assert!(text.ends_with('\n'), "the last line is whole");
    let mut lines = text.lines();
    let header = lines.next().expect("a header");
    let names: Vec<String> = header.split(',').map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|v| v.parse().expect("a number")).collect()).collect();
    assert!(rows.iter().all(|row| row.len() == names.len()));
    (names, rows)
}

pub(crate) fn json(path: &Path) -> serde_json::Value {
    parsed(&std::fs::read_to_string(path).expect("the file is there"))
}

pub(crate) fn parsed(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("it is JSON")
}

/// Sample rate of the signals that tests analyse, Hz.
pub(crate) const FS: f64 = 12_000.0;

/// Twelve uniform numbers, summed: something like a normal variable.
pub(crate) fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.part()).sum::<f64>() - 6.0
}

/// Two seconds of impacts on the outer race of a 6205 at 1800 r/min, of a height over unit noise.
pub(crate) fn impacts(height: f64) -> Vec<f64> {
    let mut noise = Random::new(7);
    let at = |i: u32| {
        let since = (f64::from(i) / FS) % (1.0 / (3.5848 * 30.0));
        height * (-since / 8e-4).exp() * (TAU * 3000.0 * since).sin()
    };
    (0..24_000).map(|i| at(i) + normal(&mut noise)).collect()
}

/// A file of one column without a name.
pub(crate) fn column(path: &Path, values: &[f64]) {
    let lines: Vec<String> = values.iter().map(|v| format!("{v:.5}\n")).collect();
    std::fs::write(path, lines.concat()).expect("it is written");
}

/// What `analyze` needs beside the file: `6205` at 1800 r/min has BPFO 107.5 Hz.
pub(crate) const GIVEN: [&str; 8] = ["--rate", "12000", "--unit", "g", "--bearing", "6205", "--speed", "1800"];
