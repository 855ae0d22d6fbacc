//! Entries that follow from a maker's table by rule: a row of `series.csv` fills a template, which reads as
//! `catalogue.toml` does.

use std::f64::consts::PI;

const ROWS: &str = include_str!("series.csv");
const ROLLERS: &str = include_str!("series_rollers.toml");
const BALLS: &str = include_str!("series_balls.toml");
/// kg/mm^3.
const STEEL: f64 = 7850e-9;
const POLYAMIDE: f64 = 1300e-9;
/// Length of a roller that does not bear, mm: of the NU206's 10 mm ISO 76 gives 8.8 mm.
const UNLOADED: f64 = 1.2;
/// Width of a cage beside its pockets, mm.
const BARS: f64 = 3.0;

/// The rows, each with the name of its bearing.
pub(super) fn rows() -> impl Iterator<Item = (&'static str, &'static str)> {
    ROWS.lines().filter(|row| !row.starts_with('#')).filter_map(|row| Some((row.split_once(';')?.0, row)))
}

/// A row's entry as `catalogue.toml` would write it. `None` where a row has a cell that does not do.
pub(super) fn text(row: &str) -> Option<String> {
    let cells: Vec<&str> = row.split(';').collect();
    let numbers = cells.get(3..)?.iter().map(|cell| cell.parse().ok()).collect::<Option<Vec<f64>>>()?;
    let (template, second, values) = match *numbers.as_slice() {
        [d, outside, width, c, c0, mass, f, e, rib, least, largest] => {
            let common = Common { d, outside, width, c, c0, mass, least, largest };
            (ROLLERS, "{designation}", rollers(&common, [f, e, rib]))
        }
        [d, outside, width, c, c0, mass, d1, d2, number, ball, least, largest] => {
            let common = Common { d, outside, width, c, c0, mass, least, largest };
            (BALLS, "{note}", balls(&common, [d1, d2], number, ball))
        }
        _ => return None,
    };
    let words = template.replace("{name}", cells[0]).replace(second, cells[1]).replace("{source}", cells[2]);
    Some(values.into_iter().fold(words, |text, (key, value)| text.replace(&format!("{{{key}}}"), &value)))
}

/// What both kinds have: mm, kN, kg and um.
struct Common {
    d: f64,
    outside: f64,
    width: f64,
    c: f64,
    c0: f64,
    mass: f64,
    least: f64,
    largest: f64,
}

type Filled = Vec<(&'static str, String)>;

impl Common {
    fn filled(&self) -> Filled {
        let whole = |x: f64| x.to_string();
        vec![
            ("d", decimal(self.d)),
            ("D", decimal(self.outside)),
            ("B", decimal(self.width)),
            ("C", decimal((1e3 * self.c).round())),
            ("C0", decimal((1e3 * self.c0).round())),
            ("mass", decimal(self.mass)),
            ("clearance", decimal(0.25 * (self.least + self.largest))),
            // In words, as no decimal.
            ("d_", whole(self.d)),
            ("D_", whole(self.outside)),
            ("B_", whole(self.width)),
            ("least", whole(self.least)),
            ("largest", whole(self.largest)),
        ]
    }
}

/// Raceway diameters F and E, and D1 of the outer ring's ribs, mm.
fn rollers(b: &Common, [inner_raceway, outer_raceway, rib]: [f64; 3]) -> Filled {
    let (roller, pitch) = (0.5 * (outer_raceway - inner_raceway), 0.5 * (outer_raceway + inner_raceway));
    let number = (PI * pitch / (1.25 * roller)).round();
    let length = tenths(1e3 * b.c0 / (44.0 * (1.0 - roller / pitch) * number * roller));
    let full = tenths(length + UNLOADED);
    let ring = |large: f64, small: f64| 0.25 * PI * (large * large - small * small);
    let (cage_inner, cage_outer) = (pitch - 0.5 * roller, pitch + 0.5 * roller);
    let pockets = number * roller * full * 0.5 * (cage_outer - cage_inner);
    let outer = ring(b.outside, outer_raceway) * b.width + ring(outer_raceway, rib) * (b.width - full);
    let mut all = b.filled();
    all.extend([
        ("F", decimal(inner_raceway)),
        ("E", decimal(outer_raceway)),
        ("D1", decimal(rib)),
        ("pitch", decimal(pitch)),
        ("roller", decimal(roller)),
        ("number", number.to_string()),
        ("length", decimal(length)),
        ("full", decimal(full)),
        ("inner", digits(STEEL * ring(inner_raceway, b.d) * b.width)),
        ("outer", digits(STEEL * outer)),
        ("one", digits(STEEL * 0.25 * PI * roller * roller * full)),
        ("cage", digits(POLYAMIDE * (ring(cage_outer, cage_inner) * (full + BARS) - pockets))),
        ("cage_inner", decimal(cage_inner)),
        ("cage_outer", decimal(cage_outer)),
        ("pocket", digits(0.015 * roller)),
        ("ribs", decimal(tenths(b.width - full))),
    ]);
    all
}

/// Shoulders d1 and D1, mm, number and diameter (mm) of the balls.
fn balls(b: &Common, [d1, d2]: [f64; 2], number: f64, ball: f64) -> Filled {
    let pitch = 0.5 * (b.d + b.outside);
    let one = STEEL * PI / 6.0 * ball.powi(3);
    let cage = STEEL * 2.0 * (0.1 * ball) * (0.64 * ball) * PI * pitch;
    let rings = b.mass - number * one - cage;
    let (inner, outer) = (b.d + d1, b.outside + d2);
    let mut all = b.filled();
    all.extend([
        ("F", digits(pitch - ball)),
        ("E", digits(pitch + ball)),
        ("d1", decimal(d1)),
        ("D1", decimal(d2)),
        ("pitch", decimal(pitch)),
        ("ball", decimal(ball)),
        ("number", number.to_string()),
        ("inner", digits(rings * inner / (inner + outer))),
        ("outer", digits(rings * outer / (inner + outer))),
        ("one", digits(one)),
        ("cage", digits(cage)),
        ("cage_inner", digits(pitch - 0.6 * ball)),
        ("cage_outer", digits(pitch + 0.6 * ball)),
        ("pocket", digits(0.01 * ball)),
        ("land", digits(0.25 * ball)),
    ]);
    all
}

fn tenths(x: f64) -> f64 {
    (10.0 * x).round() / 10.0
}

/// As TOML writes a number that is no count.
fn decimal(x: f64) -> String {
    format!("{:?}", (1e6 * x).round() / 1e6)
}

/// The same to six digits.
fn digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    format!("{rounded:?}")
}
