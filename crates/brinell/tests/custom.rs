//! Contact laws and forces of a user's own: the program's law written anew is the program's; audits close over both.

use crate::common::cases::{every_term, random_state};
use brinell::contact::{ContactLaw, Elastic, Place, SIDES, Side, check};
use brinell::model::{Model, Motion, imbalance};
use brinell::scenario::{DefectTable, ModelKind, RollerProfile, Scenario, TableData, TableValues};
use brinell::simulate::Simulation;
use brinell::{Bodies, Custom, Error, Force, Forces};
use std::sync::Arc;

/// E = K x^(n+1)/(n+1) of x = delta less waves on raceway and element.
#[derive(Debug)]
struct Power {
    stiffness: [f64; 2],
    n: f64,
    /// Height, m, and waves around each surface.
    waves: (f64, f64),
}

impl Power {
    fn of(s: &Scenario, waves: (f64, f64)) -> Arc<Self> {
        let stiffness = [s.contact.inner_stiffness, s.contact.outer_stiffness];
        Arc::new(Self { stiffness, n: s.contact.exponent, waves })
    }
}

impl ContactLaw for Power {
    fn at(&self, place: &Place, delta: f64) -> Elastic {
        let (height, count) = self.waves;
        let wave = |u: f64| [height * (count * u).sin(), height * count * (count * u).cos()];
        let (raceway, element) = (wave(place.on_raceway), wave(2.0 * place.on_element));
        let x = delta - raceway[0] - element[0];
        if x <= 0.0 {
            return Elastic::default();
        }
        let force = self.stiffness[place.side as usize] * x.powf(self.n);
        Elastic {
            energy: force * x / (self.n + 1.0),
            force,
            tangent: self.n * force / x,
            by_raceway: -force * raceway[1],
            by_element: -2.0 * force * element[1],
        }
    }
}

/// Draws everything to a point with a spring, and turns cages and elements.
#[derive(Debug)]
struct Everywhere;

impl Force for Everywhere {
    fn add(&self, t: f64, bodies: &Bodies<'_>, forces: &mut Forces<'_>) {
        let to = |x: [f64; 2]| [3e3 * (1e-3 - x[0]) + 20.0 * (900.0 * t).sin(), -4e3 * x[1]];
        for side in SIDES {
            forces.on_ring(side, to(bodies.ring(side).position));
        }
        for row in 0..bodies.rows() {
            let cage = bodies.cage(row);
            forces.on_cage(row, to(cage.position), -1e-5 * cage.speed);
            for element in 0..bodies.elements() {
                let body = bodies.element(row, element);
                forces.on_element(row, element, to(body.position).map(|f| 0.01 * f), -1e-7 * body.speed);
            }
        }
    }
}

const SOUND: &str =
    "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.06";

/// Healthy, by the program's default laws, short.
fn sound() -> Scenario {
    Scenario::from_toml(SOUND).unwrap()
}

