//! What is around a bearing in a machine: the shaft, the other bearings, housings, sensors.

use super::choices::{Choice, choices};
use super::unset::sections;
use super::{ModelKind, Scenario, Simulation};

choices! {
    /// What an accelerometer of a machine sits on.
    pub enum SensorOn {
        Housing = "housing", "a housing";
        Shaft = "shaft", "the shaft";
    }
}

sections! {
    /// A shaft on several bearings. The scenario that holds this is one of them, and has the speed, the gravity, the ramp of the load and
    /// `[simulation]` of all; loads act on the shaft.
    pub struct Machine {
        /// The shaft.
        pub shaft: Shaft,
        /// Where each bearing is, in the file's order.
        pub seats: Vec<Seat>,
        /// Which of them the scenario itself is, from 0: the first that is damaged, or the first.
        pub lead: usize,
        /// The others, in order. Of `operation` and `simulation` they hold the same.
        pub others: Vec<Scenario>,
        /// Housings.
        pub housings: Vec<MachineHousing>,
        /// Accelerometers.
        pub sensors: Vec<Accelerometer>,
    }

    /// `[shaft]`: a shaft of cylindrical parts.
    pub struct Shaft {
        /// Z of its ends and of every place where the diameter changes or that is looked at, mm, rising.
        pub stations_mm: Vec<f64>,
        /// Between one station and the next, mm.
        pub diameters_mm: Vec<f64>,
        /// Bores, likewise; none: solid.
        pub bores_mm: Option<Vec<f64>>,
        /// E, GPa.
        pub youngs_modulus_gpa: f64,
        /// G, GPa.
        pub shear_modulus_gpa: f64,
        /// kg/m^3.
        pub density_kg_per_m3: f64,
        /// Whether it does not bend.
        pub rigid: bool,
        /// Modes up to here are kept, Hz.
        pub band_hz: f64,
        /// Of each mode that bends.
        pub damping_ratio: f64,
        /// Discs, rotors, halves of couplings.
        pub disc: Vec<Disc>,
        /// What pulls round with the shaft.
        pub unbalance: Vec<Unbalance>,
        /// Forces.
        pub load: Vec<ShaftLoad>,
        /// Springs to the ground.
        pub coupling: Vec<Coupling>,
    }

    /// `[[shaft.disc]]`: a rigid body on the shaft.
    pub struct Disc {
        /// Z, mm.
        pub at_mm: f64,
        /// Of a disc of the shaft's material that is not given by mass.
        pub diameter_mm: Option<f64>,
        /// Along the axis, likewise.
        pub width_mm: Option<f64>,
        /// Its bore, likewise.
        pub bore_mm: Option<f64>,
        /// kg.
        pub mass_kg: f64,
        /// About the axis, kg m^2.
        pub polar_inertia_kg_m2: f64,
        /// About a diameter, kg m^2.
        pub diametral_inertia_kg_m2: f64,
    }

    /// `[[shaft.unbalance]]`.
    pub struct Unbalance {
        /// Z, mm.
        pub at_mm: f64,
        /// Mass times its distance from the axis, g mm.
        pub size_g_mm: f64,
        /// Where on the shaft: from X at t = 0, degrees.
        pub angle_deg: f64,
    }

    /// `[[shaft.load]]`.
    pub struct ShaftLoad {
        /// Z, mm.
        pub at_mm: f64,
        /// F, N.
        pub force_n: [f64; 2],
    }

    /// `[[shaft.coupling]]`.
    pub struct Coupling {
        /// Z, mm.
        pub at_mm: f64,
        /// N/m.
        pub radial_stiffness_n_per_m: f64,
        /// N m/rad.
        pub tilt_stiffness_nm_per_rad: f64,
    }

    /// Where a bearing is, among the keys of `[[bearing]]`.
    pub struct Seat {
        /// Z of its middle, mm.
        pub at_mm: f64,
        /// Number of the housing that its outer ring sits in, from 1; `None`: in the only one, or on its own support where there is none.
        pub housing: Option<usize>,
        /// By how much the seat of the outer ring is off the line of the shaft, um.
        pub offset_um: [f64; 2],
        /// By how much it is tilted: its axis' slopes in (X, Z) and (Y, Z), mrad.
        pub misalignment_mrad: [f64; 2],
        /// Spring of the outer ring in its housing; none: it fits without play.
        pub fit_stiffness_n_per_m: Option<f64>,
        /// Damper of the fit.
        pub fit_damping_ns_per_m: f64,
    }

    /// `[[housing]]`: a rigid body on springs, or modes.
    pub struct MachineHousing {
        /// Modes in place of a rigid body.
        pub modes: Option<HousingModes>,
        /// M in place of these: of x and y of each seat of the bearings in it, of each sensor on it along its direction, and of anything else.
        pub mass_matrix_kg: Option<Vec<Vec<f64>>>,
        /// K of the same.
        pub stiffness_matrix_n_per_m: Option<Vec<Vec<f64>>>,
        /// Of the modes of these matrices.
        pub damping_ratio: f64,
        /// Z of its centre of mass, mm.
        pub at_mm: f64,
        /// kg.
        pub mass_kg: f64,
        /// About X and Y, kg m^2.
        pub inertia_kg_m2: f64,
        /// N/m.
        pub stiffness_n_per_m: f64,
        /// N s/m.
        pub damping_ns_per_m: f64,
        /// N m/rad.
        pub tilt_stiffness_nm_per_rad: f64,
        /// N m s/rad.
        pub tilt_damping_nms_per_rad: f64,
    }

    /// `[[sensor]]`: an accelerometer behind the anti-alias filter.
    pub struct Accelerometer {
        /// The end of its channel's name.
        pub name: String,
        /// What it sits on.
        pub on: SensorOn,
        /// Number of its housing, from 1; `None`: the only one.
        pub housing: Option<usize>,
        /// Z, mm.
        pub at_mm: f64,
        /// Counter-clockwise from X.
        pub direction_deg: f64,
    }
}

