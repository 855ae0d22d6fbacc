//! How each contact moves (section 18): deformation, its rate and slip, and where it lies.

use crate::defect::SIDES;
use crate::lanes::Lanes;
use crate::model::full::sums::Turn;
use crate::model::full::view::{Plane, column, columns, pair, polar};
use crate::model::workspace::Contacts;
use crate::model::{Model, Workspace};

/// One ring as a contact sees it: its centre and velocity, and where it tilts its slope and the slope's rate.
struct Ring<L> {
    x: Plane<L>,
    v: Plane<L>,
    tau: Plane<L>,
    dtau: Plane<L>,
}

impl<L: Lanes> Ring<L> {
    #[inline(always)]
    fn new<const TILT: bool>((q, v): (&[f64], &[f64]), at: usize, tilt: usize) -> Self {
        let nothing = [L::zero(); 2];
        let (tau, dtau) = if TILT { (pair(&q[tilt..]), pair(&v[tilt..])) } else { (nothing, nothing) };
        Self { x: pair(&q[at..]), v: pair(&v[at..]), tau, dtau }
    }
}

/// A group of rollers: directions, radial offset, its rate, the arm R_m + r_j, and the speed along the orbit.
struct Rollers<L> {
    axes: (L, L),
    r: L,
    dr: L,
    along: L,
    dphi: L,
}

/// What is written of one side's contacts.
struct Columns<'a, L: Lanes> {
    deformation: &'a mut [L::Group],
    rate: &'a mut [L::Group],
    slip: &'a mut [L::Group],
    normal_r: &'a mut [L::Group],
    normal_t: &'a mut [L::Group],
    distance: &'a mut [L::Group],
    tilt: &'a mut [L::Group],
    tilt_rate: &'a mut [L::Group],
}

impl<'a, L: Lanes> Columns<'a, L> {
    #[inline(always)]
    fn new(contacts: &'a mut Contacts, count: usize) -> Self {
        let [normal_r, normal_t] = &mut contacts.normal;
        Self {
            deformation: &mut L::groups_mut(&mut contacts.deformation)[..count],
            rate: &mut L::groups_mut(&mut contacts.approach_rate)[..count],
            slip: &mut L::groups_mut(&mut contacts.slip)[..count],
            normal_r: &mut L::groups_mut(normal_r)[..count],
            normal_t: &mut L::groups_mut(normal_t)[..count],
            distance: &mut L::groups_mut(&mut contacts.distance)[..count],
            tilt: L::groups_mut(&mut contacts.tilt),
            tilt_rate: L::groups_mut(&mut contacts.tilt_rate),
        }
    }
}

/// How each contact moves.
#[inline(always)]
pub(in crate::model::full) fn motion<L: Lanes, const TILT: bool>(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    turn: Turn,
    ws: &mut Workspace,
) {
    let l = &model.layout;
    let count = l.slots / L::COUNT;
    let q_r = column::<L>(q, 0, count);
    let [v_r, v_theta, v_phi] = columns::<L>(v, count);
    let rings = [
        Ring::<L>::new::<TILT>((q, v), l.inner(), l.inner_tilt()),
        Ring::<L>::new::<TILT>((q, v), l.outer(), l.outer_tilt()),
    ];
    let pitch = L::splat(model.geometry.pitch_radius);
    let radius = L::splat(model.geometry.roller_radius);
    let half = L::splat(0.5);
    // w_g of the inner and of the outer ring, which does not turn.
    let speed = L::splat(turn.speed);
    let levers = model.tilt.as_ref().map_or(&[][..], |tilt| &tilt.levers);
    let [beta, dbeta] = if TILT { [column::<L>(q, 3, count), column::<L>(v, 3, count)] } else { [&[][..], &[][..]] };
    let Workspace { sin, cos, contacts, .. } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    for side in SIDES {
        let k = side as usize;
        let is_inner = k == 0;
        let ring = &rings[k];
        let gaps = column::<L>(&model.gaps[k], 0, count);
        let out = Columns::<L>::new(&mut contacts[k], count);
        for group in 0..count {
            let dtheta = L::new(v_theta[group]);
            let r = L::new(q_r[group]);
            let roller = Rollers {
                axes: (L::new(sin[group]), L::new(cos[group])),
                r,
                dr: L::new(v_r[group]),
                along: (pitch + r) * dtheta,
                dphi: L::new(v_phi[group]),
            };
            let (mut x_r, mut x_t) = polar(roller.axes, &ring.x);
            let (mut u_r, mut u_t) = polar(roller.axes, &ring.v);
            if TILT {
                // The ring's centre at the row's middle.
                let lever = L::new(L::groups(levers)[group]);
                let (tau_r, tau_t) = polar(roller.axes, &ring.tau);
                let (dtau_r, dtau_t) = polar(roller.axes, &ring.dtau);
                (x_r, x_t) = (lever.times_plus(tau_r, x_r), lever.times_plus(tau_t, x_t));
                (u_r, u_t) = (lever.times_plus(dtau_r, u_r), lever.times_plus(dtau_t, u_t));
            }
            // D = (R_m + a, D_t); rho - R_m without cancellation.
            let a = roller.r - x_r;
            let along_r = pitch + a;
            let square = along_r.times_plus(along_r, x_t * x_t);
            let rho = square.sqrt();
            let sum = rho + pitch;
            // 1/rho and 1/(rho + R_m) by one division.
            let per = L::splat(1.0) / (rho * sum);
            let per_rho = per * sum;
            let beyond = a.times_plus(pitch + along_r, x_t * x_t) * (per * rho);
            let (n_r, n_t) = (along_r * per_rho, -(x_t * per_rho));
            let (d_r, d_t) = (roller.dr - u_r, roller.along - u_t);
            let apart = n_r.times_plus(d_r, n_t * d_t);
            let across = n_r.times_plus(d_t, -(n_t * d_r));
            let gap = L::new(gaps[group]);
            let (delta, rate) = if is_inner { (-(gap + beyond), -apart) } else { (beyond - gap, apart) };
            // The contact point lies in the middle of the overlap: b = r - delta/2 on the roller.
            let arm = half.minus_times(delta, radius);
            let rolling = roller.dphi * arm;
            let slip = if is_inner { speed.times_plus(rho - arm, rolling - across) } else { -(rolling + across) };
            out.deformation[group] = delta.array();
            out.rate[group] = rate.array();
            out.slip[group] = slip.array();
            out.normal_r[group] = n_r.array();
            out.normal_t[group] = n_t.array();
            out.distance[group] = rho.array();
            if TILT {
                // n . tau_g, its rate with that of n, (d/dt n) = across/rho t.
                let (tau_r, tau_t) = polar(roller.axes, &ring.tau);
                let (dtau_r, dtau_t) = polar(roller.axes, &ring.dtau);
                let slope = n_r.times_plus(tau_r, n_t * tau_t);
                let turned = n_r.times_plus(tau_t, -(n_t * tau_r));
                let slope_rate = (across * per_rho).times_plus(turned, n_r.times_plus(dtau_r, n_t * dtau_t));
                let (beta, dbeta) = (L::new(beta[group]), L::new(dbeta[group]));
                let (tilt, tilt_rate) = (slope - beta, slope_rate - dbeta);
                out.tilt[group] = if is_inner { tilt } else { -tilt }.array();
                out.tilt_rate[group] = if is_inner { tilt_rate } else { -tilt_rate }.array();
            }
        }
    }
}
