//! Colors of the pictures, and the scale that turns a value into one.
//!
//! The scale is viridis (S. van der Walt and N. Smith, matplotlib, CC0): lightness grows evenly with
//! the value, also for color-blind eyes and in gray print.

use super::canvas::Ink;

/// Text and axes.
pub(super) const DARK: Ink = Ink([45, 50, 58], 1.0);
/// Grid lines of a chart.
pub(super) const GRID: Ink = Ink([223, 226, 231], 1.0);
/// Edges and ticks.
pub(super) const FRAME: Ink = Ink([160, 166, 175], 1.0);
/// The place of the largest shear.
pub(super) const RED: Ink = Ink([214, 25, 33], 1.0);
/// Seeds and arrows.
pub(super) const BLACK: Ink = Ink([20, 22, 26], 1.0);
/// Viridis at every sixteenth of its range.
const VIRIDIS: [[u8; 3]; 17] = [
    [68, 1, 84],
    [72, 24, 106],
    [71, 45, 123],
    [66, 64, 134],
    [59, 82, 139],
    [51, 99, 141],
    [44, 114, 142],
    [38, 130, 142],
    [33, 145, 140],
    [31, 160, 136],
    [40, 174, 128],
    [63, 188, 115],
    [94, 201, 98],
    [132, 212, 75],
    [173, 220, 48],
    [216, 226, 25],
    [253, 231, 37],
];

/// The color at a share of the range, 0 to 1; beyond it the end's color.
pub(super) fn viridis(share: f64) -> Ink {
    let last = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last - 1);
    let part = place - low as f64;
    let mix = |c: usize| {
        let (a, b) = (f64::from(VIRIDIS[low][c]), f64::from(VIRIDIS[low + 1][c]));
        (a + part * (b - a)).round() as u8
    };
    Ink([mix(0), mix(1), mix(2)], 1.0)
}

/// The color at a share of the range, 0 to 1, as red, green and blue.
pub(crate) fn viridis_rgb(share: f64) -> [u8; 3] {
    viridis(share).0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lightness (relative luminance) grows all along, so order survives in gray print.
    #[test]
    fn the_scale_grows_lighter_all_along() {
        let luminance = |k: usize| {
            let Ink(rgb, _) = viridis(k as f64 / 100.0);
            let linear = rgb.map(|c| (f64::from(c) / 255.0).powf(2.2));
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        assert!((0..100).all(|k| luminance(k + 1) > luminance(k)));
        assert_eq!(viridis(-1.0), viridis(0.0));
        assert_eq!(viridis(2.0), Ink([253, 231, 37], 1.0));
    }
}
