//! Of a run's page, what moves: spectrogram, cage orbits, slip, and the bearing's frames.

use crate::number::short;
use crate::{AxialRow, AxialSection, CageOrbit, CageOrbits, Motion, MotionDamage, MotionRow, SlipRow, Spectrogram};
use brinell::observe::orbit::TURNS;
use brinell::result::Parts;
use std::f64::consts::TAU;

pub(super) fn spectrogram(parts: &Parts, label: String) -> Spectrogram {
    let Some(s) = &parts.findings.spectrogram else {
        return Spectrogram::default();
    };
    let frames = s.time_step * s.frequency_step * 2.0;
    let averaged = if frames > 1.5 { format!(", means of {frames:.0} segments") } else { String::new() };
    Spectrogram {
        label,
        unit: "(m/s^2)^2/Hz".into(),
        of: s.clone(),
        note: format!(
            "The whole run; Hann windows of {} ms that overlap by half{averaged}.",
            short(1e3 / s.frequency_step, 3)
        ),
    }
}

pub(super) fn cage_orbits(parts: &Parts) -> CageOrbits {
    let model = parts.simulation.model();
    let orbit = &parts.findings.cage_orbit;
    let guide = model.land_on().word();
    let rows = (0..orbit.rows()).map(|row| {
        let points: Vec<(f64, [f64; 2])> = orbit.points(row).collect();
        let end = points.last().map_or(0.0, |p| p.0);
        let speed = model.rolling_orbit_speed(model.rotation.at(end).0).abs();
        let turn = if speed > 0.0 { TAU / speed } else { f64::INFINITY };
        CageOrbit {
            title: format!("Cage of row {}", row + 1),
            x_um: points.iter().map(|p| 1e6 * p.1[0]).collect(),
            y_um: points.iter().map(|p| 1e6 * p.1[1]).collect(),
            last_turn: points.iter().filter(|p| p.0 >= end - turn).count(),
        }
    });
    CageOrbits {
        rows: rows.collect(),
        clearance_um: Some(1e6 * model.guide.clearance),
        note: format!(
            "Centre of each cage from the {guide} ring’s centre: the last {TURNS} turns of the cage, or as many as the run holds."
        ),
    }
}

pub(super) fn slip_rows(parts: &Parts) -> Vec<SlipRow> {
    let course = &parts.findings.slip_course;
    let dt = course.samples_per_stretch() as f64 / parts.simulation.sample_rate();
    let slip = |row: usize| SlipRow {
        name: format!("row {}", row + 1),
        dt_s: dt,
        over_time: course.over_time(row),
        over_angle: course.over_angle(row),
    };
    (0..parts.simulation.model().layout.rows).map(slip).collect()
}

pub(super) fn motion(parts: &Parts) -> Motion {
    let model = parts.simulation.model();
    let (l, g) = (&model.layout, &model.geometry);
    let kept = &parts.findings.motion;
    let frames = kept.len();
    if frames < 2 {
        return Motion::default();
    }
    let rows = (0..l.rows).map(|row| {
        let slots = || (0..l.rollers_per_row).map(|roller| l.slot(row, roller));
        let mut data = MotionRow {
            title: format!("Row {}", row + 1),
            pockets: slots().map(|slot| model.pocket_angle[slot] as f32).collect(),
            ..MotionRow::default()
        };
        for frame in 0..frames {
            let rollers = kept.rollers(frame);
            data.cage.push(kept.cages(frame)[row]);
            data.orbit.extend(slots().map(|s| rollers[s].orbit));
            data.spin.extend(slots().map(|s| rollers[s].spin));
            data.inner_n.extend(slots().map(|s| rollers[s].inner_force));
            data.outer_n.extend(slots().map(|s| rollers[s].outer_force));
        }
        data
    });
    let damage = model.defects.iter().map(|defect| {
        let (first, last) = defect.shape.arc();
        MotionDamage {
            row: defect.row,
            surface: defect.surface,
            angle: [first, last].map(|s| defect.center + s / defect.radius),
        }
    });
    Motion {
        t0_s: kept.time(0),
        dt_s: (kept.time(frames - 1) - kept.time(0)) / (frames - 1) as f64,
        inner_radius_mm: 1e3 * g.inner_radius,
        outer_radius_mm: 1e3 * g.outer_radius,
        pitch_radius_mm: 1e3 * g.pitch_radius,
        roller_radius_mm: 1e3 * g.roller_radius,
        ring: (0..frames).map(|frame| kept.ring(frame)).collect(),
        rows: rows.collect(),
        damage: damage.collect(),
        section: axial_section(parts, frames),
    }
}

/// The bearing from the side; `None` where nothing tilts.
fn axial_section(parts: &Parts, frames: usize) -> Option<AxialSection> {
    let model = parts.simulation.model();
    let (tilt, g, kept) = (model.tilt.as_ref()?, &model.geometry, &parts.findings.motion);
    let strips = kept.section_row(0, 0)?.line_loads[0].len();
    let rows = tilt.rows.iter().enumerate().map(|(row, middle)| {
        let mut data = AxialRow { middle_mm: 1e3 * middle, ..AxialRow::default() };
        for kept in (0..frames).filter_map(|frame| kept.section_row(frame, row)) {
            data.tilt.push(kept.tilt);
            let [inner, outer] = kept.line_loads;
            data.inner.extend(inner.iter().map(|q| 1e-3 * q));
            data.outer.extend(outer.iter().map(|q| 1e-3 * q));
        }
        data
    });
    Some(AxialSection {
        through: match model.defects.first() {
            Some(_) => "the damage".into(),
            None => "the middle of the load zone".into(),
        },
        width_mm: parts.loaded.scenario.bearing.width_mm,
        roller_length_mm: 1e3 * g.roller_length,
        roller_diameter_mm: 2e3 * g.roller_radius,
        rings: (0..frames).filter_map(|frame| kept.ring_tilts(frame)).collect(),
        rows: rows.collect(),
        strips,
    })
}
