//! How to read a depth map: units, missing points, form, zero, turn.

use crate::depth::MAX_DEPTH_UM;
use crate::direction::Direction;
use crate::error::{DamageError, check_range};
use crate::form::Form;

/// What the numbers of a depth map count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unit {
    /// Micrometres.
    Um,
    /// Millimetres.
    Mm,
    /// Metres.
    M,
    /// So many nanometres per count: for PNG and integer arrays.
    NmPerCount(f64),
}

/// What to do about missing points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fill {
    /// Refuse a map that has any.
    #[default]
    None,
    /// Join their neighbours smoothly.
    Neighbours,
}

/// What counts as depth 0, after the form is off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Zero {
    /// The map's own zero.
    AsIs,
    /// The median of the map's rim: its outermost 5 % on each side.
    #[default]
    RimMedian,
    /// The depth that this percentage of the points does not exceed (50: the median).
    Percentile(f64),
}

/// Which side of the picture a file's first row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FirstRow {
    /// The top, as in a printed table or an image.
    #[default]
    Top,
    /// The bottom, as where rows count upwards along `y`.
    Bottom,
}

/// How to read a depth map.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMapOptions {
    /// From point to point along the rolling direction, mm; `None`: as the file says (SDF, X3P, SUR, a point cloud).
    pub ds_mm: Option<f64>,
    /// From point to point along the axis, mm; `None`: as the file says.
    pub dz_mm: Option<f64>,
    /// The unit of the numbers.
    pub unit: Unit,
    /// The numbers are heights, up out of the material; else depths, into it.
    pub height_positive_up: bool,
    /// A number that marks missing points, beside NaN, infinities and empty cells.
    pub missing: Option<f64>,
    /// What to do about missing points.
    pub fill: Fill,
    /// The raceway's form, to take off.
    pub remove_form: Form,
    /// What counts as depth 0.
    pub zero: Zero,
    /// Which side the file's first row is.
    pub first_row: FirstRow,
    /// Where the roller passes to, in the picture.
    pub rolling_direction: Direction,
    /// Shallower (and less raised) than this is undamaged.
    pub threshold_um: f64,
    /// Damaged spots smaller than this are noise, mm^2; 0 keeps all.
    pub speck_mm2: f64,
    /// Puts the damage's bounding box at the origin; else the map's centre is the origin.
    pub center: bool,
}

impl Default for DepthMapOptions {
    /// Heights in um, spacing as the file says, nothing taken off but the rim's level, all beyond 1 um damage.
    fn default() -> Self {
        Self {
            ds_mm: None,
            dz_mm: None,
            unit: Unit::Um,
            height_positive_up: true,
            missing: None,
            fill: Fill::None,
            remove_form: Form::None,
            zero: Zero::RimMedian,
            first_row: FirstRow::Top,
            rolling_direction: Direction::Right,
            threshold_um: 1.0,
            speck_mm2: 0.0,
            center: true,
        }
    }
}

/// Every number within its range.
pub(crate) fn check(options: &DepthMapOptions) -> Result<(), DamageError> {
    const SPACING: &str = "a number of mm above 0, at most 10";
    for (name, spacing) in [("ds_mm", options.ds_mm), ("dz_mm", options.dz_mm)] {
        if let Some(spacing) = spacing {
            check_range(name, spacing, 0.0, 10.0, SPACING)?;
        }
    }
    let least = -f64::MIN_POSITIVE;
    check_range("threshold_um", options.threshold_um, least, MAX_DEPTH_UM, "0 to 5000 um")?;
    check_range("speck_mm2", options.speck_mm2, least, 1e6, "an area of 0 mm^2 or more")?;
    if let Unit::NmPerCount(nm) = options.unit {
        check_range("unit", nm, 0.0, 1e6, "a number of nm per count above 0, at most 1e6")?;
    }
    if let Zero::Percentile(p) = options.zero {
        check_range("zero", p, least, 100.0, "a percentile from 0 to 100")?;
    }
    if let Form::Cylinder { radius_mm: Some(r) } = options.remove_form {
        check_range("radius_mm", r, 0.0, 1e5, "a number of mm above 0, at most 100000")?;
    }
    Ok(())
}
