//! Slices across a roller: where they lie, the profile's drop there, and what healthy ones carry together (sections 15, 16).
//!
//! The contact laws of [`crate::contact`] hold for each slice with 1/n_s of the stiffness and of the damping. SI; z
//! from the roller's middle along +Z.

use crate::contact::{Damping, LoadDeflection, damped};
use crate::lanes::{Column, Lanes};
use crate::scenario::RollerProfile;

/// First and last z of slice k (from 0) of n_s across a roller of length L, m.
pub(crate) fn borders(k: usize, slices: usize, length: f64) -> [f64; 2] {
    // From the middle, so that slices on both sides are mirror images to the bit.
    let border = |k: usize| (2 * k as i64 - slices as i64) as f64 / (2.0 * slices as f64) * length;
    [border(k), border(k + 1)]
}

/// Drop p(z) of a profile, m: section 15, ISO/TS 16281. z, the roller's length and its diameter in m; infinite at the
/// logarithm's ends.
pub fn drop(profile: &RollerProfile, z: f64, length: f64, diameter: f64) -> f64 {
    match profile {
        RollerProfile::Straight => 0.0,
        RollerProfile::Crowned { crowned_radius_mm } => z * z / (2e-3 * crowned_radius_mm),
        RollerProfile::Logarithmic => {
            let curved = (2.5 * diameter).min(length);
            let scale = if length <= 2.5 * diameter { 0.35e-3 } else { 0.5e-3 };
            let from_straight = (2.0 * z.abs() - (length - curved)).max(0.0);
            -scale * diameter * (1.0 - (from_straight / curved).powi(2)).ln()
        }
        RollerProfile::Table { z_mm, drop_um } => {
            let z = 1e3 * z;
            let above = z_mm.partition_point(|at| *at <= z);
            1e-6 * match (above.checked_sub(1), z_mm.get(above)) {
                (None, _) => drop_um[0],
                (Some(k), None) => drop_um[k],
                (Some(k), Some(next)) => drop_um[k] + (drop_um[above] - drop_um[k]) * (z - z_mm[k]) / (next - z_mm[k]),
            }
        }
    }
}

/// The slices of every roller of a bearing, padded to whole groups with slices that weigh nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Slices {
    /// n_s.
    pub count: usize,
    /// z_k, m.
    pub z: Column,
    /// p(z_k), m.
    pub drop: Column,
    /// 1/n_s; 0 for padding.
    pub weight: Column,
    /// Half the roller's length, m.
    half: f64,
    /// The drops that there are, rising, and the weight of all slices of each: what counts where nothing tilts. Padding
    /// repeats the last and weighs nothing.
    level_drop: Column,
    level_weight: Column,
}

/// Distinct drops, rising, and the weights of all slices of each, padded to whole groups.
fn levels(drops: &[f64]) -> [Column; 2] {
    let mut sorted = drops.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut levels: Vec<(f64, f64)> = Vec::new();
    for drop in sorted {
        match levels.last_mut() {
            Some((last, slices)) if *last == drop => *slices += 1.0,
            _ => levels.push((drop, 1.0)),
        }
    }
    let padded = levels.len().next_multiple_of(crate::lanes::WIDTH);
    let last = levels.last().map_or(0.0, |(drop, _)| *drop);
    let (mut drop, mut weight) = (Column::new(padded, last), Column::new(padded, 0.0));
    for (k, (of, slices)) in levels.into_iter().enumerate() {
        (drop[k], weight[k]) = (of, slices / drops.len() as f64);
    }
    [drop, weight]
}

/// How roller and raceway approach at the roller's middle, and how that changes along it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Approach {
    /// delta at z = 0 before the profile, m.
    pub deformation: f64,
    /// d(delta)/dz.
    pub tilt: f64,
    /// Rate of the former, m/s.
    pub rate: f64,
    /// Rate of the latter, 1/s.
    pub tilt_rate: f64,
}