#[test]
fn xval_the_programs_law_written_anew_moves_alike() {
    let s = sound();
    let own = Model::new(&s).unwrap();
    let custom = Custom { contact: Some(Power::of(&s, (0.0, 0.0))), forces: vec![] };
    let anew = Model::with_custom(&s, custom).unwrap();
    for seed in 0..20 {
        let y = random_state(&own, seed);
        let [a, b] = [&own, &anew].map(|model| {
            let mut dy = vec![0.0; y.len()];
            Motion::new(model).derivative(1e-3, &y, &mut dy);
            dy
        });
        let scale = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() <= 1e-11 * scale, "{a} {b}");
        }
    }
    for (side, force) in [(Side::Inner, 30.0), (Side::Outer, 500.0)] {
        assert!((anew.deflection(side, force) / own.deflection(side, force) - 1.0).abs() < 1e-9);
        assert!((anew.stiffness_at(side, force) / own.stiffness_at(side, force) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn prop_the_energy_audit_closes_over_a_law_that_changes_along_both_surfaces() {
    let s = sound();
    let custom = Custom { contact: Some(Power::of(&s, (0.4e-6, 9.0))), forces: vec![] };
    let waves = brinell::simulate_custom(&s, custom, &mut ()).unwrap();
    assert!(waves.outcome.energy.relative_residual().unwrap().abs() < 1e-3, "{:?}", waves.outcome.energy);
    assert!(waves.outcome.momentum_imbalance.unwrap() < 1e-9);
    let rms = |result: &brinell::RunResult| result.quantity("sensor_ax.rms").unwrap().value.unwrap();
    assert!(rms(&waves) > 1.2 * rms(&brinell::simulate(&s).unwrap()), "waves are felt");
}

#[test]
fn prop_audits_close_over_forces_on_every_body() {
    for kind in [ModelKind::Full, ModelKind::Tilting] {
        let mut s = sound();
        s.simulation.model = kind;
        s.simulation.duration_s = 0.03;
        let custom = Custom { forces: vec![Arc::new(Everywhere)], ..Custom::default() };
        let run = brinell::simulate_custom(&s, custom, &mut ()).unwrap();
        assert!(run.outcome.energy.relative_residual().unwrap().abs() < 1e-3, "{kind:?} {:?}", run.outcome.energy);
        assert!(run.outcome.momentum_imbalance.unwrap() < 1e-9, "{kind:?}");
    }
}

type Change = fn(&mut Elastic);

/// The law with something wrong.
#[derive(Debug)]
struct Wrong(Arc<Power>, Change);

impl ContactLaw for Wrong {
    fn at(&self, place: &Place, delta: f64) -> Elastic {
        let mut at = self.0.at(place, delta);
        (self.1)(&mut at);
        at
    }
}

#[test]
fn analytic_a_law_whose_derivatives_are_not_those_of_its_energy_is_refused() {
    let s = sound();
    let law = Power::of(&s, (0.4e-6, 9.0));
    check(&*law, (2, 19)).unwrap();
    let wrongs: [(&str, Change); 7] = [
        ("force", |e| e.force *= 1.1),
        ("force", |e| e.energy *= 1.5),
        ("tangent", |e| e.tangent *= 2.0),
        ("by_raceway", |e| e.by_raceway *= -1.0),
        ("by_raceway", |e| e.by_raceway = 0.0),
        ("by_element", |e| e.by_element *= 0.5),
        ("not finite", |e| e.force = f64::NAN),
    ];
    for (words, wrong) in wrongs {
        let custom = Custom { contact: Some(Arc::new(Wrong(law.clone(), wrong))), forces: vec![] };
        let error = Model::with_custom(&s, custom).unwrap_err();
        assert!(error.key == "contact law" && error.value.contains(words), "{words}: {error}");
    }
}

#[test]
fn analytic_forces_accelerate_the_body_they_act_on() {
    for (name, s) in every_term().into_iter().filter(|(_, s)| s.simulation.model != ModelKind::Lumped) {
        let (without, with) = (
            Model::with_custom(&s, Custom::default()).unwrap(),
            Model::with_custom(&s, Custom { forces: vec![Arc::new(Everywhere)], ..Custom::default() }).unwrap(),
        );
        let y = random_state(&without, 7);
        let t = 1e-3;
        let evaluate = |model: &Model| {
            let mut dy = vec![0.0; y.len()];
            let mut motion = Motion::new(model);
            motion.derivative(t, &y, &mut dy);
            let a = &dy[model.layout.dof()..];
            (a.to_vec(), imbalance(model, t, &y, a, &motion.ws))
        };
        let ((a, _), (b, left)) = (evaluate(&without), evaluate(&with));
        assert!(left.unwrap() < 1e-9, "{name} {left:?}");
        let at = without.layout.outer();
        let expected = (3e3 * (1e-3 - y[at]) + 20.0 * (900.0 * t).sin()) / s.bearing.outer_ring_mass_kg;
        assert!(((b[at] - a[at]) / expected - 1.0).abs() < 1e-9, "{name}");
    }
}

#[test]
fn xval_a_table_of_energies_is_that_of_effective_deformations() {
    let mut s = sound();
    s.defects = Scenario::from_toml(&format!(
        "{SOUND}\n[[defects]]\non = \"outer-raceway\"\ndepth_um = 20\nshape = {{ rectangle = {{ length_mm = 3, width_mm = 4 }} }}"
    ))
    .unwrap()
    .defects;
    let healthy = Model::new(&sound()).unwrap();
    let (s_mm, delta_um) = ([-2.0, -1.6, -1.0, 0.0, 1.0, 1.6, 2.0].to_vec(), [0.0, 1.0, 2.0, 4.0, 8.0].to_vec());
    let share = |s: f64| if s.abs() == 2.0 { 1.0 } else { 0.4 + 0.2 * s.abs() };
    let effective: Vec<f64> = s_mm.iter().flat_map(|s| delta_um.iter().map(|d| share(*s) * d)).collect();
    let energies = effective.iter().map(|um| healthy.healthy(Side::Outer).energy(1e-6 * um)).collect();
    let mut with = |values: TableValues| {
        let data = TableData { s_mm: s_mm.clone(), delta_um: delta_um.clone(), values };
        s.defects[0].table = Some(DefectTable::Read(data));
        Model::new(&s)
    };
    let wrong: Vec<f64> = effective.iter().map(|um| 1e3 * healthy.healthy(Side::Outer).energy(1e-6 * um)).collect();
    let [a, b] =
        [TableValues::DeltaEffUm(effective), TableValues::EnergyJ(energies)].map(|values| with(values).unwrap());
    for (s, delta) in [(-1.5e-3, 3e-6), (0.3e-3, 1e-6), (1.9e-3, 9e-6)] {
        let [a, b] = [&a, &b].map(|model| model.defects[0].table(Side::Outer).unwrap().at(delta, s).delta);
        assert!((a - b).abs() < 1e-12 * delta, "{a} {b}");
    }
    let error = with(TableValues::EnergyJ(wrong)).unwrap_err();
    assert_eq!(error.key, "defects.0.table");
}

#[test]
fn prop_what_the_equations_have_no_place_for_is_refused_by_name() {
    let law = |s: &Scenario| Custom { contact: Some(Power::of(s, (0.0, 0.0))), forces: vec![] };
    let refused = |s: &Scenario, custom: Custom| match Simulation::with_custom(s, custom) {
        Err(error @ Error::Model(_)) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let mut crowned = sound();
    crowned.bearing.profile = RollerProfile::Crowned { crowned_radius_mm: 900.0 };
    assert!(refused(&crowned, law(&crowned)).starts_with("bearing.profile = "));
    let mut tilting = sound();
    tilting.simulation.model = ModelKind::Tilting;
    assert!(refused(&tilting, law(&tilting)).starts_with("simulation.model = tilting"));
    let li2023 = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.05\nlaws = \"li2023\"";
    let centred = Scenario::from_toml(li2023).unwrap();
    assert!(refused(&centred, law(&centred)).starts_with("simulation.geometry = "));
    let lumped = Scenario::from_toml(&li2023.replace("laws = \"li2023\"", "model = \"lumped\"")).unwrap();
    let forces = Custom { forces: vec![Arc::new(Everywhere)], ..Custom::default() };
    assert!(refused(&lumped, forces).starts_with("simulation.model = "));
}
