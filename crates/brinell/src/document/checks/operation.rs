//! Speed, load, supports and sampling.

use super::{Checker, short};
use crate::analysis::HARMONICS;
use crate::bearing::kinematics::{Geometry, Kinematics};
use crate::bearing::rating::static_rating;
use crate::operation::Load;
use crate::pressure::static_limit;
use crate::scenario::{LoadOn, Speed};
use crate::signal::{self, decimate::PASSBAND};
use std::f64::consts::PI;

/// Samples beyond which a run is a slip of the unit.
const MOST_SAMPLES: f64 = 1e10;
/// Samples beyond which a run is worth a word.
const MANY_SAMPLES: f64 = 1e8;

/// Speed factor beyond which no bearing turns, mm r/min: |speed| times pitch diameter. Main-shaft bearings of aircraft
/// engines were tested at 3e6 (Bamberger, Zaretsky, Signer: Endurance and failure characteristics of main-shaft jet
/// engine bearings at 3 x 10^6 DN, Journal of Lubrication Technology 98, 1976, 580-585); this leaves three times as
/// much.
const MOST_SPEED_FACTOR: f64 = 1e7;
/// That of the tests.
const TESTED_SPEED_FACTOR: f64 = 3e6;

/// Multiple of the static load rating that no bearing carries. The rating represents 4 GPa at the heaviest roller (ISO
/// 76), and a line contact's pressure grows with the square root of the load, so this is 12.6 GPa, and 9.9 GPa on
/// average over the contact: more than the hardness of bearing steel, some 8 GPa (60 HRC), which is the average
/// pressure that it flows under. From about 30 times the rating on, a roller is squeezed so hard that a run hardly
/// moves. Of balls the rating represents 4.2 GPa, and a point contact's pressure grows with the cube root: 9.05 GPa. Their
/// permanent deformation, 1/10000 of the diameter at the rating, grows with the square of the load (Palmgren, in Harris,
/// Rolling Bearing Analysis, on permanent deformation), and is 1 % of the diameter here.
const MOST_RATINGS: f64 = 10.0;

const SPEED: &str = "operation.speed_rpm";
const LOAD: &str = "operation.load_n";
const GRAVITY: &str = "operation.gravity_m_per_s2";
const RATE: &str = "simulation.sample_rate_hz";
const DURATION: &str = "simulation.duration_s";

