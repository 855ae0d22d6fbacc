//! What is between the numbers of a text file, and within them.

/// What is between the numbers of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delimiter {
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
}

/// What is before a number's fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decimal {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

/// What a caller knows of a text file; what is `None` is found out from the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextFormat {
    /// Between numbers.
    pub delimiter: Option<Delimiter>,
    /// Within numbers.
    pub decimal: Option<Decimal>,
}
