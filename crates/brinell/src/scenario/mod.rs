//! The resolved scenario: every key of the file, with every default filled in.
//!
//! Fields carry the file's names and units; [`crate::model`] converts to SI once. A value here has passed the
//! range checks of the reader, but a scenario built in code has not: [`Scenario::problems`] makes up for that.

mod choices;
mod damage;
mod laws;
mod machine;
mod sensor;
mod table;
mod unset;

pub(crate) use choices::words;
pub use choices::*;
pub use damage::{Defect, DefectTable, DepthGrid, ImageFile, ScanFile, Shape, Surface, SvgFile};
pub use machine::{
    Accelerometer, Coupling, Disc, HousingMode, HousingModes, Machine, MachineHousing, Seat, SensorOn, Shaft,
    ShaftLoad, Unbalance,
};
pub use sensor::{PathMode, Range, Sensor};
pub(crate) use table::OfList;
pub use table::{TableData, TableFault, TableValues};
#[doc(hidden)]
pub use unset::Unset;
use unset::{sections, unset};

sections! {
    /// One run, completely described.
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
        /// What moves with the outer ring.
        pub housing: Housing,
        /// Speed, load and gravity.
        pub operation: Operation,
        /// Damage, none or any number.
        pub defects: Vec<Defect>,
        /// From the ring to the record.
        pub sensor: Sensor,
        /// What to compute and to record.
        pub simulation: Simulation,
        /// The machine that the bearing is in, if it is not on supports of its own.
        pub machine: Option<Box<Machine>>,
    }
}

impl Speed {
    /// The speed, r/min, where it is constant.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Speed::Constant(rpm) => Some(*rpm),
            Speed::Profile(_) => None,
        }
    }
}

impl Operation {
    /// The axis nearer the load: 0 is X, 1 is Y.
    pub fn axis_of_load(&self) -> usize {
        Self::axis_along(self.load_n)
    }

    /// The axis nearer a load, the same way.
    #[doc(hidden)]
    pub fn axis_along([x, y]: [f64; 2]) -> usize {
        usize::from(y.abs() > x.abs())
    }
}

impl Scenario {
    /// Whether a healthy contact is pressed evenly along its roller: no profile, nothing that tilts.
    pub fn has_even_contacts(&self) -> bool {
        self.bearing.profile == RollerProfile::Straight && self.simulation.model != ModelKind::Tilting
    }

    /// Whether damage pushes along its surface, with a reaction on every body: on a half-space.
    pub(crate) fn has_damage_that_pushes(&self) -> bool {
        self.contact.law == Law::HalfSpace && !self.defects.is_empty()
    }

    /// Keys of the waves that there are, which push likewise.
    pub(crate) fn waves(&self) -> impl Iterator<Item = &'static str> {
        let b = &self.bearing;
        let keys = [("bearing.waviness", &b.waviness), ("bearing.element_waviness", &b.element_waviness)];
        keys.into_iter().filter_map(|(key, waves)| waves.as_ref().map(|_| key))
    }
}

impl Element {
    /// Stribeck: without clearance the heaviest carries this times F / Z.
    pub(crate) fn stribeck(self) -> f64 {
        match self {
            Self::Roller => 4.08,
            Self::Ball => 4.37,
        }
    }

    /// I_r / (m r^2) of its spin: a cylinder's about its axis, a sphere's.
    pub(crate) fn spin_inertia(self) -> f64 {
        match self {
            Self::Roller => 0.5,
            Self::Ball => 0.4,
        }
    }
}

