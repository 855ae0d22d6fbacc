//! What each run of a plan draws.

use super::damaged::{bearings_of, damage_of};
use super::distribution::{Distribution, KINDS, Value};
use super::drawn::{Drawn, Parameter, common_axes, sequence};
use super::plan::{Class, OutOfRange, Plan};
use super::sequence::Sequence;
use super::split::{self, Part};
use super::stream::{Secret, bits, seed, unit, word};
use super::turns::{APART, Place, places};
use brinell::document::reading::{Node, Toml, parse, quote};
use brinell::document::{Loaded, Problem, read};

/// Times that a run is drawn before its class counts as impossible.
const MOST_ATTEMPTS: u64 = 1000;

/// Bands of equal probability that a continuous distribution is cut into, where runs are grouped by conditions.
const BANDS: f64 = 8.0;

/// A seed that every run has one of its own of.
struct Seeded {
    /// The table that holds it; `*` is any element of a list. A run whose scenario has no such table has no such seed.
    table: &'static str,
    /// Its name there.
    name: &'static str,
    /// Keys of which the table has one where the seed means something; none where it always does.
    with: &'static [&'static str],
    /// The seed's key, where another table holds it.
    elsewhere: Option<&'static str>,
}

impl Seeded {
    /// The key, of a table that is there.
    fn key(&self, holder: &str) -> String {
        self.elsewhere.map_or_else(|| format!("{holder}.{}", self.name), str::to_owned)
    }
}

/// Keys that are seeded per run, where the plan does not set them.
const SEEDED_PER_RUN: [Seeded; 5] = [
    Seeded { table: "defects.*.shape.random", name: "seed", with: &[], elsewhere: None },
    Seeded { table: "bearing.*.defects.*.shape.random", name: "seed", with: &[], elsewhere: None },
    Seeded { table: "sensor", name: "noise_seed", with: &["noise_rms_m_per_s2", "noise_snr_db"], elsewhere: None },
    Seeded {
        table: "bearing",
        name: "seed",
        with: &["waviness", "element_waviness"],
        elsewhere: Some("simulation.seed"),
    },
    Seeded {
        table: "bearing.*",
        name: "seed",
        with: &["waviness", "element_waviness"],
        elsewhere: Some("simulation.seed"),
    },
];

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
}

/// The runs of a plan.
pub struct Draws {
    plan: Plan,
    /// Where labels are held out.
    secret: Option<Secret>,
    classes: Vec<Drawn>,
    places: Vec<Place>,
    /// Keys of `[vary]` that are drawn, and where: over all runs together.
    common: (usize, Sequence),
    /// Each run's place there, shuffled, so that it says nothing of the class.
    order: Vec<u32>,
    parts: Vec<Part>,
    /// Of like conditions, where there is a split.
    groups: usize,
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
        let mut draws = Self { plan, secret, classes, places, common, order, parts: Vec::new(), groups: 0, parameters };
        let conditions = |run, keys: &[String]| draws.conditions(run, keys);
        let numbers = |run, keys: &[String]| draws.numbers(run, keys);
        (draws.parts, draws.groups) = split::parts(&draws.plan, &draws.places, &draws.parameters, conditions, numbers)?;
        Ok(draws)
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// How many runs.
    pub fn runs(&self) -> usize {
        self.places.len()
    }

    /// Class of a run, from 0.
    pub fn class(&self, run: usize) -> usize {
        self.places[run].class as usize
    }

    /// Runs of a class.
    pub fn runs_of(&self, class: usize) -> usize {
        self.classes[class].runs
    }

    /// Every key that some class draws.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Runs of a class whose labels are not held out.
    pub fn open_runs_of(&self, class: usize) -> usize {
        self.classes[class].open
    }

    /// Whether a run's labels are held out.
    pub fn is_held_out(&self, run: usize) -> bool {
        self.places[run].number == APART
    }

    /// What a run is for.
    pub fn part(&self, run: usize) -> Part {
        self.parts[run]
    }

    /// Of each part that has runs, in the order of the files: how many of each class.
    pub fn splits(&self) -> Vec<(Part, Vec<usize>)> {
        let of = |part: Part| {
            let mut runs = vec![0; self.classes.len()];
            let mine = (0..self.runs()).filter(|run| self.parts[*run] == part);
            mine.for_each(|run| runs[self.class(run)] += 1);
            (part, runs)
        };
        let all = Part::ALL.into_iter().map(of);
        all.filter(|(_, runs)| runs.iter().any(|n| *n > 0)).collect()
    }

