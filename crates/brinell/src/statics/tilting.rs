//! Static balance where rollers and rings tilt (section 16): each roller's (r, beta) is eliminated, the rings' eight
//! coordinates are searched.

use super::balance::{
    Balance, NoBalance, Problem, Tilted, angles, by_slot, external, force_scale, own_force, softest, stalled,
};
use super::newton::{Fixed, eliminate, minimise};
use super::pressed::Pressed;
use crate::defect::Side;
use crate::model::{Model, Tilt};
use crate::slices::{Approach, Carried, Slices};

/// (x_i, y_i, tau_ix, tau_iy, x_o, y_o, tau_ox, tau_oy); tilts times the pitch radius, m.
type Rings = [f64; 8];

/// Share of the forces on the rings below which what a roller carries is round-off.
const LIGHT: f64 = 1e-6;

/// A roller between its raceways.
#[derive(Debug, Clone, Default)]
struct Roller {
    r: f64,
    beta: f64,
    contacts: [Carried; 2],
    /// d(Q, T)/d(approach and slope of the rings) through the roller.
    tangent: [[f64; 2]; 2],
    /// J.
    energy: f64,
    /// Why its own balance was not found; the search over the rings may pass places where it is not, and must not end
    /// there.
    failed: Option<NoBalance>,
}

pub(super) fn solve(model: &Model, tilt: &Tilt, problem: &Problem) -> Result<Balance, NoBalance> {
    let arm = model.geometry.pitch_radius;
    let [springs, forces] = held_by(model, tilt);
    let (inner, outer) = (!problem.fix_inner, !problem.fix_outer);
    let free = [inner, inner, inner, inner, outer, outer, outer, outer];
    let [gi, go] = problem.guess;
    let guess = [gi[0], gi[1], 0.0, 0.0, go[0], go[1], 0.0, 0.0];
    let mut rollers = vec![Roller::default(); model.layout.rollers()];
    let scale = force_scale(model, problem, &forces);
    let mut evaluate = |x: &Rings| {
        let mut state = Fixed::of_springs(&springs, &forces, x);
        press((model, tilt, problem), scale, x, &mut rollers, &mut state);
        state
    };
    let found = minimise(guess, &free, (scale, stalled(model, problem, scale), softest(model)), &mut evaluate)?;
    evaluate(&found.x);
    if let Some(failed) = rollers.iter().find_map(|roller| roller.failed.clone()) {
        return Err(failed);
    }
    let gather = |of: &dyn Fn(&Roller) -> f64| by_slot(model, &rollers, of);
    let stiffness = stiffness(tilt, problem, &rollers);
    let x = &found.x;
    Ok(Balance {
        inner: [x[0], x[1]],
        outer: [x[4], x[5]],
        r: gather(&|r| r.r),
        inner_force: gather(&|r| r.contacts[0].force),
        outer_force: gather(&|r| r.contacts[1].force),
        stiffness: [0, 1].map(|i| [stiffness[i][0], stiffness[i][1]]),
        tilting: Some(Tilted {
            rings: [[x[2] / arm, x[3] / arm], [x[6] / arm, x[7] / arm]],
            rollers: gather(&|r| r.beta),
            moments: [gather(&|r| r.contacts[0].moment), gather(&|r| r.contacts[1].moment)],
            stiffness,
        }),
        residual: found.residual,
        iterations: found.iterations,
    })
}

/// Adds what the rollers hold and do at the rings' coordinates `x`; `scale` is the largest force at play, N.
fn press(
    (model, tilt, problem): (&Model, &Tilt, &Problem),
    scale: f64,
    x: &Rings,
    rollers: &mut [Roller],
    state: &mut Fixed<8>,
) {
    let slices = model.slices.as_ref().expect("a tilting model has slices");
    for (slot, roller) in rollers.iter_mut().enumerate() {
        let along = directions(tilt.levers[slot], problem.orbit[slot], model.geometry.pitch_radius);
        let met = meet(&along, x);
        *roller = between_raceways(model, slices, problem, (slot, scale), &met);
        state.potential += roller.energy;
        add(state, roller, &along);
    }
}

