//! Who may ask the studio's server for what.

const FORBIDDEN: &str = "403 Forbidden";

/// Where the page is served, and the token that its address carries.
#[derive(Debug)]
pub(super) struct Door {
    port: u16,
    token: String,
}

/// Where a request leads.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Route<'a> {
    /// A file of the page; none of them is a secret.
    Page(&'a str),
    /// A message for the engine of a page. It gets a new one where it has none and `begins`.
    Engine { page: &'a str, begins: bool },
    /// The page is closed.
    Closed { page: &'a str },
    /// Neither: status and words.
    Refused(&'static str, &'static str),
}

impl Door {
    pub(super) fn new(port: u16, token: String) -> Self {
        Self { port, token }
    }

    /// What a browser opens.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// The host must be this machine by name or number, so that no page can reach it by a name of its own (DNS
    /// rebinding); where a browser says which page asks, it must be this one; and the engine answers those alone who
    /// have the token.
    pub(super) fn route<'a>(&self, method: &str, url: &'a str, host: Option<&str>, origin: Option<&str>) -> Route<'a> {
        let own = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        if !host.is_some_and(|host| own.iter().any(|own| own == host)) {
            return Route::Refused(FORBIDDEN, "this server answers to 127.0.0.1 alone");
        }
        let from_here = |origin: &str| own.iter().any(|own| format!("http://{own}") == origin);
        if !origin.is_none_or(from_here) {
            return Route::Refused(FORBIDDEN, "another page asks");
        }
        let (path, query) = url.split_once('?').unwrap_or((url, ""));
        let stated = |key: &str| {
            query
                .split('&')
                .find_map(|pair| pair.strip_prefix(key)?.strip_prefix('='))
                .filter(|value| !value.is_empty())
        };
        match (method, path) {
            ("GET", "/") => Route::Page("index.html"),
            ("GET", path) => Route::Page(path.trim_start_matches('/')),
            ("POST", "/ask") if !stated("token").is_some_and(|t| same(t, &self.token)) => {
                Route::Refused(FORBIDDEN, "the address lacks its token")
            }
            ("POST", "/ask") => match (stated("page"), stated("new"), stated("closed")) {
                (Some(page), None, None) => Route::Engine { page, begins: false },
                (None, Some(page), None) => Route::Engine { page, begins: true },
                (None, None, Some(page)) => Route::Closed { page },
                _ => Route::Refused("400 Bad Request", "state which page asks: one of page=, new=, closed="),
            },
            _ => Route::Refused("405 Method Not Allowed", "only GET of the page and POST of /ask"),
        }
    }
}

/// In a time that tells nothing of where they differ.
fn same(a: &str, b: &str) -> bool {
    let differ = a.bytes().zip(b.bytes()).fold(0, |d, (x, y)| d | (x ^ y));
    a.len() == b.len() && differ == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_only_this_machines_page_with_the_token_reaches_the_engine() {
        let door = Door::new(4000, "5ec3e7".into());
        let here = Some("127.0.0.1:4000");
        let ask = |url, host, origin| door.route("POST", url, host, origin);
        let good = "/ask?token=5ec3e7&page=p1";
        let engine = |begins| Route::Engine { page: "p1", begins };
        assert_eq!(ask(good, here, None), engine(false));
        assert_eq!(ask(good, Some("localhost:4000"), Some("http://localhost:4000")), engine(false));
        assert_eq!(ask("/ask?token=5ec3e7&new=p1", here, None), engine(true));
        assert_eq!(ask("/ask?closed=p1&token=5ec3e7", here, None), Route::Closed { page: "p1" });
        for nobody in ["/ask?token=5ec3e7", "/ask?token=5ec3e7&page=", "/ask?token=5ec3e7&page=p1&closed=p2"] {
            assert!(matches!(ask(nobody, here, None), Route::Refused("400 Bad Request", _)), "{nobody}");
        }
        for (url, host, origin) in [
            ("/ask?page=p1", here, None),
            ("/ask?token=&page=p1", here, None),
            ("/ask?token=5ec3e&page=p1", here, None),
            ("/ask?token=5ec3e8&new=p1", here, None),
            ("/ask?token=5ec3e77&closed=p1", here, None),
            (good, None, None),
            (good, Some("127.0.0.1"), None),
            (good, Some("evil.example:4000"), None),
            (good, Some("127.0.0.1:4001"), None),
            (good, here, Some("http://evil.example")),
            (good, here, Some("https://127.0.0.1:4000")),
            (good, here, Some("null")),
        ] {
            assert!(matches!(ask(url, host, origin), Route::Refused(FORBIDDEN, _)), "{url}");
        }
        assert_eq!(door.route("GET", "/?token=x", here, None), Route::Page("index.html"));
        assert_eq!(door.route("GET", "/src/main.js", here, None), Route::Page("src/main.js"));
        assert!(matches!(door.route("PUT", good, here, None), Route::Refused("405 Method Not Allowed", _)));
    }
}
