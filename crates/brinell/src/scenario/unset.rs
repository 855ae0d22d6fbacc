//! A scenario without values: where a walk over the keys starts from.

use super::choices::Choice;

/// What stands in for a value that could not be read or is not given: no check objects to it.
pub trait Unset {
    /// Such a value. Numbers are NaN, so that no problem is reported of what is computed from them.
    fn unset() -> Self;
}

/// Defines structs and makes them [`Unset`]; all their fields must be.
macro_rules! sections {
    ($($(#[$about:meta])* pub struct $name:ident { $($(#[$doc:meta])* pub $field:ident: $type:ty,)+ })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name {
            $($(#[$doc])* pub $field: $type,)+
        }

        impl $crate::scenario::Unset for $name {
            fn unset() -> Self {
                Self { $($field: $crate::scenario::Unset::unset()),+ }
            }
        }

        #[cfg(test)]
        impl $name {
            pub(crate) const FIELDS: &'static [&'static str] = &[$(stringify!($field)),+];
        }
    )+};
}
pub(crate) use sections;

/// Values of types that stand for themselves.
macro_rules! unset {
    ($($type:ty: $value:expr;)+) => {$(
        impl $crate::scenario::Unset for $type {
            fn unset() -> Self {
                $value
            }
        }
    )+};
}
pub(crate) use unset;

unset! {
    f64: f64::NAN;
    usize: 0;
    u64: 0;
    bool: false;
    String: String::new();
}

impl<T: Choice> Unset for T {
    fn unset() -> Self {
        T::WORDS[0].1
    }
}

impl<T> Unset for Option<T> {
    fn unset() -> Self {
        None
    }
}

impl<T> Unset for Vec<T> {
    fn unset() -> Self {
        Vec::new()
    }
}

impl<T: Unset, const N: usize> Unset for [T; N] {
    fn unset() -> Self {
        std::array::from_fn(|_| T::unset())
    }
}