impl Approach {
    /// At rest, all along the roller alike.
    pub fn pressed(deformation: f64) -> Self {
        Self { deformation, ..Self::default() }
    }
}

/// What the slices of a moving contact carry together.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pressed {
    /// Elastic sum, N.
    pub elastic: f64,
    /// Q with each slice's own damping, N.
    pub force: f64,
    /// T = sum of z_k q_k, N m.
    pub moment: f64,
    /// What the damping takes, W.
    pub loss: f64,
    /// Share of the roller's length that touches.
    pub touching: f64,
    /// K_t, N/m, where nothing tilts.
    pub tangent: f64,
}

/// What slices of a moving contact do beside their elastic sum, added up lane by lane.
trait Sums<L> {
    /// Adds a group of slices at z whose deformation is `delta` and grows at `d`: their share of the length and elastic force. A function, since a
    /// closure would not be compiled for the kernel's instructions.
    fn add(&mut self, law: &LoadDeflection, z_and_d: (L, L), delta: L, share_and_spring: (L, L));
}

/// Of slices that are damped with c each.
struct Damped<L> {
    c: f64,
    force: L,
    moment: L,
    loss: L,
}

/// Of slices that are damped with their stiffness.
struct Timed<L> {
    moment: L,
    /// The Hessian of the energy in (delta, tilt) times their rates, N/s and N m/s.
    rates: [L; 2],
    /// Largest delta_k, m.
    deepest: L,
}

/// What the slices of a resting contact carry together.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Carried {
    /// Q, N.
    pub force: f64,
    /// T, N m.
    pub moment: f64,
    /// Sums of each slice's stiffness times 1, z and z^2: N/m, N, N m.
    pub stiffness: [f64; 3],
    /// Elastic energy, J.
    pub energy: f64,
}

impl Slices {
    /// n_s of them across a roller of `length` and `diameter` (m).
    pub fn new(count: usize, length: f64, diameter: f64, profile: &RollerProfile) -> Self {
        let padded = count.next_multiple_of(crate::lanes::WIDTH);
        let middle = |k: usize| {
            let [low, high] = borders(k, count, length);
            0.5 * (low + high)
        };
        let column = |of: &dyn Fn(usize) -> f64| {
            let mut column = Column::new(padded, 0.0);
            (0..count).for_each(|k| column[k] = of(k));
            column
        };
        let drops: Vec<f64> = (0..count).map(|k| drop(profile, middle(k), length, diameter)).collect();
        let [level_drop, level_weight] = levels(&drops);
        Self {
            count,
            z: column(&middle),
            drop: column(&|k| drops[k]),
            weight: column(&|_| 1.0 / count as f64),
            half: 0.5 * length,
            level_drop,
            level_weight,
        }
    }

    /// Whether no healthy slice touches: a bound, which costs less than the sums.
    #[inline(always)]
    pub fn are_clear(&self, deformation: f64, tilt: f64) -> bool {
        deformation + tilt.abs() * self.half <= 0.0
    }

    /// Largest deformation of a healthy slice, m.
    pub(crate) fn deepest(&self, deformation: f64, tilt: f64) -> f64 {
        let own = self.z.iter().zip(&self.drop).take(self.count).map(|(z, drop)| deformation + tilt * z - drop);
        own.fold(deformation, f64::max)
    }

    /// Forces of a moving contact. Each slice that touches is damped (section 16).
    #[inline(always)]
    pub fn press<L: Lanes>(&self, law: &LoadDeflection, at: &Approach) -> Pressed {
        let c = match law.damping {
            Damping::Constant(c) => c,
            Damping::Time { tau, roughness } => return self.press_timed::<L>(law, at, [tau, roughness]),
        };
        let zero = L::zero();
        let mut sums = Damped { c, force: zero, moment: zero, loss: zero };
        let [elastic, touching] = self.sum_up(law, at, &mut sums);
        let [force, moment, loss] = [sums.force, sums.moment, sums.loss].map(L::sum);
        Pressed { elastic, force, moment, loss, touching, tangent: 0.0 }
    }

