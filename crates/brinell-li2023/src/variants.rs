//! What the paper does not state, and where the baseline departs from what it does (start, film): one change at a time, in
//! every case. They are in `variants.toml`.

use crate::outline::Outline;
use crate::reading::Reading;
use serde::Deserialize;
use std::sync::LazyLock;

/// One assumption made otherwise, in every case.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Variant {
    /// How files call it.
    pub id: &'static str,
    /// Which assumption it is about, as tables say it.
    pub about: &'static str,
    /// In words; those of its outline where it has none of its own.
    #[serde(default)]
    pub words: &'static str,
    /// Key and value.
    #[serde(default)]
    pub settings: Vec<(&'static str, &'static str)>,
    /// How Eq. (27) is read.
    #[serde(default)]
    pub outline: Outline,
    /// How RMS and peak to peak are read off the runs.
    #[serde(default)]
    pub reading: Reading,
}

impl Variant {
    /// Whether it changes one assumption: not none, and not more than what it is about.
    pub(crate) fn changes_one(&self) -> bool {
        let none = self.settings.is_empty() && self.outline == Outline::Joined && self.reading == Reading::USUAL;
        !none && self.about != SEVERAL && !MORE.contains(&self.id)
    }
}

/// What variants of several assumptions are about.
const SEVERAL: &str = "several at once";

/// Variants that change another assumption with the one that they are about.
const MORE: [&str; 2] = ["start-rest-no-ramp", "outer-hard"];

/// The film of Eq. (42).
pub(crate) const PRINTED_FILM: (&str, &str) = ("cage.guidance_film", "quasi-static");

/// Every variant; the first changes nothing, at the length of the others. Those of filter and record need no run of
/// their own.
pub(crate) static VARIANTS: LazyLock<Vec<Variant>> = LazyLock::new(|| {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
    struct File {
        variant: Vec<Variant>,
    }
    let mut file: File = crate::data("variants.toml", include_str!("variants.toml"));
    for variant in file.variant.iter_mut().filter(|variant| variant.words.is_empty()) {
        variant.words = variant.outline.words();
    }
    file.variant
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_variants_of_none_or_several_changes_are_known() {
        let others = VARIANTS.iter().filter(|variant| !variant.changes_one());
        let wanted = [
            "baseline",
            "start-rest-no-ramp",
            "together-start-up",
            "together-palmgren",
            "together-no-ramp",
            "outer-hard",
            "paper-4-1",
        ];
        assert_eq!(others.map(|variant| variant.id).collect::<Vec<_>>(), wanted);
    }
}
