//! What a walk over the keys of a scenario does at each of them.
//!
//! Whoever implements [`Walk`] reads the fields from TOML, writes them, or describes them. A walk knows no types, so that
//! it and the listings are compiled once, and not each for the other.

use super::field::Field;
use super::source::Node;
use super::spec::Spec;
use crate::bearing::clearance::ClearanceClass;
use crate::scenario::Laws;

/// What replaces a key that the file leaves out.
#[derive(Debug, Clone)]
pub enum Fallback<T> {
    /// Nothing: the key must be given.
    Required,
    /// Only a catalogue bearing, or other keys: which, in words, or empty.
    Catalogued(&'static str),
    /// Nothing in the present case; says which case that is.
    Needed(&'static str),
    /// Computed from earlier keys; always an assumption.
    Derived {
        /// The value.
        value: T,
        /// The formula in words.
        how: &'static str,
    },
    /// Computed from another key that represents this one; it outranks the catalogue bearing.
    Instead {
        /// The value.
        value: T,
        /// From what, in words.
        how: &'static str,
        /// True where that key leaves a range.
        assumed: bool,
    },
    /// A fixed value.
    Fixed {
        /// The value.
        value: T,
        /// Why this one.
        why: &'static str,
        /// True where no source states it.
        assumed: bool,
    },
}

impl<T> Fallback<T> {
    /// The same with another value, where there is one.
    pub(crate) fn map<U>(self, change: impl FnOnce(T) -> U) -> Fallback<U> {
        match self {
            Self::Required => Fallback::Required,
            Self::Catalogued(or) => Fallback::Catalogued(or),
            Self::Needed(case) => Fallback::Needed(case),
            Self::Derived { value, how } => Fallback::Derived { value: change(value), how },
            Self::Instead { value, how, assumed } => Fallback::Instead { value: change(value), how, assumed },
            Self::Fixed { value, why, assumed } => Fallback::Fixed { value: change(value), why, assumed },
        }
    }

    /// The value, where there is one.
    pub(crate) fn value(self) -> Option<T> {
        match self {
            Self::Derived { value, .. } | Self::Instead { value, .. } | Self::Fixed { value, .. } => Some(value),
            Self::Required | Self::Catalogued(_) | Self::Needed(_) => None,
        }
    }
}

/// Whether a key has a meaning here, and the words for where it has one.
pub type Case = (bool, &'static str);

/// A walk over the keys of a scenario, as listings have it.
pub type Keys<'k> = dyn Walk + 'k;

/// What a walk does at each key.
pub trait Walk {
    /// A key with one value. True where the value is to be that of the fallback.
    fn at_key(&mut self, spec: Spec, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool;

    /// A key that may be absent, as it is where not `given`: whether it is there after the walk.
    fn at_optional(&mut self, spec: Spec, given: bool, value: &mut dyn Field) -> bool;

    /// See `Keys::only_where`.
    fn at_only_where(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut dyn Field);

    /// See `Keys::key_where`. True as of [`Walk::at_key`].
    fn at_key_where(&mut self, spec: Spec, case: Case, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool;

    /// See `Keys::key_acting_where`. True as of [`Walk::at_key`].
    fn at_key_acting_where(
        &mut self,
        spec: Spec,
        case: Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        self.at_key_where(spec, case, fallback, value)
    }

    /// What the file gives of a key of a later section.
    fn later(&self, _section: &str, _name: &str) -> Option<&Node> {
        None
    }

    /// Whether the file gives a key of a section, readable or not; `None` in a walk that reads no file.
    fn gives(&self, _section: &str, _name: &str) -> Option<bool> {
        None
    }

    /// After the key that names the catalogue bearing, whose values replace keys left out from here on: those that hold
    /// with these laws.
    fn after_preset(&mut self, _spec: Spec, _laws: Laws, _value: &mut Option<String>) {}

    /// The class of clearance that the catalogue bearing's name gives.
    fn named_clearance(&self) -> Option<ClearanceClass> {
        None
    }

    /// A table of keys.
    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys));

    /// Any number of tables.
    fn at_tables(&mut self, spec: Spec, items: &mut dyn Tables);

    /// A table with exactly one of several keys, each a table.
    fn at_one_of(&mut self, spec: Spec, value: &mut dyn Offers);
}

/// A list of tables.
pub trait Tables {
    /// How many there are.
    fn count(&self) -> usize;
    /// Leaves none.
    fn clear(&mut self);
    /// Walks over the keys of table `i`.
    fn walk(&mut self, i: usize, k: &mut Keys);
    /// Walks over those of a blank one, and adds it.
    fn walk_new(&mut self, k: &mut Keys);
    /// Walks over those of a blank one.
    fn walk_blank(&mut self, k: &mut Keys);
}

/// A value that is one of several alternatives, each with keys of its own.
pub trait Offers {
    /// Name and meaning of each alternative.
    fn all(&self) -> Vec<(&'static str, &'static str)>;
    /// Number of the one that the value is.
    fn chosen(&self) -> usize;
    /// Makes it alternative `i`, blank.
    fn choose(&mut self, i: usize);
    /// Walks over its keys.
    fn walk(&mut self, k: &mut Keys);
    /// Walks over those of a blank alternative `i`.
    fn walk_blank(&mut self, i: usize, k: &mut Keys);
}
