//! The generators: straight lines over the mold, or strips of cells that keep their shear.
//!
//! A straight line takes its direction along from node to node by parallel transport. A strip of least
//! shear (Krogh et al. 2021) grows from a known edge cell by cell: of the one-parameter family of cells
//! whose edges have their lengths, the one whose mean shear is the pre-shear.

use super::build::{Build, Node};
use super::edge::{EdgeRule, straightest};
use super::meet::{Condition, meet};
use super::shear::CellShear;
use super::surface_point::SurfacePoint;
use super::tuning::TUNING;
use crate::geometry::vector::{along, cross, dot, sub};

impl Build<'_> {
    /// The first node from the seed along u, of either sign: where its edge starts off in plan.
    fn first(
        &self,
        seed: &SurfacePoint,
        sign: f64,
        u: [f64; 3],
    ) -> Result<SurfacePoint, SurfacePoint> {
        let length = Condition::Length(seed, self.placement.mesh[0]);
        let (sin, cos) = self.placement.heading.sin_cos();
        let course = match self.rule() {
            EdgeRule::Chord => Condition::Plane(seed, [-sin, cos, 0.0]),
            EdgeRule::Along => Condition::Straight(seed, cross(seed.normal, u)),
        };
        let guess = along(seed.point, sign * self.placement.mesh[0], u);
        meet(&self.surface, self.rule(), [length, course], guess, self.mesh())
    }

    /// The next node of a straight line that leaves `from` along the unit tangent `course`.
    fn straight(
        &self,
        from: &SurfacePoint,
        course: [f64; 3],
        length: f64,
    ) -> Result<SurfacePoint, SurfacePoint> {
        let conditions = [
            Condition::Length(from, length),
            Condition::Straight(from, cross(from.normal, course)),
        ];
        let guess = along(from.point, length, course);
        meet(&self.surface, self.rule(), conditions, guess, self.mesh())
    }

    /// Four lines from the seed that go straight on over the mold.
    pub fn geodesics(&mut self, seed: Node, [u, v]: [[f64; 3]; 2]) {
        let Some(start) = self.point_at(seed) else { return };
        let (mut u, mut v) = (u, v);
        // a first bar gives the direction of both generators
        if self.rule() == EdgeRule::Chord
            && let Ok(next) = self.first(&start, 1.0, u)
        {
            u = straightest(&start, &next);
            v = self.placement.across(u, start.normal);
        }
        for (step, tangent, length) in [
            ([1, 0], u, self.placement.mesh[0]),
            ([-1, 0], u.map(|x| -x), self.placement.mesh[0]),
            ([0, 1], v, self.placement.mesh[1]),
            ([0, -1], v.map(|x| -x), self.placement.mesh[1]),
        ] {
            let (mut node, mut from, mut course) = (seed, start, tangent);
            loop {
                node = [node[0] + step[0], node[1] + step[1]];
                if self.index(node).is_none() {
                    break;
                }
                match self.straight(&from, course, length) {
                    Ok(next) => {
                        self.put(node, next);
                        course = straightest(&next, &from).map(|x| -x);
                        from = next;
                    }
                    Err(near) => {
                        self.note_fold(node, near);
                        break;
                    }
                }
            }
        }
    }

    /// The seed's first edge and four strips of cells that keep the pre-shear, from its two ends.
    pub fn least_shear(&mut self, seed: Node, u: [f64; 3]) {
        let Some(start) = self.point_at(seed) else { return };
        // the seed's cell lies ahead, or behind at the net's boundary
        let ahead = [0, 1].map(|n| {
            if self.placement.seed[n] + 1 < self.placement.nodes[n] { 1_isize } else { -1 }
        });
        let ends = [seed, [seed[0] + ahead[0], seed[1]]];
        match self.first(&start, ahead[0] as f64, u) {
            Ok(next) => self.put(ends[1], next),
            Err(near) => return self.note_fold(ends[1], near),
        }
        // across u on the side of the seed's cell, then along u from that cell's two other edges
        self.strip(ends, [0, ahead[1]]);
        self.strip(ends, [0, -ahead[1]]);
        let other = |end: Node| [end, [end[0], end[1] + ahead[1]]];
        self.strip(other(ends[0]), [-ahead[0], 0]);
        self.strip(other(ends[1]), [ahead[0], 0]);
    }

    /// Cells one after the other from a known edge, each with its shear at the pre-shear.
    fn strip(&mut self, edge: [Node; 2], step: Node) {
        let mut edge = edge;
        let mut before: Option<[f64; 3]> = None;
        loop {
            let next = edge.map(|n| [n[0] + step[0], n[1] + step[1]]);
            let [Some(a), Some(b)] = edge.map(|n| self.point_at(n)) else { return };
            if next.iter().any(|n| self.index(*n).is_none()) {
                return;
            }
            if next.iter().any(|n| self.point_at(*n).is_none()) {
                match self.least_shear_cell([(edge[0], a), (edge[1], b)], step, before) {
                    Ok([c, d]) => {
                        self.put(next[0], c);
                        self.put(next[1], d);
                    }
                    Err(near) => {
                        next.iter().for_each(|n| self.note_fold(*n, near));
                        return;
                    }
                }
            }
            before = self.point_at(next[0]).map(|c| straightest(&c, &a).map(|x| -x));
            edge = next;
        }
    }

    /// The two nodes beyond a known edge whose cell has the pre-shear: the direction in which the cell's
    /// side leaves the edge's first node is found by the secant method.
    fn least_shear_cell(
        &self,
        edge: [(Node, SurfacePoint); 2],
        step: Node,
        before: Option<[f64; 3]>,
    ) -> Result<[SurfacePoint; 2], SurfacePoint> {
        let [(first, a), (second, b)] = edge;
        let (length, width) = if step[0] != 0 {
            (self.placement.mesh[0], self.placement.mesh[1])
        } else {
            (self.placement.mesh[1], self.placement.mesh[0])
        };
        // the side's direction if the corner had the pre-shear itself
        let along_edge = straightest(&a, &b);
        let side = [second[0] - first[0], second[1] - first[1]];
        let left = (side[0] * step[1] - side[1] * step[0]) as f64;
        let sign = (step[0] + step[1]) as f64 * (side[0] + side[1]) as f64;
        let (sin, cos) = (sign * self.placement.shear).sin_cos();
        let across = cross(a.normal, along_edge).map(|x| left * x);
        let straight = [0, 1, 2].map(|n| cos * across[n] + sin * along_edge[n]);
        let mut turn =
            before.map_or(0.0, |t| dot(cross(straight, t), a.normal).atan2(dot(straight, t)));

        let cell = |turn: f64| -> Result<([SurfacePoint; 2], f64), SurfacePoint> {
            let (sin, cos) = turn.sin_cos();
            let around = cross(a.normal, straight);
            let course = [0, 1, 2].map(|n| cos * straight[n] + sin * around[n]);
            let near = self.straight(&a, course, length)?;
            let conditions = [Condition::Length(&b, length), Condition::Length(&near, width)];
            let guess = along(near.point, 1.0, sub(b.point, a.point));
            let far = meet(&self.surface, self.rule(), conditions, guess, self.mesh())?;
            let shear = self.shear_of([(first, a), (second, b)], step, [near, far]);
            Ok(([near, far], shear - self.placement.shear))
        };
        let (mut found, mut miss) = cell(turn)?;
        // turning the side by dφ changes the shear by ±dφ
        let mut slope = -left * sign;
        for _ in 0..TUNING.shear_iterations {
            if miss.abs() <= TUNING.shear_error {
                break;
            }
            let change = (-miss / slope).clamp(-TUNING.longest_turn, TUNING.longest_turn);
            let (next, missed) = cell(turn + change)?;
            if missed.abs() >= miss.abs() && miss.abs() < TUNING.largest_shear_error {
                break;
            }
            let rate = (missed - miss) / change;
            // the slope stays near the flat cell's rate
            if rate * slope > TUNING.smallest_rate && change.abs() > TUNING.largest_shear_error {
                slope = rate;
            }
            (turn, found, miss) = (turn + change, next, missed);
        }
        if miss.abs() <= TUNING.largest_shear_error { Ok(found) } else { Err(found[0]) }
    }

    /// Signed shear (rad) of the cell between a known edge and its two nodes beyond.
    fn shear_of(
        &self,
        edge: [(Node, SurfacePoint); 2],
        step: Node,
        beyond: [SurfacePoint; 2],
    ) -> f64 {
        let [(p, a), (q, b)] = edge;
        let [c, d] = beyond;
        let moved = |n: Node| [n[0] + step[0], n[1] + step[1]];
        let mut corners = [(p, a), (q, b), (moved(p), c), (moved(q), d)];
        // by v and then by u: [i, j], [i+1, j], [i, j+1], [i+1, j+1]
        corners.sort_by_key(|(n, _)| [n[1], n[0]]);
        let [s00, s10, s01, s11] = corners.map(|(_, point)| point);
        CellShear::new([&s00, &s10, &s11, &s01], self.rule()).angle
    }
}