/// Springs to the ground and forces of each coordinate.
pub(super) fn held_by(model: &Model, tilt: &Tilt) -> [Rings; 2] {
    let arm = model.geometry.pitch_radius;
    let planar = external(model);
    let (load_in, load_out) = model.load.on_rings(1.0);
    let moment = |f: f64| tilt.load_offset * f / arm;
    let forces: Rings = [
        planar[0],
        planar[1],
        moment(load_in[0]),
        moment(load_in[1]),
        planar[2],
        planar[3],
        moment(load_out[0]),
        moment(load_out[1]),
    ];
    let (ki, ko) = (model.inner_support.stiffness, model.acting_outer_support().stiffness);
    let [ti, to] = [&tilt.inner, &tilt.outer].map(|ring| ring.support.stiffness / (arm * arm));
    [[ki, ki, ti, ti, ko, ko, to, to], forces]
}

/// The rollers alone between rings at `x`, under forces of the size `scale`, N.
pub(super) fn pressed(model: &Model, tilt: &Tilt, problem: &Problem, scale: f64, x: &Rings) -> Pressed {
    let mut rollers = vec![Roller::default(); model.layout.rollers()];
    let mut state = Fixed::of_springs(&[0.0; 8], &[0.0; 8], x);
    press((model, tilt, problem), scale, x, &mut rollers, &mut state);
    let gather = |of: &dyn Fn(&Roller) -> f64| by_slot(model, &rollers, of);
    Pressed { state: state.of_any_size(), r: gather(&|r| r.r), beta: gather(&|r| r.beta) }
}

/// How far a ring's coordinates (x, y, and tau times `arm`) bring its raceway along e_r at the roller's middle, and how
/// that changes with z.
fn directions(lever: f64, orbit: f64, arm: f64) -> [[f64; 4]; 2] {
    let (sin, cos) = orbit.sin_cos();
    [[cos, sin, lever * cos / arm, lever * sin / arm], [0.0, 0.0, cos / arm, sin / arm]]
}

/// Raceways' (offset, slope) along e_r: inner and outer.
fn meet(along: &[[f64; 4]; 2], x: &Rings) -> [[f64; 2]; 2] {
    let at = |ring: usize| [0, 1].map(|k| (0..4).map(|i| along[k][i] * x[4 * ring + i]).sum::<f64>());
    [at(0), at(1)]
}

/// Adds a roller's forces and tangent to the gradient and the Hessian of the potential.
fn add(state: &mut Fixed<8>, roller: &Roller, along: &[[f64; 4]; 2]) {
    let [inner, outer] = &roller.contacts;
    for i in 0..8 {
        let (ring, own) = (i / 4, i % 4);
        let (carried, sign) = if ring == 0 { (inner, 1.0) } else { (outer, -1.0) };
        state.gradient[i] += sign * (along[0][own] * carried.force + along[1][own] * carried.moment);
        for j in 0..8 {
            let same = if ring == j / 4 { 1.0 } else { -1.0 };
            for k in 0..2 {
                for m in 0..2 {
                    state.hessian[i][j] += same * along[k][own] * roller.tangent[k][m] * along[m][j % 4];
                }
            }
        }
    }
}

/// Stiffness of all rollers between the rings, over (x, y, tau_x, tau_y).
fn stiffness(tilt: &Tilt, problem: &Problem, rollers: &[Roller]) -> [[f64; 4]; 4] {
    let mut all = [[0.0; 4]; 4];
    for (slot, roller) in rollers.iter().enumerate() {
        let along = directions(tilt.levers[slot], problem.orbit[slot], 1.0);
        for i in 0..4 {
            for j in 0..4 {
                for k in 0..2 {
                    for m in 0..2 {
                        all[i][j] += along[k][i] * roller.tangent[k][m] * along[m][j];
                    }
                }
            }
        }
    }
    all
}

