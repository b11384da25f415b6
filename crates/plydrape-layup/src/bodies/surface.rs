//! The surface of a body in parts, each within a ball: what its distance from the mold is found on.
//!
//! A part is divided until it is small enough. Those of a cylinder are ranges of angle, radius and height, so that they lie on
//! the cylinder itself; triangles are kept in a tree of balls, whose leaves are divided into smaller triangles.

use super::body::Shape;
use crate::geometry::vector::{between, dot, sub};
use crate::mold::distance;
use std::f64::consts::TAU;

/// A part of a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Patch {
    /// A range of angle (rad), radius and height (m); one of the last two is a single value.
    Round { angle: [f64; 2], radius: [f64; 2], height: [f64; 2] },
    /// A triangle by its corners (m).
    Triangle([[f64; 3]; 3]),
    /// Triangles: a node of the tree.
    Node(usize),
}

/// Triangles within a ball.
#[derive(Debug, Clone, Copy)]
struct Node {
    middle: [f64; 3],
    radius: f64,
    parts: [Patch; 2],
}

/// The surface of a body.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    /// The parts that it begins with.
    pub patches: Vec<Patch>,
    tree: Vec<Node>,
}

impl Surface {
    pub fn new(shape: &Shape) -> Self {
        match shape {
            Shape::Cylinder { radius, from, to } => {
                let ends = [from, to].map(|z| Patch::Round {
                    angle: [0.0, TAU],
                    radius: [0.0, *radius],
                    height: [*z; 2],
                });
                let side =
                    Patch::Round { angle: [0.0, TAU], radius: [*radius; 2], height: [*from, *to] };
                Surface { patches: vec![ends[0], ends[1], side], tree: Vec::new() }
            }
            Shape::Box { .. } | Shape::Mesh { .. } => {
                let (vertices, triangles) = shape.triangles(0);
                let corners = triangles.iter().map(|t| t.map(|n| vertices[n as usize]));
                Surface::of_triangles(corners.collect())
            }
        }
    }

    fn of_triangles(mut triangles: Vec<[[f64; 3]; 3]>) -> Self {
        let mut surface = Surface { patches: Vec::new(), tree: Vec::new() };
        if !triangles.is_empty() {
            let whole = surface.grow(&mut triangles);
            surface.patches.push(whole);
        }
        surface
    }

    /// The tree of triangles, cut at the median of their middles along the longest side of these.
    fn grow(&mut self, triangles: &mut [[[f64; 3]; 3]]) -> Patch {
        if let [triangle] = triangles {
            return Patch::Triangle(*triangle);
        }
        let middle = |t: &[[f64; 3]; 3]| [0, 1, 2].map(|c| (t[0][c] + t[1][c] + t[2][c]) / 3.0);
        let range = |c: usize| {
            let values = triangles.iter().map(|t| middle(t)[c]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            [low, values.fold(f64::NEG_INFINITY, f64::max)]
        };
        let ranges = [0, 1, 2].map(range);
        let axis = (0..3).max_by(|a, b| {
            let wide = |c: usize| ranges[c][1] - ranges[c][0];
            wide(*a).total_cmp(&wide(*b))
        });
        let axis = axis.unwrap_or(0);
        triangles.sort_by(|a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
        let center = ranges.map(|[low, high]| 0.5 * (low + high));
        let reach = triangles.iter().flatten().map(|p| distance(*p, center)).fold(0.0, f64::max);
        let half = triangles.len() / 2;
        let (a, b) = triangles.split_at_mut(half);
        let parts = [self.grow(a), self.grow(b)];
        self.tree.push(Node { middle: center, radius: reach, parts });
        Patch::Node(self.tree.len() - 1)
    }

    /// A point that is in the middle of a part, or of the ball around it (m); the farthest distance of the part's points from there
    /// (m); and whether the point belongs to the part.
    pub fn ball(&self, patch: &Patch) -> ([f64; 3], f64, bool) {
        match patch {
            Patch::Round { angle, radius, height } => {
                let [a, r, z] = [angle, radius, height].map(|[from, to]| 0.5 * (from + to));
                // along the radius, then along the circle: half of the angle to either side
                let turn = 2.0 * r * (0.25 * (angle[1] - angle[0])).sin();
                let across = 0.5 * (radius[1] - radius[0]) + turn;
                let reach = across.hypot(0.5 * (height[1] - height[0]));
                ([r * a.cos(), r * a.sin(), z], reach, true)
            }
            Patch::Triangle(corners) => {
                let middle = [0, 1, 2].map(|c| corners.iter().map(|p| p[c]).sum::<f64>() / 3.0);
                let reach = corners.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max);
                (middle, reach, true)
            }
            Patch::Node(n) => (self.tree[*n].middle, self.tree[*n].radius, false),
        }
    }

    /// How far a part reaches at most from its middle against a unit vector (m).
    pub fn extent(&self, patch: &Patch, along: [f64; 3]) -> f64 {
        let (middle, reach, _) = self.ball(patch);
        match patch {
            Patch::Round { radius, height, angle } => {
                let turn = (radius[0] + radius[1]) * (0.25 * (angle[1] - angle[0])).sin();
                let across = 0.5 * (radius[1] - radius[0]) + turn;
                along[0].hypot(along[1]) * across + along[2].abs() * 0.5 * (height[1] - height[0])
            }
            Patch::Triangle(corners) => {
                let down = |p: &[f64; 3]| dot(sub(middle, *p), along);
                corners.iter().map(down).fold(0.0, f64::max)
            }
            Patch::Node(_) => reach,
        }
    }

    /// The two halves of a part.
    pub fn halves(&self, patch: &Patch) -> [Patch; 2] {
        match *patch {
            Patch::Round { angle, radius, height } => {
                let long = |[from, to]: [f64; 2]| to - from;
                let around = radius[1] * long(angle);
                let cut =
                    |[from, to]: [f64; 2]| [[from, 0.5 * (from + to)], [0.5 * (from + to), to]];
                if around >= long(radius).max(long(height)) {
                    cut(angle).map(|angle| Patch::Round { angle, radius, height })
                } else if long(radius) >= long(height) {
                    cut(radius).map(|radius| Patch::Round { angle, radius, height })
                } else {
                    cut(height).map(|height| Patch::Round { angle, radius, height })
                }
            }
            Patch::Triangle([a, b, c]) => {
                let sides = [distance(a, b), distance(b, c), distance(c, a)];
                let [a, b, c] = match sides {
                    [ab, bc, ca] if ab >= bc && ab >= ca => [a, b, c],
                    [_, bc, ca] if bc >= ca => [b, c, a],
                    _ => [c, a, b],
                };
                let middle = between(a, b, 0.5);
                [Patch::Triangle([a, middle, c]), Patch::Triangle([middle, b, c])]
            }
            Patch::Node(n) => self.tree[n].parts,
        }
    }
}
