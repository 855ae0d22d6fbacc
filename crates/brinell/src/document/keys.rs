//! The vocabulary in which [`super::sections`] lists the keys of a scenario, once.
//!
//! A listing is a walk: it names each key with its meaning, unit, range and default, and hands over the field that
//! holds its value. Whoever implements [`Keys`] decides what the walk does: read the field from TOML, write it, or
//! describe it. Keys are visited in order, so a default may be computed from the fields before it.

use super::spec::Spec;
use super::value_type::ValueType;
use crate::bearing::clearance::ClearanceClass;
use crate::scenario::Laws;

/// Where the defaults come from that the model states.
pub(super) const PAPER: &str = "Li et al. 2023";

/// What replaces a key that the file leaves out.
#[derive(Debug, Clone)]
pub enum Fallback<T> {
    /// Nothing: the key must be given.
    Required,
    /// Only a catalogue bearing.
    Catalogued,
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

pub(crate) fn derived<T>(value: T, how: &'static str) -> Fallback<T> {
    Fallback::Derived { value, how }
}

/// A default that was not given: it goes on the assumption sheet.
pub(crate) fn assumed<T>(value: T, why: &'static str) -> Fallback<T> {
    Fallback::Fixed { value, why, assumed: true }
}

/// A default that the source of the model states, or that is no statement about the bearing.
pub fn stated<T>(value: T, why: &'static str) -> Fallback<T> {
    Fallback::Fixed { value, why, assumed: false }
}

impl<T> Fallback<T> {
    /// The same with another value, where there is one.
    pub(crate) fn map<U>(self, change: impl FnOnce(T) -> U) -> Fallback<U> {
        match self {
            Self::Required => Fallback::Required,
            Self::Catalogued => Fallback::Catalogued,
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
            Self::Required | Self::Catalogued | Self::Needed(_) => None,
        }
    }
}

/// One of the alternatives of [`Keys::one_of`].
pub struct Variant<T> {
    pub(crate) name: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) blank: fn() -> T,
    /// Whether a value is this alternative.
    pub(crate) is: fn(&T) -> bool,
}

/// The alternative that `value` is.
pub(crate) fn variant_of<T>(variants: &'static [Variant<T>], value: &T) -> &'static Variant<T> {
    variants.iter().find(|variant| (variant.is)(value)).unwrap_or(&variants[0])
}

/// Whether a key has a meaning here, and the words for where it has one.
pub type Case = (bool, &'static str);

/// A walk over the keys of a scenario.
pub trait Keys: Sized {
    /// A key with one value.
    fn key<T: ValueType>(&mut self, spec: Spec, fallback: Fallback<T>, value: &mut T);

    /// A key that may be absent, which then means something of its own.
    fn optional<T: ValueType>(&mut self, spec: Spec, value: &mut Option<T>);

    /// A key that is required where `wanted`, and has no meaning elsewhere; `case` says where.
    fn only_where<T: ValueType>(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut T);

    /// A key with a default in a case, and without a meaning elsewhere.
    fn key_where<T: ValueType>(&mut self, spec: Spec, case: Case, fallback: Fallback<T>, value: &mut T);

    /// A key with a default that acts in a case; elsewhere it has no effect, which is said of a file that gives it.
    fn key_acting_where<T: ValueType>(&mut self, spec: Spec, case: Case, fallback: Fallback<T>, value: &mut T) {
        self.key_where(spec, case, fallback, value);
    }

    /// The value of a key of a later section, before the walk is there: `None` where it is known already or the file
    /// does not give it.
    fn foretold<T: ValueType>(&mut self, _section: &str, _name: &'static str) -> Option<T> {
        None
    }

    /// Whether the file gives a key of a section, readable or not; `None` in a walk that reads no file.
    fn gives(&self, _section: &str, _name: &str) -> Option<bool> {
        None
    }

    /// The key that names the catalogue bearing, whose values replace keys left out after it: those that hold with these
    /// laws.
    fn preset(&mut self, spec: Spec, _laws: Laws, value: &mut Option<String>) {
        self.optional(spec, value);
    }

    /// The class of clearance that the catalogue bearing's name gives.
    fn named_clearance(&self) -> Option<ClearanceClass> {
        None
    }

    /// A table of keys.
    fn section(&mut self, spec: Spec, keys: impl FnMut(&mut Self));

    /// Any number of tables.
    fn tables<T>(&mut self, spec: Spec, items: &mut Vec<T>, blank: fn() -> T, keys: impl FnMut(&mut Self, &mut T));

    /// A table with exactly one of several keys, each a table.
    fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        value: &mut T,
        keys: impl FnMut(&mut Self, &mut T),
    );
}
