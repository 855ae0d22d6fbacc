//! delta_eff(delta, tilt, s) of one damaged surface under a contact that tilts (section 19): a table for each of a few tilts, and natural
//! cubic splines between them.
//!
//! delta is the deformation at the roller's middle, tilt its change along z. A member's table counts from the end of the roller that is deepest,
//! D = delta + |tilt| L/2, where contact begins at 0. Beyond the last tilt the splines go on straight. The derivatives are exactly those of one
//! function, which is C2.

use super::spline;
use super::table::{Effective, Table};
use std::sync::Arc;

/// delta_eff of a tilting contact at one place, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaning {
    /// delta_eff, m. Where it is below 0 one end of the roller may still touch.
    pub delta: f64,
    /// d delta_eff / d delta.
    pub by_delta: f64,
    /// d delta_eff / d tilt, m.
    pub by_tilt: f64,
    /// d delta_eff / d s.
    pub by_s: f64,
    /// d2 delta_eff / d delta2, 1/m.
    pub by_delta2: f64,
    /// d2 delta_eff / d delta d tilt.
    pub by_delta_tilt: f64,
    /// d2 delta_eff / d tilt2, m.
    pub by_tilt2: f64,
}

impl Leaning {
    /// Of a contact that does not tilt.
    #[inline]
    pub(crate) fn upright(on: Effective) -> Self {
        let Effective { delta, by_delta, by_s, by_delta2 } = on;
        Self { delta, by_delta, by_tilt: 0.0, by_s, by_delta2, by_delta_tilt: 0.0, by_tilt2: 0.0 }
    }
}

/// Tables over tilt.
#[derive(Debug, Clone, PartialEq)]
pub struct Tilted {
    /// Tilts, rising.
    tilts: Vec<f64>,
    /// The table of each.
    tables: Vec<Arc<Table>>,
    /// D - delta of each, m.
    leads: Vec<f64>,
    /// Second derivatives at the nodes of the spline that is 1 at one node and 0 at the others, node by node.
    seconds: Vec<Vec<f64>>,
    /// First and last s of all, m.
    range: [f64; 2],
}

impl Tilted {
    /// From tables over D at rising `tilts`; `half` is L/2, m.
    pub(crate) fn new(tilts: Vec<f64>, tables: Vec<Arc<Table>>, half: f64) -> Self {
        let seconds = (0..tilts.len())
            .map(|k| {
                let one: Vec<f64> = (0..tilts.len()).map(|j| f64::from(u8::from(j == k))).collect();
                spline::curvatures(&tilts, &one)
            })
            .collect();
        let leads = tilts.iter().map(|tilt| tilt.abs() * half).collect();
        let join = |all: [f64; 2], own: [f64; 2]| [all[0].min(own[0]), all[1].max(own[1])];
        let range = tables.iter().map(|table| table.range_s()).fold([f64::INFINITY, f64::NEG_INFINITY], join);
        Self { tilts, tables, leads, seconds, range }
    }

    /// First and last s, m: outside, the contact is healthy.
    pub fn range_s(&self) -> [f64; 2] {
        self.range
    }

