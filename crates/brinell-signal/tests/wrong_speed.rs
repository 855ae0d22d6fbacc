//! A speed that was given wrongly: what the sidebands of the true speed say, a comb beside the bearing's frequencies, and
//! lines of another shaft.

use crate::analysis::{Damage, SHAFT, damaged, healthy};
use crate::cases::first;
use brinell_signal::analysis::{Component, DefectOrders, NamedBearing, Options, Verdict, analyze};
use brinell_signal::random::Random;
use std::f64::consts::TAU;

/// What an inner race at 29.95 turns a second shows to whoever believes in half as many again: lines where BPFO would
/// be, with sidebands at two thirds of that speed. At the true speed it is the inner race.
#[test]
fn prop_sidebands_of_another_speed_leave_the_part_open() {
    let (fs, shaft) = (20_000.0, 29.95);
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    for seed in 0..4 {
        let inner = Damage { order: 5.4152, modulation: 1.0, jitter: 0.001, snr_db: 6.0 };
        let x = damaged(fs, 4.0, seed, &inner);
        let told = |shaft: f64| analyze(&x, fs, &Options::new(shaft, orders)).unwrap();
        let right = told(shaft);
        assert!(right.verdict().starts_with("Inner race damage, very clear"), "{}", right.verdict());
        assert!(right.families.iter().all(|f| f.other_spacing.is_none()));
        let wrong = told(1.5 * shaft);
        assert_eq!(wrong.conclusion(), Verdict::CannotTell, "{}", wrong.verdict());
        let spacing = wrong.families.iter().find_map(|f| f.other_spacing).unwrap();
        assert!((spacing / shaft - 1.0).abs() < 0.01, "{spacing}");
    }
}

#[test]
fn prop_a_wrong_speed_is_pointed_to_and_blamed_on_nobody() {
    let fs = 12_000.0;
    let damage = Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db: 3.0 };
    for (seed, wrong) in [0.96, 0.97, 1.03, 1.04].into_iter().enumerate() {
        // Without the shaft's own lines, which would tell its speed.
        let rig = damaged(fs, 2.0, seed as u64, &damage);
        let x: Vec<f64> = (rig.iter().zip(healthy(fs, 2.0, seed as u64)))
            .zip(healthy(fs, 2.0, 50 + seed as u64))
            .map(|((all, without), noise)| all - without + 0.05 * noise)
            .collect();
        let orders = NamedBearing::find("6205-2RS").unwrap().orders();
        let told = analyze(&x, fs, &Options::new(wrong * SHAFT, orders)).unwrap();
        assert_eq!(first(&told), None, "{}", told.verdict());
        assert_eq!(told.conclusion(), Verdict::CannotTell);
        let elsewhere = told.elsewhere.expect("a comb at no frequency of the bearing");
        let nearest = elsewhere.nearest.expect("near BPFO");
        assert_eq!(nearest.name, "BPFO");
        // Half a per cent of slip.
        assert!((nearest.shaft / (0.995 * SHAFT) - 1.0).abs() < 5e-3, "{nearest:?}");
        let verdict = told.verdict();
        let words = format!("It would be BPFO at {:.0} r/min", 60.0 * nearest.shaft);
        assert!(verdict.contains(&words), "{verdict}");
        assert!(verdict.contains("Is one of these the speed, or the sample rate another, and is it this bearing?"));
    }
}

/// In an NN3007 2 BSF lies 3.5 % below BPFO, and 3 % of cage slip raise it by 2.3 %: into the outer race's place, with
/// an element's sidebands. Without those it is the race.
#[test]
fn prop_what_slip_of_the_cage_exchanges_is_left_open() {
    let orders = DefectOrders { ftf: Some(0.43878), bpfo: Some(8.3367), bpfi: Some(10.6633), bsf: Some(4.02215) };
    let (fs, slip) = (20_000.0, 0.03);
    let order = 2.0 * 4.02215 * (1.0 + slip * 0.43878 / (1.0 - 0.43878));
    for seed in 0..4 {
        for modulation in [0.0, (1.0 - slip) * 0.43878] {
            let damage = Damage { order: order / 0.995, modulation, jitter: 0.001, snr_db: 6.0 };
            let told = analyze(&damaged(fs, 4.0, seed, &damage), fs, &Options::new(SHAFT, orders)).unwrap();
            if modulation == 0.0 {
                assert_eq!(first(&told), Some(Component::OuterRace), "{}", told.verdict());
                continue;
            }
            assert_eq!(told.conclusion(), Verdict::CannotTell, "{}", told.verdict());
            let found = told.families.iter().find_map(|f| f.others_slip).unwrap();
            assert!((found - slip).abs() < 2e-3, "{found}");
            assert!(told.verdict().contains("the outer race or the rolling element"), "{}", told.verdict());
        }
    }
}

