//! Tables that were made before: in this process, and where its user keeps them.

use super::error::BuildError;
use crate::effective::Table;
use crate::random::mix;
use std::fmt::{self, Write};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Changes with what makes tables, so that none of before is taken for one of now.
const VERSION: u32 = 6;
/// Tables that a process keeps, at most 2 MB each; the oldest goes first.
const MOST: usize = 64;

/// Where tables outlive a process. A library opens no files: whoever has a folder for them hands one over.
pub trait Shelf: Send + Sync {
    /// What was kept under a name, a word of letters and digits.
    fn take(&self, name: &str) -> Option<Vec<u8>>;
    /// Keeps it, or not.
    fn put(&self, name: &str, bytes: &[u8]);
}

static SHELF: OnceLock<Box<dyn Shelf>> = OnceLock::new();

/// From now on tables are looked for and kept there too; the first call counts.
pub fn keep_on(shelf: Box<dyn Shelf>) {
    let _ = SHELF.set(shelf);
}

/// What a table is made of, as a number: the same for the same numbers on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Key([u64; 2]);

impl Key {
    /// Of everything that a table depends on.
    pub(super) fn of(parts: fmt::Arguments<'_>) -> Self {
        let mut hasher = Hasher([u64::from(VERSION), 1]);
        // Writing to it cannot fail.
        let _ = hasher.write_fmt(parts);
        Self(hasher.0)
    }

    fn name(self) -> String {
        format!("{:016x}{:016x}", self.0[0], self.0[1])
    }

    fn from_name(name: &str) -> Option<Self> {
        let half = |digits: Option<&str>| u64::from_str_radix(digits?, 16).ok();
        Some(Self([half(name.get(..16))?, half(name.get(16..))?])).filter(|key| key.name() == name)
    }
}

struct Hasher([u64; 2]);

impl Write for Hasher {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        // However the text is cut, its bytes count one by one.
        for byte in text.bytes() {
            self.0[0] = (self.0[0] ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
            self.0[1] = self.0[1].wrapping_mul(31).wrapping_add(mix(u64::from(byte)));
        }
        Ok(())
    }
}

type Cell = Arc<OnceLock<Result<Arc<Table>, BuildError>>>;

static TABLES: Mutex<Vec<(Key, Cell)>> = Mutex::new(Vec::new());

/// The place of a table in this process; a new one where it has none.
fn cell(key: Key) -> Cell {
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    match tables.iter().find(|(known, _)| *known == key) {
        Some((_, cell)) => cell.clone(),
        None => {
            if tables.len() == MOST {
                tables.remove(0);
            }
            let cell = Cell::default();
            tables.push((key, cell.clone()));
            cell
        }
    }
}

fn from_shelf(key: Key) -> Option<Arc<Table>> {
    let bytes = SHELF.get()?.take(&key.name())?;
    Table::from_bytes(&bytes).map(Arc::new)
}

/// The table of `key`; made once, whoever asks meanwhile waits for it.
pub(super) fn table(key: Key, make: impl FnOnce() -> Result<Table, BuildError>) -> Result<Arc<Table>, BuildError> {
    let made = || {
        if let Some(table) = from_shelf(key) {
            return Ok(table);
        }
        let table = make()?;
        if let Some(shelf) = SHELF.get() {
            shelf.put(&key.name(), &table.to_bytes());
        }
        Ok(Arc::new(table))
    };
    cell(key).get_or_init(made).clone()
}

/// The table of `key` where it was made before, or why it cannot be. One that is not takes no table's place.
pub(super) fn at_hand(key: Key) -> Option<Result<Arc<Table>, BuildError>> {
    let tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    let made = tables.iter().find(|(known, _)| *known == key).and_then(|(_, cell)| cell.get().cloned());
    drop(tables);
    made.or_else(|| Some(Ok(keep(key, from_shelf(key)?))))
}

/// Keeps a table that came from elsewhere; where it was made meanwhile, that one stays.
fn keep(key: Key, table: Arc<Table>) -> Arc<Table> {
    let _ = cell(key).set(Ok(table.clone()));
    table
}

/// The tables that this process has, as bytes by their names: for another process of the same version, which [`take_in`]s them.
pub fn in_bytes() -> Vec<(String, Vec<u8>)> {
    let tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    let made = tables.iter().filter_map(|(key, cell)| Some((key, cell.get()?.as_ref().ok()?)));
    made.map(|(key, table)| (key.name(), table.to_bytes())).collect()
}

/// A table that another process gave by [`in_bytes`]. `false`: it is none.
pub fn take_in(name: &str, bytes: &[u8]) -> bool {
    let taken = Key::from_name(name).zip(Table::from_bytes(bytes));
    taken.map(|(key, table)| keep(key, Arc::new(table))).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_keys_differ_with_what_they_are_of() {
        let of = |x: f64| Key::of(format_args!("{x:?} {:?}", [1.0, x]));
        assert_eq!(of(0.1), of(0.1));
        assert_ne!(of(0.1), of(0.1 + 1e-16));
        assert_eq!(of(0.1).name().len(), 32);
    }

    #[test]
    fn prop_a_table_is_made_once_and_survives_its_bytes() {
        let (s, delta) = ([-1e-3, -3e-4, 2e-4, 1e-3], [0.0, 2e-6, 5e-6, 1e-5]);
        let eff: Vec<f64> = s.iter().flat_map(|s| delta.map(|d| d * (1.0 - 0.4 / (1.0 + 1e7 * s * s)))).collect();
        let key = Key::of(format_args!("a table of this test"));
        let make = || Ok(Table::from_grid(&s, &delta, &eff)?);
        let first = table(key, make).unwrap();
        let again = table(key, || panic!("made twice")).unwrap();
        assert!(Arc::ptr_eq(&first, &again) && Arc::ptr_eq(&first, &at_hand(key).unwrap().unwrap()));
        let bytes = first.to_bytes();
        assert_eq!(Table::from_bytes(&bytes).as_ref(), Some(&*first));
        // Of another process.
        assert!(in_bytes().contains(&(key.name(), bytes.clone())));
        let other = Key::of(format_args!("a table of another process"));
        let count = || TABLES.lock().unwrap().iter().filter(|(key, _)| *key == other).count();
        assert!(at_hand(other).is_none() && count() == 0 && take_in(&other.name(), &bytes));
        assert_eq!(at_hand(other).unwrap().unwrap(), first);
        assert!(!take_in("no name of a table", &bytes) && !take_in(&other.name(), &bytes[1..]));
        // What is cut or changed is no table.
        assert_eq!(Table::from_bytes(&bytes[..bytes.len() - 3]), None);
        let mut torn = bytes;
        torn[60] ^= 1;
        assert_eq!(Table::from_bytes(&torn), None);
    }
}
