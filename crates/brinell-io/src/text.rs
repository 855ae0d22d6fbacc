//! Text files, size-limited.

use std::io::{Error, ErrorKind, Read, Result};

/// Largest text that is read, bytes: nobody writes longer ones, a device file never ends, and what is made of a text
/// takes a hundred times its room.
pub const LARGEST_TEXT: u64 = 4 << 20;

/// Everything of a scenario or a plan.
///
/// # Errors
/// Where it cannot be read, or is larger than [`LARGEST_TEXT`].
pub fn read_text(source: impl Read) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(LARGEST_TEXT + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST_TEXT {
        let why =
            format!("larger than {} MiB; a scenario or a plan is a text file of a few kilobytes", LARGEST_TEXT >> 20);
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
        assert!(error.to_string().starts_with("larger than 4 MiB"));
    }
}
