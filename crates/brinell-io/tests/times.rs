//! Which column of times belongs to a channel.

use brinell_io::{NoTimes, SignalFile, open_bytes};

/// 40 lines of columns, each with its step, under a line of names.
fn table(names: &str, steps: &[f64]) -> SignalFile {
    let line = |i: usize| {
        let fields: Vec<String> = steps.iter().map(|step| (i as f64 * step).to_string()).collect();
        fields.join(",") + "\n"
    };
    let text = (0..40).fold(format!("{names}\n"), |text, i| text + &line(i));
    open_bytes("a.csv", text.into_bytes()).unwrap()
}

fn times_of(file: &mut SignalFile, channel: &str) -> Result<Option<String>, NoTimes> {
    let channel = file.named(channel).unwrap().1;
    Ok(file.times_of(&channel)?.map(|times| times.name))
}

#[test]
fn prop_times_in_a_table_are_the_nearest_to_the_left() {
    let named = |name: &str| Ok(Some(name.to_owned()));
    for names in ["time_s,A,time_s,B", "time [s],A,time [s],B", "Time (s),A,Time (s),B", "t (milliseconds),A,t [ns],B"]
    {
        let mut file = table(names, &[0.1, 3.0, 0.2, 5.0]);
        let times: Vec<String> = [0, 2].map(|k| file.channels()[k].name.clone()).to_vec();
        assert_eq!(times_of(&mut file, "A"), named(&times[0]), "{names}");
        assert_eq!(times_of(&mut file, "B"), named(&times[1]), "{names}");
        assert!(file.channels().iter().step_by(2).all(|c| c.seconds_in_time_unit().is_some()), "{names}");
    }
    let mut file = table("A,time_s,B", &[3.0, 0.1, 5.0]);
    assert_eq!(times_of(&mut file, "A"), named("time_s"));
    // Two clocks of one rate, one of them from another beginning or in another unit.
    let mut file = table("time_s,t_ms,A", &[0.1, 100.0, 3.0]);
    assert_eq!(times_of(&mut file, "A"), named("t_ms"));
}

#[test]
fn prop_times_that_disagree_are_asked_for() {
    for (names, steps) in [
        ("time_s,t_s,A,B", [0.1, 0.2, 3.0, 5.0]),
        ("A,time_s,B,time_s", [3.0, 0.1, 5.0, 0.2]),
        ("time_s,t_ms,A,B", [0.1, 99.0, 3.0, 5.0]),
    ] {
        for channel in ["A", "B"] {
            let mut file = table(names, &steps);
            let words = times_of(&mut file, channel).unwrap_err().to_string();
            assert!(words.contains("is not clear: those in"), "{names}: {words}");
        }
    }
}

#[test]
fn prop_a_unit_of_times_that_is_not_known_is_said() {
    let file = table("time [ticks],A", &[1.0, 2.0]);
    let times = &file.channels()[0];
    assert_eq!(times.why_no_time_unit(), "the unit `ticks` of its times in `time [ticks]` is not known");
    assert_eq!(table("t,A", &[1.0, 2.0]).channels()[0].why_no_time_unit(), "no unit for its times in `t`");
}

#[cfg(feature = "npz")]
#[test]
fn regress_times_of_another_length_are_not_the_channels() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/clocks.npz");
    let mut file = brinell_io::open(path).unwrap();
    assert_eq!(times_of(&mut file, "acc"), Ok(Some("time_s".into())));
    let words = times_of(&mut file, "slow").unwrap_err().to_string();
    assert_eq!(words, "`time_s` has 300 times and `slow` 150 values");
}
