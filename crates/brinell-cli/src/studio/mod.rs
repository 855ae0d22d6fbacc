//! `brinell studio`: the studio's page on this machine, with the native engine behind it.

mod answer;
mod http;
mod limits;
mod pages;
mod places;

use crate::failure::{ExitCode, Failure};
use answer::{Door, Route};
use brinell_io::hexadecimal;
use brinell_studio_page::PAGE;
use clap::Args;
use http::{Reply, Request};
use pages::Pages;
use places::{Place, Places};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

#[derive(Debug, Args)]
pub(crate) struct StudioArgs {
    /// Port on 127.0.0.1 [default: 7178, another where that is taken]
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,
}

/// A browser keeps the last scenario for one address, so the port is the same each time.
const PORT: u16 = 7178;
/// After a connection that the system could not give.
const PAUSE: Duration = Duration::from_millis(50);
/// What every connection shares.
struct Shared {
    door: Door,
    pages: Pages,
}

/// Serves until the process ends.
pub(crate) fn studio(args: &StudioArgs) -> Result<ExitCode, Failure> {
    let port = args.port.unwrap_or(PORT);
    let no_port = |e: std::io::Error| Failure::Usage(format!("--port {port}: 127.0.0.1 cannot be listened on: {e}"));
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    let listener = match args.port {
        Some(port) => bind(port),
        None => bind(PORT).or_else(|_| bind(0)),
    };
    let listener = listener.map_err(no_port)?;
    let port = listener.local_addr().map_err(no_port)?.port();
    let shared = Arc::new(Shared { door: Door::new(port, token()?), pages: Pages::default() });
    let words = format!(
        "The studio is at {} until Ctrl-C: open that address in a browser. Only this machine can reach it.",
        shared.door.address()
    );
    // Nobody could find it otherwise.
    crate::say::at_once(&words).map_err(Failure::Output)?;
    let places = Arc::<Places>::default();
    loop {
        match listener.accept() {
            // A page that went away is no failure, and one that finds no place or no thread asks again.
            Ok((stream, _)) => {
                let stream = Arc::new(stream);
                let Some(place) = places.take(&stream) else { continue };
                let shared = Arc::clone(&shared);
                let serving = move || drop(serve(&shared, &place, stream));
                drop(thread::Builder::new().spawn(serving));
            }
            // No file is left for a connection, for one.
            Err(_) => thread::sleep(PAUSE),
        }
    }
}

/// 128 bits that nobody guesses.
fn token() -> Result<String, Failure> {
    let mut bytes = [0_u8; 16];
    getrandom::fill(&mut bytes).map_err(|e| Failure::Usage(format!("no random numbers for the address: {e}")))?;
    Ok(hexadecimal(&bytes))
}

/// One connection: one request and its reply.
fn serve(shared: &Shared, place: &Place, stream: Arc<TcpStream>) -> std::io::Result<()> {
    let mut request = match Request::read(stream)? {
        Ok(request) => request,
        Err(reply) => return reply.send(),
    };
    let host = request.host.take();
    let origin = request.origin.take();
    let (method, url) = (request.method.clone(), request.url.clone());
    let route = shared.door.route(&method, &url, host.as_deref(), origin.as_deref());
    let reply = match route {
        Route::Page(name) => match PAGE.iter().find(|(n, ..)| *n == name) {
            Some((_, kind, bytes)) => Reply::of(request.stream, kind, bytes.to_vec()),
            None => Reply::refusal(request.stream, "404 Not Found", "there is no such file"),
        },
        Route::Engine { page, begins } => {
            let (stream, body) = match request.body() {
                Ok(body) => body,
                Err(reply) => return reply.send(),
            };
            match shared.pages.engine(page, begins) {
                Some(engine) => match place.work(|| engine.ask(&body)) {
                    Some(answer) => Reply::of(stream, "application/octet-stream", answer),
                    None => return Ok(()),
                },
                None => Reply::refusal(stream, "410 Gone", "the engine of this page is gone: new= begins another"),
            }
        }
        Route::Closed { page } => {
            shared.pages.close(page);
            Reply::of(request.stream, "text/plain", Vec::new())
        }
        Route::Refused(status, words) => Reply::refusal(request.stream, status, words),
    };
    reply.send()
}
