//! Gaps between the faces of a mold: boundaries that face each other at a small distance.

use super::Mesh;
use super::detail::Size;
use super::side::Sides;
use crate::geometry::vector::{distance, dot, sub};
use crate::mold::tuning::TUNING;
use std::collections::HashMap;

/// Gaps between the faces of a mold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Gaps {
    /// Their width at the narrowest place (m).
    pub narrowest: f64,
    /// Their width at the widest place (m).
    pub widest: f64,
    /// Their length (m).
    pub length: f64,
    /// Where they are widest (m).
    pub place: [f64; 3],
}

impl Mesh {
    /// Gaps and steps between faces that are no wider than `width` (m); `None` where faces meet. A hole in a face is none.
    #[must_use]
    pub fn gaps(&self, width: f64) -> Option<Gaps> {
        let sides = Sides::new(&self.vertices, &self.triangles);
        // a narrow hole faces itself, and is a hole
        let holes = self.boundaries.iter().filter(|boundary| {
            let points: Vec<[f64; 3]> =
                boundary.vertices.iter().map(|n| self.vertices[*n as usize]).collect();
            boundary.hole && Size::new(&points, None).is_some_and(|size| size.width <= width)
        });
        let holes: HashMap<u32, usize> = holes
            .enumerate()
            .flat_map(|(n, hole)| hole.vertices.iter().map(move |vertex| (*vertex, n)))
            .collect();
        let mut gaps: Option<Gaps> = None;
        for side in &sides.all {
            let middle = side.point_at(0.5);
            let mut across: Option<f64> = None;
            for n in sides.near([middle].into_iter(), width) {
                let other = &sides.all[n];
                let [one, two] = [side, other].map(|side| holes.get(&side.ends[0]));
                if (one.is_some() && one == two) || !side.faces(other) {
                    continue;
                }
                // what lies on the other side of its own face is no gap
                let opposite = dot(side.outward, other.outward) < -TUNING.parallel_sides;
                let (share, away) = other.closest(middle);
                let outside = dot(sub(other.point_at(share), middle), side.outward) >= -0.5 * away;
                if opposite && outside && away <= width && across.is_none_or(|least| away < least) {
                    across = Some(away);
                }
            }
            let Some(away) = across.filter(|away| *away > TUNING.merge * self.size) else {
                continue;
            };
            let own = gaps.get_or_insert(Gaps {
                narrowest: away,
                widest: away,
                length: 0.0,
                place: middle,
            });
            own.narrowest = own.narrowest.min(away);
            // both of its sides say how long it is
            own.length += 0.5 * distance(side.points[0], side.points[1]);
            if away > own.widest {
                (own.widest, own.place) = (away, middle);
            }
        }
        gaps
    }
}
