//! The resolved scenario: every key of the file, with every default filled in.
//!
//! Fields carry the file's names and units; [`crate::model`] converts to SI once. A value here has passed the
//! range checks of the reader, but a scenario built in code has not: [`crate::model::Model::new`] checks again what
//! it cannot work with.

/// One run, completely described.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name of the run, free text.
    pub name: String,
    /// Geometry and masses of the bearing.
    pub bearing: Bearing,
    /// Cage geometry, mass and contact.
    pub cage: Cage,
    /// Roller-raceway normal contact.
    pub contact: Contact,
    /// Roller-raceway friction.
    pub friction: Friction,
    /// Oil.
    pub lubricant: Lubricant,
    /// Supports of the two rings.
    pub support: Support,
    /// Speed, load and gravity.
    pub operation: Operation,
    /// Damage, none or any number.
    pub defects: Vec<Defect>,
    /// From the ring to the record.
    pub sensor: Sensor,
    /// What to compute and to record.
    pub simulation: Simulation,
}

/// `[bearing]`: geometry and masses.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Catalogue name that filled the keys not given, if any.
    pub preset: Option<String>,
    /// D_i, mm.
    pub inner_raceway_diameter_mm: f64,
    /// D_o, mm.
    pub outer_raceway_diameter_mm: f64,
    /// D_m, mm.
    pub pitch_diameter_mm: f64,
    /// d, mm.
    pub roller_diameter_mm: f64,
    /// L, effective contact length, mm.
    pub roller_length_mm: f64,
    /// Z, rollers in each row.
    pub rollers_per_row: usize,
    /// N_r, rows.
    pub rows: usize,
    /// Angle by which row i lags row i - 1, degrees.
    pub row_stagger_deg: f64,
    /// C_r, radial gap on one side (half of ISO 5753's diametral value), um; negative is preload.
    pub radial_clearance_um: f64,
    /// Gap subtracted at the outer contact too, um.
    pub outer_gap_um: f64,
    /// m_i, kg.
    pub inner_ring_mass_kg: f64,
    /// m_o, kg.
    pub outer_ring_mass_kg: f64,
    /// m, kg.
    pub roller_mass_kg: f64,
}

/// What centres the cage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guidance {
    /// Land on the outer ring (the paper).
    OuterRing,
    /// Land on the inner ring.
    InnerRing,
    /// No land: the rollers carry the cage.
    Rollers,
}

/// `[cage]`: one cage for each row.
#[derive(Debug, Clone, PartialEq)]
pub struct Cage {
    /// m_c, kg.
    pub mass_kg: f64,
    /// 2 a, mm.
    pub inner_diameter_mm: f64,
    /// 2 b, mm.
    pub outer_diameter_mm: f64,
    /// C_p to each side, mm.
    pub pocket_clearance_mm: f64,
    /// Guiding ring.
    pub guidance: Guidance,
    /// C_g, radial, mm.
    pub guide_clearance_mm: f64,
    /// L_1, mm.
    pub guide_width_mm: f64,
    /// k_c, N/m, of pockets and land.
    pub contact_stiffness_n_per_m: f64,
    /// c_c, N s/m, of pockets.
    pub contact_damping_ns_per_m: f64,
}

/// Law of a roller on a damaged raceway.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Effective contact length (the paper, made continuous).
    Ecl,
    /// Independent slices across the roller, each at its own depth (in the manner of ISO/TS 16281).
    Sliced,
}

/// How a roller follows the damage's floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollerPath {
    /// The depth under the contact line (the paper).
    Point,
    /// The depth that a roller of finite radius can reach.
    Envelope,
}

/// `edge_reaction`: whether the damage's slopes push the rollers along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeReaction {
    /// No (the paper); the energy audit carries the parametric work.
    None,
    /// The generalised force -dE/du on what turns; only with `sliced` and `envelope`.
    Conservative,
}

