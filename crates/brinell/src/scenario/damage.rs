//! `[[defects]]`: where damage lies and what shape it has.

use super::choices::*;
use super::table::TableData;
use super::unset::{sections, unset};

/// Where a defect lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// Outer raceway: fixed in space.
    OuterRaceway,
    /// Inner raceway: turns with the ring.
    InnerRaceway,
    /// One roller of the row, counted from 1.
    Roller(usize),
}

/// Outline and floor of a defect. Length runs along s, counter-clockwise around the surface, width along the axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// L_s = width for |s| <= length / 2.
    Rectangle {
        /// Along s, mm.
        length_mm: f64,
        /// Along the axis, mm.
        width_mm: f64,
    },
    /// L_s = 2 sqrt(a^2 - s^2).
    Circle {
        /// 2 a, mm.
        diameter_mm: f64,
    },
    /// Linear between points; where the arc repeats, it jumps.
    Profile {
        /// s, mm, never decreasing.
        arc_mm: Vec<f64>,
        /// L_s at each s, mm.
        width_mm: Vec<f64>,
        /// h_s at each s, um; left out: the defect's depth.
        depth_um: Option<Vec<f64>>,
    },
    /// The paper's Eq. (27), made whole.
    Li2023Irregular {
        /// Largest L_s, mm (4 in the paper).
        max_width_mm: f64,
    },
    /// Seen from above: the inside of closed polygons, each closing on its first point. The even-odd rule makes holes.
    Outline {
        /// Points (s, z) of each polygon, mm, from the defect's centre: s counter-clockwise, z along the
        /// axis.
        polygons_mm: Vec<Vec<[f64; 2]>>,
    },
    /// Depths on a grid, a profilometer's scan for one; the defect's own depth is not used.
    DepthMap {
        /// The scan.
        grid: DepthGrid,
    },
    /// An outline enlarged or shrunk alike in both directions, about s = z = 0, until it has the width or the area
    /// requested.
    Grown {
        /// Polygons as in [`Shape::Outline`], mm.
        outline: Vec<Vec<[f64; 2]>>,
        /// Largest L_s wanted, mm. Either this or the area is given.
        max_width_mm: Option<f64>,
        /// Area wanted, mm^2.
        area_mm2: Option<f64>,
    },
    /// A ragged spall drawn from a seed, the same on every machine; the mean of its depths is the defect's depth.
    Random {
        /// Which one.
        seed: u64,
        /// Extent along s, mm.
        length_mm: f64,
        /// Extent along the axis, mm.
        width_mm: f64,
        /// 0: an ellipse of even depth; 1: as ragged and uneven as it gets.
        roughness: f64,
    },
    /// A photo or a mask, not read yet: the core opens no files. `brinell-damage` puts an outline in its place.
    Image(ImageFile),
    /// A drawing, not read yet; becomes an outline.
    Svg(SvgFile),
    /// A profilometer's file, not read yet; becomes a depth map.
    Scan(ScanFile),
}

impl Shape {
    /// The file that this shape is still to be read from.
    pub fn file(&self) -> Option<&str> {
        match self {
            Self::Image(image) => Some(&image.file),
            Self::Svg(drawing) => Some(&drawing.file),
            Self::Scan(scan) => Some(&scan.file),
            _ => None,
        }
    }
}

/// `image`: damage in a PNG or JPEG.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageFile {
    /// Path, from the scenario's folder.
    pub file: String,
    /// The side of a pixel, mm; a file may give a length in the picture in its place, its `scale_bar`.
    pub mm_per_pixel: f64,
    /// Brightness (0 to 1) below which is damage; `None`: the level that divides the picture best.
    pub threshold: Option<f64>,
    /// The alpha channel is the mask.
    pub use_alpha: bool,
    /// Lighter, or more transparent, is damage.
    pub invert: bool,
    /// Where +s points in the picture.
    pub rolling_direction: RollingDirection,
    /// Puts the damage's bounding box at the defect's centre; else the image's middle.
    pub center: bool,
    /// How outlines run.
    pub edges: ImageEdges,
    /// Standard deviation of the blur before, pixels; none along pixel edges.
    pub blur_px: Option<f64>,
    /// Spots and holes smaller than this are dropped, mm^2.
    pub speck_mm2: f64,
    /// What of the picture is read: left, top, width, height, pixels; `None`: all.
    pub region_px: Option<[f64; 4]>,
    /// Which pieces are damage; `None`: of a photo the largest, of a mask or with a threshold all.
    pub pieces: Option<ImagePieces>,
    /// A point within the piece that is damage, pixels from the upper left corner.
    pub at_px: Option<[f64; 2]>,
}

impl Default for ImageFile {
    /// A photo whose scale is not known (NaN); blur of 1.5 pixels, specks below 0.02 mm^2.
    fn default() -> Self {
        Self {
            file: String::new(),
            mm_per_pixel: f64::NAN,
            threshold: None,
            use_alpha: false,
            invert: false,
            rolling_direction: RollingDirection::Right,
            center: true,
            edges: ImageEdges::SubPixel,
            blur_px: Some(1.5),
            speck_mm2: 0.02,
            region_px: None,
            pieces: None,
            at_px: None,
        }
    }
}

