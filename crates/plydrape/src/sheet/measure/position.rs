//! Position of the landed nodes at the end, against the ideal drape.

use super::super::fabric::Fabric;
use super::Most;
use crate::mold::{Mold, distance};
use crate::net::Net;

/// The largest distance (m) of landed nodes from their ideal places, and the root of the mean square of all of them.
pub fn positions(
    fabric: &Fabric,
    mold: &Mold,
    ideal: &Net,
    x: &[[f64; 3]],
    landed: impl Fn(usize) -> bool,
    step: usize,
) -> (Most, Option<f64>) {
    let (mut most, mut squares, mut areas) = (Most::default(), 0.0, 0.0);
    for (node, uv) in fabric.places.iter().enumerate().filter(|(node, _)| landed(*node)) {
        let Some(place) = ideal.place(mold, *uv) else { continue };
        let off = distance(x[node], place);
        most.meet(off, *uv, x[node], step);
        squares += fabric.areas[node] * off * off;
        areas += fabric.areas[node];
    }
    (most, (areas > 0.0).then(|| (squares / areas).sqrt()))
}
