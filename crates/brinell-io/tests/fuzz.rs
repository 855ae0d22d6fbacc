//! Mutated files against all readers: no bytes may make one panic, hang or take much memory. A program of its own: its
//! panic hook and peak memory are the process's.
//!
//! A few seconds in the suite, the same mutations each time; `BRINELL_FUZZ_SECONDS=600` goes on for so long,
//! `BRINELL_FUZZ_SEED` takes others. The seeds are the files in `tests/data/` and `tests/corpus/`; a file that breaks a
//! reader is kept in the latter and replayed from then on. Panics of other people's readers are caught in the library
//! and told as damage; here only our own count. Each file is read from the disk and from memory, which must come to the
//! same.
#![cfg(all(feature = "parquet", feature = "hdf5", feature = "npz"))]

use std::ops::ControlFlow;
use std::panic;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use brinell_io::{Column, Format, IoError, Metadata, Outcome, SignalFile, keys, open, open_bytes};

/// Mutations of the suite's run, whatever the machine's speed.
const RUNS: u64 = 6_000;
const MAX_VALUES: u64 = 1 << 21;

static OURS: AtomicUsize = AtomicUsize::new(0);
static THEIRS: AtomicUsize = AtomicUsize::new(0);

struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(name)
}

const WORDS: [&[u8]; 26] = [
    b"0",
    b"-1",
    b"1e308",
    b"nan",
    b",",
    b";",
    b"\t",
    b"\n",
    b"\"",
    b"#",
    b".",
    b"    -1\n",
    b"    58b",
    b"(999999999999,)",
    b"'<f2'",
    b"data",
    b"LIST",
    b"PK\x01\x02",
    b"\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\0\0\0\0",
    b"\x0e\0\0\0",
    b"\x0f\0\0\0",
    b"TREE",
    b"SNOD",
    b"\0\0\0\0\0\0\0\x80",
];

fn mutate(noise: &mut Noise, seed: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + noise.below(5) {
        // Headers are at the front, and that is where most can be broken.
        let reach = [64, 512, 4096, usize::MAX][noise.below(4)].min(bytes.len() + 1);
        let at = noise.below(reach);
        let end = (at + noise.below(24)).min(bytes.len());
        match noise.below(10) {
            0..=2 if at < bytes.len() => bytes[at] ^= 1 << noise.below(8),
            3 | 4 if at < bytes.len() => bytes[at] = [0, 0xff, 0x7f, 0x80, 1, 2][noise.below(6)],
            5 => drop(bytes.drain(at..end)),
            6 => {
                let copy = bytes[at..end].to_vec();
                let to = noise.below(bytes.len() + 1);
                drop(bytes.splice(to..to, copy));
            }
            7 => {
                let word = WORDS[noise.below(WORDS.len())];
                let end = (at + word.len()).min(bytes.len());
                let over = if noise.below(3) == 0 { at } else { end };
                drop(bytes.splice(at..over, word.iter().copied()));
            }
            8 => {
                let from = noise.below(other.len());
                let to = (from + noise.below(60)).min(other.len());
                drop(bytes.splice(at..end, other[from..to].iter().copied()));
            }
            _ if noise.below(6) == 0 => bytes.truncate(at),
            _ => {}
        }
    }
    bytes
}

/// What a file comes to.
#[derive(Default, PartialEq)]
struct Seen {
    /// Of errors.
    words: Vec<String>,
    /// Of all values, in order.
    digest: u64,
    /// Whether a channel could be read.
    any: bool,
}

/// Reads what is there, up to a limit.
fn read_all(file: Result<SignalFile, IoError>) -> Seen {
    let mut seen = Seen::default();
    let mut file = match file {
        Ok(file) => file,
        Err(error) => {
            seen.words.push(error.to_string());
            return seen;
        }
    };
    seen.words.extend(file.only_signal().err().map(|e| e.to_string()));
    let names: Vec<String> = file.channels().iter().map(|c| c.name.clone()).collect();
    for name in names.iter().take(40) {
        let mut count = 0;
        let mut take = |values: &[f64]| {
            count += values.len() as u64;
            seen.digest =
                values.iter().fold(seen.digest, |sum, value| (sum ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3));
            if count > MAX_VALUES { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut read = |name: &str| file.read_pieces(name, &mut take);
        let result = match read(name) {
            Err(IoError::Unsupported { .. }) => read(&format!("{name}(:,2)")),
            result => result,
        };
        seen.any |= result.is_ok();
        seen.words.extend(result.err().map(|e| e.to_string()));
    }
    seen
}

fn peak_memory_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? / 1024)
}