/// `svg`: damage drawn in a vector editor.
#[derive(Debug, Clone, PartialEq)]
pub struct SvgFile {
    /// Path, from the scenario's folder.
    pub file: String,
    /// One path, shape or group of the drawing; `None`: all of it.
    pub path_id: Option<String>,
    /// Scale; `None`: the drawing's own.
    pub mm_per_unit: Option<f64>,
    /// How far polygons may stray from curves, mm.
    pub tolerance_mm: f64,
    /// Puts the damage's bounding box at the defect's centre; else the page's middle.
    pub center: bool,
}

impl Default for SvgFile {
    /// The whole drawing at its own scale, within a micrometre, centred.
    fn default() -> Self {
        Self { file: String::new(), path_id: None, mm_per_unit: None, tolerance_mm: 0.001, center: true }
    }
}

/// `depth_map` with `file`: heights in CSV, NPY, 16-bit PNG, SDF, X3P or SUR.
#[derive(Debug, Clone, PartialEq)]
pub struct ScanFile {
    /// Path, from the scenario's folder.
    pub file: String,
    /// From point to point along s, whichever way that runs in the file, mm; `None`: as the file says.
    pub ds_mm: Option<f64>,
    /// From point to point along the axis, likewise.
    pub dz_mm: Option<f64>,
    /// What the numbers count.
    pub unit: ScanUnit,
    /// nm, where `unit` is `Counts`.
    pub nm_per_count: Option<f64>,
    /// Heights out of the material; else depths into it.
    pub height_positive_up: bool,
    /// A number that marks missing points, beside empty cells and NaN.
    pub missing: Option<f64>,
    /// What to do about them.
    pub fill: ScanFill,
    /// The form to take off.
    pub remove_form: ScanForm,
    /// Radius along s of the cylinder or torus where known, mm.
    pub radius_mm: Option<f64>,
    /// Depth 0.
    pub zero: ScanZero,
    /// Percent, where `zero` is `Percentile`.
    pub zero_percentile: Option<f64>,
    /// First row of the file.
    pub first_row: FirstRow,
    /// Where +s points in the picture.
    pub rolling_direction: RollingDirection,
    /// Shallower than this is undamaged, um.
    pub threshold_um: f64,
    /// Spots smaller than this are noise, mm^2.
    pub speck_mm2: f64,
    /// Puts the damage's bounding box at the defect's centre; else the scan's middle.
    pub center: bool,
}

impl Default for ScanFile {
    /// Heights in um, spacing as the file says, nothing taken off but the rim's level, all beyond 1 um damage.
    fn default() -> Self {
        Self {
            file: String::new(),
            ds_mm: None,
            dz_mm: None,
            unit: ScanUnit::Um,
            nm_per_count: None,
            height_positive_up: true,
            missing: None,
            fill: ScanFill::None,
            remove_form: ScanForm::None,
            radius_mm: None,
            zero: ScanZero::RimMedian,
            zero_percentile: None,
            first_row: FirstRow::Top,
            rolling_direction: RollingDirection::Right,
            threshold_um: 1.0,
            speck_mm2: 0.0,
            center: true,
        }
    }
}

sections! {
    /// Depths at the nodes of a rectangular grid, bilinear between them, 0 beyond its border.
    pub struct DepthGrid {
        /// s of the first column, mm.
        pub s0_mm: f64,
        /// z of the first row, mm.
        pub z0_mm: f64,
        /// Distance of columns, mm.
        pub ds_mm: f64,
        /// Distance of rows, mm.
        pub dz_mm: f64,
        /// Nodes along s.
        pub columns: usize,
        /// Nodes along z.
        pub rows: usize,
        /// `depth_um[row * columns + column]` at (s0 + column ds, z0 + row dz), um; 0 is undamaged, negative a raised edge.
        pub depth_um: Vec<f64>,
    }
}

impl DepthGrid {
    /// The depth at a node, um.
    pub fn at(&self, column: usize, row: usize) -> f64 {
        self.depth_um[row * self.columns + column]
    }

    /// The deepest node, um; 0 where none is below the sound surface.
    pub fn deepest_um(&self) -> f64 {
        self.depth_um.iter().copied().fold(0.0, f64::max)
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

sections! {
    /// One `[[defects]]` entry.
    pub struct Defect {
        /// Damaged surface.
        pub on: Surface,
        /// Row, from 1.
        pub row: usize,
        /// psi, degrees.
        pub center_deg: f64,
        /// h, um; the depths of a profile or a depth map override it.
        pub depth_um: f64,
        /// Moves the shape along +Z, mm; 0: z = 0 of the shape is the middle of the row.
        pub axial_offset_mm: f64,
        /// Outline.
        pub shape: Shape,
        /// delta_eff(s, delta) from elsewhere, in place of what the engine finds for the shape; `half-space` only.
        pub table: Option<DefectTable>,
    }
}

impl Defect {
    /// The file that its table is still to be read from.
    pub fn table_file(&self) -> Option<&str> {
        match &self.table {
            Some(DefectTable::File(file)) => Some(file),
            Some(DefectTable::Read(_)) | None => None,
        }
    }
}

/// `table`: how the contact yields over this damage.
#[derive(Debug, Clone, PartialEq)]
pub enum DefectTable {
    /// Path from the scenario's folder, not read yet: the core opens no files. `brinell-damage` puts the table in its
    /// place.
    File(String),
    /// The table.
    Read(TableData),
}

unset! {
    DefectTable: Self::File(String::new());
    Shape: Self::Rectangle { length_mm: f64::NAN, width_mm: f64::NAN };
    Surface: Self::OuterRaceway;
}