sections! {
    /// `[bearing]`: geometry and masses.
    pub struct Bearing {
        /// Catalogue name that filled the keys not given, if any. What runs are the other fields, whatever the catalogue says of
        /// that bearing: `None` for one that is another. The bore alone goes by the name, where `bore_diameter_mm` gives none.
        pub preset: Option<String>,
        /// Rollers or balls. The keys named after rollers are then a ball's.
        pub element: Element,
        /// D_i, mm; a groove's at its bottom.
        pub inner_raceway_diameter_mm: f64,
        /// D_o, mm; a groove's at its bottom.
        pub outer_raceway_diameter_mm: f64,
        /// D_m, mm.
        pub pitch_diameter_mm: f64,
        /// d, mm.
        pub roller_diameter_mm: f64,
        /// C0, N, where a file gives it; else the catalogue's or an estimate counts.
        pub static_load_rating_n: Option<f64>,
        /// L, effective contact length, mm. A ball has none, no key for it either, and its diameter here.
        pub roller_length_mm: f64,
        /// Radius of the inner groove's cross-section over the ball's diameter; `None` for rollers.
        pub inner_groove_conformity: Option<f64>,
        /// The same of the outer groove.
        pub outer_groove_conformity: Option<f64>,
        /// Z, rollers in each row.
        pub rollers_per_row: usize,
        /// N_r, rows.
        pub rows: usize,
        /// Angle by which row i lags row i - 1, degrees.
        pub row_stagger_deg: f64,
        /// Bore, mm: for classes of clearance. `None`: that of the preset.
        pub bore_diameter_mm: Option<f64>,
        /// C_r, radial gap on one side (half of ISO 5753's diametral value), um; negative is preload. A file may give the
        /// diametral value or a class instead.
        pub radial_clearance_um: f64,
        /// Gap subtracted at the outer contact too, um.
        pub outer_gap_um: f64,
        /// m_i, kg.
        pub inner_ring_mass_kg: f64,
        /// m_o, kg.
        pub outer_ring_mass_kg: f64,
        /// m, kg.
        pub roller_mass_kg: f64,
        /// p(z), the drop of roller and raceway together.
        pub profile: RollerProfile,
        /// w(u) of every raceway; `None`: smooth.
        pub waviness: Option<Waviness>,
        /// w(u) of every rolling element; `None`: smooth.
        pub element_waviness: Option<Waviness>,
        /// B, of all rows; `tilting` only.
        pub width_mm: f64,
        /// b, between the middles of neighbouring rows; `tilting` only.
        pub row_spacing_mm: f64,
    }
}

impl Bearing {
    /// Whether balls roll in it.
    pub fn has_balls(&self) -> bool {
        self.element == Element::Ball
    }

    /// Diameter of a surface, mm.
    pub fn diameter_mm(&self, of: Surface) -> f64 {
        match of {
            Surface::OuterRaceway => self.outer_raceway_diameter_mm,
            Surface::InnerRaceway => self.inner_raceway_diameter_mm,
            Surface::Roller(_) => self.roller_diameter_mm,
        }
    }

    /// Length along the axis within which damage must lie, mm: that of a roller, and more than a ball's groove is wide.
    pub fn axial_reach_mm(&self) -> f64 {
        match self.element {
            Element::Roller => self.roller_length_mm,
            Element::Ball => 2.0 * self.roller_diameter_mm,
        }
    }
}

sections! {
    /// `[cage]`: one cage for each row.
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
        /// Law of the guidance film.
        pub guidance_film: GuidanceFilm,
        /// C_g, radial, mm.
        pub guide_clearance_mm: f64,
        /// L_1, mm.
        pub guide_width_mm: f64,
        /// Law of pockets and lands.
        pub walls: Walls,
        /// What the pockets hold.
        pub pockets: Pockets,
        /// mu_p of pockets; `oiled` walls only.
        pub friction_coefficient: f64,
        /// k_c, N/m, of pockets; `linear` walls only, like the next three.
        pub contact_stiffness_n_per_m: f64,
        /// c_c, N s/m, of pockets.
        pub contact_damping_ns_per_m: f64,
        /// k_l, N/m, where the cage meets a ring.
        pub land_stiffness_n_per_m: f64,
        /// c_l, N s/m, where the cage meets a ring; none under the quasi-static film.
        pub land_damping_ns_per_m: f64,
    }
}

sections! {
    /// `[contact]`: normal contact of rollers and raceways.
    pub struct Contact {
        /// Law of a damaged contact.
        pub law: Law,
        /// Path of the roller through damage, under `ecl`.
        pub roller_path: RollerPath,
        /// Slices across rollers that tilt or have a profile.
        pub slices: usize,
        /// n; 3/2 of balls, which have no key for it.
        pub exponent: f64,
        /// E of elements and rings, GPa; `None` where neither balls nor a half-space need it.
        pub youngs_modulus_gpa: Option<f64>,
        /// Poisson's ratio of both, likewise.
        pub poisson_ratio: Option<f64>,
        /// K_in of a healthy contact, N/m^n.
        pub inner_stiffness: f64,
        /// K_out of a healthy contact, N/m^n.
        pub outer_stiffness: f64,
        /// Of each contact.
        pub damping: ContactDamping,
        /// delta_s, um: over which damping by `tau` sets in.
        pub roughness_um: f64,
        /// Length of the running mean that rounds damage's edges, um; `half-space` only.
        pub edge_radius_um: f64,
        /// How exact the tables of damage are; `half-space` only.
        pub tables: Tables,
    }
}

/// What damps a contact of element and raceway.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactDamping {
    /// tau: the stiffness at hand, tau times the rate of approach.
    Time {
        /// tau, us.
        us: f64,
    },
    /// c, whatever the load (the paper).
    Constant {
        /// c, N s/m.
        ns_per_m: f64,
    },
}

