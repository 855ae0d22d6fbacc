//! Basic reference rating life of cylindrical roller bearings by ISO/TS 16281, from the load of every lamina.
//!
//! L10r = ( sum over rows and laminae of (q_kei/q_kci)^(9/2) + (q_kee/q_kce)^(9/2) )^(-8/9) million revolutions, 90 %
//! reliability. The inner ring turns and the load does not: the inner raceway's equivalent load is the mean of order 4
//! over the rollers, the outer one's that of order 9/2. The formulas and their constants were checked against a public
//! implementation that names the standard's equations (38 to 65), and against the derivation: 0.378, 0.364 and 1.038
//! are J_r/J_1, J_r/J_2 and J_2/J_1 of a load zone of half a turn.

use super::distribution::Distribution;
use super::line::ContactLine;
use crate::bearing::rating::{LAMBDA_NU, dynamic_rating};
use crate::scenario::Bearing;

/// Stress riser function of ISO/TS 16281 for lamina k (from 0) of n_s: 1 in the middle, 2.3 at the ends.
///
/// f = 1 - 0.01 / ln( 1.985 |(2 k - n_s - 1)/(2 n_s - 2)| ) with k from 1. It stands for the stress at the ends of
/// rollers with a profile.
pub fn stress_riser(k: usize, slices: usize) -> f64 {
    let (k, n) = (k as f64 + 1.0, slices as f64);
    let from_middle = (2.0 * k - n - 1.0).abs();
    // ln 0: the middle lamina of an odd number, and the only one.
    if from_middle == 0.0 {
        return 1.0;
    }
    1.0 - 0.01 / (1.985 * from_middle / (2.0 * n - 2.0)).ln()
}

/// q_kci and q_kce, the basic dynamic load ratings of a lamina at the inner and the outer raceway, N; C_r by
/// [`dynamic_rating`].
///
/// Q_ci = C_r / (0.83 * 0.378 Z i^(7/9)) (1 + g^(9/2))^(2/9), Q_ce = C_r / (0.83 * 0.364 Z i^(7/9)) (1 +
/// g^(-9/2))^(2/9), g = 1.038 ((1 - d/D_m)/(1 + d/D_m))^(143/108); q = Q n_s^(-7/9).
pub fn lamina_ratings(bearing: &Bearing, slices: usize) -> [f64; 2] {
    let gamma = bearing.roller_diameter_mm / bearing.pitch_diameter_mm;
    let g = 1.038 * ((1.0 - gamma) / (1.0 + gamma)).powf(143.0 / 108.0);
    let rollers = bearing.rollers_per_row as f64 * (bearing.rows as f64).powf(7.0 / 9.0);
    let roller = dynamic_rating(bearing) / (LAMBDA_NU * rollers);
    let share = (slices as f64).powf(-7.0 / 9.0);
    [(0.378, 4.5), (0.364, -4.5)].map(|(j, power)| share * roller / j * (1.0 + g.powf(power)).powf(2.0 / 9.0))
}

/// L10r, revolutions; `None` where no roller presses the inner raceway: the rollers' own centrifugal force is no load
/// of the bearing.
///
/// A distribution at several positions of the cage counts as one with so many times the rollers. The forces are those
/// of the contacts: what a support holds is not among them, and the rollers' centrifugal force is.
pub fn reference_life(bearing: &Bearing, distribution: &Distribution) -> Option<f64> {
    let contacts = &distribution.contacts;
    if contacts.iter().all(|[inner, _]| inner.force <= 0.0) {
        return None;
    }
    let slices = distribution.z.len();
    let width = 1e-3 * bearing.roller_length_mm / slices as f64;
    let ratings = lamina_ratings(bearing, slices);
    let mut sum = 0.0;
    for row in 0..bearing.rows {
        let pairs = contacts.iter().filter(|p| p[0].row == row);
        let count = pairs.clone().count() as f64;
        for k in 0..slices {
            for (side, order) in [(0, 4.0), (1, 4.5)] {
                let power = |p: &[ContactLine; 2]| (p[side].line_load[k] * width / ratings[side]).powf(order);
                let mean = pairs.clone().map(power).sum::<f64>() / count;
                let equivalent = stress_riser(k, slices) * mean.powf(1.0 / order);
                sum += equivalent.powf(4.5);
            }
        }
    }
    (sum > 0.0).then(|| 1e6 * sum.powf(-8.0 / 9.0))
}