/// Modes of a housing without the outer rings in it.
#[derive(Debug, Clone, PartialEq)]
pub enum HousingModes {
    /// Name of a CSV file with them.
    File(String),
    /// They themselves.
    Read(Vec<HousingMode>),
}

/// A mode of a housing, its shape of modal mass 1 kg: 1/sqrt(kg).
#[derive(Debug, Clone, PartialEq)]
pub struct HousingMode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// [x, y] at the seat of each bearing in the housing, in the file's order.
    pub seats: Vec<[f64; 2]>,
    /// At each sensor on the housing along its direction, in the file's order.
    pub sensors: Vec<f64>,
}

impl MachineHousing {
    /// Whether it is a rigid body.
    pub fn is_rigid(&self) -> bool {
        self.modes.is_none() && self.mass_matrix_kg.is_none() && self.stiffness_matrix_n_per_m.is_none()
    }
}

impl HousingMode {
    /// Those of a CSV text: a line with `frequency_hz,damping_ratio`, `bearing1_x,bearing1_y` of each bearing in the housing, by its number among
    /// all, and the names of the sensors on it; then a line a mode.
    ///
    /// # Errors
    /// In words, with the line.
    pub fn from_csv_text(text: &str, bearings: &[usize], sensors: &[String]) -> Result<Vec<Self>, String> {
        let seats = bearings.iter().flat_map(|k| [format!("bearing{}_x", k + 1), format!("bearing{}_y", k + 1)]);
        let columns: Vec<String> = ["frequency_hz", "damping_ratio"]
            .map(String::from)
            .into_iter()
            .chain(seats)
            .chain(sensors.iter().cloned())
            .collect();
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
        let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let needed = columns.join(",");
        let (number, head) = lines.next().ok_or_else(|| format!("the file is empty; a line {needed} comes first"))?;
        let names: Vec<&str> = head.split(',').map(|name| name.trim().trim_matches('"')).collect();
        let place = |column: &String| {
            let found = names.iter().position(|name| name == column);
            found.ok_or_else(|| format!("line {number}: there is no column {column}; needed are {needed}"))
        };
        let places: Vec<usize> = columns.iter().map(place).collect::<Result<_, _>>()?;
        let mode = |(number, line): (usize, &str)| {
            let cells: Vec<&str> = line.split(',').map(str::trim).collect();
            let value = |(column, place): (&String, &usize)| {
                let cell = cells.get(*place).copied().unwrap_or_default();
                let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
                value.ok_or_else(|| format!("line {number}: {column} is \"{cell}\"; a finite number is needed"))
            };
            let values: Vec<f64> = columns.iter().zip(&places).map(value).collect::<Result<_, _>>()?;
            let (seats, sensors) = values[2..].split_at(2 * bearings.len());
            Ok(Self {
                frequency_hz: values[0],
                damping_ratio: values[1],
                seats: seats.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect(),
                sensors: sensors.to_vec(),
            })
        };
        let modes: Vec<Self> = lines.map(mode).collect::<Result<_, String>>()?;
        if modes.is_empty() { Err("there is no mode in it".into()) } else { Ok(modes) }
    }
}

impl Machine {
    /// The bearings whose outer rings sit in a housing, from 0.
    pub fn bearings_in(&self, housing: usize) -> Vec<usize> {
        (0..self.seats.len()).filter(|k| self.housing_of(self.seats[*k].housing) == Some(housing)).collect()
    }

    /// The sensors on a housing.
    pub fn sensors_on(&self, housing: usize) -> impl Iterator<Item = &Accelerometer> {
        let on = move |of: &&Accelerometer| of.on == SensorOn::Housing && self.housing_of(of.housing) == Some(housing);
        self.sensors.iter().filter(on)
    }

    /// How many bearings it has.
    pub fn bearings(&self) -> usize {
        self.seats.len()
    }

    /// The housing that a key names, from 0: the only one where it names none.
    pub fn housing_of(&self, named: Option<usize>) -> Option<usize> {
        named.map(|number| number.wrapping_sub(1)).or((self.housings.len() == 1).then_some(0))
    }

