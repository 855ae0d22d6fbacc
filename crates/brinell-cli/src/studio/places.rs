//! Places for connections. Where all are taken, the client that has kept the server waiting the longest loses its own: whoever
//! opens many connections and says nothing locks nobody out.

use super::limits::CONNECTIONS;
use std::collections::VecDeque;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// All places.
#[derive(Debug, Default)]
pub(super) struct Places(Mutex<Taken>);

#[derive(Debug, Default)]
struct Taken {
    /// Whose request is not read, or whose reply is not taken; the one that waits for its client the longest first.
    waiting: VecDeque<Arc<TcpStream>>,
    /// Connections whose engine works.
    at_work: usize,
}

impl Taken {
    /// Takes a connection from those that wait. `false` where it has lost its place.
    fn stop_waiting(&mut self, stream: &Arc<TcpStream>) -> bool {
        let at = self.waiting.iter().position(|other| Arc::ptr_eq(other, stream));
        at.and_then(|at| self.waiting.remove(at)).is_some()
    }
}

/// The place of one connection.
#[derive(Debug)]
pub(super) struct Place {
    places: Arc<Places>,
    stream: Arc<TcpStream>,
}

impl Places {
    fn taken(&self) -> MutexGuard<'_, Taken> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a connection. `None` where every other one has an engine that works.
    pub(super) fn take(self: &Arc<Self>, stream: &Arc<TcpStream>) -> Option<Place> {
        let mut taken = self.taken();
        if taken.waiting.len() + taken.at_work >= CONNECTIONS {
            // What its thread waits for comes to an end. One that has ended by itself is no failure.
            drop(taken.waiting.pop_front()?.shutdown(Shutdown::Both));
        }
        taken.waiting.push_back(Arc::clone(stream));
        Some(Place { places: Arc::clone(self), stream: Arc::clone(stream) })
    }
}

impl Place {
    /// Works for the client, who does not wait for it meanwhile. `None` where it has lost its place.
    pub(super) fn work<T>(&self, work: impl FnOnce() -> T) -> Option<T> {
        {
            let mut taken = self.places.taken();
            if !taken.stop_waiting(&self.stream) {
                return None;
            }
            taken.at_work += 1;
        }
        let _ends = Ends(self);
        Some(work())
    }
}

/// The end of work, by a panic too.
struct Ends<'a>(&'a Place);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        let mut taken = self.0.places.taken();
        taken.at_work -= 1;
        taken.waiting.push_back(Arc::clone(&self.0.stream));
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.places.taken().stop_waiting(&self.stream);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;
    use std::net::{Ipv4Addr, TcpListener};

    #[test]
    fn prop_one_more_gets_the_place_of_who_waits_longest_and_never_that_of_who_works() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let places = Arc::<Places>::default();
        let connect = || {
            let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
            (client, Arc::new(listener.accept().unwrap().0))
        };
        let mut all: Vec<_> = (0..CONNECTIONS).map(|_| connect()).collect();
        let mut held: Vec<Place> = all.iter().map(|(_, stream)| places.take(stream).unwrap()).collect();
        let (_client, stream) = connect();
        let first = held.remove(0);
        let more = first.work(|| places.take(&stream)).unwrap();
        // The second lost its place: its connection is at its end, and nothing is done for it.
        assert_eq!(all[1].0.read(&mut [0]).unwrap(), 0);
        assert!(held[0].work(|| ()).is_none());
        assert!(more.is_some_and(|more| more.work(|| ()).is_some()));
        assert_eq!((places.taken().at_work, places.taken().waiting.len()), (0, CONNECTIONS - 1));
    }

    #[test]
    fn prop_where_all_work_one_more_gets_no_place() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let _client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let stream = Arc::new(listener.accept().unwrap().0);
        let places = Arc::<Places>::default();
        fn within(left: usize, places: &Arc<Places>, stream: &Arc<TcpStream>) -> bool {
            let place = places.take(stream);
            match (left, place) {
                (0, none) => none.is_none(),
                (_, Some(place)) => place.work(|| within(left - 1, places, stream)).unwrap(),
                (_, None) => false,
            }
        }
        assert!(within(CONNECTIONS, &places, &stream));
        assert_eq!((places.taken().at_work, places.taken().waiting.len()), (0, 0));
    }
}