    /// Under which conditions run `run` runs: of each key its value, or in which of [`BANDS`] it lies where it is drawn
    /// from a continuous distribution.
    fn conditions(&self, run: usize, keys: &[String]) -> Vec<String> {
        let class = &self.classes[self.class(run)];
        let of_grid = self.of_grid(run);
        let axes = class.axes.iter().enumerate();
        axes.filter(|(_, axis)| keys.contains(&self.parameters[axis.parameter].key))
            .map(|(k, axis)| match axis.distribution {
                Distribution::Uniform { .. } | Distribution::Log { .. } | Distribution::Normal { .. } => {
                    format!("{:.0}", (BANDS * self.unit(run, k, 0)).floor())
                }
                Distribution::Whole { .. } | Distribution::Choice { .. } | Distribution::Grid { .. } => {
                    self.value(run, k, 0, of_grid.as_deref()).toml
                }
            })
            .collect()
    }

    /// What run `run` draws for those of the keys that its class draws, where that is a number.
    fn numbers(&self, run: usize, keys: &[String]) -> Vec<f64> {
        let class = &self.classes[self.class(run)];
        let of_grid = self.of_grid(run);
        let axes = class.axes.iter().enumerate();
        axes.filter(|(_, axis)| keys.contains(&self.parameters[axis.parameter].key))
            .filter_map(|(k, _)| self.value(run, k, 0, of_grid.as_deref()).number)
            .collect()
    }

    /// What the author should know: grids whose combinations come unequally often, and splits without a class.
    pub fn notes(&self) -> Vec<String> {
        let uneven = |(class, drawn): (&Class, &Drawn)| {
            (drawn.open % drawn.combinations != 0).then(|| {
                format!(
                    "class {:?} has {} runs for {} combinations of its grids: some combinations come once more than others",
                    class.name, drawn.open, drawn.combinations
                )
            })
        };
        let classes = self.plan.classes.iter().zip(&self.classes);
        let splits = self.splits();
        let lacks = splits.iter().flat_map(|split| self.lacks(split));
        let notes = self.without_runs().chain(self.idle_secret());
        notes.chain(classes.filter_map(uneven)).chain(self.lonely()).chain(lacks).collect()
    }

    /// That a class has a share and no run.
    fn without_runs(&self) -> impl Iterator<Item = String> {
        let classes = self.plan.classes.iter().zip(&self.classes);
        let empty = classes.filter(|(class, drawn)| class.share > 0.0 && drawn.runs == 0);
        empty.map(|(class, _)| {
            let (share, runs) = (class.share, self.runs());
            format!("class {:?} has no run: its share, {share}, is too small for {runs} runs", class.name)
        })
    }

    /// That a secret decides nothing.
    fn idle_secret(&self) -> Option<String> {
        let is_idle = !self.plan.secret.is_empty() && !self.plan.holds_out();
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
        let remedies = [
            (severe, "split.severity_range holds all of its runs, which are for the test: take a narrower range"),
            (few, "take more runs, or fewer keys in split.by ([] makes each run a group)"),
        ];
        let noted = remedies.into_iter().filter(|(classes, _)| !classes.is_empty()).map(|(classes, remedy)| {
            let names: Vec<String> =
                classes.iter().map(|class| format!("{:?}", self.plan.classes[*class].name)).collect();
            format!("the split {} has no run of class {}: {remedy}", part.word(), names.join(", "))
        });
        noted.collect()
    }

    /// Whether every open run of a class has a severity that is for the test alone.
    fn is_severe(&self, class: usize) -> bool {
        let Some(severity) = self.plan.split.as_ref().and_then(|split| split.severity.as_ref()) else {
            return false;
        };
        let mut open = (0..self.runs()).filter(|run| self.class(*run) == class && !self.is_held_out(*run));
        open.all(|run| severity.holds(&self.numbers(run, &severity.keys)))
    }

    /// Bits that belong to a run and words: of the secret where its labels are held out, and of nothing else then.
    fn own_bits(&self, run: usize, words: &[u64]) -> u64 {
        let run_and: Vec<u64> = std::iter::once(run as u64).chain(words.iter().copied()).collect();
        match &self.secret {
            Some(secret) if self.is_held_out(run) => secret.bits(&run_and),
            _ => bits(&[&[self.plan.seed], &*run_and].concat()),
        }
    }

    /// Place of a run's first draw along an axis of its class, in [0, 1).
    fn unit(&self, run: usize, axis: usize, attempt: u64) -> f64 {
        let Place { class, number } = self.places[run];
        let class = &self.classes[class as usize];
        let own = word(&self.parameters[class.axes[axis].parameter].key);
        // A second draw has no place in the design, nor has a run whose labels are held out: the place would tell the
        // class.
        if attempt == 0 && number != APART {
            let (common, together) = &self.common;
            let place = match axis.checked_sub(*common) {
                None => together.place(self.order[run] as usize, axis),
                Some(own) => class.sequence.place(number as usize, own),
            };
            if let Some(place) = place {
                return place;
            }
        }
        unit(self.own_bits(run, &[attempt, own]))
    }

