//! What the Rust programs of `benches/peers` share: the problem, the layout of states in tables, clocks and output.

use brinell::document::{self, Loaded};
use brinell::model::{Layout, Model, Motion};
use brinell::scenario::Scenario;
use std::io::Write;
use std::path::Path;

/// Accelerations of both rings at one instant: inner x, y, outer x, y.
pub type Sample = [f64; 4];

/// Reads a scenario file, with overrides as on the command line.
pub fn scenario(path: &str, overrides: &[(&str, String)]) -> Scenario {
    load(path, overrides).scenario
}

fn load(path: &str, overrides: &[(&str, String)]) -> Loaded {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let overrides: Vec<(String, String)> = overrides.iter().map(|(k, v)| ((*k).to_owned(), v.clone())).collect();
    document::read(&text, &overrides).unwrap_or_else(|problems| panic!("{path}: {problems:?}"))
}

/// Where each coordinate of the tables' layout is in brinell's: r of every roller (row by row), theta, phi, then x, y,
/// theta of each cage, tilts where there are any (beta of every roller, slopes of the inner and the outer ring), and x,
/// y of the inner and the outer ring.
pub fn coordinates(l: &Layout) -> Vec<usize> {
    let rollers: Vec<usize> =
        (0..l.rows).flat_map(|row| (0..l.rollers_per_row).map(move |roller| l.slot(row, roller))).collect();
    let blocks = [l.r(), l.theta(), l.phi()];
    let of_rollers = blocks.into_iter().flat_map(|block| rollers.iter().map(move |slot| block + slot));
    let of_cages = (0..l.rows).flat_map(|row| (0..3).map(move |k| l.cage(row) + k));
    let of_rings = [l.inner(), l.outer()].into_iter().flat_map(|at| [at, at + 1]);
    let betas = rollers.iter().map(|slot| l.beta() + slot);
    let slopes = [l.inner_tilt(), l.outer_tilt()].into_iter().flat_map(|at| [at, at + 1]);
    let tilts = betas.chain(slopes).filter(|_| l.tilts);
    of_rollers.chain(of_cages).chain(tilts).chain(of_rings).collect()
}

/// The radius that turns each coordinate of the tables' layout into a length on a surface.
pub fn levers(model: &Model) -> Vec<f64> {
    let (l, g) = (&model.layout, &model.geometry);
    let n = l.rollers();
    let planar = 3 * n + 3 * l.rows;
    let tilts = if l.tilts { n + 4 } else { 0 };
    let mut lever = vec![1.0; planar + tilts + 4];
    lever[n..2 * n].fill(g.pitch_radius);
    lever[2 * n..3 * n].fill(g.roller_radius);
    for row in 0..l.rows {
        lever[3 * n + 3 * row + 2] = g.pitch_radius;
    }
    if l.tilts {
        lever[planar..planar + n].fill(0.5 * g.roller_length);
        lever[planar + n..planar + tilts].fill(g.pitch_radius);
    }
    lever
}

/// The equations of motion in the tables' layout.
pub struct Compact<'a> {
    motion: Motion<'a>,
    coordinates: Vec<usize>,
    y: Vec<f64>,
    dy: Vec<f64>,
}

impl<'a> Compact<'a> {
    /// Of a model, with `y` for the entries that are not in the tables' layout.
    pub fn new(model: &'a Model, y: &[f64]) -> Self {
        Self {
            motion: Motion::new(model),
            coordinates: coordinates(&model.layout),
            dy: vec![0.0; y.len()],
            y: y.to_vec(),
        }
    }

    /// Degrees of freedom.
    pub fn dof(&self) -> usize {
        self.coordinates.len()
    }

    /// A state of brinell's in the tables' layout.
    pub fn compact(&self, y: &[f64]) -> Vec<f64> {
        let half = y.len() / 2;
        let rates = self.coordinates.iter().map(|k| y[half + k]);
        self.coordinates.iter().map(|k| y[*k]).chain(rates).collect()
    }

    /// dy/dt.
    pub fn derivative(&mut self, t: f64, compact: &[f64], rates: &mut [f64]) {
        let (dof, half) = (self.coordinates.len(), self.y.len() / 2);
        for (i, &k) in self.coordinates.iter().enumerate() {
            self.y[k] = compact[i];
            self.y[half + k] = compact[dof + i];
        }
        self.motion.derivative(t, &self.y, &mut self.dy);
        for (i, &k) in self.coordinates.iter().enumerate() {
            rates[i] = self.dy[k];
            rates[dof + i] = self.dy[half + k];
        }
    }
}

