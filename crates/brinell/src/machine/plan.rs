//! What a machine is to be, and the machine that it makes.

use super::assembly::{Machine, Mount, Point};
use super::structure::{Seat, Structure};
use crate::model::{Model, Support};
use crate::steel::{DENSITY, POISSONS_RATIO, YOUNGS_MODULUS_GPA};
use brinell_shaft::{Beam, Disc, Material, Part, Port, Reduced, Spring, reduce};

/// The shaft: parts from Z = 0 on, and what is on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaft {
    /// Its material.
    pub material: Material,
    /// Cylinders, one after the other.
    pub parts: Vec<Part>,
    /// Discs, rotors, halves of couplings; inner rings are added.
    pub discs: Vec<Disc>,
    /// Springs to the ground, of couplings.
    pub couplings: Vec<Spring>,
    /// Full loads: Z, m, and N along X and Y.
    pub loads: Vec<(f64, [f64; 2])>,
    /// Unbalance: Z, m; kg m; where on the shaft, rad from X at t = 0.
    pub unbalances: Vec<(f64, f64, f64)>,
    /// Places of which the displacements along X and Y are channels: name and Z, m.
    pub looked_at: Vec<(String, f64)>,
    /// Accelerometers: name; Z, m; direction, rad from X.
    pub sensors: Vec<(String, f64, f64)>,
    /// Modes up to here are kept, Hz.
    pub band: f64,
    /// Damping ratio of each mode.
    pub damping_ratio: f64,
    /// Whether it does not bend.
    pub is_rigid: bool,
}

impl Shaft {
    /// Of steel and of these parts, with modes up to 2 kHz of the damping ratio 0.005.
    pub fn of_steel(parts: Vec<Part>) -> Self {
        Self {
            material: Material {
                youngs_modulus: 1e9 * YOUNGS_MODULUS_GPA,
                shear_modulus: 0.5e9 * YOUNGS_MODULUS_GPA / (1.0 + POISSONS_RATIO),
                density: 1e9 * DENSITY,
            },
            parts,
            discs: Vec::new(),
            couplings: Vec::new(),
            loads: Vec::new(),
            unbalances: Vec::new(),
            looked_at: Vec::new(),
            sensors: Vec::new(),
            band: 2000.0,
            damping_ratio: 0.005,
            is_rigid: false,
        }
    }

    /// m.
    fn length(&self) -> f64 {
        self.parts.iter().map(|part| part.length).sum()
    }
}

/// A bearing on the shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct OnShaft {
    /// The bearing; its outer ring's mass moves with the housing, if it sits in one, which holds it then instead of its own support. What supports
    /// its inner ring supports the shaft there.
    pub model: Model,
    /// Z of its middle, m.
    pub at: f64,
    /// In which housing its outer ring sits, from 0; else that is on its own support.
    pub housing: Option<usize>,
    /// By how much its seat there is off the line through all of them, m.
    pub offset: [f64; 2],
    /// By how much it is tilted, rad: slopes of its axis in (X, Z) and (Y, Z).
    pub misalignment: [f64; 2],
    /// Spring and damper of the outer ring in the housing; without one it sits there rigidly. Of bearings that do not tilt.
    pub fit: Option<Support>,
}

impl OnShaft {
    /// In line with the others.
    pub fn new(model: Model, at: f64, housing: Option<usize>) -> Self {
        Self { model, at, housing, offset: [0.0; 2], misalignment: [0.0; 2], fit: None }
    }
}

/// A rigid housing, held at the centre of mass of it and of the outer rings in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Housing {
    /// Z of its own centre of mass, m.
    pub at: f64,
    /// kg.
    pub mass: f64,
    /// About X and Y through its centre of mass, kg m^2.
    pub inertia: f64,
    /// Against shifts, N/m and N s/m.
    pub support: Support,
    /// Against tilts, N m/rad and N m s/rad.
    pub tilt_support: Support,
    /// Accelerometers: name; Z, m; direction, rad from X.
    pub sensors: Vec<(String, f64, f64)>,
}

/// A machine that is to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The shaft.
    pub shaft: Shaft,
    /// At least one; all turn with the speed of the first, under its gravity.
    pub bearings: Vec<OnShaft>,
    /// The housings.
    pub housings: Vec<Housing>,
}

