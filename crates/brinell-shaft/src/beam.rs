//! Finite elements of a shaft.

use crate::equations::{Equations, Port};
use nalgebra::{DMatrix, DVector, Matrix4, SMatrix};
use std::f64::consts::PI;

/// Elastic constants and density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// E, Pa.
    pub youngs_modulus: f64,
    /// G, Pa; infinite in a beam that does not shear.
    pub shear_modulus: f64,
    /// kg/m^3.
    pub density: f64,
}

/// A cylindrical part of a shaft, solid or hollow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// m.
    pub length: f64,
    /// m.
    pub outer_diameter: f64,
    /// m; 0 is solid.
    pub inner_diameter: f64,
}

/// A rigid body on a node: a disc, a coupling's half, a bearing's inner ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Z, m.
    pub at: f64,
    /// kg.
    pub mass: f64,
    /// About a diameter through its centre, kg m^2.
    pub diametral_inertia: f64,
    /// About the axis, kg m^2.
    pub polar_inertia: f64,
}

impl Disc {
    /// A hollow cylinder.
    pub fn of_cylinder(at: f64, part: &Part, density: f64) -> Self {
        let [outer, inner] = [part.outer_diameter, part.inner_diameter].map(|d| 0.25 * d * d);
        let mass = density * PI * part.length * (outer - inner);
        Self {
            at,
            mass,
            diametral_inertia: mass * (3.0 * (outer + inner) + part.length.powi(2)) / 12.0,
            polar_inertia: 0.5 * mass * (outer + inner),
        }
    }
}

/// A spring between a node and the ground, the same in both planes: of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Z, m.
    pub at: f64,
    /// N/m.
    pub radial: f64,
    /// N m/rad.
    pub tilt: f64,
}

/// A shaft in finite elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Z of the nodes, m, ascending.
    pub nodes: Vec<f64>,
    /// Its equations: coordinate 2 k is the displacement of node k in a plane, 2 k + 1 its tilt.
    pub equations: Equations,
}

/// Two places that are one, m: a shorter element would only cost digits.
const SAME_PLACE: f64 = 1e-7;

impl Beam {
    /// The parts follow one another from Z = 0 on. Nodes are where parts end, where anything sits and at the places `further`, and between
    /// them so many that no element is longer than `longest`, m.
    ///
    /// `None` where something sits beyond the shaft's ends, a part has no length or no section, or elements are to have no length.
    pub fn new(
        material: &Material,
        parts: &[Part],
        (discs, springs): (&[Disc], &[Spring]),
        further: &[f64],
        longest: f64,
    ) -> Option<Self> {
        let mut ends = vec![0.0];
        parts.iter().for_each(|part| ends.push(ends[ends.len() - 1] + part.length));
        let length = *ends.last()?;
        let placed = discs.iter().map(|d| d.at).chain(springs.iter().map(|s| s.at)).chain(further.iter().copied());
        let mut places: Vec<f64> = ends.iter().copied().chain(placed).collect();
        let is_on = |z: &f64| (-SAME_PLACE..=length + SAME_PLACE).contains(z);
        let is_body = |part: &Part| part.length > 0.0 && (0.0..part.outer_diameter).contains(&part.inner_diameter);
        if parts.is_empty()
            || !parts.iter().all(is_body)
            || !places.iter().all(is_on)
            || longest.is_nan()
            || longest <= 0.0
        {
            return None;
        }
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| *a - *b <= SAME_PLACE);
        let mut nodes = vec![places[0]];
        for pair in places.windows(2) {
            let count = ((pair[1] - pair[0]) / longest).ceil().max(1.0) as usize;
            nodes.extend((1..=count).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64));
        }
        let mut beam = Self { equations: Equations::new(2 * nodes.len()), nodes };
        for k in 0..beam.nodes.len() - 1 {
            let (from, to) = (beam.nodes[k], beam.nodes[k + 1]);
            let middle = 0.5 * (from + to);
            let part = ends[1..].iter().position(|&end| middle < end)?;
            beam.add_element(k, &Element::new(material, &parts[part], to - from));
        }
        for disc in discs {
            let at = 2 * beam.node(disc.at)?;
            beam.equations.mass[(at, at)] += disc.mass;
            beam.equations.mass[(at + 1, at + 1)] += disc.diametral_inertia;
            beam.equations.gyroscopic[(at + 1, at + 1)] += disc.polar_inertia;
        }
        for spring in springs {
            let at = 2 * beam.node(spring.at)?;
            beam.equations.stiffness[(at, at)] += spring.radial;
            beam.equations.stiffness[(at + 1, at + 1)] += spring.tilt;
        }
        Some(beam)
    }

    /// The node at Z, m.
    pub fn node(&self, z: f64) -> Option<usize> {
        self.nodes.iter().position(|node| (node - z).abs() <= SAME_PLACE)
    }

    /// Displacement of the node at Z, m.
    pub fn port(&self, z: f64) -> Option<Port> {
        self.unit(2 * self.node(z)?)
    }

    /// Tilt of the node at Z, m.
    pub fn tilt_port(&self, z: f64) -> Option<Port> {
        self.unit(2 * self.node(z)? + 1)
    }

    fn unit(&self, k: usize) -> Option<Port> {
        let mut unit = DVector::zeros(self.equations.size());
        unit[k] = 1.0;
        Some(Port(unit))
    }

    /// M times a unit of displacement of all nodes: what its weight does, and its momentum.
    pub fn weight(&self) -> Port {
        Port(&self.equations.mass * self.moved(|_| 1.0, 0.0))
    }

    /// kg, of all that is on it too.
    pub fn mass(&self) -> f64 {
        self.moved(|_| 1.0, 0.0).dot(&self.weight().0)
    }

    /// Z of its centre of mass, m.
    pub fn centre(&self) -> f64 {
        self.moved(|z| z, 1.0).dot(&self.weight().0) / self.mass()
    }

    /// The two motions of the rigid shaft: along, and about its centre of mass.
    pub(crate) fn rigid(&self) -> [DVector<f64>; 2] {
        let centre = self.centre();
        [self.moved(|_| 1.0, 0.0), self.moved(|z| z - centre, 1.0)]
    }

    /// A displacement by place, with the same tilt everywhere.
    fn moved(&self, x: impl Fn(f64) -> f64, tilt: f64) -> DVector<f64> {
        DVector::from_fn(2 * self.nodes.len(), |k, _| if k % 2 == 0 { x(self.nodes[k / 2]) } else { tilt })
    }

    fn add_element(&mut self, node: usize, element: &Element) {
        let at = 2 * node;
        let add = |to: &mut DMatrix<f64>, what: &Matrix4<f64>| {
            let mut block = to.view_mut((at, at), (4, 4));
            block += what;
        };
        add(&mut self.equations.mass, &element.mass);
        add(&mut self.equations.stiffness, &element.stiffness);
        add(&mut self.equations.gyroscopic, &element.gyroscopic);
    }
}

