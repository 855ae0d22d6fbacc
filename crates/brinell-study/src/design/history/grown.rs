//! The damage of a snapshot: the class's, in the size of that time.

use super::outline::Star;
use super::{Edge, History, Snapshot};
use brinell::defect::{Extent, Shape};
use brinell::derived::Passing;
use brinell::document::Problem;
use brinell::model::Model;
use brinell::scenario::{self, Defect, Scenario, Speed, Surface};
use brinell::signal::rounded;
use brinell_damage::plan::{CORNERS, polygons_mm};
use std::f64::consts::{PI, TAU};

/// Turns of the shaft in a snapshot at least.
const LEAST_TURNS: f64 = 8.0;

/// The one defect of a machine that fails, from a scenario with all of its damage.
pub(in crate::design) fn only_defect(scenario: &Scenario) -> Result<Option<&Defect>, Vec<Problem>> {
    let wrong = |message: String, allowed: &str| Err(vec![Problem::error("defects", message).allowed(allowed)]);
    match &scenario.defects[..] {
        [] => Ok(None),
        [one] if one.shape.file().is_some() => wrong(
            "a history grows a shape that is at hand, and this one is in a file".into(),
            "rectangle, circle, profile, random, grown or outline; `brinell defect` makes an outline of a photo, a drawing or a scan",
        ),
        [one] if matches!(one.shape, scenario::Shape::Profile { depth_um: Some(_), .. }) => wrong(
            "damage grows as an outline of one depth, and the depths of this profile over its arc would be lost".into(),
            "a profile without `depth_um`: its widths keep their course, and the defect's depth_um is the depth; or rectangle, circle, random, grown, outline",
        ),
        [one] if one.table.is_some() => {
            wrong("a table holds for one size, and a history has many".into(), "a defect without `table`")
        }
        [one] => Ok(Some(one)),
        all => wrong(
            format!("a history grows one defect, and there are {}", all.len()),
            "one defect, or none for machines that stay healthy",
        ),
    }
}

/// The bearing whose damage it is, healthy and by itself.
fn healthy(scenario: &Scenario) -> Scenario {
    let lead = scenario.machine.as_ref().map_or(0, |machine| machine.lead);
    Scenario { defects: Vec::new(), ..scenario.bearing_of_machine(lead) }
}

/// End of the start, s, and how often the shaft turns from there on.
fn turned_after_the_start(scenario: &Scenario, model: &Model) -> [f64; 2] {
    let start = scenario.settled_s();
    let angle = |t: f64| model.rotation.at(t).1;
    [start, (angle(scenario.simulation.duration_s) - angle(start)).abs() / TAU]
}

/// What the shaft does in a snapshot.
pub(in crate::design) struct Turning {
    model: Model,
}

impl Turning {
    /// `slowest` is the least speed that the plan's snapshots draw, r/min, where they draw one.
    pub(in crate::design) fn of(scenario: &Scenario, slowest: Option<f64>) -> Result<Self, Vec<Problem>> {
        let model =
            Model::new(&healthy(scenario)).map_err(|error| vec![Problem::error("bearing", error.to_string())])?;
        let duration = scenario.simulation.duration_s;
        let slowest = slowest.or(scenario.operation.speed_rpm.constant().map(f64::abs));
        let (turns, needed, at) = match slowest {
            Some(rpm) => {
                let mut slow = scenario.clone();
                slow.operation.speed_rpm = Speed::Constant(rpm);
                // The end of the start, as of a run that is long enough.
                slow.simulation.duration_s = f64::INFINITY;
                let start = slow.settled_s();
                let needed = start + 60.0 * LEAST_TURNS / rpm;
                ((duration - start).max(0.0) * rpm / 60.0, needed, format!(" at the slowest speed, {rpm} r/min"))
            }
            None => {
                let [start, turns] = turned_after_the_start(scenario, &model);
                (turns, start + (duration - start) * LEAST_TURNS / turns, String::new())
            }
        };
        // What is 8 turns by its decimals is 8 turns.
        if turns >= LEAST_TURNS * (1.0 - 1e-9) {
            return Ok(Self { model });
        }
        let message =
            format!("a snapshot of {} turns of the shaft from the end of its start on{at}", rounded(turns, 3));
        let allowed = match needed.is_finite() {
            // Three digits, upwards.
            true => {
                let needed = (1e3 * needed).ceil() / 1e3;
                format!(">= {needed} s: {LEAST_TURNS} turns after the start; or a higher speed")
            }
            false => format!("a shaft that turns: {LEAST_TURNS} turns a snapshot"),
        };
        Err(vec![Problem::error("simulation.duration_s", message).value(duration.to_string()).allowed(allowed)])
    }

    /// Whether rolling elements pass damage from its first s to its last.
    fn is_towards_plus(&self, on: Surface) -> Option<bool> {
        match Passing::of(&self.model, on) {
            Passing::TowardsPlus => Some(true),
            Passing::TowardsMinus => Some(false),
            Passing::Never | Passing::Both { .. } => None,
        }
    }
}

impl Snapshot {
    /// What a snapshot's damage sets, below the key of its list of defects: `all` is the damage at failure.
    pub(in crate::design) fn grown(
        &self,
        history: &History,
        (scenario, all): (&Scenario, &Defect),
        turning: &Turning,
    ) -> Result<Vec<(&'static str, String)>, Vec<Problem>> {
        let around = PI * scenario.bearing.diameter_mm(all.on);
        if self.fails_mm >= around {
            let message = format!("damage of this length goes once around the {}", all.on.word().replace('-', " "));
            let problem = Problem::error("history.fails_mm", message).value(self.fails_mm.to_string());
            return Err(vec![problem.allowed(format!("< {} mm", rounded(around, 4)))]);
        }
        let shape = Shape::new(&all.shape, 1e-6 * all.depth_um);
        let Some(shape) = shape else {
            return Err(vec![Problem::error("defects", "the shape makes no sense")]);
        };
        let towards_plus = match (turning.is_towards_plus(all.on), history.edge) {
            (Some(towards), _) => towards,
            (None, Edge::Both) => true,
            (None, _) => {
                let message = "the shaft turns both ways, so that damage has no trailing edge";
                return Err(vec![
                    Problem::error("operation.speed_rpm", message).allowed("one sense, or history.edge = \"both\""),
                ]);
            }
        };
        let Some(star) = Star::of(&polygons_mm(all, &shape, CORNERS), history.edge, towards_plus) else {
            return Err(vec![
                Problem::error("defects", "the damage at failure has no length or no depth")
                    .allowed("a shape with a length, and depth_um above 0"),
            ]);
        };
        let widest = history.widest_mm.unwrap_or(f64::INFINITY).min(scenario.bearing.axial_reach_mm());
        let outline = star.grown(self.length_mm, self.fails_mm, widest, -all.axial_offset_mm);
        let points: Vec<String> = outline.iter().map(|[s, z]| format!("[{s}, {z}]")).collect();
        let depth = match &all.shape {
            scenario::Shape::DepthMap { .. } => 1e6 * Extent::of(&shape, 1e-6 * all.depth_um).depth,
            _ => all.depth_um,
        };
        let depth = depth * (self.length_mm / self.fails_mm).powf(history.depth_exponent);
        Ok(vec![
            ("shape", format!("{{ outline = {{ polygons_mm = [[{}]] }} }}", points.join(", "))),
            ("depth_um", format!("{:?}", rounded(depth, 9))),
        ])
    }
}