/// Why a plan makes no machine.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// Nothing holds the shaft.
    #[error("a shaft without bearings")]
    NoBearing,
    /// It could turn about the one bearing like a pendulum.
    #[error("a shaft on one bearing needs a coupling, or it turns about it")]
    OneBearing,
    /// Something is not on it.
    #[error("something sits at Z = {at} m, beyond the shaft, which reaches from 0 to {length} m")]
    Beyond {
        /// Where.
        at: f64,
        /// The shaft's length.
        length: f64,
    },
    /// A part, a mass or an inertia is not positive.
    #[error("{what} = {value}: must be above 0")]
    NotPositive {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A housing that is not there.
    #[error("bearing {bearing} sits in housing {housing}, of which there are {count}")]
    NoHousing {
        /// From 1.
        bearing: usize,
        /// From 1.
        housing: usize,
        /// How many there are.
        count: usize,
    },
}

/// Elements of the beam over the shaft's length, at least.
const ELEMENTS: f64 = 20.0;

impl Plan {
    /// The machine.
    ///
    /// # Errors
    /// Where something is not on the shaft, not positive, or not held.
    pub fn machine(self) -> Result<Machine, PlanError> {
        self.check()?;
        let Self { shaft, bearings, housings } = self;
        let (beam, reduced) = bend(&shaft, &bearings)?;
        let seat = |z: f64| {
            let port = |port: Option<Port>| reduced.port(&port.expect("everything has a node"));
            Structure::seat_of_shaft(&port(beam.port(z)), &port(beam.tilt_port(z)))
        };
        let mut of_shaft = Structure::shaft(&beam, &reduced);
        shaft.loads.iter().for_each(|(z, force)| of_shaft.add_load(&seat(*z), *force));
        shaft.unbalances.iter().for_each(|(z, size, angle)| of_shaft.add_unbalance(&seat(*z), *size, *angle));
        let mut points = Vec::new();
        for (name, z) in &shaft.looked_at {
            let [x, y] = seat(*z).shift;
            for (axis, row) in [("x", x), ("y", y)] {
                points.push(Point { name: format!("shaft.{axis}{name}"), is_sensor: false, structure: 0, row });
            }
        }
        for (name, z, direction) in &shaft.sensors {
            let row = seat(*z).along(*direction);
            points.push(Point { name: format!("shaft.{name}"), is_sensor: true, structure: 0, row });
        }
        let mut structures = vec![of_shaft];
        let mut bodies = Vec::new();
        for (k, housing) in housings.iter().enumerate() {
            let within = |bearing: &&OnShaft| bearing.housing == Some(k) && bearing.fit.is_none();
            let body = Rigid::new(housing, bearings.iter().filter(within));
            structures.push(Structure::rigid((body.mass, body.inertia), (housing.support, housing.tilt_support)));
            for (name, z, direction) in &housing.sensors {
                let row = body.seat(*z).along(*direction);
                points.push(Point { name: format!("housing{}.{name}", k + 1), is_sensor: true, structure: k + 1, row });
            }
            bodies.push(body);
        }
        let mut fits = Vec::new();
        let mut place = |(number, mut bearing): (usize, OnShaft)| {
            let inner = Mount { structure: 0, seat: seat(bearing.at), shift: [0.0; 2], tilt: [0.0; 2] };
            let outer = bearing.housing.map(|k| Mount {
                structure: k + 1,
                seat: bodies[k].seat(bearing.at),
                shift: bearing.offset,
                tilt: bearing.misalignment,
            });
            match (bearing.fit, outer) {
                (Some(fit), Some(outer)) => {
                    bearing.model.outer_support = fit;
                    fits.push((number, outer));
                    (bearing.model, [Some(inner), None])
                }
                (None, Some(outer)) => {
                    bearing.model.outer_support = Support { stiffness: 0.0, damping: 0.0 };
                    (bearing.model, [Some(inner), Some(outer)])
                }
                (_, None) => (bearing.model, [Some(inner), None]),
            }
        };
        let bearings = bearings.into_iter().enumerate().map(&mut place).collect();
        let machine = Machine::new(bearings, structures, points);
        Ok(fits.into_iter().fold(machine, |machine, (number, mount)| machine.with_fit(number, mount)))
    }

