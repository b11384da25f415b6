//! Bridges: where the ply touches the mold a second time and spans the gap between both touches.

use super::gap::Run;
use super::sampling::{STATIONS, fraction};
use super::spans::{FreeSpan, Point};
use crate::mold::{Mold, distance};

/// A touch away from the contact segment: the ply bridges the part of the mold between them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bridge {
    /// Place of the largest gap between segment and touch (m).
    pub place: Point,
    /// That gap (m).
    pub gap: f64,
    /// Straight distance between the touches on both sides of it (m).
    pub width: f64,
}

impl Bridge {
    /// The bridge with the largest gap between one of `runs`, ascending along a span, and the others; `None` if there is no other.
    pub fn widest(span: &FreeSpan, mold: &Mold, runs: &[Run], run: &Run) -> Option<Bridge> {
        let between = |other: &Run| match other.to < run.from {
            true => Bridge::between(span, mold, [other.to, run.from]),
            false => Bridge::between(span, mold, [run.to, other.from]),
        };
        let others = runs.iter().filter(|other| *other != run);
        others.map(between).max_by(|a, b| a.gap.total_cmp(&b.gap))
    }

    /// The largest gap between two fractions of a span.
    fn between(span: &FreeSpan, mold: &Mold, [from, to]: [f64; 2]) -> Bridge {
        let [a, b] = [from, to].map(|t| span.point(t));
        let mut worst = Bridge { place: a, gap: 0.0, width: distance(a, b) };
        for n in 0..STATIONS {
            let place = span.point(from + (to - from) * fraction(n));
            let gap = mold.signed_distance(place);
            if gap > worst.gap {
                worst = Bridge { place, gap, ..worst };
            }
        }
        worst
    }
}
