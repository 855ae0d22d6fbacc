//! How long tables of damaged contacts take to build and to look up: `half_space SCENARIO STATIC_DEFORMATION_UM [THREADS]`.

use brinell::Scenario;
use brinell::defect::{Defect, SIDES};
use brinell::half_space::build::{Range, table};
use brinell::half_space::damage::{Damage, gather};
use brinell::half_space::geometry::Geometry;
use brinell::scenario::Tables;
use std::error::Error;
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(file), Some(deformation)) = (arguments.next(), arguments.next()) else {
        return Err("usage: half_space SCENARIO STATIC_DEFORMATION_UM [THREADS]".into());
    };
    let range = Range::of(1e-6 * deformation.parse::<f64>()?);
    let threads: NonZeroUsize = arguments.next().map_or(Ok(NonZeroUsize::MIN), |n| n.parse())?;
    let scenario = Scenario::from_toml(&std::fs::read_to_string(file)?)?;
    let bearing = &scenario.bearing;
    let defects = Defect::all(&scenario.defects, bearing, &scenario.contact).map_err(|k| format!("defect {k}"))?;
    for side in SIDES {
        let geometry = Geometry::of_bearing(bearing, &scenario.contact, side).ok_or("no contact")?;
        let reach = geometry.reach(range.largest);
        for group in gather(&defects, |_| reach) {
            let damage = Damage::of(&defects, &group, 10e-6);
            if !damage.members.iter().any(|k| defects[*k].meets_side(side)) {
                continue;
            }
            let start = Instant::now();
            let built = table(&geometry, &damage.raster, &range, Tables::Standard, threads, &AtomicBool::new(false))?;
            let seconds = start.elapsed().as_secs_f64();
            let (s, delta) = (built.table.range_s(), built.table.last_delta());
            const LOOKED_UP: u32 = 2_000_000;
            let start = Instant::now();
            let mut sum = 0.0;
            for k in 0..LOOKED_UP {
                let [a, b] = [0.618e-3, 0.414e-3].map(|step| (f64::from(k) * step).fract());
                sum += built.table.at(a * delta, s[0] + b * (s[1] - s[0])).by_delta;
            }
            let each = start.elapsed().as_secs_f64() / f64::from(LOOKED_UP);
            println!(
                "{:?} of row {}, {side:?} contact: {seconds:.2} s, {} solutions, {} x {} nodes; a look-up {:.0} ns (mean slope {:.3})",
                damage.surface,
                damage.row + 1,
                built.solutions,
                built.table.s_nodes().len(),
                built.table.delta_nodes().len(),
                1e9 * each,
                sum / f64::from(LOOKED_UP)
            );
        }
    }
    Ok(())
}