    fn check(&self) -> Result<(), PlanError> {
        let Self { shaft, bearings, housings } = self;
        let parts = shaft.parts.iter().flat_map(|part| {
            [("a part's length, m", part.length), ("a part's wall, m", part.outer_diameter - part.inner_diameter)]
        });
        let of_housings = housings
            .iter()
            .flat_map(|of| [("a housing's mass, kg", of.mass), ("a housing's moment of inertia, kg m^2", of.inertia)]);
        if let Some((what, value)) = parts.chain(of_housings).find(|(_, value)| value.is_nan() || *value <= 0.0) {
            return Err(PlanError::NotPositive { what, value });
        }
        if bearings.is_empty() {
            return Err(PlanError::NoBearing);
        }
        if bearings.len() == 1 && shaft.couplings.is_empty() {
            return Err(PlanError::OneBearing);
        }
        let count = housings.len();
        let lost =
            bearings.iter().enumerate().find_map(|(k, bearing)| Some((k, bearing.housing.filter(|of| *of >= count)?)));
        if let Some((k, housing)) = lost {
            return Err(PlanError::NoHousing { bearing: k + 1, housing: housing + 1, count });
        }
        let length = shaft.length();
        match places(shaft, bearings).into_iter().find(|at| !(0.0..=length).contains(at)) {
            Some(at) => Err(PlanError::Beyond { at, length }),
            None => Ok(()),
        }
    }
}

/// Z of everything on the shaft.
fn places(shaft: &Shaft, bearings: &[OnShaft]) -> Vec<f64> {
    let discs = shaft.discs.iter().map(|disc| disc.at).chain(shaft.couplings.iter().map(|spring| spring.at));
    let pulls = shaft.loads.iter().map(|of| of.0).chain(shaft.unbalances.iter().map(|of| of.0));
    let others = shaft.looked_at.iter().map(|of| of.1).chain(bearings.iter().map(|bearing| bearing.at));
    let others = others.chain(shaft.sensors.iter().map(|of| of.1));
    discs.chain(pulls).chain(others).collect()
}

/// The shaft as a beam with the inner rings on it, and in its modes: with residual vectors wherever a force acts.
fn bend(shaft: &Shaft, bearings: &[OnShaft]) -> Result<(Beam, Reduced), PlanError> {
    let length = shaft.length();
    let mut discs = shaft.discs.clone();
    for OnShaft { model, at, .. } in bearings {
        let turning = model.tilt.as_ref().map_or((0.0, 0.0), |tilt| (tilt.inner.inertia, tilt.inner.polar_inertia));
        discs.push(Disc {
            at: *at,
            mass: model.inertia.inner_ring,
            diametral_inertia: turning.0,
            polar_inertia: turning.1,
        });
    }
    let all = places(shaft, bearings);
    let beam = Beam::new(&shaft.material, &shaft.parts, (&discs, &shaft.couplings), &all, length / ELEMENTS)
        .ok_or(PlanError::Beyond { at: f64::NAN, length })?;
    let seats = bearings.iter().map(|bearing| bearing.at);
    let pulled = seats.chain(shaft.loads.iter().map(|of| of.0)).chain(shaft.unbalances.iter().map(|of| of.0));
    let mut ports: Vec<Port> = pulled.filter_map(|z| beam.port(z)).collect();
    if bearings.iter().any(|bearing| bearing.model.tilt.is_some()) {
        ports.extend(bearings.iter().filter_map(|bearing| beam.tilt_port(bearing.at)));
    }
    let reduced = reduce(&beam, shaft.band, &ports, shaft.damping_ratio, shaft.is_rigid)
        .ok_or(PlanError::NotPositive { what: "the shaft's density, kg/m^3", value: shaft.material.density })?;
    Ok((beam, reduced))
}

/// A housing with the outer rings in it.
struct Rigid {
    centre: f64,
    mass: f64,
    inertia: f64,
}

impl Rigid {
    fn new<'a>(housing: &Housing, bearings: impl Iterator<Item = &'a OnShaft>) -> Self {
        // Mass, place, and inertia about its own centre.
        let ring = |bearing: &OnShaft| {
            let own = bearing.model.tilt.as_ref().map_or(0.0, |tilt| tilt.outer.inertia);
            (bearing.model.inertia.outer_ring, bearing.at, own)
        };
        let bodies: Vec<_> =
            std::iter::once((housing.mass, housing.at, housing.inertia)).chain(bearings.map(ring)).collect();
        let mass: f64 = bodies.iter().map(|(m, ..)| m).sum();
        let centre = bodies.iter().map(|(m, z, _)| m * z).sum::<f64>() / mass;
        let inertia = bodies.iter().map(|(m, z, own)| own + m * (z - centre).powi(2)).sum();
        Self { centre, mass, inertia }
    }

    fn seat(&self, z: f64) -> Seat {
        Structure::seat_of_rigid((self.mass, self.inertia), z - self.centre)
    }
}
