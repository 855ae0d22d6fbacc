//! As much of HTTP/1.1 as one page on this machine needs: a request and its reply, then the connection ends.

use std::io::{Read, Result, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Longest head of a request, bytes.
const LONGEST_HEAD: usize = 16 << 10;
/// Longest body, bytes: a photo, or a measured signal.
const LONGEST_BODY: u64 = 256 << 20;
/// Most header fields.
const FIELDS: usize = 64;
/// A page on this machine is not slower between two pieces.
const PATIENCE: Duration = Duration::from_secs(10);
/// Nor for a whole head. A browser opens connections before it needs them; they hold no place for longer.
const HEAD_PATIENCE: Duration = Duration::from_secs(2);

/// A request whose body is not read yet.
pub(super) struct Request {
    pub(super) stream: TcpStream,
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
    pub(super) fn read(mut stream: TcpStream) -> Result<std::result::Result<Self, Reply>> {
        stream.set_read_timeout(Some(HEAD_PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let begun = Instant::now();
        let mut bytes = Vec::new();
        let mut piece = [0; 4096];
        loop {
            let n = stream.read(&mut piece)?;
            bytes.extend(&piece[..n]);
            let mut fields = [httparse::EMPTY_HEADER; FIELDS];
            let mut head = httparse::Request::new(&mut fields);
            let parsed = head.parse(&bytes);
            if let Ok(httparse::Status::Complete(end)) = parsed {
                // Of several of a name all, which are then nobody's.
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
            let late = begun.elapsed() > HEAD_PATIENCE;
            if parsed.is_err() || n == 0 || bytes.len() > LONGEST_HEAD || late {
                let words = "this is no request that is answered here";
                return Ok(Err(Reply::refusal(stream, "400 Bad Request", words)));
            }
        }
    }

    /// Reads the body, whose length must be stated.
    pub(super) fn body(mut self) -> Result<std::result::Result<(TcpStream, Vec<u8>), Reply>> {
        let Some(length) = self.length else {
            let words = "the request does not state its length";
            return Ok(Err(Reply::refusal(self.stream, "411 Length Required", words)));
        };
        if length > LONGEST_BODY {
            let words = "the request is longer than 256 MiB";
            return Ok(Err(Reply::refusal(self.stream, "413 Content Too Large", words)));
        }
        self.stream.set_read_timeout(Some(PATIENCE))?;
        let missing = length.saturating_sub(self.begun.len() as u64);
        (&mut self.stream).take(missing).read_to_end(&mut self.begun)?;
        if self.begun.len() as u64 != length {
            let words = format!("the request has {} bytes, not the {length} that it states", self.begun.len());
            return Ok(Err(Reply::refusal(self.stream, "400 Bad Request", &words)));
        }
        Ok(Ok((self.stream, self.begun)))
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
    stream: TcpStream,
    status: &'static str,
    kind: String,
    body: Vec<u8>,
}

impl Reply {
    pub(super) fn of(stream: TcpStream, kind: &str, body: Vec<u8>) -> Self {
        Self { stream, status: "200 OK", kind: kind.to_owned(), body }
    }

    pub(super) fn refusal(stream: TcpStream, status: &'static str, words: &str) -> Self {
        Self { status, ..Self::of(stream, "text/plain; charset=utf-8", words.into()) }
    }

    pub(super) fn send(mut self) -> Result<()> {
        let (status, kind, length) = (self.status, &self.kind, self.body.len());
        write!(
            self.stream,
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{FIELDS_OF_REPLIES}\r\n"
        )?;
        self.stream.write_all(&self.body)?;
        self.stream.flush()
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
        Request::read(server).unwrap()?.body().unwrap().map(|(_, body)| body)
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
        assert!(Request::read(server).is_err());
        assert!(from.elapsed() < PATIENCE / 2);
    }
}
