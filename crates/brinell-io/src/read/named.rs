//! The channel that a user means: by name, by label, by number, or by words of one of them.

use super::{Channel, SignalFile, names};

/// Why a text names no channel, in words that go on after it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NotNamed(String);

impl SignalFile {
    /// The channel meant, with the name under which it is read. `text` is its name, its label, its number from 1, a
    /// column or row of a matrix such as `X(:,2)`, or whole words of one name or label alone: `DE` is `X098_DE_time`,
    /// and not `grade`; where none has the word, one that begins so, from three characters on. Words end at `_` and the
    /// like, between letters and digits, and where capitals begin or end.
    ///
    /// # Errors
    /// Where there is no such channel, or several are called like that: which there are.
    pub fn named(&self, text: &str) -> Result<(String, Channel), NotNamed> {
        let channels = self.channels();
        let whole = |c: &Channel| (c.name.clone(), c.clone());
        if let Some(found) = channels.iter().find(|c| c.name == text) {
            return Ok(whole(found));
        }
        let called: Vec<&Channel> = channels.iter().filter(|c| c.label.as_deref() == Some(text)).collect();
        if let [only] = called[..] {
            return Ok(whole(only));
        }
        if let Ok(number) = text.trim().parse::<usize>() {
            return self.numbered(text, number);
        }
        // `X(:,2)`: the reader takes it apart; rate and unit are the matrix's.
        if let Some(open) = text.rfind('(')
            && let Some(found) = channels.iter().find(|c| c.name == text[..open])
        {
            return Ok((text.to_owned(), found.clone()));
        }
        let said = |whole: bool| -> Vec<&Channel> {
            let says = |c: &&Channel| {
                let label = c.label.as_deref().unwrap_or_default();
                [c.name.as_str(), label].iter().any(|name| has_words(name, text, whole))
            };
            channels.iter().filter(|c| c.may_be_signal()).filter(says).collect()
        };
        let mut partly = said(true);
        if partly.is_empty() && text.trim().chars().count() >= LEAST_BEGINNING {
            partly = said(false);
        }
        match partly[..] {
            [only] => Ok(whole(only)),
            [] => Err(NotNamed(format!(
                "{} has no such channel, by name or by a word of one; there are {}",
                self.path().display(),
                listed(channels.iter())
            ))),
            _ => Err(NotNamed(format!("several channels are called like that: {}", listed(partly.into_iter())))),
        }
    }

    fn numbered(&self, text: &str, number: usize) -> Result<(String, Channel), NotNamed> {
        let (channels, path) = (self.channels(), self.path().display());
        if let [matrix] = channels
            && matrix.is_matrix()
        {
            return Err(NotNamed(format!(
                "{path} has one channel, the matrix `{0}`; its column {text} is called '{0}(:,{text})'",
                matrix.name
            )));
        }
        let found = number.checked_sub(1).and_then(|k| channels.get(k));
        found.map(|c| (c.name.clone(), c.clone())).ok_or_else(|| {
            NotNamed(format!(
                "{path} has {} channel(s); they count from 1: {}",
                channels.len(),
                listed(channels.iter())
            ))
        })
    }
}

/// Names with their labels, for a message.
fn listed<'a>(channels: impl Iterator<Item = &'a Channel>) -> String {
    names(channels.map(Channel::with_label))
}

/// Fewest characters of the beginning of a word: `acc` of `acceleration`. Two may be anybody's.
const LEAST_BEGINNING: usize = 3;

/// Whether `text` is in `name` from the beginning of a word on, and to the end of one if it has to be `whole`, whatever
/// the case.
fn has_words(name: &str, text: &str, whole: bool) -> bool {
    let (name, text): (Vec<char>, Vec<char>) = (name.chars().collect(), text.trim().chars().collect());
    let alike = |a: &char, b: &char| a.to_lowercase().eq(b.to_lowercase());
    let at = |k: usize| {
        let end = k + text.len();
        let ends = !whole || is_border(&name, end);
        is_border(&name, k) && ends && name[k..end].iter().zip(&text).all(|(a, b)| alike(a, b))
    };
    !text.is_empty() && text.len() <= name.len() && (0..=name.len() - text.len()).any(at)
}

/// Whether a word of `name` begins or ends before its `k`-th character.
fn is_border(name: &[char], k: usize) -> bool {
    if k == 0 || k >= name.len() {
        return true;
    }
    let (a, b) = (name[k - 1], name[k]);
    if !a.is_alphanumeric() || !b.is_alphanumeric() || a.is_numeric() != b.is_numeric() {
        return true;
    }
    // Of `DEtime` and `DETime` both are words: `DE`, and `Time`.
    let before = k >= 2 && name[k - 2].is_uppercase();
    let after = name.get(k + 1).is_some_and(|c| c.is_lowercase());
    match (a.is_uppercase(), b.is_uppercase()) {
        (false, true) => true,
        (true, false) => before,
        (true, true) => after,
        (false, false) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_a_part_of_a_name_is_whole_words_of_it() {
        for (name, text) in [
            ("X098_DE_time", "DE"),
            ("X098_DE_time", "de_time"),
            ("X098_DE_time", "098"),
            ("X098RPM", "rpm"),
            ("driveEnd", "drive"),
            ("driveEnd", "end"),
            ("DETime", "DE"),
            ("DEtime", "DE"),
            ("acc [g]", "acc"),
            ("Schwingung Süd", "süd"),
        ] {
            assert!(has_words(name, text, true), "{text} of {name}");
        }
        for (name, text) in
            [("grade_of_oil", "DE"), ("Drive", "d"), ("X098_DE_time", "D"), ("X1098", "98"), ("depth", "DE"), ("a", "")]
        {
            assert!(!has_words(name, text, true), "{text} of {name}");
        }
    }
}