/// `[contact]`: normal contact of rollers and raceways.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// Law of a damaged contact.
    pub law: Law,
    /// Path of the roller through damage.
    pub roller_path: RollerPath,
    /// Slices across the roller; `ecl` does not use them.
    pub slices: usize,
    /// Tangential push of the damage's slopes.
    pub edge_reaction: EdgeReaction,
    /// n.
    pub exponent: f64,
    /// K_in of a healthy contact, N/m^n.
    pub inner_stiffness: f64,
    /// K_out of a healthy contact, N/m^n.
    pub outer_stiffness: f64,
    /// c, N s/m.
    pub damping_ns_per_m: f64,
}

/// `[friction]`: rollers on raceways.
#[derive(Debug, Clone, PartialEq)]
pub struct Friction {
    /// mu.
    pub raceway_coefficient: f64,
    /// v_s, m/s.
    pub slip_velocity_m_per_s: f64,
}

/// `[lubricant]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Lubricant {
    /// eta, Pa s, of the guidance film.
    pub viscosity_pa_s: f64,
    /// C_d of a roller.
    pub drag_coefficient: f64,
    /// rho_f of the oil-air mixture, kg/m^3.
    pub effective_density_kg_per_m3: f64,
}

/// `[support]`: isotropic springs and dampers of the rings to ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// k_i, N/m.
    pub inner_stiffness_n_per_m: f64,
    /// c_i, N s/m.
    pub inner_damping_ns_per_m: f64,
    /// k_o, N/m.
    pub outer_stiffness_n_per_m: f64,
    /// c_o, N s/m.
    pub outer_damping_ns_per_m: f64,
}

/// `speed_rpm`: a number, or points (t in s, r/min) joined by lines and held beyond both ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Speed {
    /// Constant, r/min.
    Constant(f64),
    /// Points (t_s, rpm), t strictly increasing.
    Profile(Vec<[f64; 2]>),
}

/// The ring that the load acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadOn {
    /// -F on the outer ring (the paper's rig).
    OuterRing,
    /// +F on the inner ring.
    InnerRing,
}

/// `[operation]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Operation {
    /// Speed of the inner ring, counter-clockwise positive.
    pub speed_rpm: Speed,
    /// F, N: from the bearing centre to the middle of the load zone.
    pub load_n: [f64; 2],
    /// Which ring carries it.
    pub load_on: LoadOn,
    /// Time over which the load rises linearly, s; 0 is at once.
    pub load_ramp_s: f64,
    /// g, m/s^2.
    pub gravity_m_per_s2: [f64; 2],
}

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

/// Outline and floor of a defect. Length runs along the rolling direction, width along the axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// L_s = width for |s| <= length / 2.
    Rectangle {
        /// Along the rolling direction, mm.
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
        /// Points (s, z) of each polygon, mm, from the defect's centre: s along the rolling direction, z along the axis.
        polygons_mm: Vec<Vec<[f64; 2]>>,
    },
    /// Depths on a grid, a profilometer's scan for one; the defect's own depth is not used.
    DepthMap {
        /// The scan.
        grid: DepthGrid,
    },
    /// An outline enlarged or shrunk alike in both directions, about s = z = 0, until it has the width or the area asked for.
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
        /// Extent along the rolling direction, mm.
        length_mm: f64,
        /// Extent along the axis, mm.
        width_mm: f64,
        /// 0: an ellipse with an even floor; 1: as ragged and uneven as it gets.
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

/// Where the roller passes to, in a picture as it is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollingDirection {
    /// To the right.
    Right,
    /// Upwards.
    Up,
    /// To the left.
    Left,
    /// Downwards.
    Down,
}

/// How an outline runs between the pixels of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageEdges {
    /// Where the brightness crosses the threshold: photos.
    SubPixel,
    /// Along pixel edges: masks drawn pixel by pixel.
    PixelEdges,
}

