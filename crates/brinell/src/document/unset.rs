//! A scenario without values: where a walk over the keys starts from.

use super::value_type::ValueType;
use crate::scenario::*;

pub(crate) const NONE: f64 = f64::NAN;

pub(crate) fn scenario() -> Scenario {
    Scenario {
        name: String::new(),
        bearing: Bearing {
            preset: None,
            element: ValueType::blank(),
            inner_raceway_diameter_mm: NONE,
            outer_raceway_diameter_mm: NONE,
            pitch_diameter_mm: NONE,
            roller_diameter_mm: NONE,
            roller_length_mm: NONE,
            inner_groove_conformity: None,
            outer_groove_conformity: None,
            rollers_per_row: 0,
            rows: 0,
            row_stagger_deg: NONE,
            bore_diameter_mm: None,
            radial_clearance_um: NONE,
            outer_gap_um: NONE,
            inner_ring_mass_kg: NONE,
            outer_ring_mass_kg: NONE,
            roller_mass_kg: NONE,
            profile: ValueType::blank(),
            waviness: None,
            element_waviness: None,
            width_mm: NONE,
            row_spacing_mm: NONE,
        },
        cage: Cage {
            mass_kg: NONE,
            inner_diameter_mm: NONE,
            outer_diameter_mm: NONE,
            pocket_clearance_mm: NONE,
            guidance: ValueType::blank(),
            guidance_film: ValueType::blank(),
            guide_clearance_mm: NONE,
            guide_width_mm: NONE,
            walls: ValueType::blank(),
            pockets: ValueType::blank(),
            friction_coefficient: NONE,
            contact_stiffness_n_per_m: NONE,
            contact_damping_ns_per_m: NONE,
            land_stiffness_n_per_m: NONE,
            land_damping_ns_per_m: NONE,
        },
        contact: Contact {
            law: ValueType::blank(),
            roller_path: ValueType::blank(),
            slices: 0,
            exponent: NONE,
            youngs_modulus_gpa: None,
            poisson_ratio: None,
            inner_stiffness: NONE,
            outer_stiffness: NONE,
            damping: ContactDamping::Constant { ns_per_m: NONE },
            roughness_um: NONE,
            edge_radius_um: NONE,
            tables: ValueType::blank(),
        },
        friction: Friction { raceway_coefficient: NONE, slip_velocity_m_per_s: NONE, rolling_coefficient: NONE },
        lubricant: Lubricant {
            viscosity_pa_s: NONE,
            raceway_film: ValueType::blank(),
            drag_coefficient: NONE,
            effective_density_kg_per_m3: NONE,
        },
        support: Support {
            inner_stiffness_n_per_m: NONE,
            inner_damping_ns_per_m: NONE,
            outer_stiffness_n_per_m: NONE,
            outer_damping_ns_per_m: NONE,
            inner_tilt_stiffness_nm_per_rad: NONE,
            inner_tilt_damping_nms_per_rad: NONE,
            outer_tilt_stiffness_nm_per_rad: NONE,
            outer_tilt_damping_nms_per_rad: NONE,
        },
        housing: Housing { mass_kg: NONE },
        operation: Operation {
            speed_rpm: ValueType::blank(),
            load_n: [NONE; 2],
            load_on: ValueType::blank(),
            load_ramp_s: NONE,
            gravity_m_per_s2: [NONE; 2],
            load_offset_mm: NONE,
        },
        defects: Vec::new(),
        sensor: Sensor::off(),
        simulation: Simulation {
            laws: Laws::DEFAULT,
            geometry: ValueType::blank(),
            seed: 0,
            model: ValueType::blank(),
            duration_s: NONE,
            sample_rate_hz: NONE,
            start: ValueType::blank(),
            accuracy: ValueType::blank(),
            most_steps: NONE,
            record: Vec::new(),
        },
    }
}

pub(crate) fn defect() -> Defect {
    Defect {
        on: Surface::OuterRaceway,
        row: 0,
        center_deg: NONE,
        depth_um: NONE,
        axial_offset_mm: NONE,
        shape: rectangle(),
        table: None,
    }
}

pub(crate) fn path_mode() -> PathMode {
    PathMode { frequency_hz: NONE, damping_ratio: NONE, gain: NONE }
}

pub(crate) fn rectangle() -> Shape {
    Shape::Rectangle { length_mm: NONE, width_mm: NONE }
}

pub(crate) fn grid() -> DepthGrid {
    DepthGrid { s0_mm: NONE, z0_mm: NONE, ds_mm: NONE, dz_mm: NONE, columns: 0, rows: 0, depth_um: Vec::new() }
}
