//! What a machine is to be, and the machine that it makes.

use super::assembly::{Machine, Mount, Point};
use super::structure::{Row, Seat, Structure};
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
    /// Modes of an elastic housing without the outer rings in it; where there are any, only they and the sensors' names count.
    pub modes: Vec<HousingMode>,
}

/// A mode of a housing, its shape of modal mass 1 kg.
#[derive(Debug, Clone, PartialEq)]
pub struct HousingMode {
    /// Natural frequency without damping, rad/s.
    pub frequency: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// x and y at the seat of each bearing in it, in the plan's order.
    pub seats: Vec<[f64; 2]>,
    /// At each sensor, along its direction.
    pub sensors: Vec<f64>,
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
    /// Shapes of a housing's modes that do not fit it.
    #[error("modes of housing {housing}: each has {seats} seats and {sensors} sensors")]
    Modes {
        /// From 1.
        housing: usize,
        /// How many bearings sit in it.
        seats: usize,
        /// How many sensors are on it.
        sensors: usize,
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
        let mut seats_of: Vec<Box<dyn Fn(usize) -> Seat>> = Vec::new();
        for (k, housing) in housings.iter().enumerate() {
            if !housing.modes.is_empty() {
                let (structure, seats, sensors) = bent(k, housing, &bearings)?;
                structures.push(structure);
                for ((name, ..), row) in housing.sensors.iter().zip(sensors) {
                    points.push(Point {
                        name: format!("housing{}.{name}", k + 1),
                        is_sensor: true,
                        structure: k + 1,
                        row,
                    });
                }
                seats_of.push(Box::new(move |number| {
                    let found = seats.iter().find(|(of, _)| *of == number);
                    found.map(|(_, seat)| seat.clone()).expect("every bearing in it has a seat")
                }));
                continue;
            }
            let within = |bearing: &&OnShaft| bearing.housing == Some(k) && bearing.fit.is_none();
            let body = Rigid::new(housing, bearings.iter().filter(within));
            structures.push(Structure::rigid((body.mass, body.inertia), (housing.support, housing.tilt_support)));
            for (name, z, direction) in &housing.sensors {
                let row = body.seat(*z).along(*direction);
                points.push(Point { name: format!("housing{}.{name}", k + 1), is_sensor: true, structure: k + 1, row });
            }
            let places: Vec<f64> = bearings.iter().map(|bearing| bearing.at).collect();
            seats_of.push(Box::new(move |number| body.seat(places[number])));
        }
        let mut fits = Vec::new();
        let mut place = |(number, mut bearing): (usize, OnShaft)| {
            let inner = Mount { structure: 0, seat: seat(bearing.at), shift: [0.0; 2], tilt: [0.0; 2] };
            let outer = bearing.housing.map(|k| Mount {
                structure: k + 1,
                seat: seats_of[k](number),
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
            .filter(|of| of.modes.is_empty())
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

/// An elastic housing, with the seats of the bearings in it and its sensors.
type Bent = (Structure, Vec<(usize, Seat)>, Vec<Row>);

fn bent(k: usize, housing: &Housing, bearings: &[OnShaft]) -> Result<Bent, PlanError> {
    let within: Vec<usize> = (0..bearings.len()).filter(|number| bearings[*number].housing == Some(k)).collect();
    let modes = &housing.modes;
    let fits = |mode: &&HousingMode| mode.seats.len() == within.len() && mode.sensors.len() == housing.sensors.len();
    if modes.iter().filter(fits).count() < modes.len() {
        return Err(PlanError::Modes { housing: k + 1, seats: within.len(), sensors: housing.sensors.len() });
    }
    let squares: Vec<f64> = modes.iter().map(|mode| mode.frequency.powi(2)).collect();
    let dampers: Vec<f64> = modes.iter().map(|mode| 2.0 * mode.damping_ratio * mode.frequency).collect();
    let at =
        |place: usize| [0, 1].map(|axis: usize| modes.iter().map(|mode| mode.seats[place][axis]).collect::<Vec<f64>>());
    // A ring on a fit has its mass to itself.
    let rigid = within.iter().enumerate().filter(|(_, number)| bearings[**number].fit.is_none());
    let rings: Vec<_> = rigid.map(|(place, number)| (bearings[*number].model.inertia.outer_ring, at(place))).collect();
    let (structure, row) = Structure::elastic((&squares, &dampers), &rings)
        .ok_or(PlanError::NotPositive { what: "an outer ring's mass, kg", value: f64::NAN })?;
    let seat = |(place, number): (usize, &usize)| (*number, Structure::seat_of_elastic(at(place).map(|of| row(&of))));
    let seats = within.iter().enumerate().map(seat).collect();
    let sensors =
        (0..housing.sensors.len()).map(|k| row(&modes.iter().map(|mode| mode.sensors[k]).collect::<Vec<_>>()));
    Ok((structure, seats, sensors.collect()))
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