/// `image`: damage in a PNG or JPEG.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageFile {
    /// Path, from the scenario's folder.
    pub file: String,
    /// The side of a pixel, mm.
    pub mm_per_pixel: f64,
    /// Brightness (0 to 1) below which is damage; `None`: the level that divides the picture best.
    pub threshold: Option<f64>,
    /// The alpha channel is the mask.
    pub use_alpha: bool,
    /// Lighter, or more transparent, is damage.
    pub invert: bool,
    /// Where the roller passes to.
    pub rolling_direction: RollingDirection,
    /// Puts the damage's bounding box at the defect's centre; else the image's middle.
    pub center: bool,
    /// How outlines run.
    pub edges: ImageEdges,
    /// Standard deviation of the blur before, pixels; none along pixel edges.
    pub blur_px: Option<f64>,
    /// Spots and holes smaller than this are dropped, mm^2.
    pub speck_mm2: f64,
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

/// What the numbers of a scan count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanUnit {
    /// Micrometres.
    Um,
    /// Millimetres.
    Mm,
    /// Metres.
    M,
    /// Whole numbers of a PNG or an array, `nm_per_count` each.
    Counts,
}

/// What to do about points that a scan lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanFill {
    /// Refuse them.
    None,
    /// Join their neighbours.
    Neighbours,
}

/// The raceway's own form under a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanForm {
    /// Stays.
    None,
    /// A tilted plane, taken off.
    Plane,
    /// A tilted cylinder, taken off.
    Cylinder,
}

/// What counts as depth 0 of a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanZero {
    /// The median of the rim.
    RimMedian,
    /// The scan's own zero.
    AsIs,
    /// The depth that `zero_percentile` of the points do not exceed.
    Percentile,
}

/// Where a scan's first row lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstRow {
    /// On top, as in print.
    Top,
    /// At the bottom, rows counting upwards.
    Bottom,
}

/// `depth_map` with `file`: heights in CSV, NPY or 16-bit PNG.
#[derive(Debug, Clone, PartialEq)]
pub struct ScanFile {
    /// Path, from the scenario's folder.
    pub file: String,
    /// From point to point along the rolling direction, mm.
    pub ds_mm: f64,
    /// From point to point along the axis, mm.
    pub dz_mm: f64,
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
    /// The cylinder's radius where known, mm.
    pub radius_mm: Option<f64>,
    /// Depth 0.
    pub zero: ScanZero,
    /// Percent, where `zero` is `Percentile`.
    pub zero_percentile: Option<f64>,
    /// First row of the file.
    pub first_row: FirstRow,
    /// Where the roller passes to.
    pub rolling_direction: RollingDirection,
    /// Shallower than this is undamaged, um.
    pub threshold_um: f64,
    /// Spots smaller than this are noise, mm^2.
    pub speck_mm2: f64,
    /// Puts the damage's bounding box at the defect's centre; else the scan's middle.
    pub center: bool,
}

/// Depths at the nodes of a rectangular grid, bilinear between them, 0 beyond its border.
#[derive(Debug, Clone, PartialEq)]
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

/// One `[[defects]]` entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Defect {
    /// Damaged surface.
    pub on: Surface,
    /// Row, from 1.
    pub row: usize,
    /// psi, degrees.
    pub center_deg: f64,
    /// h, um; the depths of a profile or a depth map override it.
    pub depth_um: f64,
    /// Outline.
    pub shape: Shape,
}

/// Colour of a sensor's noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseColour {
    /// The same density everywhere.
    White,
    /// Density ~ 1/f above the corner.
    Pink,
    /// Density ~ 1/f^2 above the corner.
    Brown,
}

/// One mode of the structure between ring and sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct PathMode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// Participation at the sensor: 1 and one mode is a mass on a spring; negative moves against the ring.
    pub gain: f64,
}

