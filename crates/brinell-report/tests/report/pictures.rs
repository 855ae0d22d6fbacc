//! Pictures: places and lengths in them against what they are to show.

use brinell::observe::slip_course::Slips;
use brinell::signal;
use brinell_report::{
    CageOrbit, CageOrbits, Layout, Motion, MotionRow, SlipRow, Spectrogram, bearing_motion, cage_orbit, slip_over_time,
    spectrogram,
};

/// A quarter turn on, a roller that orbits at (r, 0) is at (0, r), its force's line above it; the scale is the same
/// both ways.
#[test]
fn analytic_a_force_line_begins_at_its_contact_and_is_as_long_as_the_force() {
    let quarter = std::f32::consts::FRAC_PI_2;
    let motion = Motion {
        dt_s: 1e-3,
        inner_radius_mm: 20.0,
        outer_radius_mm: 30.0,
        pitch_radius_mm: 25.0,
        roller_radius_mm: 5.0,
        ring: vec![0.0, quarter],
        rows: vec![MotionRow {
            title: "Row 1".into(),
            pockets: vec![0.0],
            cage: vec![0.0, quarter],
            orbit: vec![0.0, quarter],
            spin: vec![0.0, -quarter],
            inner_n: vec![0.0, 50.0],
            outer_n: vec![100.0, 50.0],
        }],
        ..Motion::default()
    };
    let numbers = |svg: &str, group: &str| -> Vec<f64> {
        let after = svg.split(&format!("class=\"{group}\">")).nth(1).unwrap();
        let d = after.split("d=\"").nth(1).unwrap();
        d.split('"').next().unwrap().split(['M', 'L', ' ']).filter_map(|n| n.parse().ok()).collect()
    };
    let first = bearing_motion(&motion, 0, Layout::Wide).svg();
    let second = bearing_motion(&motion, 1, Layout::Wide).svg();
    let (a, b) = (numbers(&first, "m-outer"), numbers(&second, "m-outer"));
    assert!(numbers(&first, "m-inner").is_empty());
    // The largest force is 46 px long, half of it 23 px.
    assert!((a[2] - a[0] - 46.0).abs() < 0.11 && a[1] == a[3], "{a:?}");
    assert!((b[1] - b[3] - 23.0).abs() < 0.11 && b[0] == b[2], "{b:?}");
    let inwards = numbers(&second, "m-inner");
    assert!((inwards[3] - inwards[1] - 23.0).abs() < 0.11, "{inwards:?}");
    // From contact to contact it is the rollers' diameter: (30 - 20) mm to 30 mm of (0.5 460 - 52) px.
    let per_mm = (0.5 * 460.0 - 52.0) / 30.0;
    assert!((inwards[1] - b[1] - 10.0 * per_mm).abs() < 0.11);
}

/// An orbit of circles is drawn round: as wide as it is high.
#[test]
fn analytic_a_cage_orbit_has_one_scale() {
    let turn = |k: i32| (f64::from(k) * 6.0).to_radians();
    let row = CageOrbit {
        title: "Cage of row 1".into(),
        x_um: (0..=60).map(|k| 30.0 * turn(k).cos()).collect(),
        y_um: (0..=60).map(|k| 30.0 * turn(k).sin()).collect(),
        last_turn: 61,
    };
    let orbits = CageOrbits { rows: vec![row.clone(), row], clearance_um: Some(40.0), note: String::new() };
    for layout in [Layout::Wide, Layout::Narrow] {
        let svg = cage_orbit(&orbits, layout).svg();
        let way = svg
            .split("<path d=\"")
            .filter(|p| p.contains("#0072B2") && p.matches('L').count() > 30)
            .map(|p| p.split('"').next().unwrap())
            .next()
            .expect("the orbit is drawn");
        let points: Vec<f64> = way.split(['M', 'L', ' ']).filter_map(|n| n.parse().ok()).collect();
        let extent = |first: usize| {
            let seen = || points.iter().skip(first).step_by(2).copied();
            seen().fold(f64::MIN, f64::max) - seen().fold(f64::MAX, f64::min)
        };
        assert!((extent(0) - extent(1)).abs() < 0.3 && extent(0) > 100.0);
    }
}