fn parquet(path: &Path) {
    let columns = [Column::new("t", "s", ""), Column::new("x", "m", "")];
    let metadata = Metadata::default().with(keys::SAMPLE_RATE_HZ, "100");
    let mut writer = Format::Parquet.create(path, &columns, &metadata).unwrap();
    for i in 0..50 {
        writer.write_row(&[f64::from(i), 0.5]).unwrap();
    }
    writer.finish(Outcome::Complete).unwrap();
}

#[test]
fn prop_no_bytes_make_a_reader_panic() {
    let number = |key: &str| std::env::var(key).ok().and_then(|s| s.parse::<u64>().ok());
    let seconds = number("BRINELL_FUZZ_SECONDS").map(Duration::from_secs);
    let mut noise = Noise(number("BRINELL_FUZZ_SEED").unwrap_or(1).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    // In memory, where the system has such a folder.
    let shm = Path::new("/dev/shm");
    let here = if shm.is_dir() { tempfile::tempdir_in(shm) } else { tempfile::tempdir() }.unwrap();
    parquet(here.path());
    let mut paths = vec![here.path().join("signals.parquet")];
    for name in ["data", "corpus"] {
        let entries = std::fs::read_dir(folder(name)).unwrap();
        let mut files: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
        files.sort();
        paths.extend(files);
    }
    let seeds: Vec<Vec<u8>> = paths.iter().map(|p| std::fs::read(p).unwrap()).collect();
    panic::set_hook(Box::new(|info| {
        let ours = info.location().is_none_or(|l| {
            let file = l.file().replace('\\', "/");
            file.contains("brinell-io/") && !file.contains("registry")
        });
        if ours {
            eprintln!("{info}");
            OURS.fetch_add(1, Ordering::Relaxed);
        } else {
            THEIRS.fetch_add(1, Ordering::Relaxed);
        }
    }));
    let begin = Instant::now();
    let (mut runs, mut readable, mut kept) = (0, 0, 0);
    let mut slowest = Duration::ZERO;
    // No ending that promises anything: the content decides.
    let path = here.path().join("fuzz.bin");
    while runs < RUNS || seconds.is_some_and(|s| begin.elapsed() < s) {
        let pick = &seeds[runs as usize % seeds.len()];
        let other = noise.below(seeds.len());
        let bytes = if runs < seeds.len() as u64 { pick.clone() } else { mutate(&mut noise, pick, &seeds[other]) };
        std::fs::write(&path, &bytes).unwrap();
        let (ours, started) = (OURS.load(Ordering::Relaxed), Instant::now());
        let seen = read_all(open(&path));
        readable += u64::from(seen.any);
        let took = started.elapsed();
        slowest = slowest.max(took);
        let name = path.to_str().unwrap();
        let differs = seen != read_all(open_bytes(name, bytes.clone()));
        let panicked = OURS.load(Ordering::Relaxed) > ours;
        if panicked || differs || took > Duration::from_secs(20) {
            kept += 1;
            let what = match (panicked, differs) {
                (true, _) => "panic",
                (_, true) => "differs",
                _ => "slow",
            };
            std::fs::write(folder("corpus").join(format!("{what}-{:016x}", noise.0)), &bytes).unwrap();
        }
        runs += 1;
    }
    let _ = panic::take_hook();
    let (ours, theirs) = (OURS.load(Ordering::Relaxed), THEIRS.load(Ordering::Relaxed));
    println!(
        "{runs} files, {readable} readable, {ours} panics of ours and {theirs} of others, slowest {slowest:?}, peak memory {:?} MB, {:?}",
        peak_memory_mb(),
        begin.elapsed()
    );
    assert_eq!((ours, kept), (0, 0));
    assert!(peak_memory_mb().is_none_or(|mb| mb < 1500));
}