/// Matrices of one Timoshenko element over (x_1, tau_1, x_2, tau_2), consistent: of the shapes that a load-free element takes.
struct Element {
    mass: Matrix4<f64>,
    stiffness: Matrix4<f64>,
    /// G at 1 rad/s.
    gyroscopic: Matrix4<f64>,
}

impl Element {
    /// Przemieniecki, Theory of Matrix Structural Analysis (1968); Nelson, A finite rotating shaft element using Timoshenko beam theory,
    /// J. Mech. Design 102 (1980) 793.
    fn new(material: &Material, part: &Part, l: f64) -> Self {
        let [outer, inner] = [part.outer_diameter, part.inner_diameter];
        let area = 0.25 * PI * (outer.powi(2) - inner.powi(2));
        let second_moment = PI / 64.0 * (outer.powi(4) - inner.powi(4));
        let bending = material.youngs_modulus * second_moment;
        let shear = shear_coefficient(material, outer, inner) * area * material.shear_modulus;
        let phi = 12.0 * bending / (shear * l * l);
        let stiffness = symmetric([12.0, 6.0 * l, -12.0, (4.0 + phi) * l * l, (2.0 - phi) * l * l], 6.0 * l)
            * (bending / ((1.0 + phi) * l.powi(3)));
        let one = (1.0 + phi).powi(2);
        let p2 = phi * phi;
        let moved = [
            13.0 / 35.0 + 0.7 * phi + p2 / 3.0,
            (11.0 / 210.0 + 11.0 / 120.0 * phi + p2 / 24.0) * l,
            9.0 / 70.0 + 0.3 * phi + p2 / 6.0,
            (1.0 / 105.0 + phi / 60.0 + p2 / 120.0) * l * l,
            -(1.0 / 140.0 + phi / 60.0 + p2 / 120.0) * l * l,
        ];
        let across = -(13.0 / 420.0 + 3.0 / 40.0 * phi + p2 / 24.0) * l;
        let turned = [
            1.2,
            (0.1 - 0.5 * phi) * l,
            -1.2,
            (2.0 / 15.0 + phi / 6.0 + p2 / 3.0) * l * l,
            (-1.0 / 30.0 - phi / 6.0 + p2 / 6.0) * l * l,
        ];
        let rotary = symmetric(turned, turned[1]) * (material.density * second_moment / (one * l));
        Self {
            mass: symmetric(moved, across) * (material.density * area * l / one) + rotary,
            stiffness,
            // The polar moment of a section is twice the diametral one.
            gyroscopic: 2.0 * rotary,
        }
    }
}

/// From the entries 11, 12, 13, 22, 24 and 14: an element is the same seen from its other end.
fn symmetric([a, b, c, d, e]: [f64; 5], f: f64) -> Matrix4<f64> {
    #[rustfmt::skip]
    let matrix = SMatrix::<f64, 4, 4>::new(
        a, b, c, f,
        b, d, -f, e,
        c, -f, a, -b,
        f, e, -b, d,
    );
    matrix
}

/// Share of the section that carries shear: Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335. Without
/// the limits of Poisson's ratio it would fall as 1/G, and no G would make a beam that does not shear.
fn shear_coefficient(material: &Material, outer: f64, inner: f64) -> f64 {
    let nu = (0.5 * material.youngs_modulus / material.shear_modulus - 1.0).clamp(0.0, 0.5);
    let square = (inner / outer).powi(2);
    let one = (1.0 + square).powi(2);
    6.0 * (1.0 + nu) * one / ((7.0 + 6.0 * nu) * one + (20.0 + 12.0 * nu) * square)
}
