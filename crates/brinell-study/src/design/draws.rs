//! What each run of a plan draws.

use super::damaged::{bearings_of, damage_of};
use super::distribution::{Distribution, KINDS, Value};
use super::drawn::{Drawn, Parameter, common_axes, sequence};
use super::history::{History, Snapshot, Turning, only_defect, times};
use super::plan::{OutOfRange, Plan};
use super::seeded::{SEEDED_PER_RUN, Seeded, holding};
use super::sequence::Sequence;
use super::split::{self, Part};
use super::stream::{Secret, bits, seed, unit, word};
use super::template::Template;
use super::turns::{APART, Place, places};
use brinell::document::reading::{Node, parse, quote};
use brinell::document::{Loaded, Problem, read};
use brinell::scenario::Speed;

/// Times that a run is drawn before its class counts as impossible.
const MOST_ATTEMPTS: u64 = 1000;

/// Bands of equal probability that a continuous distribution is cut into, where runs are grouped by conditions.
const BANDS: f64 = 8.0;

/// One run's settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// Index of the class.
    pub class: usize,
    /// Overrides for [`brinell::document::read`], seeds included.
    pub settings: Vec<(String, String)>,
    /// What was drawn, a value for each of [`Draws::parameters`]; `None` where the class does not draw it.
    pub values: Vec<Option<Value>>,
    /// How often it was drawn before, because its values did not fit.
    pub redrawn: u64,
    /// Of a history: what the machine is at this run.
    pub snapshot: Option<Box<Snapshot>>,
}

/// The runs of a plan. Places are those of runs, or of machines where each has a history: what is said of a run's place is
/// then said of its machine's.
pub struct Draws {
    plan: Plan,
    /// Where labels are held out.
    secret: Option<Secret>,
    pub(super) classes: Vec<Drawn>,
    pub(super) places: Vec<Place>,
    /// Keys of `[vary]` that are drawn, and where: over all runs together.
    common: (usize, Sequence),
    /// Each run's place there, shuffled, so that it says nothing of the class.
    order: Vec<u32>,
    parts: Vec<Part>,
    /// With histories: the first run of each place, and at the end how many runs there are.
    firsts: Vec<usize>,
    /// Of like conditions, where there is a split.
    pub(super) groups: usize,
    parameters: Vec<Parameter>,
}

