//! Damage told from the sound surface in a photo whose threshold nobody states.
//!
//! Under even light the level is Otsu's. Else the light is fitted and divided out ([`crate::background`]), and the
//! level lies halfway between the sound surface and the piece that is found: what exceeds the noise, then what exceeds
//! half the contrast of that, until it converges. A piece is separable where its contrast is well above the noise,
//! its border is a step, and it is more than a line.

use crate::background::Cells;
use crate::error::DamageError;
use crate::numbers::median;
use crate::pieces::{Piece, Run, pieces};
use crate::pixels::Pixels;
use crate::threshold::otsu;
use std::collections::HashMap;
use std::rc::Rc;

/// Of a flattened picture: the value of the sound surface, and of a contrast of 1.
const SOUND: f64 = 16_384.0;
const CONTRAST: f64 = 45_000.0;
/// Contrast of a piece over the standard deviation of the sound surface, at least.
const LEAST_CONTRAST: f64 = 4.0;
/// Where the search begins, in standard deviations.
const FIRST_LEVEL: f64 = 3.5;
/// Share of the contrast that its border has within a few pixels, at least.
const LEAST_STEP: f64 = 0.4;
/// Contrast of a piece, at least: the blocks of a JPEG make steps of one or two hundredths.
const LEAST_VISIBLE: f64 = 0.03;
/// Half of a piece's thickness, px, at least; and in standard deviations of the blur, under which its contrast is not
/// its own.
const LEAST_RADIUS: f64 = 2.5;
const RESOLVED: f64 = 3.0;
/// Share of a side of the picture that a strip along it takes: the ring's shoulder, not a spall.
const STRIP: f64 = 0.7;
/// How far grey may stray on either side under even light, as a share of the contrast.
const EVEN: f64 = 0.1;
/// Pieces that are looked at, the largest first.
const LOOKED_AT: usize = 12;
/// Rounds of fitting the light with what was found left out.
const ROUNDS: usize = 3;
/// Rounds of moving the level.
const ROUNDS_OF_LEVEL: usize = 10;
/// Steps of the level, as a contrast.
const STEP: f64 = 0.004;
/// Contrasts at which the search begins; not below the noise.
const STARTS: [f64; 6] = [0.0, 0.04, 0.08, 0.16, 0.3, 0.5];

/// Which of the pieces are damage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pieces {
    /// The largest that is a class of its own.
    Largest,
    /// All.
    All,
    /// The one at this point, columns and rows of pixels from the upper left corner of the picture as a viewer shows
    /// it.
    At([f64; 2]),
}

/// A picture in which damage is above the level, whatever its sign was.
pub(crate) struct Found {
    pub(crate) pixels: Pixels,
    pub(crate) level: f64,
    /// Share of the light, 0 to 1, that the level stands for; `None` under even light.
    pub(crate) share_of_light: Option<f64>,
    /// What was chosen, the largest first.
    pub(crate) chosen: Vec<Piece>,
    /// What was not, though it is as large as damage.
    pub(crate) left_out: Vec<Piece>,
    /// Smaller spots.
    pub(crate) specks: usize,
}

/// What to look for.
#[derive(Clone, Copy)]
pub(crate) struct Wanted {
    pub(crate) bright: bool,
    pub(crate) pieces: Pieces,
    /// Smallest piece, px.
    pub(crate) smallest: f64,
    /// Standard deviation of the blur before.
    pub(crate) blur_px: f64,
}

/// The grey of the sound surface and its standard deviation.
#[derive(Clone, Copy)]
struct Sound {
    level: f64,
    sigma: f64,
}

impl Sound {
    fn of(all: &[f64]) -> Self {
        let level = median(all.iter().copied());
        // Of the side away from damage, which is free of it.
        let away = all.iter().filter(|v| **v <= level).map(|v| level - v);
        Self { level, sigma: 1.4826 * median(away) }
    }
}

/// Finds the damage of a photo; `None` where nothing is a class of its own.
pub(crate) fn find(photo: &Pixels, wanted: Wanted) -> Result<Option<Found>, DamageError> {
    let cells = Cells::of(photo);
    if let Some(found) = under_even_light(photo, &cells, wanted)? {
        return Ok(Some(found));
    }
    let mut damaged: Option<Vec<bool>> = None;
    let mut best = None;
    for _ in 0..ROUNDS {
        let light = cells.light(damaged.as_deref());
        let flat = flattened(photo, &cells, &light, wanted.bright);
        let sound = sound(&flat, &cells, damaged.as_deref());
        best = halfway(flat, sound, wanted)?;
        let Some(found) = &best else {
            return Ok(None);
        };
        damaged = Some(covered(&cells, found));
    }
    Ok(best)
}

