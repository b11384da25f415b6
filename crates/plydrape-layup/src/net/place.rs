//! Between the nodes: where any point of the fabric lies, and which way its fibers run there.
//!
//! Places come from the tensor product of cubics through 4 × 4 nodes around the point's cell, moved to
//! their closest point on the mold; near the boundary of the net, or beside missing nodes, the 4 × 4 nodes lie more to
//! one side, or are fewer. The cubics' error is of fourth order in the mesh width.

use super::Net;
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use crate::geometry::vector::{along, dot, unit};
use crate::mold::Mold;
use crate::ply::Ply;

/// The nodes that a place is interpolated from: the lowest one and how many each way.
struct Patch {
    from: [usize; 2],
    size: [usize; 2],
}

impl Net {
    /// X*(u, v): where the fabric point `uv` (m) lies on the mold (m); none off
    /// the fabric, off the mold or where the net has no nodes. Exact at nodes.
    #[must_use]
    pub fn place(&self, mold: &Mold, uv: [f64; 2]) -> Option<[f64; 3]> {
        let (patch, at) = self.patch(uv)?;
        let [p, q] = [0, 1].map(|n| weights(at[n], patch.size[n]).0);
        let closest = mold.closest_point(self.sum(&patch, p, q));
        (!closest.beyond).then_some(closest.point)
    }

    /// Unit tangents of u and v at the fabric point `uv` (m); `None` where [`Net::place`] is none.
    #[must_use]
    pub fn fibers(&self, mold: &Mold, uv: [f64; 2]) -> Option<[[f64; 3]; 2]> {
        let (patch, at) = self.patch(uv)?;
        let [(p, dp), (q, dq)] = [0, 1].map(|n| weights(at[n], patch.size[n]));
        let closest = mold.closest_point(self.sum(&patch, p, q));
        if closest.beyond {
            return None;
        }
        let tangent = |d: [f64; 3]| unit(along(d, -dot(d, closest.normal), closest.normal));
        let scaled = |d: [f64; 3], width: f64| d.map(|x| x / width);
        let [du, dv] = self.placement.mesh;
        Some([
            tangent(scaled(self.sum(&patch, dp, q), du))?,
            tangent(scaled(self.sum(&patch, p, dq), dv))?,
        ])
    }

    /// As [`Net::place`], of the fabric that a ply has at `uv` (m) by the error of its pick-up: to the first order in that, so that it is known up
    /// to the edges of the ply.
    #[must_use]
    pub fn held_place(&self, mold: &Mold, ply: &Ply, uv: [f64; 2]) -> Option<[f64; 3]> {
        let place = self.place(mold, uv)?;
        if ply.pick_up_error.is_none() {
            return Some(place);
        }
        let ([u, v], off) = (self.fibers(mold, uv)?, ply.held_off(uv));
        Some(along(along(place, off[0], u), off[1], v))
    }

    /// As [`Net::fibers`], along the lines u and v of a ply that is turned by the error of its pick-up.
    #[must_use]
    pub fn held_fibers(&self, mold: &Mold, ply: &Ply, uv: [f64; 2]) -> Option<[[f64; 3]; 2]> {
        let ([u, v], yaw) = (self.fibers(mold, uv)?, ply.pick_up_error.yaw);
        Some([unit(along(u, yaw, v))?, unit(along(v, -yaw, u))?])
    }

    /// Where a fabric point (m) lies on a mold or on its extension; `None` where the net has no nodes.
    pub(super) fn surface_point(
        &self,
        surface: &ExtendedSurface,
        uv: [f64; 2],
    ) -> Option<SurfacePoint> {
        let (patch, at) = self.patch(uv)?;
        let [p, q] = [0, 1].map(|n| weights(at[n], patch.size[n]).0);
        Some(surface.under(self.sum(&patch, p, q)))
    }

    /// A vector along u at a fabric point (m), about tangent to the mold; `None` where the net has no nodes.
    pub(super) fn tangent_u(&self, uv: [f64; 2]) -> Option<[f64; 3]> {
        let (patch, at) = self.patch(uv)?;
        let [(_, dp), (q, _)] = [0, 1].map(|n| weights(at[n], patch.size[n]));
        unit(self.sum(&patch, dp, q).map(|x| x / self.placement.mesh[0]))
    }

    /// The nodes around a fabric point, and where it lies among them, in mesh widths from the lowest.
    fn patch(&self, uv: [f64; 2]) -> Option<(Patch, [f64; 2])> {
        let mut cell = [0_usize; 2];
        let mut at = [0.0_f64; 2];
        for n in 0..2 {
            let last = self.placement.nodes[n] - 1;
            // a rounding error beyond the boundary is the boundary
            let t = (uv[n] - self.placement.origin[n]) / self.placement.mesh[n];
            if !(-TUNING.boundary_rounding..=last as f64 + TUNING.boundary_rounding).contains(&t) {
                return None;
            }
            at[n] = t.clamp(0.0, last as f64);
            cell[n] = (at[n] as usize).min(last.saturating_sub(1));
        }
        for most in [4, 3, 2] {
            let size = self.placement.nodes.map(|n| n.min(most));
            // the most central first
            let [first, second] =
                [0, 1].map(|n| origins(cell[n], size[n], self.placement.nodes[n]));
            let mut pairs: Vec<(usize, [usize; 2])> = Vec::with_capacity(16);
            for (p, i) in &first {
                for (q, j) in &second {
                    pairs.push((p + q, [*i, *j]));
                }
            }
            pairs.sort_by_key(|(off, _)| *off);
            let whole = |from: &[usize; 2]| {
                let [nu, _] = self.placement.nodes;
                (0..size[1]).all(|q| {
                    (0..size[0]).all(|p| self.points[(from[1] + q) * nu + from[0] + p].is_some())
                })
            };
            if let Some((_, from)) = pairs.into_iter().find(|(_, from)| whole(from)) {
                let at = [0, 1].map(|n| at[n] - from[n] as f64);
                return Some((Patch { from, size }, at));
            }
        }
        None
    }

    /// The nodes of a patch, summed with weights along u and v (m).
    fn sum(&self, patch: &Patch, p: [f64; 4], q: [f64; 4]) -> [f64; 3] {
        let ([i, j], [nu, _]) = (patch.from, self.placement.nodes);
        let mut sum = [0.0; 3];
        for n in 0..patch.size[1] {
            for m in 0..patch.size[0] {
                if let Some(point) = self.points[(j + n) * nu + i + m] {
                    sum = along(sum, p[m] * q[n], point.point);
                }
            }
        }
        sum
    }
}

/// Where `size` nodes that hold a cell may begin among `nodes`, each with how far off the middle.
fn origins(cell: usize, size: usize, nodes: usize) -> Vec<(usize, usize)> {
    let high = cell.min(nodes - size);
    let low = (cell + 2).saturating_sub(size).min(high);
    // twice the distance between the middles of the nodes and of the cell
    (low..=high).map(|i| ((2 * i + size).abs_diff(2 * cell + 2), i)).collect()
}

/// Lagrange's weights of the nodes 0, 1, … at `t`, and their derivatives.
fn weights(t: f64, size: usize) -> ([f64; 4], [f64; 4]) {
    let (mut value, mut slope) = ([0.0; 4], [0.0; 4]);
    for n in 0..size {
        let (mut product, mut rate) = (1.0, 0.0);
        for m in (0..size).filter(|m| *m != n) {
            let gap = n as f64 - m as f64;
            rate = (rate * (t - m as f64) + product) / gap;
            product *= (t - m as f64) / gap;
        }
        (value[n], slope[n]) = (product, rate);
    }
    (value, slope)
}
