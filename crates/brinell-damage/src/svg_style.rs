//! The little of CSS that decides whether a drawn shape shows, and how it is filled.

use roxmltree::{Document, Node};

/// What a shape inherits and has of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Style {
    pub(crate) filled: bool,
    pub(crate) stroked: bool,
    pub(crate) even_odd: bool,
    pub(crate) visible: bool,
    /// `display: none`: nothing below shows either.
    pub(crate) removed: bool,
}

impl Default for Style {
    fn default() -> Self {
        Self { filled: true, stroked: false, even_odd: false, visible: true, removed: false }
    }
}

impl Style {
    fn set(&mut self, property: &str, value: &str) {
        let value = value.trim().trim_end_matches("!important").trim_end();
        if value == "inherit" {
            return;
        }
        match property.trim() {
            "fill" => self.filled = !matches!(value, "none" | "transparent"),
            "stroke" => self.stroked = !matches!(value, "none" | "transparent"),
            "fill-rule" => self.even_odd = value == "evenodd",
            "visibility" => self.visible = value == "visible",
            "display" => self.removed |= value == "none",
            _ => {}
        }
    }

    fn set_all(&mut self, declarations: &str) {
        for declaration in declarations.split(';') {
            if let Some((property, value)) = declaration.split_once(':') {
                self.set(property, value);
            }
        }
    }
}

/// The drawing's style sheets: selectors of one tag, class or id.
#[derive(Default)]
pub(crate) struct Sheets<'a> {
    rules: Vec<(&'a str, &'a str)>,
}

impl<'a> Sheets<'a> {
    /// All `<style>` elements, without at-rules and combined selectors.
    pub(crate) fn of(document: &'a Document<'_>) -> Self {
        let mut rules = Vec::new();
        for node in document.descendants().filter(|n| n.has_tag_name("style") || n.tag_name().name() == "style") {
            for text in node.children().filter_map(|child| child.text()) {
                for block in text.split('}') {
                    let Some((selectors, declarations)) = block.split_once('{') else {
                        continue;
                    };
                    // A comment before the rule.
                    let selectors = selectors.rsplit("*/").next().unwrap_or(selectors);
                    rules.extend(selectors.split(',').map(|s| (s.trim(), declarations)));
                }
            }
        }
        Self { rules }
    }

    /// The style of an element below one that has `parent`.
    pub(crate) fn style(&self, node: Node<'_, '_>, parent: Style) -> Style {
        let mut style = parent;
        for property in ["fill", "stroke", "fill-rule", "visibility", "display"] {
            if let Some(value) = node.attribute(property) {
                style.set(property, value);
            }
        }
        let classes = node.attribute("class").unwrap_or_default();
        for (selector, declarations) in &self.rules {
            let meant = match selector.split_at_checked(1) {
                Some((".", class)) => classes.split_whitespace().any(|c| c == class),
                Some(("#", id)) => node.attribute("id") == Some(id),
                _ => *selector == node.tag_name().name(),
            };
            if meant {
                style.set_all(declarations);
            }
        }
        style.set_all(node.attribute("style").unwrap_or_default());
        style
    }
}