    /// The channel of an accelerometer.
    pub fn channel_of(&self, sensor: &Accelerometer) -> String {
        match (sensor.on, self.housing_of(sensor.housing)) {
            (SensorOn::Housing, Some(k)) => format!("housing{}.{}", k + 1, sensor.name),
            _ => format!("shaft.{}", sensor.name),
        }
    }

    /// The bearings on their own and with where they are, in the file's order; `scenario` is the one that holds this.
    pub fn each<'a>(&'a self, scenario: &'a Scenario) -> impl Iterator<Item = (&'a Seat, Scenario)> {
        self.seats.iter().enumerate().map(|(k, seat)| (seat, scenario.bearing_of_machine(k)))
    }
}

impl Scenario {
    /// The channel that findings of its run are of: the sensor's acceleration along the axis nearer the load; of a machine the accelerometer
    /// nearest to the bearing that is observed, or that bearing's outer ring.
    pub fn shown_channel(&self) -> String {
        let Some(machine) = &self.machine else {
            return ["sensor_ax", "sensor_ay"][self.operation.axis_of_load()].into();
        };
        let far = |of: &&Accelerometer| (of.at_mm - machine.seats[machine.lead].at_mm).abs();
        let nearest = machine.sensors.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map_or_else(|| format!("bearing{}.outer_ay", machine.lead + 1), |of| machine.channel_of(of))
    }

    /// The bearings of its machine, each alone, in the file's order; without a machine the scenario itself.
    pub fn bearings(&self) -> Vec<Self> {
        let count = self.machine.as_ref().map_or(1, |machine| machine.bearings());
        (0..count).map(|k| self.bearing_of_machine(k)).collect()
    }

    /// Names of the files that it names, of damage and of housings' modes.
    pub fn files(&self) -> Vec<&str> {
        let others = self.machine.iter().flat_map(|machine| &machine.others);
        let damage = self.defects.iter().chain(others.flat_map(|other| &other.defects));
        let housings = self.machine.iter().flat_map(|machine| &machine.housings);
        let modes = housings.filter_map(|housing| match &housing.modes {
            Some(HousingModes::File(file)) => Some(file.as_str()),
            _ => None,
        });
        damage.flat_map(|defect| [defect.shape.file(), defect.table_file()]).flatten().chain(modes).collect()
    }

    /// The same without damage of any bearing.
    #[must_use]
    pub fn without_damage(&self) -> Self {
        let mut healthy = self.clone();
        healthy.defects.clear();
        let others = healthy.machine.iter_mut().flat_map(|machine| &mut machine.others);
        others.for_each(|other| other.defects.clear());
        healthy
    }

    /// The same with what is observed of it at the bearing that a channel is of, or that its accelerometer is nearest to.
    #[must_use]
    pub fn seen_from(&self, channel: &str) -> Self {
        let Some(machine) = &self.machine else { return self.clone() };
        let sensor = machine.sensors.iter().find(|sensor| machine.channel_of(sensor) == channel);
        let of_bearing = channel.strip_prefix("bearing").and_then(|rest| rest.split('.').next()?.parse::<usize>().ok());
        let nearest = |at_mm: f64| {
            let far = |k: &usize| (machine.seats[*k].at_mm - at_mm).abs();
            (0..machine.bearings()).min_by(|a, b| far(a).total_cmp(&far(b)))
        };
        let lead = match (sensor, of_bearing) {
            (Some(sensor), _) => nearest(sensor.at_mm),
            (None, number) => number.and_then(|number| number.checked_sub(1)).filter(|k| *k < machine.bearings()),
        };
        let Some(lead) = lead else { return self.clone() };
        let mut bearings = self.bearings();
        let mut seen = bearings.remove(lead);
        seen.sensor = self.sensor.clone();
        seen.machine = Some(Box::new(Machine { lead, others: bearings, ..(**machine).clone() }));
        seen
    }

    /// Of a machine what all bearings have, as the file has it: where any tilts, that they tilt.
    pub(crate) fn of_all(&self) -> Simulation {
        let others = self.machine.iter().flat_map(|machine| &machine.others);
        let tilts = others.chain([self]).any(|bearing| bearing.simulation.model == ModelKind::Tilting);
        let model = if tilts { ModelKind::Tilting } else { self.simulation.model };
        Simulation { model, ..self.simulation.clone() }
    }

    /// Bearing `k` of its machine, from 0, as a scenario without the machine; without one the scenario itself.
    pub fn bearing_of_machine(&self, k: usize) -> Self {
        let Some(machine) = &self.machine else { return self.clone() };
        let mut alone = match k.cmp(&machine.lead) {
            std::cmp::Ordering::Less => machine.others[k].clone(),
            std::cmp::Ordering::Equal => Self { machine: None, ..self.clone() },
            std::cmp::Ordering::Greater => machine.others[k - 1].clone(),
        };
        alone.name.clone_from(&self.name);
        alone.operation = self.operation.clone();
        // Balls stay in the plane where rollers tilt.
        let model = alone.simulation.model;
        alone.simulation = Simulation { model, ..self.simulation.clone() };
        alone
    }
}