/// By Otsu's level, where either side of it has one grey.
fn under_even_light(photo: &Pixels, cells: &Cells, wanted: Wanted) -> Result<Option<Found>, DamageError> {
    let Some(split) = otsu(&photo.values) else {
        return Ok(None);
    };
    let side = |above: bool| -> Vec<f64> {
        let mut all: Vec<f64> = cells.values.iter().copied().filter(|&v| (v > split.level) == above).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let (dark, light) = (side(false), side(true));
    let part = |all: &[f64], share: f64| all[(share * (all.len() - 1) as f64).round() as usize];
    if dark.is_empty() || light.is_empty() {
        return Ok(None);
    }
    let gap = part(&light, 0.5) - part(&dark, 0.5);
    let strays = |all: &[f64]| part(all, 0.9) - part(all, 0.1) > EVEN * gap;
    if strays(&dark) || strays(&light) {
        return Ok(None);
    }
    let mut pixels = photo.clone();
    let mut level = split.level;
    if !wanted.bright {
        pixels.values.iter_mut().for_each(|v| *v = u16::MAX - *v);
        level = f64::from(u16::MAX) - level;
    }
    chosen(&pixels, level, wanted).map(|found| {
        found.map(|(chosen, left_out, specks)| Found { pixels, level, share_of_light: None, chosen, left_out, specks })
    })
}

/// The picture over its light, damage up.
fn flattened(photo: &Pixels, cells: &Cells, light: &[f64], bright: bool) -> Pixels {
    let mut flat = photo.clone();
    let sign = if bright { 1.0 } else { -1.0 };
    for (i, value) in flat.values.iter_mut().enumerate() {
        let light = cells.at(light, i % photo.width, i / photo.width);
        let contrast = sign * (f64::from(*value) / light - 1.0);
        *value = (SOUND + CONTRAST * contrast).round() as u16;
    }
    flat
}

/// Median and spread of what is not damaged, from at most 200 000 pixels.
fn sound(flat: &Pixels, cells: &Cells, damaged: Option<&[bool]>) -> Sound {
    let step = 1 + flat.values.len() / 200_000;
    let cell = |i: usize| i / flat.width / cells.side * cells.columns + i % flat.width / cells.side;
    let all: Vec<f64> = (0..flat.values.len())
        .step_by(step)
        .filter(|&i| damaged.is_none_or(|d| !d[cell(i)]))
        .map(|i| f64::from(flat.values[i]))
        .collect();
    Sound::of(&all)
}

/// The largest piece that lies above half of its own contrast and is a class of its own.
fn halfway(flat: Pixels, sound: Sound, wanted: Wanted) -> Result<Option<Found>, DamageError> {
    let mut levels = Levels::of(&flat, sound, wanted);
    let mut best: Option<(Step, Piece)> = None;
    let mut seen = Vec::new();
    for start in levels.starts() {
        for piece in
            levels.at(start)?.iter().take(LOOKED_AT).filter(|p| levels.is_wanted(p)).cloned().collect::<Vec<_>>()
        {
            let Some((step, piece)) = levels.settled(start, piece)? else {
                continue;
            };
            let first = (step, piece.runs[0].row, piece.runs[0].from);
            if seen.contains(&first) {
                continue;
            }
            seen.push(first);
            let larger = best.as_ref().is_none_or(|(_, b)| piece.area > b.area);
            if larger && is_own_class(&flat, levels.level(step), wanted, &piece) {
                best = Some((step, piece));
            }
        }
    }
    let Some((step, piece)) = best else {
        return Ok(None);
    };
    let level = levels.level(step);
    let (mut all, specks) = pieces(&flat, level, wanted.smallest.max(1.0))?;
    let is_chosen = |other: &Piece| match wanted.pieces {
        Pieces::All => is_own_class(&flat, level, wanted, other),
        _ => other.runs[0] == piece.runs[0],
    };
    let chosen = all.extract_if(.., |other| is_chosen(other)).collect();
    let contrast = (level - sound.level) / CONTRAST;
    Ok(Some(Found {
        pixels: flat,
        level,
        share_of_light: Some(if wanted.bright { 1.0 + contrast } else { 1.0 - contrast }),
        chosen,
        left_out: all,
        specks,
    }))
}

/// A level in steps of [`STEP`] above the sound surface.
type Step = usize;

/// The pieces of a flattened picture by level.
struct Levels<'a> {
    flat: &'a Pixels,
    sound: Sound,
    wanted: Wanted,
    found: HashMap<Step, Rc<Vec<Piece>>>,
}

