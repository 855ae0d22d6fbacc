//! As much of HTTP/1.1 as one page on this machine needs: a request and its reply, then the connection ends.

use super::limits::{BODY, BODY_TIME, FIELDS, HEAD, HEAD_TIME};
use std::io::{ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A stream until a moment, however its bytes are spread over the time before.
struct Until<'a> {
    stream: &'a TcpStream,
    end: Instant,
}

impl<'a> Until<'a> {
    fn new(stream: &'a TcpStream, time: Duration) -> Self {
        Self { stream, end: Instant::now() + time }
    }

    fn left(&self) -> Result<Option<Duration>> {
        let left = self.end.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(ErrorKind::TimedOut.into()) } else { Ok(Some(left)) }
    }
}

impl Read for Until<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(bytes)
    }
}

impl Write for Until<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        self.stream.flush()
    }
}

/// A request whose body is not read yet.
pub(super) struct Request {
    pub(super) stream: Arc<TcpStream>,
    pub(super) method: String,
    pub(super) url: String,
    pub(super) host: Option<String>,
    pub(super) origin: Option<String>,
    length: Option<u64>,
    /// What of the body came with the head.
    begun: Vec<u8>,
}

impl Request {
    /// Reads the head. The inner error is the reply to one that makes no sense.
    pub(super) fn read(stream: Arc<TcpStream>) -> Result<std::result::Result<Self, Reply>> {
        let mut until = Until::new(&stream, HEAD_TIME);
        let mut bytes = Vec::new();
        let mut piece = [0; 4096];
        loop {
            let n = until.read(&mut piece)?;
            bytes.extend(&piece[..n]);
            let mut fields = [httparse::EMPTY_HEADER; FIELDS];
            let mut head = httparse::Request::new(&mut fields);
            let parsed = head.parse(&bytes);
            if let Ok(httparse::Status::Complete(end)) = parsed {
                // Repeated headers invalidate each other.
                let field = |name: &str| {
                    let named = head.headers.iter().filter(|h| h.name.eq_ignore_ascii_case(name));
                    let values: Vec<_> = named.map(|h| String::from_utf8_lossy(h.value)).collect();
                    (!values.is_empty()).then(|| values.join(", "))
                };
                return Ok(Ok(Self {
                    method: head.method.unwrap_or_default().to_owned(),
                    url: head.path.unwrap_or_default().to_owned(),
                    host: field("Host"),
                    origin: field("Origin"),
                    length: field("Content-Length").and_then(|n| n.parse().ok()),
                    begun: bytes[end..].to_vec(),
                    stream,
                }));
            }
            if parsed.is_err() || n == 0 || bytes.len() > HEAD {
                let words = "this is no request that is answered here";
                return Ok(Err(Reply::refusal(stream, "400 Bad Request", words)));
            }
        }
    }

    /// Reads the body, whose length must be stated. The error is the reply to one that is not as it should be.
    pub(super) fn body(self) -> std::result::Result<(Arc<TcpStream>, Vec<u8>), Reply> {
        let Self { stream, length, begun: mut body, .. } = self;
        let Some(length) = length else {
            return Err(Reply::refusal(stream, "411 Length Required", "the request does not state its length"));
        };
        if length > BODY {
            let words = format!("the request is longer than {} MiB", BODY >> 20);
            return Err(Reply::refusal(stream, "413 Content Too Large", &words));
        }
        let missing = length.saturating_sub(body.len() as u64);
        let read = Until::new(&stream, BODY_TIME).take(missing).read_to_end(&mut body);
        if read.is_err_and(|error| matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock)) {
            let words = format!("the request took longer than {} s", BODY_TIME.as_secs());
            return Err(Reply::refusal(stream, "408 Request Timeout", &words));
        }
        if body.len() as u64 != length {
            let words = format!("the request has {} bytes, not the {length} that it states", body.len());
            return Err(Reply::refusal(stream, "400 Bad Request", &words));
        }
        Ok((stream, body))
    }
}

/// Not kept, not framed by other pages, not taken for another type; scripts from here alone.
const FIELDS_OF_REPLIES: &str = "Connection: close\r\n\
    Cache-Control: no-store\r\n\
    X-Content-Type-Options: nosniff\r\n\
    X-Frame-Options: DENY\r\n\
    Referrer-Policy: no-referrer\r\n\
    Content-Security-Policy: default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; media-src 'self' blob:; frame-ancestors 'none'\r\n";

/// What a request gets.
pub(super) struct Reply {
    stream: Arc<TcpStream>,
    status: &'static str,
    kind: String,
    body: Vec<u8>,
}

impl Reply {
    pub(super) fn of(stream: Arc<TcpStream>, kind: &str, body: Vec<u8>) -> Self {
        Self { stream, status: "200 OK", kind: kind.to_owned(), body }
    }

    pub(super) fn refusal(stream: Arc<TcpStream>, status: &'static str, words: &str) -> Self {
        Self { status, ..Self::of(stream, "text/plain; charset=utf-8", words.into()) }
    }

    pub(super) fn send(self) -> Result<()> {
        let (status, kind, length) = (self.status, &self.kind, self.body.len());
        let mut until = Until::new(&self.stream, BODY_TIME);
        write!(
            until,
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{FIELDS_OF_REPLIES}\r\n"
        )?;
        until.write_all(&self.body)?;
        until.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, Shutdown, TcpListener};

    /// What comes of a request that is sent so and ends there.
    fn sent(text: &str) -> std::result::Result<Vec<u8>, Reply> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let mut client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        client.write_all(text.as_bytes()).unwrap();
        client.shutdown(Shutdown::Write).unwrap();
        let (server, _) = listener.accept().unwrap();
        Request::read(Arc::new(server)).unwrap()?.body().map(|(_, body)| body)
    }

    #[test]
    fn regress_a_body_that_is_cut_off_is_refused() {
        let head = "POST /ask HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 5\r\n\r\n";
        assert_eq!(sent(&format!("{head}whole")).ok(), Some(b"whole".to_vec()));
        let Err(reply) = sent(&format!("{head}cut")) else { panic!("it was taken") };
        assert_eq!(reply.status, "400 Bad Request");
        assert_eq!(reply.body, b"the request has 3 bytes, not the 5 that it states");
    }

    #[test]
    fn regress_a_connection_without_a_request_is_given_up_soon() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let _idle = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (server, from) = (listener.accept().unwrap().0, Instant::now());
        assert!(Request::read(Arc::new(server)).is_err());
        assert!(from.elapsed() < 5 * HEAD_TIME / 2);
    }

    /// However often a byte comes.
    #[test]
    fn regress_a_client_that_sends_byte_by_byte_has_no_more_time() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let mut client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (server, _) = listener.accept().unwrap();
        let drips = std::thread::spawn(move || {
            while client.write_all(b"x").is_ok() {
                std::thread::sleep(Duration::from_millis(20));
            }
        });
        let mut bytes = Vec::new();
        let read = Until::new(&server, Duration::from_millis(300)).read_to_end(&mut bytes);
        assert!(matches!(read.unwrap_err().kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock));
        assert!(!bytes.is_empty());
        drop(server);
        drips.join().unwrap();
    }
}
