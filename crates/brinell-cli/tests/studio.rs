//! The server of `brinell studio`, asked over its socket.

use crate::common::command;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// More than the connections that the server has at a time.
const MANY: usize = 40;
/// Nobody here is slower.
const PATIENCE: Duration = Duration::from_secs(60);

/// A server that ends with the test.
struct Server {
    child: Child,
    /// `127.0.0.1:PORT`.
    host: String,
    token: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Server {
    fn start() -> Self {
        let here = std::env::temp_dir();
        let mut child = command(&here, &["studio", "--port", "0"]).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.split(' ').find_map(|word| word.strip_prefix("http://")).expect("an address");
        let (host, token) = address.split_once("/?token=").unwrap();
        Self { child, host: host.into(), token: token.into() }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// A connection that has sent so much and goes on.
    fn sent(&self, text: &str) -> TcpStream {
        let mut stream = self.connect();
        stream.write_all(text.as_bytes()).unwrap();
        stream
    }

    /// First line of the reply to a request.
    fn status(&self, request: &str) -> String {
        let mut stream = self.sent(request);
        stream.shutdown(Shutdown::Write).unwrap();
        let mut reply = Vec::new();
        stream.read_to_end(&mut reply).unwrap();
        String::from_utf8_lossy(&reply).lines().next().unwrap_or_default().to_owned()
    }

    fn head(&self, what: &str, length: usize) -> String {
        format!("{what} HTTP/1.1\r\nHost: {}\r\nContent-Length: {length}\r\n\r\n", self.host)
    }
}

#[test]
fn regress_idle_connections_and_slow_bodies_lock_nobody_out() {
    let server = Server::start();
    let page = server.head("GET /", 0);
    let ask = format!("POST /ask?token={}&new=p", server.token);
    for begun in [String::new(), "GET / HT".into(), format!("{}slow", server.head(&ask, 1000))] {
        let held: Vec<TcpStream> = (0..MANY).map(|_| server.sent(&begun)).collect();
        for _ in 0..3 {
            assert_eq!(server.status(&page), "HTTP/1.1 200 OK", "behind {MANY} of {begun:?}");
        }
        let message = "\u{e}\0\0\0{\"do\":\"about\"}";
        let answered = server.status(&format!("{}{message}", server.head(&ask, message.len())));
        assert_eq!(answered, "HTTP/1.1 200 OK", "behind {MANY} of {begun:?}");
        drop(held);
    }
}

/// Where nobody can learn the address, nobody is served.
#[cfg(target_os = "linux")]
#[test]
fn regress_a_server_whose_address_cannot_be_printed_ends() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let (unread, closed) = std::io::pipe().unwrap();
    drop(unread);
    for out in [Stdio::from(full), Stdio::from(closed)] {
        let here = std::env::temp_dir();
        let mut child = command(&here, &["studio", "--port", "0"]).stdout(out).stderr(Stdio::piped()).spawn().unwrap();
        let begin = Instant::now();
        let ended = loop {
            match child.try_wait().unwrap() {
                None if begin.elapsed() < PATIENCE => std::thread::sleep(Duration::from_millis(20)),
                ended => break ended,
            }
        };
        let _ = child.kill();
        let call = crate::common::Call::from(child.wait_with_output().unwrap());
        assert!(ended.is_some(), "it runs on: {call:?}");
        call.exits(1).complains(&["cannot write to standard output"]);
    }
}