impl<'a> Levels<'a> {
    fn of(flat: &'a Pixels, sound: Sound, wanted: Wanted) -> Self {
        Self { flat, sound, wanted, found: HashMap::new() }
    }

    fn level(&self, step: Step) -> f64 {
        self.sound.level + STEP * CONTRAST * step as f64
    }

    /// The step nearest to a level, above the noise.
    fn step(&self, level: f64) -> Step {
        let least = (FIRST_LEVEL * self.sound.sigma / (STEP * CONTRAST)).ceil().max(3.0);
        ((level - self.sound.level) / (STEP * CONTRAST)).round().max(least) as Step
    }

    /// Where to begin: at the noise, then at contrasts that keep shade apart.
    fn starts(&self) -> Vec<Step> {
        let mut starts: Vec<Step> = STARTS.iter().map(|c| self.step(self.sound.level + c * CONTRAST)).collect();
        starts.dedup();
        starts
    }

    fn at(&mut self, step: Step) -> Result<Rc<Vec<Piece>>, DamageError> {
        if let Some(known) = self.found.get(&step) {
            return Ok(known.clone());
        }
        let (mut all, _) = pieces(self.flat, self.level(step), self.wanted.smallest.max(1.0))?;
        all.truncate(LOOKED_AT);
        let all = Rc::new(all);
        self.found.insert(step, all.clone());
        Ok(all)
    }

    /// Whether it is at the requested point.
    fn is_wanted(&self, piece: &Piece) -> bool {
        match self.wanted.pieces {
            Pieces::At(at) => piece.holds(at.map(|v| v.max(0.0) as usize)),
            _ => true,
        }
    }

    /// Moves the level to half of the piece's contrast until it stays there.
    fn settled(&mut self, mut step: Step, mut piece: Piece) -> Result<Option<(Step, Piece)>, DamageError> {
        for _ in 0..ROUNDS_OF_LEVEL {
            let next = self.step(0.5 * (self.sound.level + grey(self.flat, &piece)));
            if next == step {
                break;
            }
            step = next;
            let all = self.at(step)?;
            let shared = |other: &&Piece| other.shared(&piece);
            let Some(other) =
                all.iter().filter(|p| self.is_wanted(p)).max_by_key(shared).filter(|p| p.shared(&piece) > 0)
            else {
                return Ok(None);
            };
            piece = other.clone();
        }
        Ok(Some((step, piece)))
    }
}

type Choice = (Vec<Piece>, Vec<Piece>, usize);

/// The pieces that are wanted and the others; `None` where none is.
fn chosen(pixels: &Pixels, level: f64, wanted: Wanted) -> Result<Option<Choice>, DamageError> {
    let (mut all, specks) = pieces(pixels, level, wanted.smallest.max(1.0))?;
    let own_class = |piece: &Piece| is_own_class(pixels, level, wanted, piece);
    let picked: Vec<Piece> = match wanted.pieces {
        Pieces::At([x, y]) => {
            let at = [x.max(0.0) as usize, y.max(0.0) as usize];
            let there = all.iter().position(|piece| piece.holds(at));
            there.map(|k| all.remove(k)).into_iter().collect()
        }
        Pieces::Largest => {
            let first = all.iter().take(LOOKED_AT).position(own_class);
            first.map(|k| all.remove(k)).into_iter().collect()
        }
        Pieces::All => {
            let (own, others) = std::mem::take(&mut all).into_iter().partition(own_class);
            all = others;
            own
        }
    };
    Ok((!picked.is_empty()).then_some((picked, all, specks)))
}