    /// Elastic sum (N) and touching share of the slices of a moving contact; what else they do, into `sums`.
    #[inline(always)]
    fn sum_up<L: Lanes>(&self, law: &LoadDeflection, at: &Approach, sums: &mut impl Sums<L>) -> [f64; 2] {
        let zero = L::zero();
        let (deformation, tilt) = (L::splat(at.deformation), L::splat(at.tilt));
        let (rate, tilt_rate) = (L::splat(at.rate), L::splat(at.tilt_rate));
        let (mut elastic, mut touching) = (zero, zero);
        for k in 0..self.z.len() / L::COUNT {
            let z = L::new(L::groups(&self.z)[k]);
            let share = L::new(L::groups(&self.weight)[k]);
            let delta = tilt.times_plus(z, deformation - L::new(L::groups(&self.drop)[k]));
            if !delta.any_positive() {
                continue;
            }
            let spring = share * law.healthy(delta);
            elastic += spring;
            touching += delta.if_above(zero, share, zero);
            sums.add(law, (z, tilt_rate.times_plus(z, rate)), delta, (share, spring));
        }
        [elastic.sum(), touching.sum()]
    }

    /// The same where damping goes with the stiffness (section 20): tau sigma times the Hessian of the energy times the rates, sigma at the slice that is deformed most where that is more than the middle.
    #[inline(always)]
    fn press_timed<L: Lanes>(&self, law: &LoadDeflection, at: &Approach, [tau, roughness]: [f64; 2]) -> Pressed {
        let zero = L::zero();
        let mut sums = Timed { moment: zero, rates: [zero; 2], deepest: zero };
        let [elastic, touching] = self.sum_up(law, at, &mut sums);
        let moment = sums.moment.sum();
        let x = sums.deepest.array().as_ref().iter().fold(at.deformation, |a, b| a.max(*b));
        let damping = if x > 0.0 { tau * x / (x + roughness) } else { 0.0 };
        let added = sums.rates.map(|rate| damping * rate.sum());
        let force = elastic + added[0];
        let open = force <= 0.0 || elastic <= 0.0;
        let [by_force, by_moment] = if open { [-elastic, -moment] } else { added };
        Pressed {
            elastic,
            force: elastic + by_force,
            moment: moment + by_moment,
            loss: by_force * at.rate + by_moment * at.tilt_rate,
            touching,
            tangent: 0.0,
        }
    }

    /// Elastic sum, touching share of the length and tangent stiffness at a deformation (m) without tilt and damage: those of
    /// [`Slices::press`], to round-off.
    #[inline(always)]
    pub fn press_evenly<L: Lanes>(&self, law: &LoadDeflection, deformation: f64) -> Pressed {
        let whole = L::splat(deformation);
        let exponent = L::splat(law.exponent.value());
        let (mut elastic, mut touching, mut tangent) = (L::zero(), L::zero(), L::zero());
        for k in 0..self.level_drop.len() / L::COUNT {
            let delta = whole - L::new(L::groups(&self.level_drop)[k]);
            if !delta.any_positive() {
                // The drops rise.
                break;
            }
            let weight = L::new(L::groups(&self.level_weight)[k]);
            let force = law.healthy(delta);
            elastic = weight.times_plus(force, elastic);
            touching += delta.if_above(L::zero(), weight, L::zero());
            tangent += weight * exponent * force / delta.if_above(L::zero(), delta, L::splat(1.0));
        }
        Pressed { elastic: elastic.sum(), touching: touching.sum(), tangent: tangent.sum(), ..Pressed::default() }
    }