impl Contact {
    /// E' = E/(1 - nu^2) of elements and rings, Pa, where the scenario has both.
    pub(crate) fn modulus(&self) -> Option<f64> {
        let ratio = self.poisson_ratio?;
        Some(1e9 * self.youngs_modulus_gpa? / (1.0 - ratio * ratio))
    }
}

impl ContactDamping {
    /// c, where it is a constant.
    pub fn constant_ns_per_m(self) -> Option<f64> {
        match self {
            Self::Constant { ns_per_m } => Some(ns_per_m),
            Self::Time { .. } => None,
        }
    }

    /// tau, where it is a time.
    pub fn time_us(self) -> Option<f64> {
        match self {
            Self::Time { us } => Some(us),
            Self::Constant { .. } => None,
        }
    }
}

/// Waves of a surface of revolution: w(u) = sum of A_k cos(k u + phase_k) with A_k = A_1 k^-q.
#[derive(Debug, Clone, PartialEq)]
pub struct Waviness {
    /// A_1, um.
    pub amplitude_um: f64,
    /// q.
    pub exponent: f64,
    /// Waves per turn, the fewest and the most.
    pub waves: [usize; 2],
}

sections! {
    /// `[friction]`: rollers on raceways.
    pub struct Friction {
        /// mu.
        pub raceway_coefficient: f64,
        /// v_s, m/s.
        pub slip_velocity_m_per_s: f64,
        /// k_r, of the couple that resists rolling.
        pub rolling_coefficient: f64,
    }
}

sections! {
    /// `[lubricant]`.
    pub struct Lubricant {
        /// eta, Pa s, of the cage's guidance film and of the film on the raceways.
        pub viscosity_pa_s: f64,
        /// What open contacts of rollers and raceways carry.
        pub raceway_film: RacewayFilm,
        /// C_d of a roller.
        pub drag_coefficient: f64,
        /// rho_f of the oil-air mixture, kg/m^3.
        pub effective_density_kg_per_m3: f64,
    }
}

sections! {
    /// `[support]`: isotropic springs and dampers of the rings to ground.
    pub struct Support {
        /// k_i, N/m.
        pub inner_stiffness_n_per_m: f64,
        /// c_i, N s/m.
        pub inner_damping_ns_per_m: f64,
        /// k_o, N/m.
        pub outer_stiffness_n_per_m: f64,
        /// c_o, N s/m.
        pub outer_damping_ns_per_m: f64,
        /// k_ti; `tilting` only, like the next three.
        pub inner_tilt_stiffness_nm_per_rad: f64,
        /// c_ti.
        pub inner_tilt_damping_nms_per_rad: f64,
        /// k_to.
        pub outer_tilt_stiffness_nm_per_rad: f64,
        /// c_to.
        pub outer_tilt_damping_nms_per_rad: f64,
    }
}

sections! {
    /// `[housing]`: fixed to the outer ring.
    pub struct Housing {
        /// kg.
        pub mass_kg: f64,
    }
}

/// `speed_rpm`: a number, or points (t in s, r/min) joined by lines and held beyond both ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Speed {
    /// Constant, r/min.
    Constant(f64),
    /// Points (t_s, rpm), t strictly increasing.
    Profile(Vec<[f64; 2]>),
}

sections! {
    /// `[operation]`.
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
        /// Z_F, where along the axis the load acts; `tilting` only.
        pub load_offset_mm: f64,
    }
}

impl ModelKind {
    /// Whether every part moves.
    pub fn moves_every_part(self) -> bool {
        self != Self::Lumped
    }
}

/// Drop of roller and raceway together along the roller (ISO/TS 16281), the same at both contacts.
#[derive(Debug, Clone, PartialEq)]
pub enum RollerProfile {
    /// None.
    Straight,
    /// ISO/TS 16281's.
    Logarithmic,
    /// An arc: z^2 / (2 R_c).
    Crowned {
        /// R_c.
        crowned_radius_mm: f64,
    },
    /// Linear between points, constant beyond them.
    Table {
        /// z, rising.
        z_mm: Vec<f64>,
        /// p at each.
        drop_um: Vec<f64>,
    },
}

sections! {
    /// `[simulation]`.
    pub struct Simulation {
        /// Where keys left out took their defaults from.
        pub laws: Laws,
        /// Normals and levers of contacts.
        pub geometry: GeometryLaw,
        /// Of the phases of waviness.
        pub seed: u64,
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
        /// Steps that a run may take.
        pub most_steps: f64,
        /// Channel names to record, `*` matches any run of characters.
        pub record: Vec<String>,
    }
}

unset! {
    ContactDamping: Self::Constant { ns_per_m: f64::NAN };
    RollerProfile: Self::Straight;
    Speed: Self::Constant(f64::NAN);
}
