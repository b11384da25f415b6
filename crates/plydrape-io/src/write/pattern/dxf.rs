//! The flat pattern as DXF, in millimeters.
//!
//! Layers: `CUT` is the boundary and `HOLES` are the holes, which a cutter follows; `GRIPPERS` has a circle and a name for each
//! gripper, `FIBER` the arrow of the warp, and `TITLE` the title.

use super::dxf_text::Text;
use super::{Pattern, arrow};

/// Layers and their colors: red, blue, green, magenta and the color of the page.
const LAYERS: [(&str, u8); 5] =
    [("CUT", 1), ("HOLES", 5), ("GRIPPERS", 3), ("FIBER", 6), ("TITLE", 7)];

/// The drawing as DXF text. Same pattern, same bytes.
#[must_use]
pub fn text(pattern: &Pattern) -> String {
    let mut text = Text::new(&LAYERS);
    text.polyline("CUT", pattern.outline.boundary(), true);
    for hole in pattern.outline.holes() {
        text.polyline("HOLES", hole, true);
    }
    let [low, high] = pattern.outline.bounds();
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    for gripper in pattern.grippers {
        text.circle("GRIPPERS", gripper.place, gripper.radius);
        let fits = 1.2 * gripper.radius / gripper.name.chars().count().max(1) as f64;
        text.text(
            "GRIPPERS",
            gripper.place,
            if fits > 0.0 { fits } else { 0.01 * size },
            &gripper.name,
        );
    }
    for line in arrow(pattern) {
        text.polyline("FIBER", &line, false);
    }
    let height = 0.02 * size;
    let middle = [0.5 * (low[0] + high[0]), high[1] + 1.5 * height];
    text.text("TITLE", middle, height, pattern.title);
    text.finish()
}
