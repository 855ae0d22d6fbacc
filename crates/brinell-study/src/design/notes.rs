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
        let notes = histories.chain(self.without_runs()).chain(self.idle_secret());
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
