//! From families to a verdict: which of them is damage, and which merely shares another's lines.

use super::elsewhere::{Elsewhere, SIDES, SLOWER, Search, slower_comb};
use super::family::{AHEAD, DEEP, FAINT, Family, Finding, at_slip, cage, lag, read, score};
use super::frequencies::Component;
use super::known_lines::near_multiple;
use super::spacing::of_other_shaft;
use super::together::{Envelopes, SUPPLY_KNOWN, Shaft, Together};
use super::{AnalysisError, Options};

/// Harmonics of a race that shaft or mains hide from which it may be damaged unseen.
const HIDDEN: usize = 2;
/// Lead in score that an element needs over the races: its sidebands at the cage's frequency reach most lines.
const LEAD: f64 = 2.0;
/// How far BPFO + BPFI of two damaged races may lie from so many times the shaft's speed as there are elements,
/// relative.
const ONE_SLIP: f64 = 0.002;
/// Bins within which two lines are one: half the main lobe of Hann's window.
const ONE_LINE: f64 = 2.0;
/// Turns of the cage from which sidebands at its frequency are told from other lines: in a shorter record they fill the
/// spectrum.
pub(super) const TELLING: f64 = 20.0;
/// The same for the cage's own lines.
pub(super) const TELLING_CAGE: f64 = 40.0;

/// What was looked at, how long the shortest record is, and what was found.
pub(super) struct Record {
    pub(super) together: Together,
    revolutions: f64,
    /// Shaft speed, Hz.
    pub(super) shaft: f64,
    /// Whether lines of the shaft told it.
    by_lines: bool,
    pub(super) options: Options,
    /// Those that are damage first, the one that leads before the others.
    pub(super) families: Vec<Family>,
    /// Where there is one, nothing is damage.
    pub(super) elsewhere: Option<Elsewhere>,
}

impl Record {
    pub(super) fn of(envelopes: &Envelopes, known: Shaft, options: &Options) -> Result<Self, AnalysisError> {
        let mut record = Record {
            together: Together::of(envelopes, known, options)?,
            revolutions: envelopes.shortest() * known.hz,
            shaft: known.hz,
            by_lines: known.tolerance > 0.0,
            options: options.clone(),
            families: Vec::new(),
            elsewhere: None,
        };
        (record.families, record.elsewhere) = record.judge();
        Ok(record)
    }

    /// Whether a family is damage.
    pub(super) fn is_damage(&self) -> bool {
        self.lead().is_some()
    }

    /// The family that leads, where one is damage.
    pub(super) fn lead(&self) -> Option<&Family> {
        (self.families.iter()).find(|f| f.finding == Finding::Damage)
    }

    /// Score of the family that leads or, where none is damage, of the highest: the first is more.
    pub(super) fn evidence(&self) -> (bool, f64) {
        let damage = self.is_damage();
        let these = (self.families.iter()).filter(|f| !damage || f.finding == Finding::Damage);
        let highest = these.map(|f| f.score).reduce(f64::max);
        (damage, highest.unwrap_or(0.0))
    }

    fn judge(&mut self) -> (Vec<Family>, Option<Elsewhere>) {
        let mut all = read(&self.together, self.shaft, &self.options);
        let mut undecided = f64::NEG_INFINITY;
        for family in all.iter_mut().filter(|f| f.finding == Finding::Damage) {
            if self.is_short_for(family.component) {
                family.finding = Finding::Open;
                if family.component == Component::Element {
                    undecided = family.score;
                }
            }
        }
        one_slip(&mut all, self.shaft, self.options.tolerance);
        self.within_first(&mut all);
        let mut lead = leading(&all, self.options.exact);
        // A damaged element's sidebands reach the races' lines.
        let is_open = lead.is_some_and(|k| !is_turning(all[k].component) && undecided > all[k].score + LEAD);
        let mut elsewhere = if is_open { None } else { self.search().comb(lead.map(|k| &all[k])) };
        if let Some(slips) = elsewhere.and_then(|comb| self.by_slip(&comb, &mut all)) {
            (lead, elsewhere) = (Some(slips), None);
        }
        if let Some(lead) = lead.filter(|_| elsewhere.is_none() && !self.options.exact) {
            all[lead].others_slip = self.others_slip(&all[lead]);
            // A cage that slips has sidebands at a speed of its own.
            if all[lead].others_slip.is_none() {
                all[lead].other_spacing = of_other_shaft(&self.together, &all[lead], self.shaft, &self.options);
            }
        }
        let is_open = is_open || all.iter().any(Family::may_be_anothers);
        let Some(lead) = lead.filter(|_| elsewhere.is_none() && !is_open) else {
            for family in all.iter_mut().filter(|f| f.finding == Finding::Damage) {
                family.finding = Finding::Open;
            }
            slipped(&mut all, self.options.tolerance);
            if elsewhere.is_none() {
                self.masked(&mut all);
                // A wrong speed, or another part's: a sound bearing has no such lines of its own.
                let beyond = |f: &&mut Family| f.finding == Finding::Silent && f.is_damage_beyond();
                all.iter_mut().filter(beyond).for_each(|f| f.finding = Finding::Open);
            }
            all.sort_by(|a, b| b.score.total_cmp(&a.score));
            return (all, elsewhere);
        };
        let lead = all.remove(lead);
        self.at_slip_of(&lead, &mut all);
        self.share(&lead, &mut all);
        let rank = |f: &Family| match f.finding {
            Finding::Damage => 0,
            _ => 1,
        };
        all.sort_by(|a, b| rank(a).cmp(&rank(b)).then(b.score.total_cmp(&a.score)));
        all.insert(0, lead);
        // What causes an impact once a turn of the cage is one element on its way through the load, more often than the
        // cage.
        if all[0].component == Component::Cage && self.options.orders.bsf.is_some() {
            all[0].component = Component::Element;
        }
        (all, None)
    }

