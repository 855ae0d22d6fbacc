//! What is between the numbers of a text file, and within them.

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

    /// What is between delimiters, whole where it begins with a quote (RFC 4180); a quote elsewhere is a sign, as of
    /// inches.
    pub(super) fn fields(self, line: &[u8]) -> impl Iterator<Item = &[u8]> {
        let blanks = self == Self::Blanks;
        let (mut quoted, mut begins) = (false, true);
        let ends = move |b: &u8| {
            let is_delimiter = *b == self.sign() || blanks && *b == b'\t';
            if quoted {
                // A doubled one goes on.
                (quoted, begins) = (*b != b'"', *b == b'"');
                return false;
            }
            quoted = *b == b'"' && begins;
            begins = is_delimiter || begins && *b == b' ';
            is_delimiter
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