    /// Deformation of each slice, m.
    #[inline]
    pub(crate) fn deformations(&self, at: Approach) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |k| at.deformation + at.tilt * self.z[k] - self.drop[k])
    }

    /// Line load q at each slice of a moving contact, N/m: its force over its width; `out` holds n_s numbers.
    pub fn line_load(&self, law: &LoadDeflection, at: &Approach, out: &mut [f64]) {
        let per_width = 0.5 / self.half;
        for ((out, delta), z) in out.iter_mut().zip(self.deformations(*at)).zip(&self.z) {
            let rate = at.rate + at.tilt_rate * z;
            *out = per_width * damped(law.healthy(delta), law.damper(law.healthy(delta), delta), rate);
        }
    }

    /// A resting contact.
    pub fn carry(&self, law: &LoadDeflection, at: &Approach) -> Carried {
        let mut sum = Carried::default();
        for (k, delta) in self.deformations(*at).enumerate().filter(|(_, delta)| *delta > 0.0) {
            let (z, weight) = (self.z[k], self.weight[k]);
            let force = weight * law.healthy(delta);
            let stiffness = weight * law.tangent(delta);
            sum.force += force;
            sum.moment += force * z;
            for (sum, lever) in sum.stiffness.iter_mut().zip([1.0, z, z * z]) {
                *sum += stiffness * lever;
            }
            sum.energy += weight * law.energy(delta);
        }
        sum
    }

    /// Deformation at the roller's middle under `force` (N) without tilt, m; at least `least`, that of a
    /// straight roller.
    pub fn deflection(&self, law: &LoadDeflection, force: f64, least: f64) -> f64 {
        let carried = |delta: f64| self.carry(law, &Approach::pressed(delta)).force;
        let (mut low, mut high) = (least, least);
        while carried(high) < force {
            (low, high) = (high, 2.0 * high + 1e-9);
        }
        // To the last bit.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            match carried(middle) < force {
                true => low = middle,
                false => high = middle,
            }
        }
        high
    }

    /// Share of the roller's length that touches at a deformation without tilt.
    pub fn touching(&self, deformation: f64) -> f64 {
        let touching = self.deformations(Approach::pressed(deformation)).zip(&self.weight);
        touching.filter(|(delta, _)| *delta > 0.0).map(|(_, weight)| weight).sum()
    }
}

impl<L: Lanes> Sums<L> for Timed<L> {
    #[inline(always)]
    fn add(&mut self, law: &LoadDeflection, (z, d): (L, L), delta: L, (share, spring): (L, L)) {
        let zero = L::zero();
        let stiffness = L::splat(law.exponent.value()) * spring / delta.if_above(zero, delta, L::splat(1.0));
        let stiffening = stiffness * d;
        self.moment = z.times_plus(spring, self.moment);
        self.rates[0] += stiffening;
        self.rates[1] = z.times_plus(stiffening, self.rates[1]);
        self.deepest = self.deepest.at_least(share.if_above(zero, delta, zero));
    }
}

impl<L: Lanes> Sums<L> for Damped<L> {
    #[inline(always)]
    fn add(&mut self, _: &LoadDeflection, (z, d): (L, L), delta: L, (share, spring): (L, L)) {
        let zero = L::zero();
        let pressed = (share * L::splat(self.c)).times_plus(d, spring);
        let pressed = delta.if_above(zero, pressed.positive_part(), zero);
        self.force += pressed;
        self.moment = z.times_plus(pressed, self.moment);
        self.loss = (pressed - spring).times_plus(d, self.loss);
    }
}

/// A healthy contact without tilt, even or along a profile: what energy of damage refers to (section 19).
#[derive(Debug, Clone, Copy)]
pub struct Healthy<'a> {
    /// Law of the contact.
    pub law: &'a LoadDeflection,
    /// The slices, where each counts by itself.
    pub slices: Option<&'a Slices>,
    /// L, m.
    pub(crate) length: f64,
}

