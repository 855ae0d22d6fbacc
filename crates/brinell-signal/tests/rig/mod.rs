//! Made-up signals of a test rig whose damage is known. Nothing here knows brinell's own model of a bearing.
//!
//! Impacts: P. D. McFadden and J. D. Smith, J. Sound Vib. 96 (1984) 69-82, with the random slip of J. Antoni and R. B.
//! Randall, J. Vib. Acoust. 125 (2003) 282-289: intervals that vary about their mean and do not make up for it, and a
//! timing error of each impact besides. Each impact rings two resonances. Around them: harmonics of the shaft, gear
//! mesh with sidebands, mains, a frequency converter's carrier, clicks, and coloured noise that breathes with the
//! shaft. The bearing's frequencies lie off their nominal places by slip and contact angle, and the analyst's speed is
//! off too.

use std::f64::consts::TAU;

pub(crate) struct Random(brinell_signal::random::Random);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let seed = seed.wrapping_mul(0xD134_2543_DE82_EF95).wrapping_add(11);
        let mut random = Random(brinell_signal::random::Random::new(seed));
        random.uniform();
        random
    }

    pub(crate) fn uniform(&mut self) -> f64 {
        self.0.uniform()
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    pub(crate) fn normal(&mut self) -> f64 {
        self.0.normal()
    }

    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[((self.uniform() * of.len() as f64) as usize).min(of.len() - 1)]
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Damage {
    None,
    Outer,
    Inner,
    Element,
}

/// What besides the bearing is loud.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Background {
    Quiet,
    /// Unbalance and misalignment: strong harmonics of the shaft, and noise that breathes with it.
    Unbalance,
    /// A loose part knocks once a turn and rings like a bearing.
    Knock,
    /// Gear mesh with sidebands of the shaft.
    Gear,
    /// Mains with harmonics, a converter's carrier, a rectifier's pulses.
    Electrical,
    /// Clicks at random instants.
    Clicks,
}

pub(crate) const BACKGROUNDS: [Background; 6] = [
    Background::Quiet,
    Background::Unbalance,
    Background::Knock,
    Background::Gear,
    Background::Electrical,
    Background::Clicks,
];

/// One signal and its truth.
pub(crate) struct Signal {
    pub(crate) x: Vec<f64>,
    pub(crate) fs: f64,
    pub(crate) seconds: f64,
    /// Name of the bearing, as the analyst gives it.
    pub(crate) bearing: &'static str,
    /// Shaft speed that the analyst believes, Hz.
    pub(crate) told: f64,
    pub(crate) damage: Damage,
    pub(crate) background: Background,
    /// RMS of the impacts over that of the noise, dB.
    pub(crate) snr_db: f64,
}

/// Name, elements, d / D, cos a, of public data sets.
type Bearing = (&'static str, f64, f64, f64);

const BEARINGS: [Bearing; 5] = [
    ("6205-2RS", 9.0, 0.3126 / 1.537, 1.0),
    ("6203-2RS", 8.0, 0.2656 / 1.122, 1.0),
    ("NICE", 8.0, 0.235 / 1.245, 1.0),
    ("ZA-2115", 16.0, 0.331 / 2.815, 0.965_15),
    ("UER204", 8.0, 7.92 / 34.55, 1.0),
];

/// What a signal will be, before it is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    pub(crate) fs: f64,
    pub(crate) seconds: f64,
    pub(crate) snr_db: f64,
    bearing: Bearing,
    shaft: f64,
    told: f64,
    background: Background,
}

fn draw(r: &mut Random) -> Plan {
    let fs = r.pick(&[12_000.0, 25_600.0, 48_000.0, 97_656.0]);
    let longest: f64 = if fs > 60_000.0 { 4.0 } else { 10.0 };
    let seconds = longest.powf(r.uniform());
    let bearing = r.pick(&BEARINGS);
    let shaft = r.between(15.0, 50.0);
    let told = shaft * (1.0 + 0.004 * r.normal().clamp(-2.5, 2.5));
    let background = r.pick(&BACKGROUNDS);
    Plan { fs, seconds, snr_db: r.between(-22.0, 6.0), bearing, shaft, told, background }
}

fn random(index: u64, damage: Damage) -> Random {
    Random::new(4 * index + damage as u64)
}

/// The plan of signal number `index` of a campaign.
pub(crate) fn plan(index: u64, damage: Damage) -> Plan {
    draw(&mut random(index, damage))
}