impl Checker<'_> {
    pub(super) fn operation(&mut self) {
        match &self.s.operation.speed_rpm {
            Speed::Constant(speed) => {
                if *speed == 0.0 {
                    self.error(SPEED, "the inner ring must turn".into(), "not 0".into(), &[]);
                }
            }
            Speed::Profile(points) => {
                if let Some(pair) = points.windows(2).find(|pair| pair[1][0] <= pair[0][0]) {
                    self.error(
                        SPEED,
                        format!(
                            "times must increase from point to point; {} s follows {} s",
                            short(pair[1][0]),
                            short(pair[0][0])
                        ),
                        "points [[t_s, rpm], ...] with t_s strictly increasing".into(),
                        &[],
                    );
                }
                if points.iter().all(|point| point[1] == 0.0) {
                    let message = if points.is_empty() {
                        "the speed profile has no points"
                    } else {
                        "the speed is 0 throughout: the inner ring must turn"
                    };
                    self.error(SPEED, message.into(), "at least one point with a speed other than 0".into(), &[]);
                }
            }
        }
    }

    /// A speed that no bearing of this size withstands, whose run would take steps of 1e-11 s, or that none was shown to.
    pub(super) fn speed_factor(&mut self) {
        let pitch = self.s.bearing.pitch_diameter_mm;
        let (speed, place) = match &self.s.operation.speed_rpm {
            Speed::Constant(speed) => (*speed, String::new()),
            Speed::Profile(points) => match points.iter().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs())) {
                Some([t, speed]) => (*speed, format!(" at t = {} s", short(*t))),
                None => return,
            },
        };
        let factor = speed.abs() * pitch;
        let message = format!(
            "{} r/min{place} on a pitch diameter of {} mm is a speed factor of {} mm r/min",
            short(speed),
            short(pitch),
            short(factor)
        );
        let also = &["bearing.pitch_diameter_mm"];
        let within = |most: f64| format!("-{0} to {0}", short((most / pitch).floor()));
        if factor > MOST_SPEED_FACTOR {
            let message = format!("{message}; no bearing allows more than {MOST_SPEED_FACTOR:e}");
            self.error(SPEED, message, within(MOST_SPEED_FACTOR), also);
        } else if factor > TESTED_SPEED_FACTOR {
            let message =
                format!("{message}; main-shaft bearings of jet engines were tested up to {TESTED_SPEED_FACTOR:e}");
            self.warn(SPEED, message, within(TESTED_SPEED_FACTOR), also);
        }
    }

    /// Forces under which steel flows; the model is elastic.
    pub(super) fn overload(&mut self) {
        let (b, o) = (&self.s.bearing, &self.s.operation);
        let rating = static_rating(b).load;
        let most = MOST_RATINGS * rating;
        let load = o.load_n[0].hypot(o.load_n[1]);
        let gravity = o.gravity_m_per_s2[0].hypot(o.gravity_m_per_s2[1]);
        let heavier = b.inner_ring_mass_kg.max(b.outer_ring_mass_kg);
        let rings = ["bearing.inner_ring_mass_kg", "bearing.outer_ring_mass_kg"];
        for (key, what, force, allowed, also) in [
            (LOAD, "the load", load, most, &[][..]),
            (GRAVITY, "the heavier ring's weight", heavier * gravity, most / heavier, &rings),
        ] {
            if most > 0.0 && force > most {
                let root = if b.has_balls() { 1.0 / 3.0 } else { 0.5 };
                let pressure = signal::short(1e-9 * static_limit(b) * MOST_RATINGS.powf(root), 3);
                let message = format!(
                    "{what} of {} N is {} times the static load rating C0 = {} N; steel flows below {MOST_RATINGS} times C0, a contact pressure of \
                     {pressure} GPa",
                    short(force),
                    short(force / rating),
                    short(rating)
                );
                self.error(key, message, format!("a resultant of at most {}", short(allowed)), also);
            }
        }
    }

    /// Bound of `docs/src/theory/motion.md`: a support that carries the load before the clearance is closed.
    pub(super) fn support(&mut self) {
        let s = self.s;
        let load = s.operation.load_n[0].hypot(s.operation.load_n[1]);
        let masses = [s.bearing.inner_ring_mass_kg, s.bearing.outer_ring_mass_kg];
        let full = Load { full: s.operation.load_n, on: s.operation.load_on, ramp: 0.0 };
        let carried = full.with_weight(masses, s.operation.gravity_m_per_s2);
        let weight = if s.operation.gravity_m_per_s2 == [0.0; 2] { "" } else { ", the ring's weight included" };
        let (loaded, held, stiffness, other) = match s.operation.load_on {
            LoadOn::OuterRing => (
                "support.outer_stiffness_n_per_m",
                "support.inner_stiffness_n_per_m",
                s.support.outer_stiffness_n_per_m,
                s.support.inner_stiffness_n_per_m,
            ),
            LoadOn::InnerRing => (
                "support.inner_stiffness_n_per_m",
                "support.outer_stiffness_n_per_m",
                s.support.inner_stiffness_n_per_m,
                s.support.outer_stiffness_n_per_m,
            ),
        };
        // The lumped model holds neither ring by the outer support: section 10.
        let full = s.simulation.model.moves_every_part();
        let reference_inner = s.operation.load_on == LoadOn::InnerRing;
        let gap = 1e-6 * (s.bearing.radial_clearance_um + s.bearing.outer_gap_um);
        if (full || reference_inner) && carried > 0.0 && gap > 0.0 && stiffness * gap >= carried {
            self.warn(
                loaded,
                format!(
                    "the support can carry the whole load: k C_r = {} N against {} N{weight}, so the rollers may stay unloaded",
                    short(stiffness * gap),
                    short(carried)
                ),
                format!("< {:.3e}", carried / gap),
                &["bearing.radial_clearance_um", LOAD],
            );
        }
        if (full || !reference_inner) && load > 0.0 && other == 0.0 {
            self.warn(
                held,
                "nothing holds the ring that the load presses on: the bearing will drift".into(),
                "> 0".into(),
                &[LOAD],
            );
        }
    }

    pub(super) fn simulation(&mut self) {
        let (duration, rate) = (self.s.simulation.duration_s, self.s.simulation.sample_rate_hz);
        let samples = duration * rate;
        if samples < 1.0 {
            self.error(DURATION, "shorter than one sample".into(), format!(">= {}", short(1.0 / rate)), &[RATE]);
        } else if samples > MOST_SAMPLES {
            self.error(
                DURATION,
                format!("{samples:.1e} samples are more than any machine keeps"),
                format!("<= {}", short(MOST_SAMPLES / rate)),
                &[RATE],
            );
        } else if samples > MANY_SAMPLES {
            self.warn(DURATION, format!("{samples:.1e} samples of every channel"), String::new(), &[RATE]);
        }
        self.sample_rate();
        self.record();
    }

    fn sample_rate(&mut self) {
        let b = &self.s.bearing;
        let fastest = match &self.s.operation.speed_rpm {
            Speed::Constant(speed) => speed.abs(),
            Speed::Profile(points) => points.iter().fold(0.0, |m: f64, point| m.max(point[1].abs())),
        };
        let kinematics = Kinematics::pure_rolling(&Geometry::of(b), fastest * PI / 30.0);
        let highest = self
            .s
            .defects
            .iter()
            .map(|defect| kinematics.defect_frequency(defect.on))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((name, frequency)) = highest else {
            return;
        };
        // What the diagnosis reads, below what the anti-alias filter passes (`docs/src/theory/numerics.md`).
        let needed = HARMONICS as f64 * frequency / PASSBAND;
        let rate = self.s.simulation.sample_rate_hz;
        if rate < needed {
            let in_khz = if rate < 1000.0 && 1e3 * rate >= needed { "; in kHz instead of Hz?" } else { "" };
            self.warn(
                RATE,
                format!(
                    "too low for {HARMONICS} harmonics of {name} = {} Hz below {PASSBAND} of the sample rate{in_khz}",
                    short(frequency)
                ),
                format!(">= {}", short(needed)),
                &[SPEED],
            );
        }
    }

    fn record(&mut self) {
        const RECORD: &str = "simulation.record";
        let fits = |c: char| c.is_ascii_alphanumeric() || "_*.".contains(c);
        let bad = |name: &&String| name.is_empty() || !name.chars().all(fits);
        if let Some(name) = self.s.simulation.record.iter().find(bad) {
            self.error(
                RECORD,
                format!("no channel can match {}", crate::document::toml_text::quote(name)),
                "names of letters, digits, _, * and, in a machine, dots".into(),
                &[],
            );
        }
    }
}