impl Draws {
    /// Of a plan.
    ///
    /// # Errors
    /// Where the plan cannot be: fewer runs than combinations of its grids, more distributions than a Sobol sequence
    /// has dimensions.
    pub fn new(plan: Plan) -> Result<Self, Vec<Problem>> {
        let secret = Secret::of(&plan.secret).filter(|_| plan.holds_out());
        let places = places(&plan, secret.as_ref());
        let (mut parameters, mut classes, mut problems) = (Vec::new(), Vec::new(), Vec::new());
        for c in 0..plan.classes.len() {
            let mine = || places.iter().filter(|place| place.class as usize == c);
            let open = mine().filter(|place| place.number != APART).count();
            let runs = [mine().count(), open];
            classes.push(Drawn::new(&plan, c, runs, &mut parameters, &mut problems));
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        let order = shuffled(&plan, &places);
        let common = common_axes(&plan);
        let open = order.iter().filter(|place| **place != APART).count();
        let common = (common, sequence(&plan, u64::MAX, common, open));
        let (parts, firsts) = (Vec::new(), Vec::new());
        let mut draws = Self { plan, secret, classes, places, common, order, parts, firsts, groups: 0, parameters };
        draws.firsts = draws.first_runs();
        let conditions = |run, keys: &[String]| draws.conditions(run, keys);
        let numbers = |run, keys: &[String]| draws.numbers(run, keys);
        (draws.parts, draws.groups) = split::parts(&draws.plan, &draws.places, &draws.parameters, conditions, numbers)?;
        Ok(draws)
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// See [`Draws::firsts`].
    fn first_runs(&self) -> Vec<usize> {
        let Some(history) = &self.plan.history else { return Vec::new() };
        let mut next = 0;
        let mut firsts = vec![0];
        firsts.extend((0..self.places.len()).map(|place| {
            next += times(history, &self.life(place)).len();
            next
        }));
        firsts
    }

    /// What a machine's life has drawn.
    pub(super) fn life(&self, place: usize) -> Vec<Value> {
        let of_grid = self.of_grid(place);
        let axes = self.classes[self.class_at(place)].life.clone();
        axes.map(|axis| self.value((place, 0), axis, 0, of_grid.as_deref())).collect()
    }

    /// How many runs.
    pub fn runs(&self) -> usize {
        self.firsts.last().copied().unwrap_or(self.places.len())
    }

    /// Place of a run, and which of the runs there it is.
    fn place_of(&self, run: usize) -> (usize, usize) {
        if self.firsts.is_empty() {
            return (run, 0);
        }
        let place = self.firsts.partition_point(|first| *first <= run) - 1;
        (place, run - self.firsts[place])
    }

    /// Runs of a place.
    pub(super) fn runs_at(&self, place: usize) -> usize {
        self.firsts.get(place + 1).map_or(1, |next| next - self.firsts[place])
    }

    /// Number of a run's machine, with histories; of the run otherwise.
    pub(crate) fn unit_of(&self, run: usize) -> usize {
        self.place_of(run).0
    }

    /// Class of a run, from 0.
    pub fn class(&self, run: usize) -> usize {
        self.class_at(self.place_of(run).0)
    }

    pub(super) fn class_at(&self, place: usize) -> usize {
        self.places[place].class as usize
    }

    /// Every key that some class draws.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Whether a run's labels are held out.
    pub fn is_held_out(&self, run: usize) -> bool {
        self.is_apart(self.place_of(run).0)
    }

    pub(super) fn is_apart(&self, place: usize) -> bool {
        self.places[place].number == APART
    }

    /// What a run is for.
    pub fn part(&self, run: usize) -> Part {
        self.parts[self.place_of(run).0]
    }

    /// Under which conditions the runs of a place run: of each key its value, or in which of [`BANDS`] it lies where it is drawn
    /// from a continuous distribution.
    fn conditions(&self, place: usize, keys: &[String]) -> Vec<String> {
        let class = &self.classes[self.class_at(place)];
        let of_grid = self.of_grid(place);
        let axes = class.axes.iter().enumerate();
        axes.filter(|(_, axis)| keys.contains(&self.parameters[axis.parameter].key))
            .map(|(k, axis)| match axis.distribution {
                Distribution::Uniform { .. } | Distribution::Log { .. } | Distribution::Normal { .. } => {
                    format!("{:.0}", (BANDS * self.unit((place, 0), k, 0)).floor())
                }
                Distribution::Whole { .. } | Distribution::Choice { .. } | Distribution::Grid { .. } => {
                    self.value((place, 0), k, 0, of_grid.as_deref()).toml
                }
            })
            .collect()
    }

    /// What a place draws for those of the keys that its class draws, where that is a number.
    pub(super) fn numbers(&self, place: usize, keys: &[String]) -> Vec<f64> {
        let class = &self.classes[self.class_at(place)];
        let of_grid = self.of_grid(place);
        let axes = class.axes.iter().enumerate();
        axes.filter(|(_, axis)| keys.contains(&self.parameters[axis.parameter].key))
            .filter_map(|(k, _)| self.value((place, 0), k, 0, of_grid.as_deref()).number)
            .collect()
    }

    /// Bits that belong to a place and words: of the secret where its labels are held out, and of nothing else then.
    fn own_bits(&self, place: usize, words: &[u64]) -> u64 {
        let place_and: Vec<u64> = std::iter::once(place as u64).chain(words.iter().copied()).collect();
        match &self.secret {
            Some(secret) if self.is_apart(place) => secret.bits(&place_and),
            _ => bits(&[&[self.plan.seed], &*place_and].concat()),
        }
    }

    /// Where a run draws along an axis of its class, in [0, 1).
    fn unit(&self, (place, snapshot): (usize, usize), axis: usize, attempt: u64) -> f64 {
        let Place { class, number } = self.places[place];
        let class = &self.classes[class as usize];
        let own = word(&self.parameters[class.axes[axis].parameter].key);
        if class.axes[axis].is_anew {
            return unit(self.own_bits(place, &[attempt, own, word("snapshot"), snapshot as u64]));
        }
        // A second draw has no place in the design, nor has a run whose labels are held out: the place would tell the
        // class.
        if attempt == 0 && number != APART {
            let (common, together) = &self.common;
            let in_design = match axis.checked_sub(*common) {
                None => together.place(self.order[place] as usize, axis),
                Some(own) => class.sequence.place(number as usize, own),
            };
            if let Some(in_design) = in_design {
                return in_design;
            }
        }
        unit(self.own_bits(place, &[attempt, own]))
    }

    /// What a run draws at its `attempt`-th time, from 0, without the seeds that [`Draws::draw`] adds.
    fn values(&self, at: (usize, usize), attempt: u64) -> Vec<Value> {
        let class = &self.classes[self.class_at(at.0)];
        let of_grid = self.of_grid(at.0);
        let axes = 0..class.axes.len();
        axes.map(|k| self.value(at, k, attempt, of_grid.as_deref())).collect()
    }

    /// The same along one axis of its class.
    fn value(&self, at: (usize, usize), axis: usize, attempt: u64, of_grid: Option<&[usize]>) -> Value {
        match (&self.classes[self.class_at(at.0)].axes[axis].distribution, of_grid) {
            // Snapshots take each value in turn.
            (Distribution::Grid { values }, _) if self.classes[self.class_at(at.0)].axes[axis].is_anew => {
                values[at.1 % values.len()].clone()
            }
            (Distribution::Grid { values }, Some(of_grid)) => values[of_grid[axis]].clone(),
            (distribution, _) => distribution.value(self.unit(at, axis, attempt)),
        }
    }

    /// Which value of each grid a place takes: they are walked through in order, the last one changing from place to place,
    /// whatever the attempt. `None` where its labels are held out.
    fn of_grid(&self, place: usize) -> Option<Vec<usize>> {
        let Place { class, number } = self.places[place];
        let class = &self.classes[class as usize];
        let mut rest = number as usize % class.combinations;
        let mut of_grid = vec![0; class.axes.len()];
        for (k, axis) in class.axes.iter().enumerate().rev().filter(|(_, axis)| !axis.is_anew) {
            if let Distribution::Grid { values } = &axis.distribution {
                of_grid[k] = rest % values.len();
                rest /= values.len();
            }
        }
        (number != APART).then_some(of_grid)
    }

    /// What run `run` draws at its `attempt`-th time, over the base scenario's text; of a history with the damage at failure.
    fn draw(&self, base: &str, run: usize, attempt: u64) -> Result<Draw, Vec<Problem>> {
        let at = self.place_of(run);
        let c = self.class_at(at.0);
        let class = &self.plan.classes[c];
        let drawn = self.values(at, attempt);
        let mut next = drawn.iter();
        let record: Vec<String> = self.plan.signals.iter().map(|name| quote(name)).collect();
        let record = format!("[{}]", record.join(", "));
        let mut settings = vec![("simulation.record".to_owned(), record)];
        let set = |template: &Template, next: &mut std::slice::Iter<Value>, settings: &mut Vec<(String, String)>| {
            for (path, template) in template.settings() {
                settings.push((path, template.toml(next)));
            }
        };
        set(&self.plan.vary, &mut next, &mut settings);
        // A machine's life is no part of its scenario.
        next.by_ref().take(self.classes[c].life.len()).for_each(drop);
        set(&class.vary, &mut next, &mut settings);
        if let Some(defects) = &class.defects {
            let damage = defects.toml(&mut next);
            settings.extend(damage_of(bearings_of(base)?, (c, class.bearing), damage)?);
        }
        if let Some(history) = &self.plan.history {
            set(&history.snapshot, &mut next, &mut settings);
        }
        let seeds = self.seeds(base, &settings, at).map_err(no_place)?;
        settings.extend(seeds);
        let mut values = vec![None; self.parameters.len()];
        for (axis, value) in self.classes[c].axes.iter().zip(drawn) {
            values[axis.parameter] = Some(value);
        }
        Ok(Draw { class: c, settings, values, redrawn: attempt, snapshot: None })
    }

    /// Puts the damage of that time in place of the damage at failure.
    /// Gives what is to be said of the outline at failure, which grown ones take after.
    fn grow(&self, history: &History, base: &str, run: usize, draw: &mut Draw) -> Result<Vec<Problem>, Vec<Problem>> {
        let Loaded { scenario: whole, mut warnings, .. } = read(base, &draw.settings)?;
        let defect = only_defect(&whole)?;
        let at = self.place_of(run);
        let scattered = |k: usize| unit(self.own_bits(at.0, &[word("history.scatter"), k as u64]));
        let mut snapshot = Snapshot::of(history, at, defect.map(|defect| defect.on), &self.life(at.0), scattered);
        if let Speed::Constant(rpm) = whole.operation.speed_rpm {
            let speeds: Vec<f64> = (0..=at.1).map(|k| self.speed((at.0, k), draw).unwrap_or(rpm)).collect();
            snapshot.turns = Some(snapshot.turned(&speeds));
        }
        snapshot.bearing = whole.machine.as_ref().map_or(0, |machine| machine.lead);
        let has_damage = snapshot.length_mm > 0.0;
        // Also of a snapshot that makes no scenario: what it should have been.
        let snapshot = draw.snapshot.insert(Box::new(snapshot));
        let turning = Turning::of(&whole, self.slowest(draw.class))?;
        if let Some(defect) = defect {
            let key = match &whole.machine {
                Some(machine) => format!("bearing.{}.defects", machine.lead),
                None => "defects".to_owned(),
            };
            draw.settings.retain(|(path, _)| {
                !path.starts_with(&format!("{key}.0.shape")) && (has_damage || !path.starts_with(&key))
            });
            if has_damage {
                let grown = snapshot.grown(history, (&whole, defect), &turning)?;
                draw.settings.extend(grown.into_iter().map(|(name, value)| (format!("{key}.0.{name}"), value)));
            } else {
                draw.settings.push((key, "[]".to_owned()));
            }
        }
        warnings.retain(|warning| {
            has_damage && warning.key.contains(".shape.outline") && warning.message.contains(" cross")
        });
        Ok(warnings)
    }

    /// Least speed that a class draws, r/min.
    fn slowest(&self, class: usize) -> Option<f64> {
        let mut axes = self.classes[class].axes.iter();
        let axis = axes.find(|axis| self.parameters[axis.parameter].key == "operation.speed_rpm")?;
        let [low, high] = axis.distribution.ends().map(f64::abs);
        Some(low.min(high)).filter(|rpm| rpm.is_finite())
    }

    /// Speed that a snapshot draws for itself, r/min.
    fn speed(&self, at: (usize, usize), draw: &Draw) -> Option<f64> {
        let mut axes = self.classes[draw.class].axes.iter();
        let axis =
            axes.position(|axis| axis.is_anew && self.parameters[axis.parameter].key == "operation.speed_rpm")?;
        self.value(at, axis, draw.redrawn, None).number
    }

    /// Seeds of the keys in [`SEEDED_PER_RUN`].
    fn seeds(
        &self,
        base: &str,
        settings: &[(String, String)],
        (place, snapshot): (usize, usize),
    ) -> Result<Vec<(String, String)>, Vec<Problem>> {
        let root = Node::table(parse(base, settings)?);
        let mut seeds = Vec::new();
        for seeded in &SEEDED_PER_RUN {
            let mut holders = Vec::new();
            holding(&root, seeded.table, seeded.with, "", &mut holders);
            for holder in holders {
                let key = seeded.key(&holder);
                if !self.sets(self.class_at(place), &key) {
                    let anew = seeded.anew.then_some(snapshot as u64).filter(|snapshot| *snapshot > 0);
                    let words: Vec<u64> = std::iter::once(word(&key)).chain(anew).collect();
                    let own = seed(self.own_bits(place, &words));
                    seeds.push((key, own.to_string()));
                }
            }
        }
        Ok(seeds)
    }

    /// Whether the plan sets a key in a class.
    fn sets(&self, class: usize, key: &str) -> bool {
        let class = &self.plan.classes[class];
        let of_damage =
            key.split_once("defects.").filter(|(before, _)| before.is_empty() || before.starts_with("bearing."));
        let in_class = of_damage.map(|(_, rest)| rest).zip(class.defects.as_ref());
        let at_snapshots = self.plan.history.as_ref().is_some_and(|history| history.snapshot.sets(key));
        self.plan.vary.sets(key)
            || class.vary.sets(key)
            || at_snapshots
            || in_class.is_some_and(|(rest, defects)| defects.sets(rest))
    }

    /// Whether runs have a seed of their own under this key, which is no parameter and differs all the same.
    pub fn is_seed(&self, key: &str) -> bool {
        let is = |seeded: &Seeded| {
            if let Some(elsewhere) = seeded.elsewhere {
                return key == elsewhere;
            }
            let (pattern, words) = (seeded.table.split('.').chain([seeded.name]), key.split('.'));
            pattern.clone().count() == words.clone().count() && pattern.zip(words).all(|(p, w)| p == "*" || p == w)
        };
        SEEDED_PER_RUN.iter().any(is) && (0..self.classes.len()).any(|c| !self.sets(c, key))
    }

    /// A run's scenario, read from the base scenario's text with what the run draws; drawn again where the plan says
    /// so.
    ///
    /// # Errors
    /// Every problem of the first draw: of the one and only, or where no other fitted either. With the draw, where
    /// there is one.
    pub fn scenario(&self, base: &str, run: usize) -> Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)> {
        let attempts = match self.plan.out_of_range {
            OutOfRange::Redraw => MOST_ATTEMPTS,
            OutOfRange::Refuse | OutOfRange::Fail => 1,
        };
        let mut first = None;
        for attempt in 0..attempts {
            let mut draw = self.draw(base, run, attempt).map_err(|problems| (problems, None))?;
            let grown = self.plan.history.as_ref().map(|history| self.grow(history, base, run, &mut draw));
            let of_outline = match grown.transpose() {
                Ok(warnings) => warnings.unwrap_or_default(),
                Err(problems) => return Err((problems, Some(draw))),
            };
            match read(base, &draw.settings) {
                Ok(mut loaded) => {
                    loaded.warnings.extend(of_outline);
                    return Ok((loaded, draw));
                }
                Err(problems) => {
                    first.get_or_insert((problems, Some(draw)));
                }
            }
        }
        Err(first.unwrap_or_default())
    }

    /// The first draw of a run, whether or not it fits.
    ///
    /// # Errors
    /// Where the base is no TOML, or has no place for what the plan sets.
    pub fn first(&self, base: &str, run: usize) -> Result<Draw, Vec<Problem>> {
        self.draw(base, run, 0)
    }
}

/// Place of every run among those that the design spreads, in an order of its own; [`APART`] where labels are held out.
fn shuffled(plan: &Plan, places: &[Place]) -> Vec<u32> {
    let open = (0..places.len()).filter(|run| places[*run].number != APART);
    let mut open: Vec<usize> = open.collect();
    open.sort_by_cached_key(|run| bits(&[plan.seed, word("order"), *run as u64]));
    let mut order = vec![APART; places.len()];
    for (place, run) in open.into_iter().enumerate() {
        order[run] = place as u32;
    }
    order
}

/// What was to be set and has no place in the base: most often a distribution whose name is misspelt, and so a key
/// below a number.
fn no_place(problems: Vec<Problem>) -> Vec<Problem> {
    let hinted = |problem: Problem| match problem.allowed {
        None => problem.allowed(format!("a value, or {{ {} = ... }}", KINDS.join(" | "))),
        Some(_) => problem,
    };
    problems.into_iter().map(hinted).collect()
}
