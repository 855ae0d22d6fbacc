//! Photos of raceways with and without a spall, drawn from a seed, with the spall's true area.
//!
//! A picture is the light on the raceway times what the surface reflects, blurred as a lens does, with a sensor's
//! noise, then PNG or JPEG. Written before the reader that is tested with it, and not changed to suit that.

use super::{Noise, png};
use std::f64::consts::{PI, TAU};

/// One photo and its truth.
pub struct Photo {
    /// What makes it hard.
    pub name: String,
    /// PNG or JPEG.
    pub bytes: Vec<u8>,
    /// The side of a pixel.
    pub mm_per_pixel: f64,
    /// Area of the spall; 0 where there is none.
    pub area_mm2: f64,
}

/// What is wrong with a picture beside its spall; a photo has one of them in full and some others in part.
const TROUBLES: [&str; 10] =
    ["clean", "gradient", "vignette", "shoulder", "noise", "phone", "glints", "marks", "low contrast", "specks"];

/// Photo `k` of a set of 60: in 50 there is a spall, five for each trouble; in the last 10 there is none.
pub fn photo(seed: u64, k: usize) -> Photo {
    let mut noise = Noise((seed * 1000 + k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    for _ in 0..20 {
        noise.bits();
    }
    let trouble = k % TROUBLES.len();
    let spalled = k < 50;
    let n = &mut noise;
    let width = 320 + 16 * n.below(17);
    let height = 240 + 16 * n.below(13);
    let mut scene = Scene {
        width,
        height,
        mm_per_pixel: between(n, 0.008, 0.03),
        light: Light::default(),
        reflects: vec![between(n, 0.5, 0.85); width * height],
    };
    let shoulder = (trouble == 3 || (trouble != 0 && n.below(8) == 0)).then(|| Shoulder::new(n, &scene));
    let contrast = match trouble {
        8 => between(n, 0.08, 0.14),
        _ => between(n, 0.22, 0.6),
    };
    let spall = spalled.then(|| Spall::new(n, &scene, shoulder.as_ref()));
    let area_px = spall.as_ref().map_or(0.0, |s| scene.draw_spall(n, s, contrast));
    scene.draw_troubles(n, trouble, spall.as_ref(), shoulder.as_ref());
    scene.blur(between(n, 0.6, 1.4));
    let sigma = match trouble {
        0 => 0.004,
        4 => between(n, 0.04, 0.08),
        5 => between(n, 0.02, 0.05),
        8 => between(n, 0.004, 0.03),
        _ => between(n, 0.004, 0.02),
    };
    let grey = scene.exposed(n, sigma);
    let quality = match trouble {
        5 => Some(between(n, 40.0, 80.0) as u8),
        0 => None,
        _ => (n.below(2) == 0).then(|| between(n, 60.0, 95.0) as u8),
    };
    Photo {
        name: format!(
            "{k}: {}{}, {width} x {height}, {:.1} % of it, contrast {contrast:.2}, noise {sigma:.3}, JPEG {quality:?}",
            TROUBLES[trouble],
            if shoulder.is_some() { " (shoulder)" } else { "" },
            100.0 * area_px / (width * height) as f64,
        ),
        bytes: encoded(&grey, width, height, quality),
        mm_per_pixel: scene.mm_per_pixel,
        area_mm2: area_px * scene.mm_per_pixel.powi(2),
    }
}

fn between(n: &mut Noise, low: f64, high: f64) -> f64 {
    low + (high - low) * n.uniform()
}

fn encoded(grey: &[u8], width: usize, height: usize, quality: Option<u8>) -> Vec<u8> {
    let Some(quality) = quality else {
        return png(width, height, png::ColorType::Grayscale, png::BitDepth::Eight, grey);
    };
    let mut bytes = Vec::new();
    jpeg_encoder::Encoder::new(&mut bytes, quality)
        .encode(grey, width as u16, height as u16, jpeg_encoder::ColorType::Luma)
        .unwrap();
    bytes
}

/// Light on the raceway, as a share of that in the middle.
#[derive(Default)]
struct Light {
    /// Change from one side to the other, across and down.
    gradient: [f64; 2],
    /// Loss in the farthest corner.
    vignette: f64,
    /// Where the lens looks, as shares of the picture from its middle.
    centre: [f64; 2],
    /// Stray light that is added everywhere.
    haze: f64,
}

impl Light {
    fn at(&self, u: f64, v: f64) -> f64 {
        let r2 = ((u - self.centre[0]).powi(2) + (v - self.centre[1]).powi(2)) / 0.5;
        let slope = 1.0 + self.gradient[0] * u + self.gradient[1] * v;
        // The natural fall-off of a lens, cos^4 of the angle to its axis.
        let edge = 1.0 / (1.0 - self.vignette).max(0.1).sqrt() - 1.0;
        slope.max(0.1) / (1.0 + edge * r2).powi(2)
    }
}

/// The shoulder of the ring beside the raceway: a dark strip along one side.
struct Shoulder {
    /// Normal out of the raceway and distance from the picture's middle, px.
    normal: [f64; 2],
    distance: f64,
    /// What is left of the light on it.
    left: f64,
    /// Softness of its edge, px.
    soft: f64,
}

impl Shoulder {
    fn new(n: &mut Noise, scene: &Scene) -> Self {
        let side = n.below(4);
        let angle = 0.5 * PI * side as f64 + between(n, -0.05, 0.05);
        let half = 0.5 * if side.is_multiple_of(2) { scene.width } else { scene.height } as f64;
        Self {
            normal: [angle.cos(), angle.sin()],
            distance: half * between(n, 0.72, 0.9),
            left: between(n, 0.3, 0.65),
            soft: between(n, 2.0, 10.0),
        }
    }

    /// How far a point lies beyond the edge, px from the picture's middle.
    fn beyond(&self, x: f64, y: f64) -> f64 {
        x * self.normal[0] + y * self.normal[1] - self.distance
    }

    fn light(&self, x: f64, y: f64) -> f64 {
        let share = 0.5 + 0.5 * (self.beyond(x, y) / self.soft).tanh();
        1.0 - (1.0 - self.left) * share
    }
}

/// One or two lobes, each with a wavy radius, stretched and turned.
struct Spall {
    lobes: Vec<Lobe>,
}

struct Lobe {
    centre: [f64; 2],
    turn: f64,
    /// Half axes, px.
    axes: [f64; 2],
    /// Amplitude and phase of each wave.
    waves: Vec<(f64, f64)>,
    /// Corners: the exponent of a superellipse, 2 for an ellipse.
    power: f64,
}

impl Lobe {
    fn new(n: &mut Noise, area: f64) -> Self {
        let aspect = between(n, 0.5, 2.0);
        let radius = (area / PI).sqrt();
        let waves = (2..7_usize).map(|k| (between(n, 0.0, 0.3) / k as f64, between(n, 0.0, TAU))).collect();
        Self {
            centre: [0.0; 2],
            turn: between(n, 0.0, PI),
            axes: [radius * aspect.sqrt(), radius / aspect.sqrt()],
            waves,
            power: [2.0, 2.0, 3.0, 5.0][n.below(4)],
        }
    }

    fn holds(&self, x: f64, y: f64) -> bool {
        let (sin, cos) = self.turn.sin_cos();
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        let u = (dx * cos + dy * sin) / self.axes[0];
        let v = (dy * cos - dx * sin) / self.axes[1];
        if u.abs() > 2.0 || v.abs() > 2.0 {
            return false;
        }
        let angle = v.atan2(u);
        let wave: f64 = (2..).zip(&self.waves).map(|(k, (a, p))| a * (f64::from(k) * angle + p).cos()).sum();
        u.abs().powf(self.power) + v.abs().powf(self.power) < (1.0 + wave).powf(self.power)
    }
}

impl Spall {
    /// Well within the picture and the raceway; from 0.8 to about 30 % of the picture.
    fn new(n: &mut Noise, scene: &Scene, shoulder: Option<&Shoulder>) -> Self {
        let all = (scene.width * scene.height) as f64;
        for attempt in 0.. {
            let shrink = 0.97_f64.powi(attempt);
            let area = shrink * all * (between(n, 0.008_f64.ln(), 0.3_f64.ln())).exp();
            let middle = [scene.width, scene.height].map(|side| {
                let share = between(n, 0.25, 0.75);
                share * side as f64
            });
            let lobes = match n.below(3) {
                0 => {
                    let (mut a, mut b) = (Lobe::new(n, 0.6 * area), Lobe::new(n, 0.5 * area));
                    let angle = between(n, 0.0, TAU);
                    let apart = 0.55 * (area / PI).sqrt();
                    a.centre = [middle[0] + apart * angle.cos(), middle[1] + apart * angle.sin()];
                    b.centre = [middle[0] - apart * angle.cos(), middle[1] - apart * angle.sin()];
                    vec![a, b]
                }
                _ => {
                    let mut lobe = Lobe::new(n, area);
                    lobe.centre = middle;
                    vec![lobe]
                }
            };
            let spall = Self { lobes };
            if spall.fits(scene, shoulder) {
                return spall;
            }
        }
        unreachable!()
    }

    fn fits(&self, scene: &Scene, shoulder: Option<&Shoulder>) -> bool {
        let (w, h) = (scene.width as f64, scene.height as f64);
        let margin = 12.0;
        let free = |x: f64, y: f64| {
            let within = x > margin && y > margin && x < w - margin && y < h - margin;
            within && shoulder.is_none_or(|s| s.beyond(x - 0.5 * w, y - 0.5 * h) < -margin - 2.0 * s.soft)
        };
        (0..scene.height).step_by(3).all(|y| {
            (0..scene.width).step_by(3).all(|x| {
                let (x, y) = (x as f64, y as f64);
                !self.holds(x, y) || free(x, y)
            })
        })
    }

    fn holds(&self, x: f64, y: f64) -> bool {
        self.lobes.iter().any(|lobe| lobe.holds(x, y))
    }

    /// Of a pixel, the share within: 4 x 4 points where the corners differ.
    fn cover(&self, x: usize, y: usize) -> f64 {
        let at = |i: usize, part: f64| i as f64 + part;
        let corner = |k: usize| self.holds(at(x, (k % 2) as f64), at(y, (k / 2) as f64));
        let corners = (0..4).filter(|k| corner(*k)).count();
        if corners % 4 == 0 {
            return corners as f64 / 4.0;
        }
        let part = |k: usize| (k as f64 + 0.5) / 4.0;
        let hits = (0..16).filter(|k| self.holds(at(x, part(k % 4)), at(y, part(k / 4)))).count();
        hits as f64 / 16.0
    }
}

struct Scene {
    width: usize,
    height: usize,
    mm_per_pixel: f64,
    light: Light,
    /// What each pixel shows of the light.
    reflects: Vec<f64>,
}

impl Scene {
    /// Gives the true area, px.
    fn draw_spall(&mut self, n: &mut Noise, spall: &Spall, contrast: f64) -> f64 {
        // A floor that is not of one grey: waves of a tenth of the contrast or so.
        let rough = between(n, 0.0, 0.15) * contrast;
        let length = between(n, 8.0, 25.0);
        let phases: Vec<f64> = (0..4).map(|_| between(n, 0.0, TAU)).collect();
        let mut area = 0.0;
        for i in 0..self.reflects.len() {
            let (x, y) = (i % self.width, i / self.width);
            let cover = spall.cover(x, y);
            area += cover;
            let (u, v) = (x as f64 / length, y as f64 / length);
            let floor = rough
                * ((u + phases[0]).sin() * (1.3 * v + phases[1]).sin()
                    + (2.1 * u + phases[2]).sin() * (1.7 * v + phases[3]).sin());
            self.reflects[i] *= 1.0 - cover * (contrast + floor);
        }
        area
    }

    fn draw_troubles(&mut self, n: &mut Noise, trouble: usize, spall: Option<&Spall>, shoulder: Option<&Shoulder>) {
        // What is not the photo's own trouble is there in part, and not in a clean photo.
        let share = |n: &mut Noise, wanted: bool| match (wanted, trouble) {
            (true, _) => between(n, 0.6, 1.0),
            (_, 0) => 0.0,
            _ if n.below(3) == 0 => between(n, 0.0, 0.4),
            _ => 0.0,
        };
        let gradient = share(n, trouble == 1 || trouble == 5);
        let angle = between(n, 0.0, TAU);
        self.light.gradient = [1.2 * gradient * angle.cos(), 1.2 * gradient * angle.sin()];
        self.light.vignette = 0.6 * share(n, trouble == 2 || trouble == 5);
        self.light.centre = [between(n, -0.15, 0.15), between(n, -0.15, 0.15)];
        self.light.haze = if n.below(3) == 0 { between(n, 0.0, 0.1) } else { 0.0 };
        let marks = share(n, trouble == 7);
        self.draw_marks(n, 0.03 * marks);
        let specks = (15.0 * share(n, trouble == 9)) as usize;
        let glints = (20.0 * share(n, trouble == 6)) as usize;
        for k in 0..specks + glints {
            let glint = k >= specks;
            let radius = match glint {
                true => between(n, 0.8, 3.0),
                false => between(n, 0.015, 0.065) / self.mm_per_pixel,
            };
            let at = [between(n, 0.0, self.width as f64), between(n, 0.0, self.height as f64)];
            let near = |s: &Spall| {
                (0..16).any(|k| {
                    let (sin, cos) = (TAU * f64::from(k) / 16.0).sin_cos();
                    s.holds(at[0] + (radius + 4.0) * cos, at[1] + (radius + 4.0) * sin)
                })
            };
            // A glint may lie on the floor of the spall, a speck of dirt lies beside it.
            if glint || !spall.is_some_and(near) {
                self.draw_spot(at, radius, if glint { 1.6 } else { between(n, 0.3, 0.8) });
            }
        }
        if let Some(shoulder) = shoulder {
            let middle = [0.5 * self.width as f64, 0.5 * self.height as f64];
            for i in 0..self.reflects.len() {
                let (x, y) = ((i % self.width) as f64, (i / self.width) as f64);
                self.reflects[i] *= shoulder.light(x - middle[0], y - middle[1]);
            }
        }
    }

    /// Grinding marks: rows, or stretches of rows, that are a little lighter or darker.
    fn draw_marks(&mut self, n: &mut Noise, amplitude: f64) {
        if amplitude == 0.0 {
            return;
        }
        let upright = n.below(4) == 0;
        let (long, across) = if upright { (self.height, self.width) } else { (self.width, self.height) };
        for row in 0..across {
            let whole = amplitude * n.normal();
            let (from, to) = (n.below(long), n.below(long));
            let part = 1.5 * amplitude * n.normal();
            for k in 0..long {
                let stretch = if (from.min(to)..from.max(to)).contains(&k) { part } else { 0.0 };
                let i = if upright { k * self.width + row } else { row * self.width + k };
                self.reflects[i] *= 1.0 + whole + stretch;
            }
        }
    }

    fn draw_spot(&mut self, at: [f64; 2], radius: f64, factor: f64) {
        for i in 0..self.reflects.len() {
            let (x, y) = ((i % self.width) as f64 + 0.5, (i / self.width) as f64 + 0.5);
            let share = (radius + 0.5 - (x - at[0]).hypot(y - at[1])).clamp(0.0, 1.0);
            if share > 0.0 {
                self.reflects[i] *= 1.0 + share * (factor - 1.0);
            }
        }
    }

    fn blur(&mut self, sigma: f64) {
        let reach = (3.0 * sigma).ceil() as isize;
        let weight = |d: isize| (-0.5 * (d as f64 / sigma).powi(2)).exp();
        let sum: f64 = (-reach..=reach).map(weight).sum();
        let (w, h) = (self.width as isize, self.height as isize);
        for down in [false, true] {
            let before = self.reflects.clone();
            for y in 0..h {
                for x in 0..w {
                    let at = |d: isize| match down {
                        false => before[(y * w + (x + d).clamp(0, w - 1)) as usize],
                        true => before[((y + d).clamp(0, h - 1) * w + x) as usize],
                    };
                    self.reflects[(y * w + x) as usize] =
                        (-reach..=reach).map(|d| weight(d) * at(d)).sum::<f64>() / sum;
                }
            }
        }
    }

    /// Under the light, with the sensor's noise, 8 bits.
    fn exposed(&self, n: &mut Noise, sigma: f64) -> Vec<u8> {
        let grey = |i: usize| {
            let u = (i % self.width) as f64 / self.width as f64 - 0.5;
            let v = (i / self.width) as f64 / self.height as f64 - 0.5;
            let light = self.light.at(u, v);
            let shown = self.light.haze + (1.0 - self.light.haze) * light * self.reflects[i];
            shown + sigma * n.normal()
        };
        (0..self.reflects.len()).map(grey).map(|g| (255.0 * g.clamp(0.0, 1.0)).round() as u8).collect()
    }
}
