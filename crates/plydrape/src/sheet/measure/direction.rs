//! Directions of the fibers at the end: out of the mold's plane, and along it against the ideal drape.

use super::super::fabric::Fabric;
use super::{Most, middle};
use crate::mold::Mold;
use crate::mold::vector::{along, cross, dot, norm, sub, unit};
use crate::net::Net;

/// The largest angles (rad) between a cell's mid-lines and the mold's tangent plane, and, along the mold, between them and
/// the fibers of the ideal drape.
pub fn directions(
    fabric: &Fabric,
    mold: &Mold,
    ideal: Option<&Net>,
    x: &[[f64; 3]],
    step: usize,
) -> [Most; 2] {
    let mut most = [Most::default(); 2];
    for cell in fabric.cells.iter().filter(|cell| cell.is_ply()) {
        let [a, b, c, d] = cell.nodes.map(|n| x[n as usize]);
        let at = middle([a, b, c, d]);
        let uv = middle(cell.nodes.map(|n| fabric.places[n as usize]));
        let closest = mold.closest_point(at);
        if closest.beyond {
            continue;
        }
        let lines = [[b, c, a, d], [c, d, a, b]];
        let lines = lines.map(|[p, q, r, s]| unit(sub(middle([p, q]), middle([r, s]))));
        let fibres = ideal.and_then(|net| net.fibres(mold, uv));
        for (n, line) in lines.into_iter().enumerate() {
            let Some(line) = line else { continue };
            let rise = dot(line, closest.normal);
            let flat = along(line, -rise, closest.normal);
            most[0].meet(rise.abs().atan2(norm(flat)), uv, at, step);
            if let (Some(fibres), Some(flat)) = (fibres, unit(flat)) {
                let angle = norm(cross(flat, fibres[n])).atan2(dot(flat, fibres[n]));
                most[1].meet(angle, uv, at, step);
            }
        }
    }
    most
}
