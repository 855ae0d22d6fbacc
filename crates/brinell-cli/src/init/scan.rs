//! The example scan as it would be of another bearing: the same spall in that bearing's outer raceway.

/// Columns, rows, spacing (mm) and radius (mm) of the raceway in the example, as `draw_examples.rs` made it.
const EXAMPLE: (usize, usize, f64, f64) = (100, 80, STEP_MM, 27.5);
pub(super) const STEP_MM: f64 = 0.06;

/// The outer raceway that a scan is of.
#[derive(PartialEq)]
pub(super) struct Raceway {
    pub(super) radius_mm: f64,
    /// Of the groove's cross-section; infinite of a roller's.
    pub(super) across_mm: f64,
}

impl Raceway {
    /// Height over the middle, um.
    fn height_um(&self, s: f64, z: f64) -> f64 {
        let rise = |radius: f64, x: f64| x * x / (radius + (radius * radius - x * x).sqrt());
        let across = if self.across_mm.is_finite() { rise(self.across_mm, z) } else { 0.0 };
        1e3 * (across + rise(self.radius_mm - across, s))
    }
}

/// The example's bytes with a bearing's raceway in place of its own, at a spacing.
pub(super) fn scan_of(bytes: &[u8], of: &Raceway, step_mm: f64) -> Vec<u8> {
    let (columns, rows, step, radius_mm) = EXAMPLE;
    let example = Raceway { radius_mm, across_mm: f64::INFINITY };
    if *of == example {
        return bytes.to_vec();
    }
    let middle = |i: usize, n: usize| i as f64 - 0.5 * (n - 1) as f64;
    let mut out = format!("# heights in um, {} mm apart, first line on top; made up\n", step_mm);
    let text = String::from_utf8_lossy(bytes);
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    for (row, line) in lines.enumerate() {
        let cells: Vec<String> = line
            .split(',')
            .enumerate()
            .map(|(column, cell)| {
                let (s, z) = (middle(column, columns), middle(row, rows));
                let moved = of.height_um(s * step_mm, z * step_mm) - example.height_um(s * step, z * step);
                cell.parse().map_or(cell.to_owned(), |height: f64| format!("{:.2}", height + moved))
            })
            .collect();
        out += &cells.join(",");
        out.push('\n');
    }
    out.into()
}
