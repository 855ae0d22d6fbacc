//! What the readers give: polygons, or a grid of depths. Frame and origin: see the crate's header.

use brinell::scenario;

/// Damaged areas as polygons.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygons {
    /// Closed rings of points `[s, z]` in mm, the closing edge implied. Even-odd rule: a ring inside a ring is a
    /// hole. Outer rings run counter-clockwise, holes clockwise.
    pub polygons_mm: Vec<Vec<[f64; 2]>>,
    /// What may be wrong, in sentences.
    pub warnings: Vec<String>,
    /// What the reader decided by itself or left out, in sentences.
    pub notes: Vec<String>,
    /// Of an image whose threshold was left out: the one that was found, 0 black to 1 white.
    pub threshold: Option<f64>,
}

impl Polygons {
    /// The damaged area, holes taken off.
    pub fn area_mm2(&self) -> f64 {
        self.polygons_mm.iter().map(|ring| signed_area(ring)).sum()
    }

    /// The bounding box `[[s_min, z_min], [s_max, z_max]]`; `None` without a point.
    pub fn bounds_mm(&self) -> Option<[[f64; 2]; 2]> {
        let mut points = self.polygons_mm.iter().flatten();
        let first = *points.next()?;
        Some(points.fold([first, first], |[low, high], p| {
            [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
        }))
    }

    /// Moves the bounding box's centre to the origin.
    #[cfg(any(feature = "svg", feature = "image"))]
    pub(crate) fn centre(&mut self) {
        let Some([low, high]) = self.bounds_mm() else {
            return;
        };
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        for point in self.polygons_mm.iter_mut().flatten() {
            point[0] -= middle[0];
            point[1] -= middle[1];
        }
    }
}

/// The shoelace formula: positive where the ring runs counter-clockwise with the second axis up.
pub(crate) fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&origin) = ring.first() else {
        return 0.0;
    };
    let mut twice = 0.0;
    let mut before = *ring.last().unwrap_or(&origin);
    for &point in ring {
        // From the first point, so that a ring far from the origin keeps its digits.
        let a = [before[0] - origin[0], before[1] - origin[1]];
        let b = [point[0] - origin[0], point[1] - origin[1]];
        twice += a[0] * b[1] - b[0] * a[1];
        before = point;
    }
    0.5 * twice
}

/// Depths on a regular grid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DepthGrid {
    /// `s` of column 0, mm.
    pub s0_mm: f64,
    /// `z` of row 0, mm.
    pub z0_mm: f64,
    /// From column to column, mm.
    pub ds_mm: f64,
    /// From row to row, mm.
    pub dz_mm: f64,
    /// Points along `s`.
    pub columns: usize,
    /// Points along `z`.
    pub rows: usize,
    /// `depth_um[row * columns + column]`: 0 undamaged, positive into the material, negative raised.
    pub depth_um: Vec<f64>,
    /// What may be wrong, in sentences.
    pub warnings: Vec<String>,
    /// What the reader understood of the file by itself, in sentences.
    pub notes: Vec<String>,
}

impl From<scenario::DepthGrid> for DepthGrid {
    /// Nothing was taken off, nothing is said of it.
    fn from(grid: scenario::DepthGrid) -> Self {
        Self {
            s0_mm: grid.s0_mm,
            z0_mm: grid.z0_mm,
            ds_mm: grid.ds_mm,
            dz_mm: grid.dz_mm,
            columns: grid.columns,
            rows: grid.rows,
            depth_um: grid.depth_um,
            ..Self::default()
        }
    }
}

impl DepthGrid {
    /// The depth at a grid point.
    pub fn at(&self, column: usize, row: usize) -> f64 {
        self.depth_um[row * self.columns + column]
    }

    /// The area of the cells that are not 0.
    pub fn area_mm2(&self) -> f64 {
        let damaged = self.depth_um.iter().filter(|&&d| d != 0.0).count();
        damaged as f64 * self.ds_mm * self.dz_mm
    }

    /// `[min, max]` of columns and of rows that hold anything but 0: `[[c0, r0], [c1, r1]]`.
    pub fn damaged_bounds(&self) -> Option<[[usize; 2]; 2]> {
        let mut bounds: Option<[[usize; 2]; 2]> = None;
        for (row, line) in self.depth_um.chunks_exact(self.columns.max(1)).enumerate() {
            let Some(first) = line.iter().position(|&d| d != 0.0) else {
                continue;
            };
            let last = line.iter().rposition(|&d| d != 0.0).unwrap_or(first);
            bounds = Some(match bounds {
                None => [[first, row], [last, row]],
                Some([low, high]) => [[low[0].min(first), low[1]], [high[0].max(last), row]],
            });
        }
        bounds
    }
}
