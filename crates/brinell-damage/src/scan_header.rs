//! What the lines above a grid of numbers say of it: its width and height, the distance of its points, and the unit of
//! its values, as Gwyddion and other programs write them: `# Width: 3.00 mm`, `# Value units: nm`, `X step;0.5 um`.

use crate::scan::Raw;

/// Lines that are looked at.
const LINES: usize = 60;

/// As the file states it.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Stated {
    /// Of all columns and of all rows, mm.
    size_mm: [Option<f64>; 2],
    /// Of two columns and of two rows, mm.
    step_mm: [Option<f64>; 2],
    /// What one of the numbers is.
    unit_um: Option<f64>,
}

/// What a line states.
enum Said {
    Size(usize, f64),
    Step(usize, f64),
    /// Of columns and rows alike.
    Steps(f64),
    Unit(f64),
}

impl Stated {
    /// Of a file's first lines.
    pub(crate) fn of(text: &str) -> Self {
        let mut stated = Self::default();
        for said in text.lines().take(LINES).filter_map(said) {
            match said {
                Said::Size(of, mm) => stated.size_mm[of] = Some(mm),
                Said::Step(of, mm) => stated.step_mm[of] = Some(mm),
                Said::Steps(mm) => stated.step_mm = [Some(mm); 2],
                Said::Unit(um) => stated.unit_um = Some(um),
            }
        }
        stated
    }

    /// Whether a line states something, and so is no row of the grid.
    pub(crate) fn says(line: &str) -> bool {
        said(line).is_some()
    }

    /// Where the file says no more by its columns.
    pub(crate) fn put_in(&self, raw: &mut Raw) {
        let counts = [raw.width, raw.height];
        let step = |of: usize| self.step_mm[of].or_else(|| Some(self.size_mm[of]? / counts[of].max(1) as f64));
        if let (None, Some(x), Some(y)) = (raw.spacing_mm, step(0), step(1)) {
            raw.spacing_mm = Some([x, y]);
            raw.notes.push(format!("points are {x} mm by {y} mm apart, as the file says"));
        }
        if let (None, Some(um)) = (raw.unit_um, self.unit_um) {
            raw.unit_um = Some(um);
            raw.notes.push(format!("a value of 1 is {um} um, as the file says"));
        }
    }
}

fn said(line: &str) -> Option<Said> {
    let line = line.trim().trim_start_matches(['#', '%', '/']).trim();
    let (key, value) = line.split_once([':', '=', ';', '\t'])?;
    // A unit may stand beside the key: `Width [mm]: 3`.
    let (key, beside) =
        key.split_once(['[', '(']).map_or((key, ""), |(key, unit)| (key, unit.trim_end_matches([']', ')', ' '])));
    let value = value.trim().trim_end_matches([';', ',', '\t']).trim();
    let key = key.trim().to_lowercase().replace(['-', '_'], " ");
    let length = || {
        let end = value.find(|c: char| !(c.is_ascii_digit() || "+-.,eE".contains(c))).unwrap_or(value.len());
        let (number, unit) = value.split_at(end);
        let number: f64 = number.trim().replace(',', ".").parse().ok()?;
        let unit = if unit.trim().is_empty() { beside } else { unit.trim() };
        Some(number * 1e-3 * um(unit)?).filter(|mm| *mm > 0.0 && mm.is_finite())
    };
    match key.as_str() {
        "width" | "x range" | "x size" | "x length" | "scan width" => Some(Said::Size(0, length()?)),
        "height" | "y range" | "y size" | "y length" | "scan height" => Some(Said::Size(1, length()?)),
        "x step" | "dx" | "x spacing" | "x pixel size" | "x increment" | "pixel width" => {
            Some(Said::Step(0, length()?))
        }
        "y step" | "dy" | "y spacing" | "y pixel size" | "y increment" | "pixel height" => {
            Some(Said::Step(1, length()?))
        }
        "pixel size" | "lateral resolution" | "xy calibration" => Some(Said::Steps(length()?)),
        "value units" | "value unit" | "z unit" | "z units" | "height unit" | "height units" | "data unit" => {
            Some(Said::Unit(um(value)?))
        }
        _ => None,
    }
}

/// Micrometres in a unit of length.
fn um(unit: &str) -> Option<f64> {
    Some(match unit.trim().trim_matches(['[', ']', '(', ')', '"']) {
        "m" => 1e6,
        "mm" => 1e3,
        "um" | "µm" | "μm" | "micron" | "microns" => 1.0,
        "nm" => 1e-3,
        "pm" => 1e-6,
        "Å" | "A" => 1e-4,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_lines_above_a_grid_state_its_size_and_unit() {
        let gwyddion = "# Channel: Height\n# Width: 3.00 mm\n# Height: 1500 µm\n# Value units: nm\n";
        let expected = Stated { size_mm: [Some(3.0), Some(1.5)], unit_um: Some(1e-3), ..Stated::default() };
        let near = |a: Option<f64>, b: Option<f64>| a.zip(b).map_or(a == b, |(a, b)| (a / b - 1.0).abs() < 1e-12);
        let found = Stated::of(gwyddion);
        assert!((0..2).all(|k| near(found.size_mm[k], expected.size_mm[k])) && found.unit_um == expected.unit_um);
        let matrix = Stated::of("Title;made up\nX Step [um];2,5\nY Step;0.002 mm\nZ unit;um\n1;2\n");
        assert!(near(matrix.step_mm[0], Some(2.5e-3)) && near(matrix.step_mm[1], Some(2e-3)), "{matrix:?}");
        assert_eq!(matrix.unit_um, Some(1.0));
        // Numbers and other words state nothing.
        for line in ["1;2;3", "0.5\t0.25", "Width: 512", "Height: tall", "# Value units: V"] {
            assert!(!Stated::says(line), "{line}");
        }
    }
}