/// Prints the accelerations at every state of a table, which starts with their number and holds t and y of each, then
/// the start.
fn check(model: &Model, path: &str) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let mut numbers = text.split_whitespace().map(|w| w.parse::<f64>().unwrap());
    let mut take = || numbers.next().expect("a longer table");
    let start = brinell::start::state(model).unwrap();
    let mut compact = Compact::new(model, &start);
    let states = take() as usize;
    let size = 2 * compact.dof();
    let mut rates = vec![0.0; size];
    for _ in 0..states {
        let t = take();
        let y: Vec<f64> = (0..size).map(|_| take()).collect();
        compact.derivative(t, &y, &mut rates);
        for a in &rates[size / 2..] {
            println!("{a:e}");
        }
    }
    for value in compact.compact(&start) {
        println!("{value:e}");
    }
}

/// What one run cost, beside its samples.
pub struct Work {
    /// Right-hand sides, those for samples aside.
    pub rhs: u64,
    /// Steps.
    pub steps: u64,
}

/// What the driver asks for: METHOD SCENARIO OUT DURATION RATE LENGTH SPEED RTOL MAX_STEP BUDGET TOL...
pub struct Job {
    /// Name of the method.
    pub method: String,
    /// Scenario file.
    pub scenario: String,
    out: String,
    /// Simulated time, s.
    pub duration: f64,
    /// Samples a second.
    pub rate: f64,
    /// What a tolerance of 1 means for displacements on a surface, m.
    pub length: f64,
    /// And for speeds, m/s.
    pub speed: f64,
    /// And relatively.
    pub rtol: f64,
    budget: f64,
    tolerances: Vec<f64>,
}

impl Job {
    /// From the command line; answers `check SCENARIO STATES` by itself, and `resolve SCENARIO` with every default
    /// filled in.
    pub fn new() -> Option<Self> {
        let args: Vec<String> = std::env::args().skip(1).collect();
        if let [what, path] = &args[..]
            && what == "resolve"
        {
            print!("{}", load(path, &[]).to_toml());
            return None;
        }
        if let [what, path, states] = &args[..]
            && what == "check"
        {
            check(&Model::new(&scenario(path, &[])).unwrap(), states);
            return None;
        }
        assert!(args.len() > 10, "METHOD SCENARIO OUT DURATION RATE LENGTH SPEED RTOL MAX_STEP BUDGET TOL...");
        let number = |k: usize| args[k].parse::<f64>().unwrap();
        Some(Self {
            method: args[0].clone(),
            scenario: args[1].clone(),
            out: args[2].clone(),
            duration: number(3),
            rate: number(4),
            length: number(5),
            speed: number(6),
            rtol: number(7),
            budget: number(9),
            tolerances: (10..args.len()).map(number).collect(),
        })
    }

    /// Instants of the samples.
    pub fn times(&self) -> Vec<f64> {
        let count = (self.duration * self.rate + 1e-6).floor() as u64;
        (0..=count).map(|k| k as f64 / self.rate).collect()
    }

    /// Runs every tolerance again and again within the budget; keeps the shortest times.
    pub fn go(&self, mut run: impl FnMut(f64, &mut Vec<Sample>) -> Work) {
        for (i, &tolerance) in self.tolerances.iter().enumerate() {
            let (mut wall, mut cpu, mut spent, mut repeats) = (f64::INFINITY, f64::INFINITY, 0.0, 0);
            let mut samples = Vec::new();
            let mut work;
            loop {
                samples.clear();
                let start = (clock(libc::CLOCK_MONOTONIC), clock(libc::CLOCK_PROCESS_CPUTIME_ID));
                work = run(tolerance, &mut samples);
                let took = clock(libc::CLOCK_MONOTONIC) - start.0;
                wall = took.min(wall);
                cpu = (clock(libc::CLOCK_PROCESS_CPUTIME_ID) - start.1).min(cpu);
                spent += took;
                repeats += 1;
                if spent + wall >= self.budget {
                    break;
                }
            }
            let path = format!("{}-{i}.f64", self.out);
            write(Path::new(&path), &samples);
            println!(
                "{{\"tol\": {tolerance:e}, \"cpu\": {cpu:e}, \"wall\": {wall:e}, \"rhs\": {}, \"steps\": {}, \"repeats\": {repeats}}}",
                work.rhs, work.steps
            );
        }
    }
}

fn clock(id: libc::clockid_t) -> f64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `now` is a timespec to write to.
    let status = unsafe { libc::clock_gettime(id, &raw mut now) };
    assert_eq!(status, 0, "clock_gettime");
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

fn write(path: &Path, samples: &[Sample]) {
    let mut bytes = Vec::with_capacity(32 * samples.len());
    for value in samples.iter().flatten() {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    std::fs::File::create(path)
        .and_then(|mut file| file.write_all(&bytes))
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
}