/// The median grey of a piece, to a 1024th.
fn grey(pixels: &Pixels, piece: &Piece) -> f64 {
    let mut bins = vec![0_usize; 1024];
    for run in &piece.runs {
        for &value in line(pixels, run) {
            bins[usize::from(value >> 6)] += 1;
        }
    }
    let mut sum = 0;
    let middle = bins.iter().position(|count| {
        sum += count;
        2 * sum >= piece.area
    });
    64.0 * (middle.unwrap_or(0) as f64 + 0.5)
}

fn line<'a>(pixels: &'a Pixels, run: &Run) -> &'a [u16] {
    let start = run.row * pixels.width;
    &pixels.values[start + run.from..start + run.to]
}

/// Whether a piece is more than noise, shade, a scratch or the ring's shoulder.
fn is_own_class(pixels: &Pixels, level: f64, wanted: Wanted, piece: &Piece) -> bool {
    let sides = [pixels.height, pixels.height, pixels.width, pixels.width];
    let strip = piece.touch.iter().zip(sides).any(|(&t, side)| t as f64 > STRIP * side as f64);
    let radius = LEAST_RADIUS.max(RESOLVED * wanted.blur_px);
    if strip || piece.radius() < radius {
        return false;
    }
    let around = around(pixels, level, piece);
    let contrast = grey(pixels, piece) - around.level;
    contrast >= (LEAST_CONTRAST * around.sigma).max(LEAST_VISIBLE * CONTRAST)
        && step(pixels, level, piece) >= LEAST_STEP * contrast
}

/// The sound surface around a piece: what lies below the level within its own radius, and as far again, of its bounding
/// box.
fn around(pixels: &Pixels, level: f64, piece: &Piece) -> Sound {
    let reach = 2 * piece.radius().ceil() as usize;
    let first = piece.runs.iter().map(|r| r.from).min().unwrap_or(0).saturating_sub(reach);
    let last = (piece.runs.iter().map(|r| r.to).max().unwrap_or(0) + reach).min(pixels.width);
    let rows = [piece.runs.first(), piece.runs.last()].map(|r| r.map_or(0, |r| r.row));
    let (top, bottom) = (rows[0].saturating_sub(reach), (rows[1] + reach + 1).min(pixels.height));
    let step = 1 + (last - first) * (bottom - top) / 100_000;
    let place = |i: usize| (top + i / (last - first)) * pixels.width + first + i % (last - first);
    let all: Vec<f64> = (0..(last - first) * (bottom - top))
        .step_by(step)
        .map(|i| f64::from(pixels.values[place(i)]))
        .filter(|v| *v <= level)
        .collect();
    Sound::of(&all)
}

/// Mean difference across the border of a piece, over a few pixels to either side.
fn step(pixels: &Pixels, level: f64, piece: &Piece) -> f64 {
    let reach = (0.1 * piece.radius()).clamp(2.0, 6.0) as isize;
    let (w, h) = (pixels.width as isize, pixels.height as isize);
    let value = |x: isize, y: isize| {
        let within = (0..w).contains(&x) && (0..h).contains(&y);
        within.then(|| f64::from(pixels.values[(y * w + x) as usize]))
    };
    let (mut sum, mut count) = (0.0, 0.0);
    let mut add = |inside: [isize; 2], outside: [isize; 2]| {
        if let (Some(a), Some(b)) = (value(inside[0], inside[1]), value(outside[0], outside[1])) {
            sum += a - b;
            count += 1.0;
        }
    };
    for run in &piece.runs {
        let (row, from, to) = (run.row as isize, run.from as isize, run.to as isize);
        add([from + reach - 1, row], [from - reach, row]);
        add([to - reach, row], [to + reach - 1, row]);
        for x in from..to {
            for up in [-1, 1] {
                if value(x, row + up).is_some_and(|v| v <= level) {
                    add([x, row - up * (reach - 1)], [x, row + up * reach]);
                }
            }
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

/// Cells that hold any of the pieces, and those beside them.
fn covered(cells: &Cells, found: &Found) -> Vec<bool> {
    let mut covered = vec![false; cells.columns * cells.rows];
    for run in found.chosen.iter().chain(&found.left_out).flat_map(|p| &p.runs) {
        let row = run.row / cells.side;
        let (from, to) = (run.from / cells.side, (run.to - 1) / cells.side);
        for r in row.saturating_sub(1)..(row + 2).min(cells.rows) {
            let start = r * cells.columns;
            covered[start + from.saturating_sub(1)..start + (to + 2).min(cells.columns)].fill(true);
        }
    }
    covered
}