/// The signal number `index` of a campaign; the same for the same index.
pub(crate) fn signal(index: u64, damage: Damage) -> Signal {
    let mut r = random(index, damage);
    let Plan { fs, seconds, snr_db, bearing: (bearing, z, ratio, cosine), shaft, told, background } = draw(&mut r);
    // Contact angle and load move d / D cos a; sliding slows the cage.
    let g = ratio * cosine * (1.0 + 0.008 * r.normal().clamp(-2.0, 2.0));
    let cage = 0.5 * (1.0 - g) * (1.0 - 0.008 * r.uniform());
    let n = (fs * seconds) as usize;

    let resonances = [
        (r.between(2000.0, 5000.0_f64.min(0.4 * fs)), r.between(0.02, 0.06)),
        (r.between(3500.0, 16_000.0_f64.min(0.42 * fs)), r.between(0.01, 0.05)),
    ];
    let share = r.between(0.2, 0.8);
    let modes = [Mode::new(resonances[0], share, fs), Mode::new(resonances[1], 1.0 - share, fs)];
    let mut x = background_of(&mut r, background, n, fs, shaft, &modes);

    if damage != Damage::None {
        let rates = match damage {
            Damage::Outer => z * cage,
            Damage::Inner => z * (1.0 - cage),
            // 2 BSF = D / d (1 - g^2): the contact angle is in g alone.
            _ => (1.0 - g * g) / ratio,
        };
        let mut ring = impacts(&mut r, damage, rates, cage, shaft, n, fs, &modes);
        let rms = (ring.iter().map(|v| v * v).sum::<f64>() / n as f64).sqrt();
        let scale = 10f64.powf(snr_db / 20.0) / rms;
        ring.iter_mut().for_each(|v| *v *= scale);
        x.iter_mut().zip(&ring).for_each(|(x, v)| *x += v);
    }
    Signal { x, fs, seconds, bearing, told, damage, background, snr_db }
}

/// A resonance: its ring after a unit impact, by recursion.
struct Mode {
    /// 2 r cos w, r^2, gain.
    pole: [f64; 3],
}

impl Mode {
    fn new((frequency, damping): (f64, f64), share: f64, fs: f64) -> Self {
        let w = TAU * frequency / fs;
        let radius = (-damping * w).exp();
        // Unit energy of the ring, times its share.
        let gain = (share * (1.0 - radius * radius) * 2.0).sqrt();
        Mode { pole: [2.0 * radius * w.cos(), radius * radius, gain] }
    }

    fn ring(&self, force: &[f64], out: &mut [f64]) {
        let (mut y1, mut y2) = (0.0, 0.0);
        let [a, b, gain] = self.pole;
        for (f, out) in force.iter().zip(out) {
            let y = gain * f + a * y1 - b * y2;
            *out += y;
            (y2, y1) = (y1, y);
        }
    }
}

fn ringing(force: &[f64], modes: &[Mode]) -> Vec<f64> {
    let mut out = vec![0.0; force.len()];
    modes.iter().for_each(|m| m.ring(force, &mut out));
    out
}

/// An impact between two samples is shared between them.
fn strike(force: &mut [f64], at: f64, height: f64) {
    if at < 0.0 {
        return;
    }
    let (i, part) = (at as usize, at.fract());
    if i + 1 < force.len() {
        force[i] += height * (1.0 - part);
        force[i + 1] += height * part;
    }
}

#[allow(clippy::too_many_arguments)]
fn impacts(
    r: &mut Random,
    damage: Damage,
    order: f64,
    cage: f64,
    shaft: f64,
    n: usize,
    fs: f64,
    modes: &[Mode],
) -> Vec<f64> {
    let mut force = vec![0.0; n];
    let period = fs / (order * shaft);
    let (wander, jitter) = (r.between(0.003, 0.012), r.between(0.002, 0.015));
    let spread = r.between(0.05, 0.3);
    // Part of the load zone that the damage sees as it turns with its body, and what is left outside it.
    let zone = r.between(0.25, 0.6);
    let outside = r.between(0.0, 0.15);
    let turning = match damage {
        Damage::Inner => 1.0,
        Damage::Element => cage,
        _ => 0.0,
    };
    let swing = if damage == Damage::Outer { r.between(0.0, 0.3) } else { 0.0 };
    // The other raceway, half a spin later, shows less.
    let other = r.between(0.3, 1.0);
    let phase = r.uniform();
    let mut at = r.uniform() * period;
    let mut count = 0;
    while at < n as f64 {
        let turn = at / fs * shaft;
        let angle = TAU * (turning * turn + phase);
        let height = if turning > 0.0 {
            // Stribeck's load distribution.
            let load = 1.0 - (1.0 - angle.cos()) / (2.0 * zone);
            load.max(0.0).powf(1.1).max(outside)
        } else {
            1.0 + swing * (TAU * turn).cos()
        };
        let side = if damage == Damage::Element && count % 2 == 1 { other } else { 1.0 };
        let height = height * side * (spread * r.normal()).exp();
        strike(&mut force, at + jitter * period * r.normal(), height);
        at += period * (1.0 + wander * r.normal());
        count += 1;
    }
    ringing(&force, modes)
}

