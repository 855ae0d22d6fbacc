//! Words on a scan's fitted form that is not the surface's: the one check of its spacing, its turn and its place.

use crate::geometry::{Curve, Form};
use brinell::scenario::{Bearing, Scenario, Shape, Surface};

/// A radius that is off by more than this share is worth a word. It grows with the square of the spacing, so a tenth of
/// that makes a fifth of this. Grooves differ by a twentieth (0.515 to 0.54 of a ball's diameter), raceways by less.
const DOUBTFUL: f64 = 0.2;

/// Curvature of a surface along s and across, 1/mm, positive where hollow.
fn curvatures(b: &Bearing, on: Surface) -> [f64; 2] {
    let around = 2.0 / b.diameter_mm(on);
    let groove = |conformity: Option<f64>| conformity.map_or(0.0, |f| 1.0 / (f * b.roller_diameter_mm));
    match on {
        Surface::OuterRaceway => [around, groove(b.outer_groove_conformity)],
        Surface::InnerRaceway => [-around, groove(b.inner_groove_conformity)],
        Surface::Roller(_) => [-around, if b.has_balls() { -around } else { 0.0 }],
    }
}

/// Where the form's radius or its sign is not that of the surface that defect `i` lies on.
pub(crate) fn form_doubts(scenario: &Scenario, i: usize, form: &Form) -> Vec<String> {
    let (b, defect) = (&scenario.bearing, &scenario.defects[i]);
    let Shape::Scan(scan) = &defect.shape else {
        return Vec::new();
    };
    // A cylinder in a groove has no radius to speak of; the scenario's own checks say so.
    if b.has_balls() && form.across.is_none() {
        return Vec::new();
    }
    let surface = match defect.on {
        Surface::Roller(_) => b.element.word().to_owned(),
        raceway => raceway.word().replace('-', " "),
    };
    let [around, across] = curvatures(b, defect.on);
    let spacing = if form.given { "`radius_mm`" } else { "`ds_mm`, `rolling_direction`" };
    let curves = [(Some(form.around), around, "along s", spacing), (form.across, across, "across s", "`dz_mm`")];
    let mut said = Vec::new();
    for (fitted, own, place, keys) in curves {
        let Some(fitted) = fitted.filter(|fitted| own != 0.0 && is_off(fitted, own, scan.threshold_um)) else {
            continue;
        };
        let own = Curve { curvature_per_mm: own, half_mm: fitted.half_mm };
        let keys = if fitted.side() == own.side() { keys } else { "`height_positive_up`" };
        said.push(format!(
            "the fitted {} is {} {place} with a radius of {} mm, where the {surface} is {} with {} mm; \
             check {keys} and `on`",
            form.name,
            fitted.side(),
            fitted.radius_mm(),
            own.side(),
            own.radius_mm(),
        ));
    }
    said
}

/// Whether a radius is off by more than a share, and by more than what counts as undamaged over the scan.
fn is_off(fitted: &Curve, own: f64, threshold_um: f64) -> bool {
    let off = (fitted.curvature_per_mm - own).abs();
    let sag_um = 1e3 * 0.5 * off * fitted.half_mm.powi(2);
    off > DOUBTFUL * own.abs() && sag_um > threshold_um
}