/// The one loud cell of a spectrogram is the dark one, at its time and frequency.
#[test]
fn analytic_the_spectrogram_puts_a_tone_where_it_is() {
    let (frames, bins) = (40, 20);
    let mut density = vec![1e-6; frames * bins];
    density[10 * bins + 15] = 1.0;
    let view = Spectrogram {
        label: "a".into(),
        unit: "(m/s^2)^2/Hz".into(),
        of: signal::Spectrogram { first_time: 0.05, time_step: 0.1, frequency_step: 100.0, bins, density },
        note: String::new(),
    };
    let picture = spectrogram(&view, Layout::Wide);
    let svg = picture.svg();
    assert!(svg.contains("Frequency (Hz)") && svg.contains("Time (s)") && svg.contains(">dB<"));
    let png = picture.png(1.0).unwrap();
    let map = tiny_skia::Pixmap::decode_png(&png).unwrap();
    let image = svg.split("<image x=\"").nth(1).unwrap();
    let place = |name: &str| -> f64 {
        let text = format!("x=\"{image}");
        let after = text.split(&format!("{name}=\"")).nth(1).unwrap();
        after.split('"').next().unwrap().parse().unwrap()
    };
    let (x, y, width, height) = (place("x"), place(" y"), place("width"), place("height"));
    let lightness = |column: f64, row: f64| {
        let at = |share: f64, from: f64, span: f64| (from + share * span) as u32;
        let color = map.pixel(at(column / 40.0, x, width), at(1.0 - row / 20.0, y, height)).unwrap();
        u32::from(color.red()) + u32::from(color.green()) + u32::from(color.blue())
    };
    assert!(lightness(10.5, 15.5) < 150, "{}", lightness(10.5, 15.5));
    for (column, row) in [(9.2, 15.5), (11.8, 15.5), (10.5, 14.2), (10.5, 16.8)] {
        assert!(lightness(column, row) > 650);
    }
}

/// Few swings are drawn as they are; too many for the width become a shade from smallest to largest and their mean.
#[test]
fn analytic_slip_that_swings_too_often_is_drawn_by_its_mean_and_extremes() {
    let row = |swings: f64| {
        let wave: Vec<f64> =
            (0..1000).map(|k| 0.005 + 0.02 * (swings * std::f64::consts::TAU * f64::from(k) / 1000.0).sin()).collect();
        SlipRow {
            name: "row 1".into(),
            dt_s: 0.01,
            over_time: Slips { cage: wave.clone(), orbit: wave.clone(), spin: wave },
            ..SlipRow::default()
        }
    };
    for layout in [Layout::Wide, Layout::Narrow] {
        let calm = slip_over_time(&[row(5.0)], layout).svg();
        assert!(!calm.contains("shade") && !calm.contains("fill-opacity"));
        let svg = slip_over_time(&[row(200.0)], layout).svg();
        assert!(svg.contains("row 1, mean") && svg.contains("shade: smallest to largest"));
        let heights = |part: &str| -> (f64, f64) {
            let d = part.split('"').next().unwrap();
            d.split(['M', 'L'])
                .filter_map(|p| p.trim_end_matches('Z').split_once(' '))
                .filter_map(|p| p.1.parse().ok())
                .fold((f64::MAX, f64::MIN), |(a, b), y: f64| (a.min(y), b.max(y)))
        };
        let paths = || svg.split("<path d=\"");
        let (top, bottom) = heights(paths().find(|p| p.contains("fill-opacity")).unwrap());
        let mean = paths().find(|p| p.matches('L').count() > 3 && p.contains("fill=\"none\""));
        let (highest, lowest) = heights(mean.unwrap());
        // The shade spans the wave, 4 %; the mean stays near its middle.
        assert!(bottom - top > 60.0, "{top} {bottom}");
        assert!(lowest - highest < 0.1 * (bottom - top), "{highest} {lowest}");
        let middle = 0.5 * (top + bottom);
        assert!((0.5 * (highest + lowest) - middle).abs() < 0.05 * (bottom - top));
    }
}