    /// The slip s of the cage at which an element's lines lie where an outer race's do, or the reverse: that makes
    /// BPFO (1 - s) and 2 BSF (1 + s f_c / (f_s - f_c)). In many cylindrical roller bearings 2 BSF lies a few per cent
    /// below BPFO. An element has sidebands at the cage's frequency, so what has none is the race's.
    fn others_slip(&self, lead: &Family) -> Option<f64> {
        let (orders, order) = (&self.options.orders, lead.frequency / self.shaft);
        let turns = cage(1.0, &self.options);
        let slip = match lead.component {
            Component::OuterRace => (order / (2.0 * orders.bsf?) - 1.0) * (1.0 - turns) / turns,
            Component::Element => 1.0 - order / orders.bpfo?,
            Component::InnerRace | Component::Cage => return None,
        };
        // An element's rate is sought as far ahead.
        if !(-AHEAD..=2.0 * self.options.tolerance).contains(&slip) {
            return None;
        }
        let spacing = (1.0 - slip) * turns * self.shaft;
        let could_be = lead.component == Component::Element || lead.could_be_elements(&self.together, spacing);
        could_be.then_some(slip)
    }

    fn search(&self) -> Search<'_> {
        let Record { together, shaft, by_lines, options, .. } = self;
        Search { together, shaft: *shaft, by_lines: *by_lines, options }
    }

    /// The race whose lines a comb elsewhere is where the cage slips, if it is deep damage there: slip of the cage goes
    /// farther than the tolerance, one way. Only where the shaft's speed is known does a shift say so, and where lines
    /// of the cage do not say otherwise. An element's lines there are other bearings' more often.
    fn by_slip(&self, comb: &Elsewhere, all: &mut [Family]) -> Option<usize> {
        let options = &self.options;
        if !self.by_lines && options.rotation.is_none() && !options.measured_speed || options.is_other_speed(self.shaft)
        {
            return None;
        }
        let there = |f: &Family| at_slip(&self.together, self.shaft, options, f, comb.frequency / f.expected - 1.0);
        let slips = |f: &Family| {
            let is_race = !is_turning(f.component) && lag(f.component, f.shift(), options).is_some();
            is_race && f.is_damage() && f.modulation >= DEEP
        };
        let mut found = all.iter().map(there).enumerate().filter(|(_, f)| slips(f));
        let (k, family) = found.next().filter(|_| found.next().is_none())?;
        let cage = all.iter().find(|f| f.component == Component::Cage).cloned();
        let mut both: Vec<Family> = cage.into_iter().chain([family]).collect();
        one_slip(&mut both, self.shaft, options.tolerance);
        let family = both.pop().filter(|f| f.finding == Finding::Damage)?;
        all[k] = family;
        Some(k)
    }

    /// The cage carries the elements past an outer race at rest, so its lines are where BPFO's slip puts them: what is
    /// higher beside them is somebody else's. BPFI has the error of the speed too, and says less.
    fn at_slip_of(&self, lead: &Family, others: &mut [Family]) {
        if lead.component != Component::OuterRace {
            return;
        }
        for family in others.iter_mut().filter(|f| f.component == Component::Cage) {
            *family = at_slip(&self.together, self.shaft, &self.options, family, lead.shift());
        }
    }

    /// Whether the highest line of a family is a harmonic of the one that leads.
    fn is_of(&self, lead: &Family, family: &Family) -> bool {
        family
            .highest_line()
            .is_some_and(|line| near_multiple(line.frequency, lead.frequency, ONE_LINE * self.together.step()))
    }

    /// Families that share the lines of the one that leads, or are not damage in what those leave.
    fn share(&mut self, lead: &Family, others: &mut [Family]) {
        self.take_out(lead.frequency);
        let left = read(&self.together, self.shaft, &self.options);
        // Frequencies that slip may bring together are not told apart.
        let apart = |f: &Family| (f.expected / lead.expected - 1.0).abs() > 2.0 * self.options.tolerance;
        for family in others {
            let own = left.iter().find(|f| f.name == family.name);
            let stays = self.is_beside(lead, family) && own.is_some_and(Family::is_damage) && apart(family);
            let gone = own.is_none_or(|f| f.detected_harmonics() == 0);
            let shared = match family.finding {
                Finding::Damage | Finding::Open => family.component == Component::Cage || !stays,
                _ => family.detected_harmonics() > 0 && (gone || self.is_of(lead, family)),
            };
            if shared {
                family.finding = Finding::Shared(lead.name);
            }
        }
    }

    /// Where lines of shaft or mains hide a race's, nothing tells them apart. Those that would be damage are open,
    /// unless a slower comb is as high: then they are that one's.
    fn masked(&mut self, all: &mut [Family]) {
        let Record { together, shaft, options, .. } = self;
        let (shaft, options) = (*shaft, &*options);
        let revealed = together.revealed(|together| {
            let races = read(together, shaft, options).into_iter().filter(|f| !is_turning(f.component));
            let most = |f: &Family| SLOWER.max((f.frequency / shaft).round() as usize);
            let is_own = |f: &Family| slower_comb(f, most(f), |f| score(together, f)).is_none();
            // Those of the supply are known to be there.
            let of_supply = |f: f64| options.supply.is_some_and(|hz| near_multiple(f, hz, SUPPLY_KNOWN * f));
            races.filter(|f| f.is_damage() && is_own(f) && !of_supply(f.frequency)).collect::<Vec<_>>()
        });
        for mut race in revealed {
            let hidden = race.harmonics.iter().filter(|h| together.at(h.frequency).ratio.is_none());
            let Some(seen) = all.iter_mut().find(|f| f.name == race.name && f.finding != Finding::Open) else {
                continue;
            };
            if hidden.count() >= HIDDEN {
                race.masked = true;
                race.finding = Finding::Open;
                *seen = race;
            }
        }
    }

    /// Whether a family may be a second damage: the other race's where a race leads, at the same slip. All turn by
    /// that: BPFO + BPFI = Z f_shaft. An element strikes both races and carries the cage along, so that sums of its
    /// rates reach all lines of the bearing; in measured records it is not found beside a race.
    fn is_beside(&self, lead: &Family, family: &Family) -> bool {
        // At a speed farther off than the tolerance one part is as much as can be said.
        if self.options.is_other_speed(self.shaft) && self.options.rotation.is_none() {
            return false;
        }
        let most = if self.by_lines || self.options.exact { ONE_SLIP } else { self.options.tolerance };
        let sum = (lead.frequency + family.frequency) / (lead.expected + family.expected);
        ![lead, family].iter().any(|f| is_turning(f.component)) && (sum - 1.0).abs() <= most
    }

    /// Slip beyond the tolerance, as a simulation may have, explains a race's comb only where nothing within it is
    /// damage: BPFI less twice the shaft's frequency is a few per cent below BPFO, and so may 2 BSF be, which a short
    /// record leaves open.
    fn within_first(&self, all: &mut [Family]) {
        let is_near = |f: &Family| f.shift().abs() <= self.options.tolerance;
        let called = |f: &Family| f.finding == Finding::Damage && f.component != Component::Cage;
        let is_open = |f: &Family| f.finding == Finding::Open && f.component == Component::Element && f.is_damage();
        let near = all.iter().filter(|f| (called(f) || is_open(f)) && is_near(f));
        let Some(name) = near.max_by(|a, b| a.score.total_cmp(&b.score)).map(|f| f.name) else {
            return;
        };
        for far in all.iter_mut().filter(|f| called(f) && !is_near(f)) {
            far.finding = Finding::Shared(name);
        }
    }

    /// Whether the record holds so few turns of the cage that a rolling element's sidebands, or the cage's lines, are
    /// not told from others.
    fn is_short_for(&self, component: Component) -> bool {
        let needed = match component {
            Component::OuterRace | Component::InnerRace => 0.0,
            Component::Element => TELLING,
            // In a simulation nothing else turns at a frequency so low.
            Component::Cage if self.options.exact => 0.0,
            Component::Cage => TELLING_CAGE,
        };
        self.revolutions * cage(self.shaft, &self.options) < needed * self.shaft
    }

    /// Harmonics of a frequency and their sidebands are nobody's from now on. Sums of shaft and cage are not taken:
    /// nine elements pass the inner race at nine times the shaft's frequency less that at which they pass the outer
    /// one, and the cage turns at two fifths of it or so, so that their places are those of the other race's lines.
    fn take_out(&mut self, frequency: f64) {
        let sides = [self.shaft, cage(self.shaft, &self.options)];
        let most = self.together.top();
        let mut k = 0.0;
        while k * frequency < most + f64::from(SIDES) * self.shaft {
            for side in sides {
                for a in -SIDES..=SIDES {
                    let at = k * frequency + f64::from(a) * side;
                    if (0.0..most).contains(&at) {
                        self.together.hide(at);
                    }
                }
            }
            k += 1.0;
        }
    }
}

