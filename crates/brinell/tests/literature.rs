//! Figures that others print: the paper's, and makers' drive torques.
//!
//! The paper's defect frequencies of its three shapes at 1800 r/min and 300 N.
//!
//! The paper: simulated 249.60 (rectangle 3 x 4 mm), 250.39 (circle 4.5 mm) and 249.40 Hz (irregular, 7 x 4 mm); it
//! states neither the duration nor the resolution, nor which cage slip holds. Pure rolling gives 250.10 Hz.

use brinell::document::read;
use brinell::scenario::{GuidanceFilm, Scenario, Shape};
use brinell::signal::LineFrequency;
use std::f64::consts::TAU;

/// Independent starts, the load larger by one part in 10^5 each time.
const STARTS: u32 = 7;

/// Half a percent is 1.25 Hz: a bin of a 0.8 s record. The paper's own three simulated figures spread by 0.99 Hz, 0.40 %,
/// and differ from the measured ones by up to 0.55 %.
const TOLERANCE: f64 = 5e-3;

/// The line of the only defect.
fn line(s: &Scenario) -> LineFrequency {
    let findings = brinell::simulate(s).unwrap().findings;
    let line = &findings.lines[0];
    assert_eq!(line.name, "BPFO");
    line.found.expect("a line is clear of the noise")
}

fn found(name: &str, shape: Shape, printed: f64) {
    let mut s = crate::common::example();
    s.defects[0].shape = shape;
    s.defects[0].depth_um = 20.0;
    // The paper's film. In the dynamic one the cages run 0.7 mm off centre, slip by 1.27 %, and the line lies 1.15 %
    // below the print.
    s.cage.guidance_film = GuidanceFilm::QuasiStatic;
    // The cages slip by 1 % for the first 0.2 s, which the mean includes, and would pull that over half a second 0.6 %
    // below pure rolling.
    s.simulation.duration_s = 1.0;
    s.simulation.sample_rate_hz = 25_600.0;
    // Some starts end in a motion in which the cages slip by another per cent; which ones hangs on round-off. So the
    // median of several.
    let load = s.operation.load_n;
    let mut lines: Vec<LineFrequency> = (0..STARTS)
        .map(|k| {
            for (own, given) in s.operation.load_n.iter_mut().zip(&load) {
                *own = given * (1.0 + 1e-5 * f64::from(k));
            }
            line(&s)
        })
        .collect();
    lines.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    let all: Vec<String> = lines.iter().map(|l| format!("{:.2}", l.frequency)).collect();
    println!("{name}: {} Hz", all.join(", "));
    let f = lines[lines.len() / 2];
    println!(
        "{name} BPFO: {:.2} +- {:.2} Hz, printed {printed} Hz ({:+.2} %)",
        f.frequency,
        f.uncertainty,
        100.0 * (f.frequency / printed - 1.0)
    );
    assert!((f.frequency / printed - 1.0).abs() < TOLERANCE, "{} Hz, printed {printed} Hz", f.frequency);
    // A match means something only where the line is known that well.
    assert!(f.uncertainty < TOLERANCE * printed, "known to {} Hz only", f.uncertainty);
}

#[test]
fn lit_rectangle_frequency() {
    found("rectangle", Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 }, 249.60);
}

#[test]
fn lit_circle_frequency() {
    found("circle", Shape::Circle { diameter_mm: 4.5 }, 250.39);
}

#[test]
fn lit_irregular_frequency() {
    found("irregular", Shape::Li2023Irregular { max_width_mm: 4.0 }, 249.40);
}

/// SKF's quick estimate of a bearing's frictional moment, M = 0.5 mu P d (General catalogue, "Estimating the frictional moment":
/// loads of about a tenth of C, good lubrication, normal speeds), against the mean torque of the drive under section 22. The
/// contract's k_r is one number for all bearings; it gives k_r R_m times the sum of all contact forces, 1.1 to 1.2 times the load.
#[test]
fn lit_drive_torque_is_near_the_makers_quick_estimate() {
    const RPM: f64 = 1800.0;
    let (roller, ball) = (0.0011, 0.0015);
    // Bore in mm and C in kN of SKF's catalogues.
    for (bearing, bore, rating, mu) in [
        ("NN3007", 35.0, 39.1, roller),
        ("NU206", 30.0, 44.0, roller),
        ("NU210", 50.0, 73.5, roller),
        ("6205", 25.0, 14.8, ball),
        ("6309", 45.0, 55.3, ball),
    ] {
        let load = 0.1 * 1e3 * rating;
        let text = format!(
            "[bearing]\npreset = \"{bearing}\"\n[operation]\nspeed_rpm = {RPM}\nload_n = [0.0, -{load}]\nload_on = \"inner-ring\"\n\
             [simulation]\nlaws = \"mechanics\"\nduration_s = 0.1\nstart = \"equilibrium\"\nrecord = [\"inner_torque\"]\n"
        );
        let scenario = read(&text, &[]).unwrap_or_else(|problems| panic!("{bearing}: {problems:?}")).scenario;
        let (rows, outcome) = crate::common::simulate(&scenario);
        let samples = rows.column("inner_torque");
        let torque = samples.iter().sum::<f64>() / samples.len() as f64;
        let by_work = outcome.energy.flows.drive / (outcome.t * RPM / 60.0 * TAU);
        let estimate = 0.5 * mu * load * 1e-3 * bore;
        println!(
            "{bearing}, {load:.0} N: {:.2} N mm, by the drive's work {:.2}, SKF {:.2} ({:+.1} %)",
            1e3 * torque,
            1e3 * by_work,
            1e3 * estimate,
            100.0 * (torque / estimate - 1.0)
        );
        assert!((torque / estimate - 1.0).abs() < 0.3, "{bearing}: {torque} N m, SKF {estimate} N m");
        // The start takes up the couples on the elements, and cages catch up: some of the drive's work.
        assert!((by_work / torque - 1.0).abs() < 0.03, "{bearing}: {by_work} N m by work, {torque} N m");
    }
}
