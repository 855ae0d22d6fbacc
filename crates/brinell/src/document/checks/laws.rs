//! Which laws go together.

use super::Checker;
use crate::scenario::{DefectTable, GeometryLaw, Law, Laws, ModelKind, Pockets, RacewayFilm, RollerProfile};

const LAW: &str = "contact.law";
const LAWS: &str = "simulation.laws";
const MODEL: &str = "simulation.model";

impl Checker<'_> {
    pub(super) fn laws(&mut self) {
        let s = self.s;
        if s.simulation.model == ModelKind::Lumped {
            self.lumped();
        }
        self.together();
        let damping = ["contact.damping_time_us", "contact.damping_ns_per_m"];
        if damping.iter().all(|key| self.finder.is_given(key)) {
            self.error(
                damping[1],
                "a contact's damping is given twice, by a time and by a constant".into(),
                "one of contact.damping_time_us and contact.damping_ns_per_m".into(),
                &damping[..1],
            );
        }
        for (i, defect) in s.defects.iter().enumerate() {
            if defect.table.is_some() && s.contact.law != Law::HalfSpace {
                self.error(
                    &format!("defects.{i}.table"),
                    format!(
                        "a table says how a half-space yields, which law \"{}\" does not ask",
                        s.contact.law.word()
                    ),
                    "the key left out, or contact.law = \"half-space\"".into(),
                    &[LAW],
                );
            }
            if defect.table.is_some() && s.simulation.model == ModelKind::Tilting {
                self.error(
                    &format!("defects.{i}.table"),
                    "a file's table holds for rollers that do not tilt".into(),
                    "the key left out where simulation.model = \"tilting\"".into(),
                    &[MODEL],
                );
            }
            if let Some(DefectTable::Read(table)) = &defect.table
                && let Err(fault) = table.check()
            {
                self.error(&format!("defects.{i}.table"), fault.message, fault.allowed, &[]);
            }
        }
    }

    /// Laws that need each other.
    fn together(&mut self) {
        let s = self.s;
        if s.has_damage_that_pushes() && s.simulation.geometry == GeometryLaw::Centred {
            self.error(
                LAW,
                "damage on a half-space pushes along the surface, for which levers of the centred bearing have no reaction"
                    .into(),
                match (&s.bearing.profile, s.simulation.model) {
                    (RollerProfile::Straight, ModelKind::Full) if !s.bearing.has_balls() => {
                        "\"ecl\", or simulation.geometry = \"exact\"".into()
                    }
                    // Laws without a push have no ball, no profile and no tilt.
                    _ => "simulation.geometry = \"exact\"".into(),
                },
                &["simulation.geometry"],
            );
        }
        if s.simulation.geometry == GeometryLaw::Centred && s.simulation.model != ModelKind::Lumped {
            self.without_levers();
        }
        if s.lubricant.raceway_film == RacewayFilm::Squeeze && s.contact.damping.time_us().is_some() {
            self.error(
                "lubricant.raceway_film",
                "the film goes over into a contact's damper of its own".into(),
                "contact.damping_ns_per_m beside it, or no film".into(),
                &["contact.damping_time_us"],
            );
        }
    }

    /// What levers of the centred bearing leave out.
    fn without_levers(&mut self) {
        let s = self.s;
        let mut refuse = |acts: bool, key: &str, what: &str, without: &str| {
            if acts {
                let message = format!("{what}, for which levers of the centred bearing have no reaction");
                let allowed = format!("{without}, or simulation.geometry = \"exact\"");
                self.error(key, message, allowed, &["simulation.geometry"]);
            }
        };
        for key in s.waves() {
            refuse(true, key, "waves push along the surface", "the key left out");
        }
        let rolls = s.friction.rolling_coefficient > 0.0;
        refuse(rolls, "friction.rolling_coefficient", "a couple resists rolling at each contact", "0");
        let round = s.cage.pockets == Pockets::Round;
        refuse(round, "cage.pockets", "a round pocket holds its element in every direction", "\"slot\"");
    }

    /// What the lumped model does not have, as the paper has it.
    fn lumped(&mut self) {
        let s = self.s;
        if s.simulation.laws == Laws::Mechanics {
            self.error(
                LAWS,
                "the lumped model is the paper's reference model, whose contacts and cage are the paper's too".into(),
                "\"li2023\", or the key left out, where simulation.model = \"lumped\"".into(),
                &[MODEL],
            );
            return;
        }
        if s.contact.law == Law::HalfSpace {
            self.error(
                LAW,
                "the lumped model knows no half-space".into(),
                "\"ecl\" where simulation.model = \"lumped\"".into(),
                &[MODEL],
            );
        }
        for key in s.waves() {
            let allowed = "the key left out where simulation.model = \"lumped\"";
            self.error(key, "the lumped model's surfaces are smooth".into(), allowed.into(), &[MODEL]);
        }
        if s.contact.damping.time_us().is_some() {
            let allowed = "contact.damping_ns_per_m where simulation.model = \"lumped\"";
            self.error(
                "contact.damping_time_us",
                "the lumped model's contacts are damped by a constant".into(),
                allowed.into(),
                &[MODEL],
            );
        }
    }
}
