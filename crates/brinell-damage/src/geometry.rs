//! What the readers give: polygons, or a depth map. Frame and origin: see the crate's header.

use brinell::scenario::DepthGrid;
use brinell::signal::short;

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

/// A depth map as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMap {
    /// Depths; their frame and origin as elsewhere.
    pub grid: DepthGrid,
    /// What may be wrong, in sentences.
    pub warnings: Vec<String>,
    /// What the reader understood of the file by itself, in sentences.
    pub notes: Vec<String>,
    /// The curved form that was taken off.
    pub form: Option<Form>,
}

/// A cylinder or a torus that was fitted to a scan.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// As `remove_form` has it.
    pub name: &'static str,
    /// Along s; of a given radius its sign alone was found.
    pub around: Curve,
    /// Across s; none of a cylinder.
    pub across: Option<Curve>,
    /// Whether the radius along s was given.
    pub given: bool,
}

/// A circle that was fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// One over the radius; positive where the surface is hollow.
    pub curvature_per_mm: f64,
    /// Half the scan's length in that direction.
    pub half_mm: f64,
}

impl Curve {
    /// The radius, four figures of it.
    pub fn radius_mm(self) -> f64 {
        let radius = self.curvature_per_mm.abs().recip();
        short(radius, 4).parse().unwrap_or(radius)
    }

    /// Which way it is curved.
    pub fn side(self) -> &'static str {
        if self.curvature_per_mm < 0.0 { "bulging" } else { "hollow" }
    }
}

impl Form {
    /// `hollow along s; across, hollow with a radius of 4.13 mm`.
    pub fn sides(&self) -> String {
        let across = self.across.map(|c| format!("; across, {} with a radius of {} mm", c.side(), c.radius_mm()));
        format!("{} along s{}", self.around.side(), across.unwrap_or_default())
    }
}