impl Healthy<'_> {
    /// Q (N) and K_t (N/m) at a deformation, m.
    #[inline]
    pub fn force_and_tangent(&self, delta: f64) -> [f64; 2] {
        match self.slices {
            None => {
                let force = self.law.healthy(delta);
                [force, if delta > 0.0 { self.law.exponent.value() * force / delta } else { 0.0 }]
            }
            Some(slices) => {
                let pressed = slices.press_evenly::<f64>(self.law, delta);
                [pressed.elastic, pressed.tangent]
            }
        }
    }

    /// Elastic energy at a deformation, J.
    pub fn energy(&self, delta: f64) -> f64 {
        match self.slices {
            None => self.law.energy(delta),
            Some(slices) => slices.carry(self.law, &Approach::pressed(delta)).energy,
        }
    }

    /// Deformation at which it stores an energy (J, above 0), m.
    pub(crate) fn deformation_of(&self, energy: f64) -> f64 {
        let n = self.law.exponent.value();
        let even = ((n + 1.0) * energy / self.law.stiffness).powf(1.0 / (n + 1.0));
        if self.slices.is_none() {
            return even;
        }
        // A profile takes more, and the even contact bounds it from below.
        let (mut low, mut high) = (even, 2.0 * even);
        while self.energy(high) < energy {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.energy(middle) < energy { low = middle } else { high = middle }
        }
        high
    }

    /// Length that touches at a deformation, m: of a ball the axis of its ellipse across the groove.
    pub(crate) fn touching(&self, delta: f64) -> f64 {
        match (self.law.axis_across(delta), self.slices) {
            (Some(axis), _) => axis,
            (None, Some(slices)) => self.length * slices.touching(delta),
            (None, None) => self.length,
        }
    }

    /// What a contact that carries `force` (N) at the deformation `delta` (m) lacks of the touching length of the healthy one, m: of a
    /// roller by Palmgren's law, in which the force goes with the length to the power 8/9; of a ball in proportion.
    #[inline]
    pub(crate) fn lost_length(&self, delta: f64, force: f64) -> f64 {
        let [whole, _] = self.force_and_tangent(delta);
        let share = if whole > 0.0 { (force / whole).clamp(0.0, 1.0) } else { f64::from(u8::from(force > 0.0)) };
        match self.law.axis_across(delta) {
            None => self.length * (1.0 - share * share.sqrt().sqrt().sqrt()),
            Some(axis) => axis * (1.0 - share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::Exponent;
    use crate::lanes::Portable;

    #[test]
    fn prop_slices_of_equal_drop_carry_together_what_each_carries_alone() {
        let law = LoadDeflection {
            stiffness: 1e9,
            exponent: Exponent::TenNinths,
            damping: Damping::Constant(200.0),
            across: None,
        };
        let profiles = [
            RollerProfile::Straight,
            RollerProfile::Logarithmic,
            RollerProfile::Crowned { crowned_radius_mm: 800.0 },
            // Neither even nor rising.
            RollerProfile::Table { z_mm: vec![-4.0, -1.0, 0.0, 3.0, 4.0], drop_um: vec![6.0, 0.0, 0.5, 0.2, 4.0] },
        ];
        for (profile, count) in profiles.iter().flat_map(|p| [1, 2, 7, 30, 33].map(|n| (p, n))) {
            let slices = Slices::new(count, 9e-3, 9e-3, profile);
            for deformation in [-1e-6, 0.0, 1e-8, 3e-7, 2e-6, 9e-6, 4e-5] {
                let at = Approach::pressed(deformation);
                let each = slices.press::<Portable>(&law, &at);
                let Pressed { elastic, touching, .. } = slices.press_evenly::<Portable>(&law, deformation);
                let one = slices.press_evenly::<f64>(&law, deformation).elastic;
                // Round-off of some thirty additions.
                assert!((elastic - each.elastic).abs() <= 1e-14 * each.elastic);
                assert!((one - each.elastic).abs() <= 1e-14 * each.elastic);
                assert!((touching - each.touching).abs() < 1e-14);
            }
        }
    }
}
