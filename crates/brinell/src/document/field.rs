//! Fields of a scenario without their types, as walks over its keys see them.

use super::source::Node;
use super::spec::Spec;
use super::value_type::{Misfit, ValueType};
use serde_json::Value as Json;

/// Words that a kind of value has for a key.
pub(super) type Words = fn(&Spec) -> String;

/// What a kind of value says of a key.
#[derive(Clone, Copy)]
pub struct Kind {
    /// See [`ValueType::expected`].
    pub expected: Words,
    /// See [`ValueType::range`].
    pub range: Words,
    /// See [`ValueType::schema`].
    pub schema: fn(&Spec) -> Json,
}

/// A field that holds the value of a key: a [`ValueType`].
pub trait Field {
    /// Of what kind its value is.
    fn kind(&self) -> Kind;
    /// Holds what a node says; as before where that does not fit.
    ///
    /// # Errors
    /// Where it does not fit.
    fn read(&mut self, node: &Node, spec: &Spec) -> Result<(), Misfit>;
    /// How what a node says would be written.
    ///
    /// # Errors
    /// Where it does not fit.
    fn as_written(&self, node: &Node, spec: &Spec) -> Result<String, Misfit>;
    /// Holds nothing that can be computed with.
    fn unset(&mut self);
    /// See [`ValueType::node`].
    fn node(&self) -> Node;
    /// See [`ValueType::write`].
    fn write(&self) -> String;
    /// See [`ValueType::fits`].
    fn fits(&self, spec: &Spec) -> bool;
    /// See [`ValueType::is_defined`].
    fn is_defined(&self) -> bool;
}

impl<T: ValueType> Field for T {
    fn kind(&self) -> Kind {
        Kind { expected: T::expected, range: T::range, schema: T::schema }
    }

    fn read(&mut self, node: &Node, spec: &Spec) -> Result<(), Misfit> {
        *self = T::read(node, spec)?;
        Ok(())
    }

    fn as_written(&self, node: &Node, spec: &Spec) -> Result<String, Misfit> {
        Ok(T::read(node, spec)?.write())
    }

    fn unset(&mut self) {
        *self = T::unset();
    }

    fn node(&self) -> Node {
        ValueType::node(self)
    }

    fn write(&self) -> String {
        ValueType::write(self)
    }

    fn fits(&self, spec: &Spec) -> bool {
        ValueType::fits(self, spec)
    }

    fn is_defined(&self) -> bool {
        ValueType::is_defined(self)
    }
}
