//! The vocabulary in which [`super::sections`] lists the keys of a scenario, once.
//!
//! A listing names each key with its meaning, unit, range and default, and hands over the field that holds its value to
//! the [`Walk`](super::walk::Walk) at hand. Keys are visited in order, so a default may be computed from the fields
//! before it.

use super::field::Field;
use super::spec::{Spec, key};
use super::value_type::ValueType;
use super::walk::{Offers, Tables};
use crate::scenario::Laws;

pub use super::walk::{Case, Fallback, Keys};

/// Where the defaults come from that the model states.
pub(super) const PAPER: &str = "Li et al. 2023";

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

/// One of the alternatives of `Keys::one_of`.
pub struct Variant<T> {
    pub(super) name: &'static str,
    pub(super) doc: &'static str,
    pub(super) blank: fn() -> T,
    /// Whether a value is this alternative.
    pub(super) is: fn(&T) -> bool,
}

impl Keys<'_> {
    /// A key with one value.
    pub fn key<T: ValueType>(&mut self, spec: Spec, fallback: Fallback<T>, value: &mut T) {
        with_own(fallback, value, |fallback, value| self.at_key(spec, fallback, value));
    }

    /// A key that may be absent, which then means something of its own.
    pub fn optional<T: ValueType>(&mut self, spec: Spec, value: &mut Option<T>) {
        let given = value.is_some();
        let mut held = value.take().unwrap_or_else(T::unset);
        *value = self.at_optional(spec, given, &mut held).then_some(held);
    }

    /// A key that is required where `wanted`, and has no meaning elsewhere; `case` says where.
    pub fn only_where<T: ValueType>(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut T) {
        self.at_only_where(spec, wanted, case, value);
    }

    /// A key with a default in a case, and without a meaning elsewhere.
    pub fn key_where<T: ValueType>(&mut self, spec: Spec, case: Case, fallback: Fallback<T>, value: &mut T) {
        with_own(fallback, value, |fallback, value| self.at_key_where(spec, case, fallback, value));
    }

    /// A key with a default that acts in a case; elsewhere it has no effect, which is said of a file that gives it.
    pub fn key_acting_where<T: ValueType>(&mut self, spec: Spec, case: Case, fallback: Fallback<T>, value: &mut T) {
        with_own(fallback, value, |fallback, value| self.at_key_acting_where(spec, case, fallback, value));
    }

    /// The value of a key of a later section, before the walk is there: `None` where it is known already or the file
    /// does not give it.
    pub fn foretold<T: ValueType>(&mut self, section: &str, name: &'static str) -> Option<T> {
        T::read(self.later(section, name)?, &key(name, "")).ok()
    }

    /// The key that names the catalogue bearing, whose values replace keys left out after it: those that hold with these
    /// laws.
    pub(super) fn preset(&mut self, spec: Spec, laws: Laws, value: &mut Option<String>) {
        self.optional(spec, value);
        self.after_preset(spec, laws, value);
    }

    /// A table of keys.
    pub fn section(&mut self, spec: Spec, mut keys: impl FnMut(&mut Keys)) {
        self.at_section(spec, &mut keys);
    }

    /// Any number of tables.
    pub fn tables<T>(&mut self, spec: Spec, items: &mut Vec<T>, blank: fn() -> T, keys: impl FnMut(&mut Keys, &mut T)) {
        self.at_tables(spec, &mut List { items, blank, keys });
    }

    /// A table with exactly one of several keys, each a table.
    pub fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        value: &mut T,
        keys: impl FnMut(&mut Keys, &mut T),
    ) {
        self.at_one_of(spec, &mut OneOf { variants, value, keys });
    }
}

/// Walks with a fallback that has lost its type, and gives the value its own where the walk says so.
fn with_own<T: ValueType>(
    fallback: Fallback<T>,
    value: &mut T,
    walk: impl FnOnce(Fallback<&dyn Field>, &mut dyn Field) -> bool,
) {
    let mut own = None;
    let held = &mut own;
    if walk(fallback.map(move |value| held.insert(value) as &dyn Field), value)
        && let Some(own) = own
    {
        *value = own;
    }
}

/// The tables of `Keys::tables`.
struct List<'a, T, F> {
    items: &'a mut Vec<T>,
    blank: fn() -> T,
    keys: F,
}

impl<T, F: FnMut(&mut Keys, &mut T)> Tables for List<'_, T, F> {
    fn count(&self) -> usize {
        self.items.len()
    }

    fn clear(&mut self) {
        self.items.clear();
    }

    fn walk(&mut self, i: usize, k: &mut Keys) {
        (self.keys)(k, &mut self.items[i]);
    }

    fn walk_new(&mut self, k: &mut Keys) {
        let mut item = (self.blank)();
        (self.keys)(k, &mut item);
        self.items.push(item);
    }

    fn walk_blank(&mut self, k: &mut Keys) {
        (self.keys)(k, &mut (self.blank)());
    }
}

/// The value of `Keys::one_of`.
struct OneOf<'a, T: 'static, F> {
    variants: &'static [Variant<T>],
    value: &'a mut T,
    keys: F,
}

impl<T, F: FnMut(&mut Keys, &mut T)> Offers for OneOf<'_, T, F> {
    fn all(&self) -> Vec<(&'static str, &'static str)> {
        self.variants.iter().map(|variant| (variant.name, variant.doc)).collect()
    }

    fn chosen(&self) -> usize {
        self.variants.iter().position(|variant| (variant.is)(self.value)).unwrap_or(0)
    }

    fn choose(&mut self, i: usize) {
        *self.value = (self.variants[i].blank)();
    }

    fn walk(&mut self, k: &mut Keys) {
        (self.keys)(k, self.value);
    }

    fn walk_blank(&mut self, i: usize, k: &mut Keys) {
        (self.keys)(k, &mut (self.variants[i].blank)());
    }
}