/// Tones of shaft, mains, gears and a converter; gives the mains' frequency, Hz.
fn add_tones(r: &mut Random, background: Background, x: &mut [f64], fs: f64, shaft: f64) -> f64 {
    let loud = |kind: Background| background == kind;
    let mut tones: Vec<(f64, f64, f64)> = Vec::new();
    let tone = |r: &mut Random, f: f64, a: f64| (f, a, TAU * r.uniform());
    let strong = if loud(Background::Unbalance) { 3.0 } else { 0.4 };
    for k in 1..=12 {
        let a = strong * r.uniform() / f64::from(k);
        tones.push(tone(r, f64::from(k) * shaft, a));
    }
    let mains = r.pick(&[50.0, 60.0]);
    for k in 1..=6 {
        let a = if loud(Background::Electrical) { 1.0 } else { 0.1 } * r.uniform() / f64::from(k);
        let off = r.between(0.9995, 1.0005);
        tones.push(tone(r, f64::from(k) * mains * off, a));
    }
    if loud(Background::Gear) {
        for _ in 0..2 {
            let teeth = r.between(17.0, 60.0).floor();
            for k in 1..=3 {
                let mesh = f64::from(k) * teeth * shaft;
                let a = r.uniform() / f64::from(k);
                tones.push(tone(r, mesh, a));
                for m in 1..=3 {
                    for sign in [-1.0, 1.0] {
                        let side = 0.4 * a * r.uniform() / f64::from(m);
                        tones.push(tone(r, mesh + sign * f64::from(m) * shaft, side));
                    }
                }
            }
        }
    }
    if loud(Background::Electrical) {
        let carrier = r.between(2000.0, 5000.0);
        for m in [-4.0, -2.0, 0.0, 2.0, 4.0] {
            let a = 0.5 * r.uniform();
            tones.push(tone(r, carrier + m * mains, a));
        }
    }
    for (f, a, phase) in tones.into_iter().filter(|t| t.0 < 0.5 * fs) {
        // Rotation by recursion: a sine of every sample is slow.
        let (s, c) = (TAU * f / fs).sin_cos();
        let (mut re, mut im) = (a * phase.cos(), a * phase.sin());
        for v in &mut *x {
            *v += re;
            (re, im) = (re * c - im * s, re * s + im * c);
        }
    }
    mains
}

/// A blow a turn of `period` samples.
fn knocks(r: &mut Random, n: usize, period: f64) -> Vec<f64> {
    let mut force = vec![0.0; n];
    let height = r.between(0.5, 3.0);
    let mut at = r.uniform() * period;
    while at < n as f64 {
        let strength = (0.2 * r.normal()).exp();
        strike(&mut force, at + 0.002 * period * r.normal(), height * strength);
        at += period;
    }
    let rms_of_one = (1.0 / period).sqrt();
    force.iter_mut().for_each(|f| *f /= rms_of_one * 3.0);
    force
}

fn background_of(r: &mut Random, background: Background, n: usize, fs: f64, shaft: f64, modes: &[Mode]) -> Vec<f64> {
    // White noise, noise through the structure's resonances, and noise that falls with frequency; unit RMS together.
    let shares = [r.uniform() + 0.2, r.uniform(), r.uniform()];
    let white: Vec<f64> = (0..n).map(|_| r.normal()).collect();
    let pushed: Vec<f64> = (0..n).map(|_| r.normal()).collect();
    let structure = ringing(&pushed, modes);
    let mut low = 0.0;
    let slope = (-TAU * 500.0 / fs).exp();
    let red: Vec<f64> = (0..n)
        .map(|_| {
            low = slope * low + (1.0 - slope * slope).sqrt() * r.normal();
            low
        })
        .collect();
    let rms = |v: &[f64]| (v.iter().map(|x| x * x).sum::<f64>() / n as f64).sqrt();
    let total = shares.iter().sum::<f64>();
    let parts = [white, structure, red];
    let gains: Vec<f64> = (parts.iter().zip(shares)).map(|(p, s)| (s / total).sqrt() / rms(p)).collect();
    let loud = |kind: Background| background == kind;
    let breathing = if loud(Background::Unbalance) { r.between(0.05, 0.3) } else { r.between(0.0, 0.05) };
    let mut x: Vec<f64> = (0..n)
        .map(|i| {
            let noise: f64 = parts.iter().zip(&gains).map(|(p, g)| g * p[i]).sum();
            noise * (1.0 + breathing * (TAU * shaft * i as f64 / fs).cos())
        })
        .collect();

    let mains = add_tones(r, background, &mut x, fs, shaft);
    let force = if loud(Background::Knock) { knocks(r, n, fs / shaft) } else { vec![0.0; n] };
    let ring = ringing(&force, modes);
    x.iter_mut().zip(&ring).for_each(|(x, v)| *x += v);
    if loud(Background::Electrical) {
        // Six pulses of a rectifier, one of them stronger, a sample or two wide.
        let period = fs / (2.0 * mains);
        let height = r.between(0.0, 4.0);
        let mut at = r.uniform() * period;
        while at < n as f64 {
            strike(&mut x, at, height);
            at += period;
        }
    }
    if loud(Background::Clicks) {
        let (rate, height) = (r.between(0.5, 6.0), r.between(5.0, 40.0));
        let mut at = -r.uniform().ln() / rate;
        while at * fs < n as f64 {
            strike(&mut x, at * fs, height * r.normal());
            at -= r.uniform().ln() / rate;
        }
    }
    x
}
