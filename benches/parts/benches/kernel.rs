//! A right-hand side: its time with each kernel, on and off damage, and by the number of rollers and balls.
//!
//! `cargo bench -p brinell-bench --bench kernel`.

mod common;

use brinell::model::{Kernel, Model, Workspace};
use common::{Moment, moments, off_and_on_damage, rectangle};
use criterion::Criterion;
use std::hint::black_box;
use std::time::Instant;

/// Best of several, s: what a machine does when nobody else is at it.
fn shortest(mut what: impl FnMut()) -> f64 {
    (0..20)
        .map(|_| {
            let begin = Instant::now();
            what();
            begin.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

fn kernels() -> impl Iterator<Item = Kernel> {
    Kernel::ALL.into_iter().filter(|k| k.is_there())
}

/// Time of one right-hand side, s: the mean over moments.
fn time(model: &Model, kernel: Kernel, moments: &[Moment]) -> f64 {
    let rounds = 20_000 / moments.len();
    let mut ws = Workspace::with_kernel(model, kernel);
    let mut a = vec![0.0; moments[0].1.len() / 2];
    shortest(|| {
        for _ in 0..rounds {
            for (t, y) in moments {
                model.accelerations(*t, black_box(y), &mut a, &mut ws);
            }
        }
    }) / (rounds * moments.len()) as f64
}

/// Twice the rollers: at most twice the time. Without damage, over many moments: how many groups of contacts are open
/// differs from one to the next.
fn rollers() {
    let mut before: Option<f64> = None;
    for rollers_per_row in [19, 38, 76, 152] {
        let mut s = rectangle();
        s.defects.clear();
        s.bearing.rollers_per_row = rollers_per_row;
        s.bearing.row_stagger_deg = 180.0 / rollers_per_row as f64;
        let model = Model::new(&s).expect("a model");
        let seconds = time(&model, Kernel::fastest(), &moments(&model));
        let ratio = before.map_or(String::new(), |b| format!(", {:.2} times", seconds / b));
        println!("{} rollers: {:.0} ns{ratio}", model.layout.rollers(), 1e9 * seconds);
        before = Some(seconds);
    }
}

/// What an element costs: of the paper's rollers, and of balls in bearings that fill their slots and in one that does
/// not. Bodies that are there once (rings, cage) count with the elements.
fn balls() {
    let healthy = |preset: &str| {
        let mut s = rectangle();
        if preset != "NN3007" {
            let text = format!("[bearing]\npreset = \"{preset}\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n");
            s = brinell::document::read(&text, &[]).expect("sound").scenario;
        }
        s.defects.clear();
        Model::new(&s).expect("a model")
    };
    for kernel in kernels() {
        let mut roller = f64::NAN;
        for preset in ["NN3007", "NU206", "6204", "6205", "6207"] {
            let model = healthy(preset);
            let moments = moments(&model);
            let nanoseconds = 1e9 * time(&model, kernel, &moments);
            let layout = &model.layout;
            let each = nanoseconds / layout.rollers() as f64;
            if roller.is_nan() {
                roller = each;
            }
            println!(
                "{kernel:?}, {preset}: {nanoseconds:.0} ns, {} elements in {} slots: {each:.2} ns an element, {:.2} times the NN3007's; {:.2} ns a slot",
                layout.rollers(),
                layout.slots,
                each / roller,
                nanoseconds / layout.slots as f64
            );
        }
    }
}

fn main() {
    let mut criterion: Criterion = common::criterion();
    let model = Model::new(&rectangle()).expect("a model");
    let places = off_and_on_damage(&model);
    // `cargo test --benches` only wants to see that it runs.
    if !std::env::args().any(|a| a == "--test") {
        rollers();
        balls();
    }
    let mut group = criterion.benchmark_group("right-hand side");
    for kernel in kernels() {
        for (place, (t, y)) in ["off damage", "on damage"].into_iter().zip(&places) {
            let mut ws = Workspace::with_kernel(&model, kernel);
            let mut a = vec![0.0; y.len() / 2];
            group.bench_function(format!("{kernel:?}, {place}"), |b| {
                b.iter(|| model.accelerations(*t, black_box(y), &mut a, &mut ws));
            });
        }
    }
    group.finish();
    criterion.final_summary();
}
