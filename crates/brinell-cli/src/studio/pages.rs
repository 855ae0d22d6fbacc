//! Which page has which engine. Each has one of its own, so no page sees another's bearings.

use super::limits::PAGES;
use brinell_studio::SharedStudio;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Engines with the names of their pages, the one that was asked last at the end.
#[derive(Debug, Default)]
pub(super) struct Pages(Mutex<VecDeque<(String, Arc<SharedStudio>)>>);

impl Pages {
    /// The engine of a page; a new one where it has none and `begins`.
    pub(super) fn engine(&self, page: &str, begins: bool) -> Option<Arc<SharedStudio>> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = all.iter().position(|(name, _)| name == page);
        let engine = match place.and_then(|k| all.remove(k)) {
            Some((_, engine)) => engine,
            None if begins => Arc::default(),
            None => return None,
        };
        if all.len() == PAGES {
            all.pop_front();
        }
        all.push_back((page.to_owned(), Arc::clone(&engine)));
        Some(engine)
    }

    /// The page is closed.
    pub(super) fn close(&self, page: &str) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).retain(|(name, _)| name != page);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_each_page_has_an_engine_of_its_own_and_the_one_that_rested_longest_makes_room() {
        let pages = Pages::default();
        assert!(pages.engine("a", false).is_none(), "no page has begun");
        let a = pages.engine("a", true).unwrap();
        for other in ["b", "c", "d"] {
            assert!(!Arc::ptr_eq(&a, &pages.engine(other, true).unwrap()));
        }
        // It was asked again, so B has rested longest.
        assert!(Arc::ptr_eq(&a, &pages.engine("a", true).unwrap()));
        pages.engine("e", true).unwrap();
        assert!(pages.engine("b", false).is_none());
        for kept in ["c", "d", "a", "e"] {
            assert!(pages.engine(kept, false).is_some(), "{kept}");
        }
        // A page that is closed makes room before any other has to.
        pages.close("e");
        pages.engine("b", true).unwrap();
        assert!(pages.engine("c", false).is_some());
        assert!(pages.engine("e", false).is_none());
        assert_eq!(pages.0.lock().unwrap().len(), PAGES);
    }
}
