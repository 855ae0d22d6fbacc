//! What the studio's server gives to one client at most; `messages.md` of `crates/brinell-studio` states it.

use std::time::Duration;

/// Connections at a time: a browser opens six. For one more, the one that has waited for its client the longest is closed.
pub(super) const CONNECTIONS: usize = 32;
/// Pages that have an engine at a time. One more gets the place of the page that has asked for nothing the longest.
pub(super) const PAGES: usize = 4;
/// Longest head of a request, bytes.
pub(super) const HEAD: usize = 16 << 10;
/// Most header fields.
pub(super) const FIELDS: usize = 64;
/// Longest body, bytes: a photo, or a measured signal.
pub(super) const BODY: u64 = 256 << 20;
/// For a whole head. A browser opens connections before it needs them; they hold no place for longer.
pub(super) const HEAD_TIME: Duration = Duration::from_secs(2);
/// For a whole body, and for the client to take a whole reply: a page on this machine takes less than a second.
pub(super) const BODY_TIME: Duration = Duration::from_secs(30);

#[cfg(test)]
mod tests {
    use super::*;

    /// The page that describes the server's messages says what is here.
    #[test]
    fn prop_the_limits_are_those_that_are_documented() {
        let words = include_str!("../../../brinell-studio/messages.md").replace('\n', " ");
        for stated in [
            format!("{CONNECTIONS} connections"),
            format!("{PAGES} pages"),
            format!("{} KiB", HEAD >> 10),
            format!("{FIELDS} fields"),
            format!("{} MiB", BODY >> 20),
            format!("within {} s", HEAD_TIME.as_secs()),
            format!("within {} s", BODY_TIME.as_secs()),
        ] {
            assert!(words.contains(&stated), "messages.md does not say {stated:?}");
        }
    }
}
