//! Scenarios and states that several test programs start from.

use brinell::model::Model;
use brinell::scenario::{DefectTable, Guidance, GuidanceFilm, ModelKind, Scenario, TableData};
use brinell::start;

/// A scenario beside the tests, such as `reference/outer-rectangle` or `xval/roller-defect`.
pub fn case(path: &str) -> Scenario {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(path).with_extension("toml");
    let text = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let mut s = crate::common::read_li2023(&text, &[]).unwrap_or_else(|p| panic!("{path}: {p:?}")).scenario;
    with_tables(&mut s, file.parent().unwrap());
    s
}

/// Puts the tables that a scenario names into it, from its folder.
pub fn with_tables(s: &mut Scenario, folder: &std::path::Path) {
    for defect in &mut s.defects {
        if let Some(DefectTable::File(file)) = &defect.table {
            let table = std::fs::read_to_string(folder.join(file)).unwrap();
            defect.table = Some(DefectTable::Read(TableData::from_csv_text(&table).unwrap()));
        }
    }
}

/// The NN3007 of the given trajectories: rectangle 3 x 4 mm, 20 um deep, 300 N, 1800 r/min, C_r = 10 um, load ramp 20
/// ms.
pub fn rectangle() -> Scenario {
    case("reference/outer-rectangle")
}

/// The same without its damage.
pub fn healthy() -> Scenario {
    Scenario { defects: Vec::new(), ..rectangle() }
}

/// The scenarios that together meet every term of the model, by name.
pub fn every_term() -> Vec<(&'static str, Scenario)> {
    let mut lumped = rectangle();
    lumped.simulation.model = ModelKind::Lumped;
    let mut inner_guided = rectangle();
    inner_guided.cage.guidance = Guidance::InnerRing;
    inner_guided.cage.guidance_film = GuidanceFilm::Dynamic;
    inner_guided.cage.guide_clearance_mm = 0.2;
    let mut roller_guided = rectangle();
    roller_guided.cage.guidance = Guidance::Rollers;
    // So narrow that the cage falls onto its land.
    roller_guided.cage.guide_clearance_mm = 0.02;
    roller_guided.operation.gravity_m_per_s2 = [0.0, -9.81];
    vec![
        ("healthy", healthy()),
        ("rectangle", rectangle()),
        ("inner-profile", case("reference/inner-defect-gravity")),
        ("roller-defect", case("xval/roller-defect")),
        ("overlapping", case("xval/overlapping-defects")),
        ("film-dynamic", case("reference/film-dynamic")),
        ("raceway-film", raceway_film()),
        ("inner-guided", inner_guided),
        ("roller-guided", roller_guided),
        ("gravity-drag", case("xval/three-rows-drag-gap")),
        ("reference-model", lumped),
        ("rest", case("xval/rest-speed-profile")),
        ("heavy", case("xval/heavy-load-profile")),
        ("tilting", case("xval/tilting")),
        ("tilting-offset", tilting_offset()),
        ("balls", case("xval/balls")),
    ]
}

/// A catalogue bearing so slow that its profiled rollers fall through the clearance onto the film.
pub fn raceway_film() -> Scenario {
    let text = "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 300\nload_n = [0, -1000]\nload_on = \"inner-ring\"\n\
                gravity_m_per_s2 = [0, -9.81]\nload_ramp_s = 0\n[contact]\nlaw = \"half-space\"\n";
    crate::common::read_li2023(text, &[]).unwrap().scenario
}

/// A tilting bearing, its load off the middle, its cages on the inner ring.
pub fn tilting_offset() -> Scenario {
    case("tilting-offset")
}

/// A small generator of uniform numbers (xorshift64*), so that a failure names its seed and nothing else.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The start's state thrown about: rings 20 um and 0.1 m/s, rollers 10 um, pockets over their clearance, slips of 5 %,
/// cages up to 1.2 guide clearances off centre. Every kind of contact of the model is closed in some of them.
pub fn random_state(model: &Model, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let mut y = start::state(model).expect("a start that needs no balance");
    let l = &model.layout;
    let dof = l.dof();
    let pocket = model.pocket.clearance / model.geometry.pitch_radius;
    let travel = random.signed();
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed());
    let spin = model.rolling_spin_speed(model.rotation.max_speed());
    if model.kind.moves_every_part() {
        for slot in 0..l.rollers() {
            y[l.r() + slot] += 1e-5 * random.signed();
            y[l.theta() + slot] += travel + 1.2 * pocket * random.signed();
            y[l.phi() + slot] += 3.0 * random.signed();
            y[dof + l.r() + slot] += 0.05 * random.signed();
            y[dof + l.theta() + slot] += 0.05 * orbit * random.signed();
            y[dof + l.phi() + slot] += 0.05 * spin * random.signed();
            if l.tilts {
                y[l.beta() + slot] += 3e-3 * random.signed();
                y[dof + l.beta() + slot] += 20.0 * random.signed();
            }
        }
        for row in 0..l.rows {
            let at = l.cage(row);
            // Half of the cages run near the centre, half at the land.
            let reach = if random.signed() > 0.0 { 1.2 } else { 0.02 } * model.guide.clearance;
            let angle = 3.2 * random.signed();
            y[at] += reach * angle.cos();
            y[at + 1] += reach * angle.sin();
            y[at + 2] += travel + 0.3 * pocket * random.signed();
            y[dof + at] += 0.05 * random.signed();
            y[dof + at + 1] += 0.05 * random.signed();
            y[dof + at + 2] += 0.05 * orbit * random.signed();
        }
    }
    let fixed = model.outer_ring_is_fixed();
    for ring in [l.inner(), l.outer()] {
        if ring == l.outer() && fixed {
            continue;
        }
        for k in 0..2 {
            y[ring + k] += 2e-5 * random.signed();
            y[dof + ring + k] += 0.1 * random.signed();
        }
    }
    if l.tilts {
        for k in l.inner_tilt()..l.outer_tilt() + 2 {
            y[k] += 1e-3 * random.signed();
            y[dof + k] += 5.0 * random.signed();
        }
    }
    y
}
