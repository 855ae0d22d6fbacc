//! How many runs a plan has of each kind.

use super::draws::Draws;
use super::history::is_to_the_end;
use super::split::Part;

impl Draws {
    /// Runs of a class.
    pub fn runs_of(&self, class: usize) -> usize {
        self.count(|place| self.class_at(place) == class)
    }

    /// Machines of a class, with histories.
    pub fn machines_of(&self, class: usize) -> usize {
        self.classes[class].runs
    }

    /// Machines that are observed until their life ends.
    pub fn to_the_end(&self) -> usize {
        let Some(history) = &self.plan().history else { return 0 };
        (0..self.places.len()).filter(|place| is_to_the_end(history, &self.life(*place))).count()
    }

    /// Runs of some places.
    fn count(&self, of: impl Fn(usize) -> bool) -> usize {
        (0..self.places.len()).filter(|place| of(*place)).map(|place| self.runs_at(place)).sum()
    }

    /// Runs of a class whose labels are not held out.
    pub fn open_runs_of(&self, class: usize) -> usize {
        self.count(|place| self.class_at(place) == class && !self.is_apart(place))
    }

    /// Of each part that has runs, in the order of the files: how many of each class.
    pub fn splits(&self) -> Vec<(Part, Vec<usize>)> {
        let of = |part: Part| {
            let mut runs = vec![0; self.classes.len()];
            let mine = (0..self.runs()).filter(|run| self.part(*run) == part);
            mine.for_each(|run| runs[self.class(run)] += 1);
            (part, runs)
        };
        let all = Part::ALL.into_iter().map(of);
        all.filter(|(_, runs)| runs.iter().any(|n| *n > 0)).collect()
    }
}
