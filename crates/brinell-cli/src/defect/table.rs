//! `brinell defect table`: the effective deformation over one defect, as a file that a defect can name.

use super::entry::chosen;
use crate::args::TableArgs;
use crate::failure::Failure;
use crate::files::Source;
use crate::say::{say, short};
use brinell::defect::{SIDES, Side};
use brinell::model::Model;
use brinell::plausibility::observed;
use brinell::scenario::{Law, ModelKind, Surface};
use brinell_io::atomic_write;

pub(super) fn table(args: &TableArgs) -> Result<(), Failure> {
    let source = Source::open(&args.scenario.scenario, &args.scenario.set)?;
    let loaded = source.load(&[], false)?;
    let s = &loaded.scenario;
    let of = chosen(s, args.defect)?;
    if s.contact.law != Law::HalfSpace {
        return Err(Failure::Usage(format!(
            "contact.law = \"{}\" has no table; \"half-space\" has",
            s.contact.law.word()
        )));
    }
    if s.simulation.model == ModelKind::Tilting {
        return Err(Failure::Usage(
            "simulation.model = \"tilting\": contacts that tilt take tables at several tilts, and a file holds one (a defect's `table` is refused \
             there); allowed: \"full\", as by --set simulation.model=full"
                .into(),
        ));
    }
    let side = match (of.on, args.inner) {
        (Surface::InnerRaceway, false) | (Surface::Roller(_), true) => Side::Inner,
        (Surface::OuterRaceway | Surface::Roller(_), false) => Side::Outer,
        (Surface::InnerRaceway | Surface::OuterRaceway, true) => {
            return Err(Failure::Usage(format!(
                "--inner: defect {} is on the {}, which has one contact; leave it out, as it is for damage on a rolling element, which has two",
                args.defect,
                of.on.word()
            )));
        }
    };
    source.inputs().spare(&args.output)?;
    let index = args.defect - 1;
    // In a machine for the load that it carries there.
    let model = Model::new(&observed(s)).map_err(|error| Failure::Usage(error.to_string()))?;
    let Some(table) = model.defects[index].table(side) else {
        let other = (0..index).find(|k| SIDES.iter().any(|side| model.defects[*k].table(*side).is_some()));
        return Err(Failure::Usage(format!(
            "defect {} is one surface with another near it, whose table has both: --defect {}",
            index + 1,
            other.map_or(1, |k| k + 1)
        )));
    };
    let healthy = model.healthy(side);
    let text = table.to_csv_text(|delta| healthy.force_and_tangent(delta)[0]);
    let nodes = text.lines().count() - 1;
    atomic_write(&args.output, text)?;
    let [first, last] = table.range_s();
    say!(
        "{}: {} x {} nodes, s from {} to {} mm, delta to {} um, at the {} contact",
        args.output.display(),
        table.s_nodes().len(),
        nodes / table.s_nodes().len(),
        short(1e3 * first, 4),
        short(1e3 * last, 4),
        short(1e6 * table.last_delta(), 4),
        side.word()
    );
    Ok(())
}