    /// delta_eff where the deformation at the middle is `delta` (m), changes by `tilt` along z and the contact lies at `s`, m.
    pub fn at(&self, delta: f64, tilt: f64, s: f64) -> Leaning {
        let mut sum = Leaning::upright(Effective { delta: 0.0, by_delta: 0.0, by_s: 0.0, by_delta2: 0.0 });
        let last = self.tilts.len() - 1;
        let place = tilt.clamp(self.tilts[0], self.tilts[last]);
        let (k, beyond) = (spline::interval(&self.tilts, place), tilt - place);
        let weigh = spline::Weights::at(&self.tilts, k, place);
        for (j, table) in self.tables.iter().enumerate() {
            let [mut weight, slope, mut bend] = weigh.of(j, &self.seconds[j]);
            if beyond != 0.0 {
                (weight, bend) = (weight + beyond * slope, 0.0);
            }
            let on = table.straight(delta + self.leads[j], s);
            let own = on.delta - self.leads[j];
            sum.delta += weight * own;
            sum.by_delta += weight * on.by_delta;
            sum.by_tilt += slope * own;
            sum.by_s += weight * on.by_s;
            sum.by_delta2 += weight * on.by_delta2;
            sum.by_delta_tilt += slope * on.by_delta;
            sum.by_tilt2 += bend * own;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact whose damage takes a share of delta that tilt changes, by tables that know nothing of each other.
    fn tilted() -> Tilted {
        let half = 3e-3;
        let tilts = vec![-1e-3, -3e-4, 0.0, 3e-4, 1e-3];
        let s: Vec<f64> = (0..=20).map(|k| f64::from(k) * 1e-4 - 1e-3).collect();
        let delta: Vec<f64> = (0..=10).map(|k| f64::from(k) * 2e-6).collect();
        let tables = tilts
            .iter()
            .map(|tilt: &f64| {
                let value = |s: f64, d: f64| d * (1.0 - (0.3 + 200.0 * tilt) * (-(s / 4e-4).powi(2)).exp());
                let grid: Vec<f64> = s.iter().flat_map(|s| delta.iter().map(move |d| value(*s, *d))).collect();
                Arc::new(Table::from_grid(&s, &delta, &grid).unwrap())
            })
            .collect();
        Tilted::new(tilts, tables, half)
    }

    #[test]
    fn prop_derivatives_are_those_of_one_function_and_continuous() {
        let of = tilted();
        let step = [1e-10, 1e-7, 1e-8];
        for (delta, tilt, s) in [
            (3.1e-6, 1.3e-4, 2.2e-4),
            (-1e-6, -7e-4, -3.3e-4),
            (5e-6, 1.7e-3, 1e-5),
            (2e-6, -2.5e-3, 4e-4),
            (-4e-6, 2e-4, 0.0),
        ] {
            let here = of.at(delta, tilt, s);
            let slope =
                |from: Leaning, to: Leaning, step: f64, of: fn(&Leaning) -> f64| (of(&to) - of(&from)) / (2.0 * step);
            let by_delta = [of.at(delta - step[0], tilt, s), of.at(delta + step[0], tilt, s)];
            let by_tilt = [of.at(delta, tilt - step[1], s), of.at(delta, tilt + step[1], s)];
            let by_s = [of.at(delta, tilt, s - step[2]), of.at(delta, tilt, s + step[2])];
            let close = |found: f64, exact: f64, scale: f64| {
                assert!((found - exact).abs() < 1e-4 * scale, "{delta} {tilt} {s}: {found} {exact}");
            };
            close(slope(by_delta[0], by_delta[1], step[0], |x| x.delta), here.by_delta, 1.0);
            close(slope(by_delta[0], by_delta[1], step[0], |x| x.by_delta), here.by_delta2, 1e5);
            close(slope(by_tilt[0], by_tilt[1], step[1], |x| x.delta), here.by_tilt, 1e-3);
            close(slope(by_tilt[0], by_tilt[1], step[1], |x| x.by_delta), here.by_delta_tilt, 1e3);
            close(slope(by_tilt[0], by_tilt[1], step[1], |x| x.by_tilt), here.by_tilt2, 1.0);
            close(slope(by_s[0], by_s[1], step[2], |x| x.delta), here.by_s, 1e-2);
        }
    }

    #[test]
    fn analytic_off_damage_and_at_a_node_it_is_what_stands_there() {
        let of = tilted();
        let off = of.at(-2e-6, 4e-4, 5e-3);
        assert!((off.delta + 2e-6).abs() < 1e-18 && (off.by_delta - 1.0).abs() < 1e-12 && off.by_tilt.abs() < 1e-15);
        let node = of.at(2e-6, 3e-4, 1.5e-4);
        let table = of.tables[3].at(2e-6 + 0.9e-6, 1.5e-4);
        assert!((node.delta + 0.9e-6 - table.delta).abs() < 1e-18);
    }
}