    /// What run `run` draws at its `attempt`-th time, from 0, without the seeds that [`Draws::draw`] adds.
    fn values(&self, run: usize, attempt: u64) -> Vec<Value> {
        let class = &self.classes[self.class(run)];
        let of_grid = self.of_grid(run);
        let axes = 0..class.axes.len();
        axes.map(|k| self.value(run, k, attempt, of_grid.as_deref())).collect()
    }

    /// The same along one axis of its class.
    fn value(&self, run: usize, axis: usize, attempt: u64, of_grid: Option<&[usize]>) -> Value {
        match (&self.classes[self.class(run)].axes[axis].distribution, of_grid) {
            (Distribution::Grid { values }, Some(of_grid)) => values[of_grid[axis]].clone(),
            (distribution, _) => distribution.value(self.unit(run, axis, attempt)),
        }
    }

    /// Which value of each grid a run takes: they are walked through in order, the last one changing from run to run,
    /// whatever the attempt. `None` where its labels are held out.
    fn of_grid(&self, run: usize) -> Option<Vec<usize>> {
        let Place { class, number } = self.places[run];
        let class = &self.classes[class as usize];
        let mut rest = number as usize % class.combinations;
        let mut of_grid = vec![0; class.axes.len()];
        for (k, axis) in class.axes.iter().enumerate().rev() {
            if let Distribution::Grid { values } = &axis.distribution {
                of_grid[k] = rest % values.len();
                rest /= values.len();
            }
        }
        (number != APART).then_some(of_grid)
    }

    /// What run `run` draws at its `attempt`-th time, over the base scenario's text.
    fn draw(&self, base: &str, run: usize, attempt: u64) -> Result<Draw, Vec<Problem>> {
        let c = self.class(run);
        let class = &self.plan.classes[c];
        let drawn = self.values(run, attempt);
        let mut next = drawn.iter();
        let record: Vec<String> = self.plan.signals.iter().map(|name| quote(name)).collect();
        let record = format!("[{}]", record.join(", "));
        let mut settings = vec![("simulation.record".to_owned(), record)];
        for template in [&self.plan.vary, &class.vary] {
            for (path, template) in template.settings() {
                settings.push((path, template.toml(&mut next)));
            }
        }
        if let Some(defects) = &class.defects {
            let damage = defects.toml(&mut next);
            settings.extend(damage_of(bearings_of(base)?, class.bearing, damage));
        }
        let seeds = self.seeds(base, &settings, run).map_err(no_place)?;
        settings.extend(seeds);
        let mut values = vec![None; self.parameters.len()];
        for (axis, value) in self.classes[c].axes.iter().zip(drawn) {
            values[axis.parameter] = Some(value);
        }
        Ok(Draw { class: c, settings, values, redrawn: attempt })
    }

    /// Seeds of the keys in [`SEEDED_PER_RUN`].
    fn seeds(
        &self,
        base: &str,
        settings: &[(String, String)],
        run: usize,
    ) -> Result<Vec<(String, String)>, Vec<Problem>> {
        let root = Node::table(parse(base, settings)?);
        let mut seeds = Vec::new();
        for seeded in &SEEDED_PER_RUN {
            let mut holders = Vec::new();
            holding(&root, seeded.table, seeded.with, "", &mut holders);
            for holder in holders {
                let key = seeded.key(&holder);
                if !self.sets(self.class(run), &key) {
                    let own = seed(self.own_bits(run, &[word(&key)]));
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
        self.plan.vary.sets(key) || class.vary.sets(key) || in_class.is_some_and(|(rest, defects)| defects.sets(rest))
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
            let draw = self.draw(base, run, attempt).map_err(|problems| (problems, None))?;
            match read(base, &draw.settings) {
                Ok(loaded) => return Ok((loaded, draw)),
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

/// Paths of the tables that a pattern names and that have one of the keys `with`.
fn holding(node: &Node, pattern: &str, with: &[&str], path: &str, all: &mut Vec<String>) {
    let join = |name: &str| {
        if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
    };
    let Some((head, rest)) = pattern.split_once('.').or((!pattern.is_empty()).then_some((pattern, ""))) else {
        if let Toml::Table(table) = &node.value
            && (with.is_empty() || with.iter().any(|key| table.contains_key(*key)))
        {
            all.push(path.to_owned());
        }
        return;
    };
    match &node.value {
        Toml::Array(items) if head == "*" => {
            for (k, item) in items.iter().enumerate() {
                holding(item, rest, with, &join(&k.to_string()), all);
            }
        }
        Toml::Table(table) => {
            if let Some(entry) = table.get(head) {
                holding(&entry.node, rest, with, &join(head), all);
            }
        }
        _ => {}
    }
}
