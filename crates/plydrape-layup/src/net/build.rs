//! Placing the nodes: first those of the generators, then quadrant by quadrant outwards.

use super::edge::EdgeRule;
use super::meet::{Condition, meet};
use super::missing::Reason;
use super::placement::{Generators, Placement};
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::vector::{along, cross, dot};

/// A node counted from [0, 0], or beside the net.
pub(super) type Node = [isize; 2];

/// A net being placed.
pub(super) struct Build<'a> {
    pub placement: &'a Placement,
    pub surface: ExtendedSurface<'a>,
    /// Node [i, j] at j·nu + i.
    pub points: Vec<Option<SurfacePoint>>,
    /// Nodes for which no place was found, and the last trial.
    pub folds: Vec<(usize, SurfacePoint)>,
}

impl Build<'_> {
    /// Places all nodes that can be.
    pub fn run(&mut self) -> Result<(), Error> {
        let seed = self.placement.seed.map(|n| n as isize);
        let start = self.surface.under(self.placement.place);
        let directions = self.placement.directions(start.normal)?;
        self.put(seed, start);
        let cells = self.placement.nodes.iter().all(|n| *n > 1);
        match self.placement.generators {
            Generators::LeastShear if cells => self.least_shear(seed, directions[0]),
            _ => self.geodesics(seed, directions),
        }
        for step in [[1, 1], [-1, 1], [-1, -1], [1, -1]] {
            self.quadrant(seed, step);
        }
        Ok(())
    }

    /// The node's index, if the net has it.
    pub fn index(&self, [i, j]: Node) -> Option<usize> {
        let [nu, nv] = self.placement.nodes;
        let [i, j] = [usize::try_from(i).ok()?, usize::try_from(j).ok()?];
        (i < nu && j < nv).then_some(j * nu + i)
    }

    /// Where a node is; `None` if it has no place, or is not one of the net.
    pub fn point_at(&self, node: Node) -> Option<SurfacePoint> {
        self.points[self.index(node)?]
    }

    pub fn put(&mut self, node: Node, point: SurfacePoint) {
        if let Some(index) = self.index(node) {
            self.points[index] = Some(point);
        }
    }

    pub fn note_fold(&mut self, node: Node, near: SurfacePoint) {
        if let Some(index) = self.index(node)
            && !self.folds.iter().any(|(n, _)| *n == index)
        {
            self.folds.push((index, near));
        }
    }

    pub fn rule(&self) -> EdgeRule {
        self.placement.edges
    }

    pub fn mesh(&self) -> f64 {
        self.placement.mesh[0].min(self.placement.mesh[1])
    }

    /// All nodes of one quadrant, row by row from the generators outwards.
    fn quadrant(&mut self, seed: Node, [a, b]: Node) {
        let mut row = seed[1] + b;
        while self.index([seed[0], row]).is_some() {
            let mut column = seed[0] + a;
            while let Some(index) = self.index([column, row]) {
                if self.points[index].is_none() {
                    match self.corner([column, row], [a, b]) {
                        Some(Ok(point)) => self.points[index] = Some(point),
                        Some(Err(near)) => self.note_fold([column, row], near),
                        None => {}
                    }
                }
                column += a;
            }
            row += b;
        }
    }

    /// A node from its two neighbors nearer to the seed and the node between them; `None` without these.
    fn corner(&self, [i, j]: Node, [a, b]: Node) -> Option<Result<SurfacePoint, SurfacePoint>> {
        let (along_u, along_v) = (self.point_at([i - a, j])?, self.point_at([i, j - b])?);
        let inner = self.point_at([i - a, j - b])?;
        let [du, dv] = self.placement.mesh;
        let conditions = [Condition::Length(&along_u, du), Condition::Length(&along_v, dv)];
        // the fourth corner of a parallelogram
        let flat = [0, 1, 2].map(|n| along_u.point[n] + along_v.point[n] - inner.point[n]);
        // the twist of the cell, extrapolated from the cells before
        let twist = |i: isize, j: isize| -> Option<[f64; 3]> {
            let [p, q, r, s] = [
                self.point_at([i, j])?.point,
                self.point_at([i - a, j])?.point,
                self.point_at([i, j - b])?.point,
                self.point_at([i - a, j - b])?.point,
            ];
            Some([0, 1, 2].map(|n| p[n] - q[n] - r[n] + s[n]))
        };
        let (behind, below, corner) = (twist(i - a, j), twist(i, j - b), twist(i - a, j - b));
        let twist = match (behind, below, corner) {
            (Some(p), Some(q), Some(r)) => Some([0, 1, 2].map(|n| p[n] + q[n] - r[n])),
            (p, q, _) => p.or(q),
        };
        let sign = (a * b) as f64;
        let mut last = None;
        // a place with the right lengths may still be the mirrored one, or a cell that has collapsed
        for guess in twist.map(|t| along(flat, 1.0, t)).into_iter().chain([flat]) {
            match meet(&self.surface, self.rule(), conditions, guess, self.mesh()) {
                Ok(point) => {
                    let u = self.rule().gradient(&along_u, &point);
                    let v = self.rule().gradient(&along_v, &point);
                    let [uu, vv, uv] = [dot(u, u), dot(v, v), dot(u, v)];
                    let upright = sign * dot(cross(u, v), point.normal) > 0.0;
                    if upright && uv.abs() < TUNING.smallest_angle_cosine * (uu * vv).sqrt() {
                        return Some(Ok(point));
                    }
                    last = Some(point);
                }
                Err(near) => last = Some(last.unwrap_or(near)),
            }
        }
        last.map(Err)
    }

    /// Why the node at an index has no place on the mold, where its last trial is, and how far beyond the boundary (m); `None` if it has one.
    pub fn reason(&self, index: usize) -> Option<(Reason, Option<[f64; 3]>, Option<f64>)> {
        match self.points[index] {
            Some(point) if point.beyond > 0.0 => {
                Some((Reason::OffMold, Some(point.point), Some(point.beyond)))
            }
            Some(_) => None,
            None => Some(match self.folds.iter().find(|(n, _)| *n == index) {
                // fabric beside the mold has no fold of the mold's making
                Some((_, near)) if near.beyond > 0.0 => {
                    (Reason::OffMold, Some(near.point), Some(near.beyond))
                }
                Some((_, near)) => (Reason::Folded, Some(near.point), None),
                None if self.folds.iter().all(|(_, near)| near.beyond > 0.0) => {
                    (Reason::OffMold, None, None)
                }
                None => (Reason::Unreached, None, None),
            }),
        }
    }
}
