//! What the author of a plan should know that keeps it from nothing.

use super::drawn::Drawn;
use super::draws::Draws;
use super::plan::Class;
use super::split::Part;
use super::turns::{APART, Place};

impl Draws {
    /// What the author should know: grids whose combinations come unequally often, and splits without a class.
    pub fn notes(&self) -> Vec<String> {
        let uneven = |(class, drawn): (&Class, &Drawn)| {
            (drawn.open % drawn.combinations != 0).then(|| {
                format!(
                    "class {:?} has {} {}s for {} combinations of its grids: some combinations come once more than others",
                    class.name,
                    drawn.open,
                    self.plan().unit(),
                    drawn.combinations
                )
            })
        };
        let classes = self.plan().classes.iter().zip(&self.classes);
        let splits = self.splits();
        let lacks = splits.iter().flat_map(|split| self.lacks(split));
        let plan = self.plan();
        let histories = plan.history.iter().flat_map(|history| history.notes(plan.holds_out()));
        let notes = histories.chain(self.without_runs()).chain(self.idle_secret()).chain(self.none_held_out());
        notes.chain(classes.filter_map(uneven)).chain(self.lonely()).chain(lacks).collect()
    }

    /// That a class has a share and no run.
    fn without_runs(&self) -> impl Iterator<Item = String> {
        let classes = self.plan().classes.iter().zip(&self.classes);
        let empty = classes.filter(|(class, drawn)| class.share > 0.0 && drawn.runs == 0);
        empty.map(|(class, _)| {
            let (share, units, unit) = (class.share, self.places.len(), self.plan().unit());
            let s = if units == 1 { "" } else { "s" };
            format!("class {:?} has no {unit}: its share, {share}, is too small for {units} {unit}{s}", class.name)
        })
    }

    /// That a secret decides nothing.
    fn idle_secret(&self) -> Option<String> {
        let is_idle = !self.plan().secret.is_empty() && !self.plan().holds_out();
        is_idle.then(|| {
            "secret is given and held_out is 0: no labels are held out, and dataset.json shows the plan with its secret \
             (held_out = 0.2 holds out a fifth of them)"
                .to_owned()
        })
    }

    /// That chance holds out nothing, or everything.
    fn none_held_out(&self) -> Option<String> {
        /// With this chance one or more are held out.
        const SURE: f64 = 0.95;
        let (plan, units) = (self.plan(), self.places.len());
        let apart = self.places.iter().filter(|place| place.number == APART).count();
        let share = plan.held_out;
        let s = if units == 1 { "" } else { "s" };
        (plan.holds_out() && apart == 0).then(|| {
            let enough = ((1.0 - SURE).ln() / (1.0 - share).ln()).ceil();
            let larger = (100.0 * (1.0 - (1.0 - SURE).powf(1.0 / units as f64))).ceil() / 100.0;
            format!(
                "held_out = {share} holds out none of {units} {0}{s}: each is drawn by chance; with {enough} {0}s, or with held_out = {larger}, \
                 one or more are held out with a chance of 95 %; another secret draws others",
                plan.unit()
            )
        })
    }

    /// That most groups are single runs, so that a test run has near neighbours in the training.
    fn lonely(&self) -> Option<String> {
        let open = self.places.iter().filter(|place| place.number != APART).count();
        (2 * self.groups > open).then(|| {
            format!(
                "the split has {} groups of like conditions for {open} runs, so that runs of the test are much like some of the training: \
                 fewer keys in split.by make larger groups ([] makes each run a group, on purpose)",
                self.groups
            )
        })
    }

    /// That a split lacks classes which have runs; those of which the severities held out are all runs apart, as no
    /// other remedy helps there.
    fn lacks(&self, (part, runs): &(Part, Vec<usize>)) -> Vec<String> {
        let absent = (0..runs.len()).filter(|class| runs[*class] == 0 && self.open_runs_of(*class) > 0);
        let absent = absent.filter(|_| *part != Part::HeldOut);
        let (severe, few): (Vec<usize>, Vec<usize>) = absent.partition(|class| self.is_severe(*class));
        let few_words = match self.plan().history {
            Some(_) => "take more machines, or a larger share",
            None => "take more runs, or fewer keys in split.by ([] makes each run a group)",
        };
        let remedies = [
            (severe, "split.severity_range holds all of its runs, which are for the test: take a narrower range"),
            (few, few_words),
        ];
        let noted = remedies.into_iter().filter(|(classes, _)| !classes.is_empty()).map(|(classes, remedy)| {
            let names: Vec<String> =
                classes.iter().map(|class| format!("{:?}", self.plan().classes[*class].name)).collect();
            format!("the split {} has no run of class {}: {remedy}", part.word(), names.join(", "))
        });
        noted.collect()
    }

    /// Whether every open run of a class has a severity that is for the test alone.
    fn is_severe(&self, class: usize) -> bool {
        let Some(severity) = self.plan().split.as_ref().and_then(|split| split.severity.as_ref()) else {
            return false;
        };
        let of_class = |place: &Place| place.class as usize == class && place.number != APART;
        let mut open = (0..self.places.len()).filter(|place| of_class(&self.places[*place]));
        open.all(|place| severity.holds(&self.numbers(place, &severity.keys)))
    }
}
