//! Draws the two files of damage that the examples use: `photo-spall.png`, a photo-like spall on ground steel, and
//! `scan.csv`, a profilometer-like map of another. Both are made up; no photo or scan of anyone's is behind them.
//!
//! ```text
//! cargo run -p brinell-damage --example draw_examples -- examples
//! ```
//!
//! The photo: 240 x 300 pixels of 0.02 mm, +s to the right, a spall 3.0 mm long and 4.0 mm wide.
//! Its outline is r(a) of [`outline`]; grinding marks run along s, light comes from the upper left.
//! The scan: 100 x 80 points, 0.06 mm apart, heights in um: an outer raceway of 27.5 mm radius, tilted by 3 um/mm along
//! s and -2 um/mm along z, 0.15 um of noise, missing points on the steepest walls, and a spall 25 um deep.

use std::error::Error;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

const PIXEL_MM: f64 = 0.02;
const STEP_MM: f64 = 0.06;

/// Marsaglia's xorshift: the same numbers everywhere.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Roughly normal, standard deviation 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// The spall's edge at the angle `a`, as a share of its half axes.
fn outline(a: f64) -> f64 {
    0.9 + 0.06 * (2.0 * a + 0.4).sin()
        + 0.05 * (3.0 * a + 1.9).sin()
        + 0.035 * (5.0 * a + 0.7).sin()
        + 0.02 * (9.0 * a + 2.6).sin()
        + 0.012 * (17.0 * a + 1.1).sin()
}

/// Smooth noise on a lattice of cells `cell` pixels wide.
struct Patches {
    values: Vec<f64>,
    cell: f64,
}

impl Patches {
    const SIDE: usize = 64;

    fn new(noise: &mut Noise, cell: f64) -> Self {
        let values = (0..Self::SIDE * Self::SIDE).map(|_| noise.normal()).collect();
        Self { values, cell }
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        let (u, v) = (x / self.cell, y / self.cell);
        let ease = |t: f64| t * t * (3.0 - 2.0 * t);
        let (fu, fv) = (ease(u.fract()), ease(v.fract()));
        let value = |i: usize, j: usize| {
            self.values[(v as usize + j) % Self::SIDE * Self::SIDE + (u as usize + i) % Self::SIDE]
        };
        let upper = value(0, 0) * (1.0 - fu) + value(1, 0) * fu;
        let lower = value(0, 1) * (1.0 - fu) + value(1, 1) * fu;
        upper * (1.0 - fv) + lower * fv
    }
}

fn photo(path: &Path) -> Result<(), Box<dyn Error>> {
    let (width, height) = (240_usize, 300_usize);
    let mut noise = Noise(0x5EED_0001);
    let coarse = Patches::new(&mut noise, 14.0);
    let fine = Patches::new(&mut noise, 4.0);
    // The half axes that make the outline 3.0 mm x 4.0 mm over all.
    let reach = |axis: fn(f64) -> f64| {
        let ends = (0..3600).map(|i| {
            let a = TAU * f64::from(i) / 3600.0;
            outline(a) * axis(a)
        });
        ends.fold((0.0, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)))
    };
    let (left, right) = reach(f64::cos);
    let (low, high) = reach(f64::sin);
    let half_s = 3.0 / PIXEL_MM / (right - left);
    let half_z = 4.0 / PIXEL_MM / (high - low);
    let centre = [118.0, 152.0];
    let mut streak = 0.0;
    let mut grey = Vec::with_capacity(width * height);
    for y in 0..height {
        streak = 0.75 * streak + 0.045 * noise.normal();
        for x in 0..width {
            let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
            let (u, v) = ((px - centre[0]) / half_s, (centre[1] - py) / half_z);
            let (radius, angle) = (u.hypot(v), v.atan2(u));
            // The distance inside the edge, pixels; lens blur of a pixel.
            let inside = (outline(angle) - radius) * 0.5 * (half_s + half_z);
            let cover = 1.0 / (1.0 + (-2.2 * inside).exp());
            let steel = 0.64 + 0.4 * streak + 0.02 * fine.at(px, py)
                - 0.10 * (((px - 90.0) / 240.0).powi(2) + ((py - 110.0) / 300.0).powi(2));
            // Broken facets; the far wall, lower right, catches the light a little.
            let facets = 0.20 + 0.05 * coarse.at(px, py) + 0.045 * fine.at(px, py);
            let lit = 0.09 * (-(inside - 6.0).powi(2) / 18.0).exp() * (angle + 0.8).cos().max(0.0);
            let shine = steel * (1.0 - cover) + (facets + lit).max(0.03) * cover;
            let value = 255.0 * (shine + 0.012 * noise.normal()).clamp(0.0, 1.0);
            // Steps of 4 keep the file small.
            grey.push((value / 4.0).round().min(63.0) as u8 * 4);
        }
    }
    let mut encoder = png::Encoder::new(std::fs::File::create(path)?, width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(&grey)?;
    Ok(())
}

fn scan(path: &Path) -> Result<(), Box<dyn Error>> {
    let (columns, rows) = (100_usize, 80_usize);
    let mut noise = Noise(0x5EED_0002);
    let rough = Patches::new(&mut noise, 5.0);
    let mut text = String::from(
        "# made by brinell-damage/examples/draw_examples.rs: heights in um, 0.06 mm apart, first line on top\n",
    );
    for row in 0..rows {
        for column in 0..columns {
            let s = (column as f64 - 0.5 * (columns - 1) as f64) * STEP_MM;
            let z = (0.5 * (rows - 1) as f64 - row as f64) * STEP_MM;
            let raceway = 1e3 * (27.5 - (27.5_f64 * 27.5 - s * s).sqrt()) + 3.0 * s - 2.0 * z;
            let (u, v) = (s / 1.4, z / 1.1);
            // Walls from 0 to 25 um within 0.2 mm or so.
            let inside = (outline(v.atan2(u)) - u.hypot(v)) * 1.25;
            let share = (inside / 0.2).clamp(0.0, 1.0);
            let floor = 25.0 + 1.2 * rough.at(column as f64, row as f64);
            let height = raceway - floor * share + 0.15 * noise.normal();
            if column > 0 {
                text.push(',');
            }
            let on_wall = share > 0.2 && share < 0.8;
            if noise.uniform() < if on_wall { 0.25 } else { 0.003 } {
                continue;
            }
            write!(text, "{height:.2}")?;
        }
        text.push('\n');
    }
    std::fs::write(path, text)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "examples".to_owned());
    let folder = Path::new(&folder);
    photo(&folder.join("photo-spall.png"))?;
    scan(&folder.join("scan.csv"))
}
