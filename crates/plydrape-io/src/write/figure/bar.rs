//! The color bar: what value every color stands for.

use super::axes::{self, LABEL, TICK};
use super::canvas::{Canvas, Px, plain};
use super::color::{FRAME, viridis};

/// Greatest length (picture points).
const LENGTH: f64 = 340.0;
/// Width (picture points).
const WIDTH: f64 = 16.0;

/// The bar from `left` on and between two heights on the sheet; its name, and the values of its ends.
pub(super) fn bar(
    canvas: &mut Canvas,
    name: &str,
    [low, high]: [f64; 2],
    left: f64,
    [top, bottom]: Px,
) {
    let length = (bottom - top).min(LENGTH);
    let top = top + (bottom - top - length) / 2.0;
    let (right, slices) = (left + WIDTH, 85);
    for k in 0..slices {
        let share = f64::from(k) / f64::from(slices);
        let y = top + length * (1.0 - share);
        // Each slice reaches to the top and is covered by the next, so that no seam shows.
        let slice = [[left, y], [right, y], [right, top], [left, top]];
        canvas.polygon(&slice, viridis((f64::from(k) + 0.5) / f64::from(slices)));
    }
    for tick in axes::round_numbers(low, high, length / 42.0) {
        let y = top + length * (1.0 - (tick - low) / (high - low));
        canvas.line(&[[right, y], [right + 4.0, y]], FRAME, 1.0);
        canvas.text(&axes::label(tick), [right + 8.0, y], plain(TICK, -1));
    }
    canvas.text(name, [left - 4.0, top - 16.0], plain(LABEL, -1));
}
