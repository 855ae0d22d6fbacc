//! A file that somebody wrote by hand, read whole.

use std::io::{Error, ErrorKind, Read, Result};

/// Largest text that is read, bytes: nobody writes longer ones, and a device file never ends.
const LARGEST: u64 = 64 << 20;

/// Everything of a scenario or a plan.
///
/// # Errors
/// Where it cannot be read, or is larger than 64 MiB.
pub fn read_text(source: impl Read) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(LARGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        let why = format!(
            "larger than {} MiB; a scenario or a plan is a text file of a few kilobytes",
            LARGEST >> 20
        );
        return Err(Error::new(ErrorKind::FileTooLarge, why));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_what_never_ends_is_refused() {
        assert_eq!(read_text(&b"a = 1"[..]).unwrap(), b"a = 1");
        let error = read_text(std::io::repeat(b'#')).unwrap_err();
        assert!(error.to_string().starts_with("larger than 64 MiB"));
    }
}