/// The cage carries the elements past both races: the slip s of FTF is that of BPFO, and BPFI has -s f_c/(f_s - f_c). A
/// race's comb farther than the tolerance from where a cage that is clear of the noise puts it is somebody else's: of a
/// damaged element where 2 BSF lies a few per cent below BPFO.
fn one_slip(all: &mut [Family], shaft: f64, tolerance: f64) {
    let cage = all.iter().find(|f| {
        f.component == Component::Cage && f.score > f.limit && f.modulation >= FAINT && f.detected_harmonics() >= 3
    });
    let Some((name, slip, turns)) = cage.map(|f| (f.name, f.shift(), f.expected)) else {
        return;
    };
    for race in all.iter_mut().filter(|f| f.finding == Finding::Damage) {
        let due = match race.component {
            Component::OuterRace => slip,
            Component::InnerRace => -slip * turns / (shaft - turns),
            Component::Element | Component::Cage => continue,
        };
        if (race.shift() - due).abs() > tolerance {
            race.finding = Finding::Shared(name);
        }
    }
}

/// Lines at an element's rate without its sidebands are a race's that slips, where that scores more and its frequency
/// lies within the tolerances of both: what is open is then the race.
fn slipped(all: &mut [Family], tolerance: f64) {
    let Some(k) = all.iter().position(|f| f.finding == Finding::Open && f.lacks_sidebands()) else {
        return;
    };
    let (score, frequency) = (all[k].score, all[k].frequency);
    let is_its = |f: &&mut Family| {
        let near = (f.frequency / frequency - 1.0).abs() <= 2.0 * tolerance;
        near && !is_turning(f.component) && f.finding == Finding::Faint && f.is_whole() && f.score > score
    };
    if let Some(race) = all.iter_mut().find(is_its) {
        race.finding = Finding::Open;
        let name = race.name;
        all[k].finding = Finding::Shared(name);
    }
}

