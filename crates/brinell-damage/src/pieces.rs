//! The connected pieces of a picture that lie above a level, in runs of pixels along its rows.

use crate::error::DamageError;
use crate::pixels::Pixels;

/// More runs than this are texture, not pieces.
const MOST_RUNS: usize = 8_000_000;

/// Neighbouring pixels of a row, `to` left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    pub(crate) row: usize,
    pub(crate) from: usize,
    pub(crate) to: usize,
}

/// Pixels that hang together, at corners too.
#[derive(Debug, Clone, Default)]
pub(crate) struct Piece {
    /// Pixels.
    pub(crate) area: usize,
    /// Pixels of it on the left, right, top and bottom side of the picture.
    pub(crate) touch: [usize; 4],
    /// Row by row.
    pub(crate) runs: Vec<Run>,
    /// Sides of pixels that face the outside.
    perimeter: usize,
}

impl Piece {
    /// About half of its thickness: the radius of a disc with as much area for its border, px.
    pub(crate) fn radius(&self) -> f64 {
        // Along pixels a border is 4 / pi longer than it is.
        2.0 * self.area as f64 / (std::f64::consts::FRAC_PI_4 * self.perimeter.max(1) as f64)
    }

    pub(crate) fn holds(&self, [x, y]: [usize; 2]) -> bool {
        self.runs.iter().any(|r| r.row == y && (r.from..r.to).contains(&x))
    }

    /// Pixels that both have.
    pub(crate) fn shared(&self, other: &Self) -> usize {
        // Runs come row by row, and within a row from the left.
        let (mut shared, mut next) = (0, 0);
        for run in &self.runs {
            while other.runs.get(next).is_some_and(|o| (o.row, o.to) <= (run.row, run.from)) {
                next += 1;
            }
            let reached = |o: &&Run| (o.row, o.from) < (run.row, run.to);
            for o in other.runs[next..].iter().take_while(reached) {
                shared += o.to.min(run.to).saturating_sub(o.from.max(run.from));
            }
        }
        shared
    }

    fn add(&mut self, run: Run, pixels: &Pixels) {
        let length = run.to - run.from;
        self.area += length;
        self.perimeter += 2 + 2 * length;
        self.touch[0] += usize::from(run.from == 0);
        self.touch[1] += usize::from(run.to == pixels.width);
        self.touch[2] += if run.row == 0 { length } else { 0 };
        self.touch[3] += if run.row + 1 == pixels.height { length } else { 0 };
        self.runs.push(run);
    }
}

/// All pieces of at least `smallest` pixels, the largest first, and how many smaller ones there are.
pub(crate) fn pieces(pixels: &Pixels, level: f64, smallest: f64) -> Result<(Vec<Piece>, usize), DamageError> {
    let runs = runs(pixels, level)?;
    let mut parents: Vec<u32> = (0..runs.len() as u32).collect();
    // Sides that a run shares with the row above it.
    let mut shared = vec![0_u32; runs.len()];
    let mut above = 0;
    for (k, run) in runs.iter().enumerate() {
        while above < k
            && (runs[above].row + 1 < run.row || (runs[above].row + 1 == run.row && runs[above].to < run.from))
        {
            above += 1;
        }
        let reached = |r: &&Run| r.row + 1 == run.row && r.from <= run.to;
        for (j, other) in (above..).zip(runs[above..k].iter().take_while(reached)) {
            if other.to >= run.from {
                join(&mut parents, j as u32, k as u32);
                let both = other.to.min(run.to).saturating_sub(other.from.max(run.from));
                shared[k] += both as u32;
            }
        }
    }
    let mut areas = vec![0_usize; runs.len()];
    for (k, run) in runs.iter().enumerate() {
        areas[root(&mut parents, k as u32)] += run.to - run.from;
    }
    let dropped = areas.iter().filter(|&&a| a > 0 && (a as f64) < smallest).count();
    let mut places = vec![usize::MAX; runs.len()];
    let mut all: Vec<Piece> = Vec::new();
    for (k, &run) in runs.iter().enumerate() {
        let of = root(&mut parents, k as u32);
        if (areas[of] as f64) < smallest {
            continue;
        }
        if places[of] == usize::MAX {
            places[of] = all.len();
            all.push(Piece::default());
        }
        let piece = &mut all[places[of]];
        piece.add(run, pixels);
        piece.perimeter = piece.perimeter.saturating_sub(2 * shared[k] as usize);
    }
    all.sort_by_key(|piece| std::cmp::Reverse(piece.area));
    Ok((all, dropped))
}

fn runs(pixels: &Pixels, level: f64) -> Result<Vec<Run>, DamageError> {
    let mut runs = Vec::new();
    for (row, line) in pixels.values.chunks_exact(pixels.width).enumerate() {
        let mut x = 0;
        while let Some(skip) = line[x..].iter().position(|&v| f64::from(v) > level) {
            let from = x + skip;
            let length = line[from..].iter().position(|&v| f64::from(v) <= level);
            x = length.map_or(line.len(), |n| from + n);
            runs.push(Run { row, from, to: x });
        }
        if runs.len() > MOST_RUNS {
            return Err(DamageError::TooLarge {
                what: "the number of spots in the picture",
                value: format!("above {MOST_RUNS}"),
                limit: format!("{MOST_RUNS}"),
                way_out: "this is texture rather than damage: raise `blur_px`, or state `threshold`",
            });
        }
    }
    Ok(runs)
}

fn root(parents: &mut [u32], mut k: u32) -> usize {
    while parents[k as usize] != k {
        parents[k as usize] = parents[parents[k as usize] as usize];
        k = parents[k as usize];
    }
    k as usize
}

fn join(parents: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parents, a), root(parents, b));
    parents[a.max(b)] = a.min(b) as u32;
}