/// A second shaft 8 % faster, where this one has no lines of its own: nothing says whether the speed given is wrong.
/// Damage at that speed is then neither called nor passed over.
#[test]
fn prop_damage_at_the_speed_given_is_said_beside_another_shafts_lines() {
    let fs = 12_000.0;
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let damage = Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db: 3.0 };
    for seed in 0..4 {
        let mut noise = Random::new(seed);
        let impacts =
            damaged(fs, 4.0, seed, &damage).into_iter().zip(healthy(fs, 4.0, seed)).map(|(all, rest)| all - rest);
        let x: Vec<f64> = (impacts.enumerate())
            .map(|(i, v)| {
                let turns = 1.08 * SHAFT * i as f64 / fs;
                let comb: f64 = (1..=8).map(|k| 0.1 * (TAU * f64::from(k) * turns).sin()).sum();
                v + comb + 0.1 * noise.normal()
            })
            .collect();
        let a = analyze(&x, fs, &Options::new(SHAFT, orders)).unwrap();
        assert!((a.shaft / (1.08 * SHAFT) - 1.0).abs() < 1e-3, "{seed} {}", a.shaft);
        assert_eq!(a.conclusion(), Verdict::CannotTell);
        let at_given = a.at_given.as_ref().expect("damage at the speed given");
        assert_eq!(at_given.component, Component::OuterRace, "{}", a.verdict());
        assert!(a.verdict().contains("A record of the speed would tell."), "{}", a.verdict());
    }
}

/// A cage that slips takes BPFO down and BPFI up, farther than the tolerance: damage where the shaft's lines tell its
/// speed, and the verdict names the slip. The other way, or where nothing tells the speed, it is none.
#[test]
fn prop_slip_of_the_cage_has_one_sign() {
    let fs = 12_000.0;
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let turns = orders.ftf.unwrap();
    let told = |slip: f64, (bpf, modulation): (f64, f64), own_lines: bool| {
        // The rig slips by half a per cent.
        let damage = Damage { order: bpf / 0.995, modulation, jitter: 0.002, snr_db: 3.0 };
        let mut x = damaged(fs, 4.0, 7, &damage);
        if !own_lines {
            let mut noise = Random::new(8);
            x = x.iter().zip(healthy(fs, 4.0, 7)).map(|(all, without)| all - without + 0.1 * noise.normal()).collect();
        }
        (analyze(&x, fs, &Options::new(SHAFT, orders)).unwrap(), slip)
    };
    let outer = |slip: f64| ((1.0 - slip) * orders.bpfo.unwrap(), 0.0);
    let inner = |slip: f64| ((1.0 + slip * turns / (1.0 - turns)) * orders.bpfi.unwrap(), 1.0);
    for (slip, lines, part) in [
        (0.025, outer(0.025), Component::OuterRace),
        (0.03, outer(0.03), Component::OuterRace),
        (0.045, outer(0.045), Component::OuterRace),
        (0.045, inner(0.045), Component::InnerRace),
        (0.07, inner(0.07), Component::InnerRace),
    ] {
        let (a, slip) = told(slip, lines, true);
        assert_eq!((first(&a), a.shaft_lines.is_empty()), (Some(part), false), "{}", a.verdict());
        let words = format!("The cage slips: {:.1} % behind pure rolling", 100.0 * slip);
        assert!(a.verdict().contains(&words), "{slip}: {}", a.verdict());
        assert_eq!(a.clarity(a.causes().next().unwrap()), "clear");
    }
    for (slip, lines, own) in [
        (-0.03, outer(-0.03), true),
        (-0.05, inner(-0.05), true),
        (0.06, outer(0.06), true),
        (0.03, outer(0.03), false),
    ] {
        let (a, _) = told(slip, lines, own);
        assert_eq!((first(&a), a.conclusion()), (None, Verdict::CannotTell), "{slip}: {}", a.verdict());
        let names_slip = a.verdict().contains("or with a cage that slips by 3.0 %");
        assert_eq!(names_slip, !own, "{slip}: {}", a.verdict());
    }
}
