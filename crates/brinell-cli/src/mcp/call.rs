//! One call: this program again as a process, its JSON and its words.

use crate::confined;
use std::ffi::OsString;
use std::io::{Error, ErrorKind, Read};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

/// Calls at a time; more wait their turn. Sweeps take every core by themselves.
const AT_ONCE: usize = 4;

/// Starts calls in a folder.
pub(super) struct Calls {
    /// Program and first words of its own.
    program: Vec<OsString>,
    /// Without links in it.
    folder: PathBuf,
    places: Semaphore,
}

/// What a call that is over has said.
pub(super) struct Ended {
    pub(super) succeeded: bool,
    pub(super) out: String,
    pub(super) err: String,
}

impl Calls {
    /// # Errors
    /// Where this program cannot tell where it lies.
    pub(super) fn new(folder: PathBuf) -> Result<Self, Error> {
        Ok(Self { program: crate::program()?, folder, places: Semaphore::new(AT_ONCE) })
    }

    /// Runs the command with these words; dropped before, it ends the process.
    ///
    /// # Errors
    /// Where the process cannot be started or read.
    pub(super) async fn call(&self, words: &[String]) -> Result<Ended, Error> {
        let _place = self.places.acquire().await.map_err(Error::other)?;
        let (program, own) = self.program.split_first().ok_or(ErrorKind::NotFound)?;
        let mut command = Command::new(program);
        command.args(own).args(words).current_dir(&self.folder).env(confined::FOLDER, &self.folder);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut process = Process(command.spawn()?);
        let (out, err) = (process.0.stdout.take(), process.0.stderr.take());
        // Their ends are the process's.
        let (out, err) = (spawn_blocking(|| text(out)), spawn_blocking(|| text(err)));
        let (out, err) = (out.await.map_err(Error::other)??, err.await.map_err(Error::other)??);
        Ok(Ended { succeeded: process.0.wait()?.success(), out, err })
    }
}

fn text(stream: Option<impl Read>) -> Result<String, Error> {
    let mut bytes = Vec::new();
    stream.map_or(Ok(0), |mut stream| stream.read_to_end(&mut bytes))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A process that does not outlive the call.
struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        // One that has ended is no failure.
        drop(self.0.kill());
        drop(self.0.wait());
    }
}
