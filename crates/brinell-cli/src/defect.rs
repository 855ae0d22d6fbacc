//! `brinell defect`: damage before it is simulated.

mod entry;
mod preview;
mod table;

use crate::args::{ConvertArgs, DefectCommand, FitArgs, RandomArgs, ScenarioArgs, SimpleShape, SimplifyArgs, Written};
use crate::failure::{ExitCode, Failure};
use crate::files::Source;
use crate::say::{self, say, short, twelve_digits};
use brinell::defect::Extent;
use brinell::defect::Shape;
use brinell::defect::fit::{Fit, FitSettings, Segment};
use brinell::defect::simplify::{Simple, simplify};
use brinell::document::Loaded;
use brinell::scenario::{self, Scenario, Surface};
use brinell::signal::objects;
use brinell_damage::plan::{self, Contour};
use entry::{chosen, print, print_entry};
use preview::preview;

/// Most points a shape is written with.
const MOST_POINTS: usize = 100_000;

pub(crate) fn defect(command: &DefectCommand) -> Result<ExitCode, Failure> {
    match command {
        DefectCommand::Preview(args) => preview(args)?,
        DefectCommand::Convert(args) => convert(args)?,
        DefectCommand::Simplify(args) => simple(args)?,
        DefectCommand::Fit(args) => fit(args)?,
        DefectCommand::Random(args) => random(args)?,
        DefectCommand::Table(args) => table::table(args)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Its shape in SI, as the simulation takes it.
fn shape(defect: &scenario::Defect) -> Result<Shape, Failure> {
    Shape::new(&defect.shape, 1e-6 * defect.depth_um).ok_or_else(|| Failure::Usage("the shape makes no sense".into()))
}

/// The scenario of a command that prints an entry.
fn to_print_of(args: &ScenarioArgs) -> Result<Loaded, Failure> {
    let source = Source::open(&args.scenario, &args.set)?;
    let loaded = source.load(&[], false)?;
    source.inputs().spare_standard_output()?;
    Ok(loaded)
}

fn checked_points(points: usize, least: usize) -> Result<usize, Failure> {
    if (least..=MOST_POINTS).contains(&points) {
        return Ok(points);
    }
    Err(Failure::Usage(format!("--points {points}: expected {least} to {MOST_POINTS}")))
}

fn convert(args: &ConvertArgs) -> Result<(), Failure> {
    let loaded = to_print_of(&args.scenario)?;
    let s = &loaded.scenario;
    let of = chosen(s, args.defect)?;
    let real = shape(of)?;
    let extent = Extent::of(&real, 1e-6 * of.depth_um);
    let points = checked_points(args.points, 8)?;
    if extent.area <= 0.0 && args.to == Written::Outline {
        return Err(Failure::Usage(format!(
            "defect {} damages nothing: its width is 0 all along; an outline needs an area",
            args.defect
        )));
    }
    let grid = plan::depth_grid(of).filter(|_| args.to == Written::Outline);
    if grid.is_none() && (args.level_um.is_some() || args.tolerance_mm.is_some()) {
        return Err(Failure::Usage(
            "--level-um and --tolerance-mm belong to the outline of a depth map or a random spall".into(),
        ));
    }
    let mut remarks = Vec::new();
    let (shape, depth_um) = match args.to {
        Written::Profile => {
            let course = plan::course(&real, points);
            let has_depths = real.own_depth(extent.middle).is_some();
            let depth = |mm: &f64| 1e6 * real.own_depth(1e-3 * mm).unwrap_or(0.0).max(0.0);
            let arc_mm: Vec<f64> = course.iter().map(|p| p.0).collect();
            let depth_um = has_depths.then(|| arc_mm.iter().map(depth).collect());
            let width_mm = course.iter().map(|p| p.1).collect();
            (scenario::Shape::Profile { arc_mm, width_mm, depth_um }, of.depth_um)
        }
        Written::Outline => match grid {
            Some(grid) => {
                let usual = Contour::of(&grid, &real).map_err(refused)?;
                let level_um = args.level_um.unwrap_or(usual.level_um);
                let tolerance_mm = args.tolerance_mm.unwrap_or(usual.tolerance_mm);
                let outline = brinell_damage::outline(&grid, level_um, tolerance_mm).map_err(refused)?;
                let volume = extent.area * extent.depth;
                let depth_um = 1e12 * volume / outline.area_mm2();
                remarks.push(format!(
                    "what is deeper than {} um, to {} mm; {} um deep, so that it holds as much volume",
                    short(level_um, 3),
                    short(tolerance_mm, 3),
                    short(depth_um, 4)
                ));
                let polygons_mm = outline.polygons_mm;
                (scenario::Shape::Outline { polygons_mm }, depth_um)
            }
            None => {
                (scenario::Shape::Outline { polygons_mm: plan::polygons_mm(of, &real, points) }, 1e6 * extent.depth)
            }
        },
    };
    let defect = scenario::Defect { shape, depth_um, ..of.clone() };
    let new = self::shape(&defect)?;
    let words = match real {
        Shape::DepthMap(_) => "the damaged nodes of the grid it was written from count",
        _ => "the shape it was written from has",
    };
    let [now, before] = [new.area(), real.area_in_ecl()].map(|area| short(1e6 * area, 5));
    remarks.push(format!("area {now} mm^2; {words} {before} mm^2"));
    print(s, defect, &remarks);
    Ok(())
}

/// An outline that cannot be drawn, with the options by their names.
fn refused(error: brinell_damage::DamageError) -> Failure {
    let text = error.to_string();
    Failure::Usage(text.replace("`level_um`", "--level-um").replace("`tolerance_mm`", "--tolerance-mm"))
}

fn simple(args: &SimplifyArgs) -> Result<(), Failure> {
    let loaded = to_print_of(&args.scenario)?;
    let s = &loaded.scenario;
    let of = chosen(s, args.defect)?;
    let (to, name) = match args.to {
        SimpleShape::BoundingRectangle => (Simple::BoundingRectangle, "bounding rectangle"),
        SimpleShape::EqualAreaRectangle => (Simple::EqualAreaRectangle, "rectangle of equal area"),
        SimpleShape::EqualAreaCircle => (Simple::EqualAreaCircle, "circle of equal area"),
    };
    let defect = simplify(of, &s.bearing, to).ok_or_else(|| Failure::Usage("the shape makes no sense".into()))?;
    let area = |d: &scenario::Defect| Ok::<_, Failure>(1e6 * shape(d)?.area());
    let remark = format!("{name}: {} mm^2 in place of {} mm^2", short(area(&defect)?, 5), short(area(of)?, 5));
    print(s, defect, &[remark]);
    Ok(())
}

fn fit(args: &FitArgs) -> Result<(), Failure> {
    let loaded = to_print_of(&args.scenario)?;
    let s = &loaded.scenario;
    let of = chosen(s, args.defect)?;
    let settings = FitSettings { segments: args.segments, order: args.order, samples: args.samples };
    let bounded = args.segments <= 10_000 && args.samples <= MOST_POINTS;
    let fit = bounded
        .then(|| Fit::new(&shape(of).ok()?, 1e-6 * of.depth_um, &settings))
        .flatten()
        .ok_or_else(|| {
            Failure::Usage(format!(
                "--segments {} --order {} --samples {}: expected 1 to 10000 segments, an order of at most 20, and more samples \
                 than the order, at most {MOST_POINTS}",
                args.segments, args.order, args.samples
            ))
        })?;
    let [width, depth] = errors_um(&fit).map(|errors| errors.map(|um| short(um, 3)));
    let error = format!(
        "fit error: width rms {} um, largest {} um; depth rms {} um, largest {} um",
        width[0], width[1], depth[0], depth[1]
    );
    let head = format!("{} segments, order {}, {} samples each", args.segments, args.order, args.samples);
    if args.toml {
        let defect = scenario::Defect { shape: fit.shape(32), ..of.clone() };
        print(s, defect, &[head, error]);
        return Ok(());
    }
    if args.json {
        say::json(&fit_json(&fit, args));
        return Ok(());
    }
    say!("{head}");
    say!("{error}");
    say!("L_s(x) in mm and h_s(x) in um, x = (2 s - from - to)/(to - from), coefficients of x^0, x^1, ...");
    let list = |values: &[f64], unit: f64| {
        let all = sound(values, unit);
        let all: Vec<String> = all.iter().map(|c| format!("{c:.6e}")).collect();
        all.join(" ")
    };
    for (k, g) in fit.segments.iter().enumerate() {
        say!("segment {}: s from {:.6} to {:.6} mm", k + 1, mm(g.from), mm(g.to));
        say!("  width {}", list(&g.width, 1e3));
        say!("  depth {}", list(&g.depth, 1e6));
    }
    Ok(())
}

/// Coefficients in another unit; what is round-off beside the largest is 0.
fn sound(values: &[f64], unit: f64) -> Vec<f64> {
    let largest = values.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let one = |c: &f64| match c.abs() < 1e-12 * largest {
        true => 0.0,
        false => twelve_digits(unit * c),
    };
    values.iter().map(one).collect()
}

/// A length in mm to 1e-6, and never -0.
fn mm(x: f64) -> f64 {
    (1e9 * x).round() / 1e6 + 0.0
}

/// Errors of width and depth, RMS and largest, um; what is round-off beside the largest coefficient is 0.
fn errors_um(fit: &Fit) -> [[f64; 2]; 2] {
    const ROUND_OFF: f64 = 1e-12;
    let largest = |of: fn(&Segment) -> &Vec<f64>| {
        let all = fit.segments.iter().flat_map(of);
        all.fold(0.0_f64, |m, c| m.max(c.abs()))
    };
    let clean = |error: f64, scale: f64| match error < ROUND_OFF * scale {
        true => 0.0,
        false => twelve_digits(1e6 * error),
    };
    let (width, depth) = (largest(|g| &g.width), largest(|g| &g.depth));
    [
        [fit.width_error.rms, fit.width_error.max].map(|e| clean(e, width)),
        [fit.depth_error.rms, fit.depth_error.max].map(|e| clean(e, depth)),
    ]
}

objects! {
    /// A fit, and how far it is off.
    Fitted { order: usize, samples: usize, width_error_um: Off, depth_error_um: Off, segments: Vec<Piece> }
    /// Errors over the samples.
    Off { rms: f64, largest: f64 }
    /// Coefficients of a segment.
    Piece { from_mm: f64, to_mm: f64, width_mm: Vec<f64>, depth_um: Vec<f64> }
}

/// What the fit says, as JSON.
fn fit_json(fit: &Fit, args: &FitArgs) -> Fitted {
    let segments = fit.segments.iter().map(|g| Piece {
        from_mm: mm(g.from),
        to_mm: mm(g.to),
        width_mm: sound(&g.width, 1e3),
        depth_um: sound(&g.depth, 1e6),
    });
    let [width_error_um, depth_error_um] = errors_um(fit).map(|[rms, largest]| Off { rms, largest });
    let segments = segments.collect();
    Fitted { order: args.order, samples: args.samples, width_error_um, depth_error_um, segments }
}

fn random(args: &RandomArgs) -> Result<(), Failure> {
    for (name, x, top) in
        [("--length-mm", args.length_mm, 1e4), ("--width-mm", args.width_mm, 1e4), ("--depth-um", args.depth_um, 1e5)]
    {
        if !(x > 0.0 && x <= top) {
            return Err(Failure::Usage(format!("{name} {x}: expected more than 0, at most {top}")));
        }
    }
    if !(0.0..=1.0).contains(&args.roughness) {
        return Err(Failure::Usage(format!("--roughness {}: expected 0 (an ellipse) to 1 (ragged)", args.roughness)));
    }
    let defect = scenario::Defect {
        on: Surface::OuterRaceway,
        row: 1,
        center_deg: 0.0,
        depth_um: args.depth_um,
        axial_offset_mm: 0.0,
        shape: scenario::Shape::Random {
            seed: args.seed,
            length_mm: args.length_mm,
            width_mm: args.width_mm,
            roughness: args.roughness,
        },
        table: None,
    };
    let area = 1e6 * shape(&defect)?.area();
    let deepest = match shape(&defect)? {
        Shape::DepthMap(grid) => 1e6 * grid.extremes().0,
        _ => args.depth_um,
    };
    let alone = Scenario { defects: vec![defect], ..Scenario::example() };
    let remark = format!(
        "area {} mm^2, deepest {} um; see it: brinell defect preview SCENARIO",
        short(area, 4),
        short(deepest, 3)
    );
    print_entry(&alone, &[remark]);
    Ok(())
}
