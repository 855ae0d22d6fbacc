//! Numbers that belong to a place in a campaign: functions of a key and the place, not of what was drawn before.
//!
//! What anybody may know comes of the plan's seed ([`bits`]), fast and invertible. What is held out comes of the plan's
//! secret by HMAC-SHA-256 (RFC 2104, FIPS 198-1): who has any number of these numbers learns nothing of the secret, nor
//! of another number.

use brinell::random::mix;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;
use std::collections::BTreeSet;

/// Hexadecimal digits of a secret at least: 128 bits.
pub(super) const SECRET_DIGITS: usize = 32;
/// Different digits among them at least. 32 digits drawn at random have fewer once in 10^8.
pub(super) const SECRET_DIFFERENT: usize = 7;

/// A key that nobody can guess.
#[derive(Clone)]
pub(super) struct Secret(Hmac<Sha256>);

impl Secret {
    /// Of hexadecimal digits; `None` where there are too few, others, or too few different ones.
    pub(super) fn of(text: &str) -> Option<Self> {
        let key = text.to_ascii_lowercase().into_bytes();
        let different: BTreeSet<u8> = key.iter().copied().collect();
        let is_sound = different.iter().all(u8::is_ascii_hexdigit)
            && key.len() >= SECRET_DIGITS
            && different.len() >= SECRET_DIFFERENT;
        // HMAC takes keys of any length.
        let mac = is_sound.then(|| Hmac::new_from_slice(&key).ok());
        mac.flatten().map(Self)
    }

    /// 64 bits that belong to words.
    pub(super) fn bits(&self, words: &[u64]) -> u64 {
        let mut mac = self.0.clone();
        for word in words {
            mac.update(&word.to_le_bytes());
        }
        let mut first = [0; 8];
        first.copy_from_slice(&mac.finalize().into_bytes()[..8]);
        u64::from_le_bytes(first)
    }
}

/// 64 bits that belong to words, such as campaign seed, run and attempt.
pub(super) fn bits(words: &[u64]) -> u64 {
    words.iter().fold(0, |state, word| mix(state ^ mix(*word)))
}

/// A number of [0, 1).
pub(super) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// A seed that JSON, TOML and a double hold exactly: below 2^53.
pub(super) fn seed(bits: u64) -> u64 {
    bits >> 11
}

/// A key's own word, whatever its place among the keys: FNV-1a.
pub(super) fn word(key: &str) -> u64 {
    key.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn xval_secret_bits_are_hmac_sha_256() {
        // Python: hmac.new(b"000102030405060708090a0b0c0d0e0f", struct.pack("<2Q", 1, 2), "sha256").digest()[:8].
        let secret = Secret::of("000102030405060708090A0B0C0D0E0F").unwrap();
        assert_eq!(secret.bits(&[1, 2]).to_le_bytes(), [0x4b, 0x21, 0x7a, 0x57, 0x21, 0x45, 0xa5, 0x05]);
        assert_ne!(secret.bits(&[1, 2]), secret.bits(&[2, 1]));
    }

    #[test]
    fn prop_a_secret_has_128_bits() {
        let random = "9f86d081884c7d659a2feaa0c55ad015";
        assert!(Secret::of(random).is_some() && Secret::of(&random.repeat(2)).is_some());
        for bad in ["", &random[1..], &format!("{random}g"), &"01".repeat(40)] {
            assert!(Secret::of(bad).is_none(), "{bad}");
        }
    }

    #[test]
    fn prop_places_do_not_share_numbers() {
        let mut seen = std::collections::HashSet::new();
        for seed in 0..20 {
            for run in 0..50 {
                for key in ["a", "b", "operation.speed_rpm"] {
                    assert!(seen.insert(bits(&[seed, run, word(key)])));
                }
            }
        }
    }

    #[test]
    fn prop_units_are_spread_evenly() {
        // Chi-square over 20 slices of 20000 numbers: 19 degrees of freedom, 99.9 % below 43.8.
        let mut counts = [0_u32; 20];
        for run in 0..20_000 {
            counts[(20.0 * unit(bits(&[7, run]))) as usize] += 1;
        }
        let chi: f64 = counts.iter().map(|n| (f64::from(*n) - 1000.0).powi(2) / 1000.0).sum();
        assert!(chi < 43.8, "{chi}");
    }
}