/// The roller's equilibrium between raceways at (offset, slope): Q_in - Q_out + its own radial force = 0, T_in = T_out.
///
/// The potential over (r, beta) is convex: a damped Newton method finds its least. `load` is the largest force at play
/// on the rings, N.
fn between_raceways(
    model: &Model,
    slices: &Slices,
    problem: &Problem,
    (slot, load): (usize, f64),
    met: &[[f64; 2]; 2],
) -> Roller {
    let g = &model.geometry;
    let own = own_force(model, problem, slot);
    let [[inner, inner_slope], [outer, outer_slope]] = *met;
    let (inner, outer) = (inner - g.clearance, outer + g.outer_gap);
    let met = angles(problem, slot);
    let contacts = |r: f64, beta: f64| {
        let carried = |side: Side, deformation: f64, tilt: f64| {
            let at = Approach { deformation, tilt, ..Approach::default() };
            model.carried(slices, (slot, side), &met, &at)
        };
        [carried(Side::Inner, inner - r, inner_slope - beta), carried(Side::Outer, r - outer, beta - outer_slope)]
    };
    // Lengths: beta times half the roller's length.
    let half = 0.5 * g.roller_length;
    let evaluate = |x: &[f64; 2]| {
        let [i, o] = contacts(x[0], x[1] / half);
        let sum = [0, 1, 2].map(|k| i.stiffness[k] + o.stiffness[k]);
        Fixed {
            potential: i.energy + o.energy - own * x[0],
            gradient: [o.force - i.force - own, (o.moment - i.moment) / half],
            hessian: [[sum[0], sum[1] / half], [sum[1] / half, sum[2] / (half * half)]],
        }
    };
    let guess = first_guess(model, own, [inner, outer], [inner_slope, outer_slope]);
    // A tilted roller may touch at one end alone.
    let nearest = inner - outer + half * (inner_slope - outer_slope).abs();
    let scale = own.abs().max(model.series_contact.healthy(nearest.max(0.0))).max(LIGHT * load);
    let found = minimise(guess, &[true, true], (scale, 1e-7 * scale, softest(model)), evaluate);
    let failed = found.as_ref().err().cloned();
    let x = found.map_or(guess, |found| found.x);
    let (r, beta) = (x[0], x[1] / half);
    let [i, o] = contacts(r, beta);
    Roller {
        r,
        beta,
        tangent: in_series(&i.stiffness, &o.stiffness, g.roller_length),
        energy: i.energy + o.energy - own * r,
        contacts: [i, o],
        failed,
    }
}

/// Where the search over (r, beta times half the roller's length) begins. In a gap the roller is pressed against the
/// raceway that its own force leads to, as far as that force alone would, lying along it; else it is in the middle.
fn first_guess(model: &Model, own: f64, [inner, outer]: [f64; 2], [inner_slope, outer_slope]: [f64; 2]) -> [f64; 2] {
    let half = 0.5 * model.geometry.roller_length;
    if inner > outer {
        return [0.5 * (inner + outer), 0.5 * half * (inner_slope + outer_slope)];
    }
    let deep = model.outer_contact.deflection(own.abs());
    match own >= 0.0 {
        true => [outer + deep, half * outer_slope],
        false => [inner - deep, half * inner_slope],
    }
}

/// K_in (K_in + K_out)^-1 K_out of two contacts in series, over (approach, slope); 0 where the roller is free of one.
///
/// One slice alone leaves the roller free to turn about it. It is held by next to nothing there, or its stiffness would
/// be lost to the search.
fn in_series(inner: &[f64; 3], outer: &[f64; 3], length: f64) -> [[f64; 2]; 2] {
    const NEXT_TO_NOTHING: f64 = 1e-9;
    let matrix = |k: &[f64; 3]| [[k[0], k[1]], [k[1], k[2]]];
    let sum = [0, 1, 2].map(|k| inner[k] + outer[k]);
    let free = sum[0] * sum[2] - sum[1] * sum[1] <= NEXT_TO_NOTHING * sum[0] * sum[0] * length * length;
    let mut sum = matrix(&sum);
    if free {
        sum[1][1] += NEXT_TO_NOTHING * sum[0][0] * length * length;
    }
    let (inner, outer) = (matrix(inner), matrix(outer));
    let mut series = [[0.0; 2]; 2];
    for j in 0..2 {
        let Some(column) = eliminate(sum, [outer[0][j], outer[1][j]]) else {
            return [[0.0; 2]; 2];
        };
        for i in 0..2 {
            series[i][j] = inner[i][0] * column[0] + inner[i][1] * column[1];
        }
    }
    series
}
