//! What is between the numbers of a text file, and within them.

use memchr::memchr_iter;

/// What is between the numbers of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Delimiter {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
    /// Any number of spaces and tabs.
    Blanks,
}

impl Delimiter {
    /// Its byte; a space for [`Delimiter::Blanks`].
    pub(super) fn sign(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Blanks => b' ',
        }
    }

    /// What is between delimiters, whole where it is in quotes.
    pub(super) fn fields(self, line: &[u8]) -> impl Iterator<Item = &[u8]> {
        let blanks = self == Self::Blanks;
        // A single quote sign, as of inches, is none about a field.
        let in_pairs = memchr_iter(b'"', line).count().is_multiple_of(2);
        let mut quoted = false;
        let ends = move |b: &u8| {
            quoted ^= *b == b'"' && in_pairs;
            !quoted && (*b == self.sign() || blanks && *b == b'\t')
        };
        line.split(ends).filter(move |field| !(blanks && field.is_empty()))
    }
}

/// What is before a number's fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Decimal {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

/// What a text file's header says; what is `None` is found out from its numbers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TextFormat {
    pub(super) delimiter: Option<Delimiter>,
    pub(super) decimal: Option<Decimal>,
}
