//! Curves, points and layers of a drawing, as messages show them.

use std::fmt::{self, Write};

/// A curve of a drawing, for messages: what it is, its layer, and a point of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EntityPlace {
    /// Type, as DXF names it.
    pub entity: &'static str,
    /// Layer.
    pub layer: String,
    /// A point of it (m).
    pub at: [f64; 2],
}

impl fmt::Display for EntityPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EntityPlace { entity, layer, at } = self;
        write!(f, "{entity} on layer `{}` at {}", layer.escape_debug(), mm(*at))
    }
}

/// A point as messages show it (mm).
pub(super) fn mm(at: [f64; 2]) -> String {
    format!("({:.3}, {:.3}) mm", at[0] * 1e3, at[1] * 1e3)
}

/// Layers by name; of many the first.
pub(super) fn listed(layers: &[impl AsRef<str>]) -> String {
    const MOST: usize = 20;
    let name = |name: &_| format!("`{}`", AsRef::<str>::as_ref(name).escape_debug());
    let names: Vec<String> = layers.iter().take(MOST).map(name).collect();
    let more = if layers.len() > MOST { ", …" } else { "" };
    format!("{}{more}", names.join(", "))
}

/// A text of a drawing as a TOML file has it, so that it can be copied into a scene.
pub(super) fn toml(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            _ if letter.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(letter));
            }
            _ => out.push(letter),
        }
    }
    out + "\""
}