/// Whether the cage's lines may be a race's: elements that differ modulate its damage once a turn of the cage, and
/// where its own lines smear, as the speed varies, or are hidden, the cage's are left. A simulation has neither.
fn may_carry_cage(family: &Family) -> bool {
    !is_turning(family.component) && (family.score >= family.noise || family.hidden_harmonics() >= HIDDEN)
}

fn is_turning(component: Component) -> bool {
    matches!(component, Component::Element | Component::Cage)
}

/// The family that leads: the highest score; an element's or the cage's only with a lead over the races'.
fn leading(all: &[Family], exact: bool) -> Option<usize> {
    let highest = |of: &dyn Fn(Component) -> bool| {
        let these = (all.iter().enumerate()).filter(|(_, f)| f.finding == Finding::Damage && of(f.component));
        these.max_by(|a, b| a.1.score.total_cmp(&b.1.score))
    };
    let race = highest(&|c| !is_turning(c));
    // A damaged element shows at the cage's frequency too; at its own nothing else does.
    let cage = || highest(&|c| c == Component::Cage).filter(|_| exact || !all.iter().any(may_carry_cage));
    let turning = highest(&|c| c == Component::Element).or_else(cage);
    match (race, turning) {
        (Some(race), Some(turning)) if turning.1.score > race.1.score + LEAD => Some(turning.0),
        (Some(race), _) => Some(race.0),
        (None, turning) => turning.map(|t| t.0),
    }
}