/// `[sensor]`: what stands between the outer ring's acceleration and the record. What is not given is not there.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// The axis of a channel of its own, degrees counter-clockwise from +X.
    pub direction_deg: Option<f64>,
    /// mV for each m/s^2, of that channel and of the converter.
    pub sensitivity_mv_per_m_per_s2: Option<f64>,
    /// Resonance of the sensor on its mounting, Hz.
    pub mounting_resonance_hz: Option<f64>,
    /// Its share of critical damping.
    pub mounting_damping_ratio: f64,
    /// Lower end of the band, Hz, -3 dB, first order.
    pub low_cut_hz: Option<f64>,
    /// Upper end of the band, Hz, -3 dB, second-order Butterworth.
    pub high_cut_hz: Option<f64>,
    /// Standard deviation of the noise, m/s^2; or the next two.
    pub noise_rms_m_per_s2: Option<f64>,
    /// Level of a signal of the next key's RMS over the noise, dB.
    pub noise_snr_db: Option<f64>,
    /// The RMS that the ratio refers to, m/s^2.
    pub noise_reference_rms_m_per_s2: f64,
    /// Its colour.
    pub noise_colour: NoiseColour,
    /// Below this the noise's density is flat, Hz; white noise does not use it.
    pub noise_corner_hz: f64,
    /// Which noise.
    pub noise_seed: u64,
    /// Bits of the converter.
    pub converter_bits: Option<usize>,
    /// Its ends, plus and minus, m/s^2; or the next one.
    pub converter_range_m_per_s2: Option<f64>,
    /// Its ends, mV.
    pub converter_range_mv: Option<f64>,
    /// Modes between ring and sensor.
    pub path: Vec<PathMode>,
}

/// The ends of a converter, plus and minus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// m/s^2.
    Acceleration(f64),
    /// mV.
    Voltage(f64),
}

impl Sensor {
    /// No sensor: the record is the ring's own acceleration.
    pub fn off() -> Self {
        Self {
            direction_deg: None,
            sensitivity_mv_per_m_per_s2: None,
            mounting_resonance_hz: None,
            mounting_damping_ratio: 0.0,
            low_cut_hz: None,
            high_cut_hz: None,
            noise_rms_m_per_s2: None,
            noise_snr_db: None,
            noise_reference_rms_m_per_s2: 0.0,
            noise_colour: NoiseColour::White,
            noise_corner_hz: 0.0,
            noise_seed: 0,
            converter_bits: None,
            converter_range_m_per_s2: None,
            converter_range_mv: None,
            path: Vec::new(),
        }
    }

    /// Whether anything is asked for.
    pub fn is_on(&self) -> bool {
        let filters = [
            self.mounting_resonance_hz,
            self.low_cut_hz,
            self.high_cut_hz,
        ];
        self.direction_deg.is_some()
            || filters.iter().any(Option::is_some)
            || self.noise_rms().is_some()
            || self.range().is_some()
            || !self.path.is_empty()
    }

    /// Standard deviation of the noise, m/s^2, whichever way it is given.
    pub fn noise_rms(&self) -> Option<f64> {
        let below = |db: f64| self.noise_reference_rms_m_per_s2 * 10f64.powf(-db / 20.0);
        self.noise_rms_m_per_s2.or(self.noise_snr_db.map(below))
    }

    /// The converter's ends, where there is one.
    pub fn range(&self) -> Option<Range> {
        self.converter_bits?;
        let volts = self.converter_range_mv.map(Range::Voltage);
        self.converter_range_m_per_s2
            .map(Range::Acceleration)
            .or(volts)
    }
}

/// Which equations are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelKind {
    /// Every part a moving body.
    Full,
    /// The lumped model that the paper compares against.
    Reference,
}

/// State at t = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// Pure rolling, rings displaced by 1 um (the paper).
    Rolling,
    /// Everything at rest but the inner ring.
    Rest,
    /// Pure rolling, rings and rollers in static balance under the full load.
    Equilibrium,
}

/// Tolerance of the integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Accuracy {
    /// About 1 % of an acceleration over 2.5 ms.
    Standard,
    /// As tight as round-off amplified by impacts makes sensible.
    Reference,
}

/// `[simulation]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// Equations.
    pub model: ModelKind,
    /// Simulated time, s.
    pub duration_s: f64,
    /// f_s, Hz.
    pub sample_rate_hz: f64,
    /// Initial state.
    pub start: Start,
    /// Tolerance.
    pub accuracy: Accuracy,
    /// Channel names to record, `*` matches any run of characters.
    pub record: Vec<String>,
}
