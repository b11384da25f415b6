//! Curves that are joined end to end into closed lines.
//!
//! Ends that are the same but for rounding join first. Of those that are left, the nearest join over gaps up to a tolerance, as
//! drawings have them that were exploded or converted: both ends move to the middle of their gap.

use super::entity::{Curve, Placed};
use super::place::{EntityPlace, mm, toml};
use crate::error::Fault;
use plydrape::ply::Ring;
use std::collections::BTreeSet;

/// Open ends near one end that are looked at: where there are more, nobody can say which one it belongs to.
const MOST_NEAR: usize = 8;

/// A closed line.
#[derive(Debug, Clone)]
pub struct Closed {
    /// Points (m).
    pub ring: Ring,
    /// A curve and a point of it, for messages.
    pub place: EntityPlace,
    /// The layers of its curves.
    pub layers: BTreeSet<String>,
    /// The block that its curves are of.
    pub placed: Placed,
    /// Widths of the gaps that were closed in it (m).
    pub gaps: Vec<f64>,
}

/// An end of a curve that joins no other one, or is one of several at a point.
#[derive(Debug, Clone)]
pub struct Open {
    /// The curve, and where it ends.
    pub place: EntityPlace,
    /// Whether more than two curves end there.
    pub is_crowded: bool,
    /// Counts the ends of curves in the order of the file.
    order: usize,
}

/// Curves that were joined as far as they join.
#[derive(Debug, Clone, Default)]
pub struct Chained {
    /// Closed lines.
    pub closed: Vec<Closed>,
    /// What does not close.
    pub open: Vec<Open>,
}

/// How far ends that join are from one another (m).
#[derive(Debug, Clone, Copy)]
pub struct Reach {
    /// Ends that are the same but for rounding.
    pub join: f64,
    /// Ends with a gap between them.
    pub gap: f64,
}

impl Chained {
    /// What to say of an open end, in a drawing of a size (m).
    pub fn fault(&self, open: &Open, reach: Reach, file: &str, size: f64) -> Fault {
        let Open { place, is_crowded, .. } = open;
        let others = |crowded: bool| {
            let same = move |other: &&Open| other.is_crowded == crowded;
            self.open.iter().filter(same).map(|other| other.place.at)
        };
        if *is_crowded {
            let count = others(true).filter(|at| apart(*at, place.at) <= 2.0 * reach.join).count();
            return Fault::new(
                format!("{count} curves end at {}, one of them {place}", mm(place.at)),
                "remove lines that are drawn twice, or choose the layer that has the outline alone",
            );
        }
        let far = |at: &[f64; 2]| apart(place.at, *at);
        let mut itself = true;
        let rest = others(false).filter(|at| far(at) > 0.0 || !std::mem::take(&mut itself));
        let next = rest.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(place.at);
        let gap = far(&next);
        let mut help =
            "join the ends in the drawing, or choose the layer that has the outline alone"
                .to_owned();
        if gap > reach.gap && gap <= WIDEST * size {
            // upwards, so that the gap is within it
            let (file, wide) = (toml(file), (gap * 1e5).floor() * 1e-2 + 0.01);
            help += &format!(
                "; gaps up to a tolerance are closed, as in outline = {{ file = {file}, tolerance = \"{wide:.2} mm\" }}"
            );
        }
        Fault::new(
            format!(
                "{place} is not closed: it ends {:.3} mm from the nearest other open end, which is at {}",
                gap * 1e3,
                mm(next)
            ),
            help,
        )
    }
}

/// A gap that is wider than this share of the drawing is no gap that a tolerance should close.
const WIDEST: f64 = 1e-3;

/// All closed lines of curves.
pub fn closed(curves: Vec<Curve>, reach: Reach) -> Chained {
    let mut found = Chained::default();
    let mut open = Vec::new();
    for mut curve in curves {
        let first = curve.points[0];
        let last = curve.points[curve.points.len() - 1];
        let extent = curve.points.iter().map(|p| apart(first, *p)).fold(0.0, f64::max);
        if extent <= reach.join {
            // a line of no length
            continue;
        }
        if curve.points.len() > 1 && apart(first, last) <= reach.join {
            curve.points.pop();
            curve.closed = true;
        }
        if curve.closed {
            found.closed.push(Closed {
                place: curve.place(first),
                ring: curve.points,
                layers: BTreeSet::from([curve.layer]),
                placed: curve.placed,
                gaps: Vec::new(),
            });
        } else {
            open.push((curve, extent));
        }
    }
    let (mut open, extents): (Vec<Curve>, Vec<f64>) = open.into_iter().unzip();
    let mut joints = same(&open, reach.join);
    over_gaps(&mut open, &extents, &mut joints, reach.gap);
    trace(&open, &joints, &mut found);
    found
}

/// An end of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
struct End {
    curve: usize,
    last: bool,
}

impl End {
    fn index(self) -> usize {
        2 * self.curve + usize::from(self.last)
    }

    fn new(index: usize) -> Self {
        End { curve: index / 2, last: index % 2 == 1 }
    }

    fn other(self) -> Self {
        End { last: !self.last, ..self }
    }

    fn point(self, curves: &[Curve]) -> [f64; 2] {
        let points = &curves[self.curve].points;
        if self.last { points[points.len() - 1] } else { points[0] }
    }

    fn place(self, curves: &[Curve]) -> EntityPlace {
        curves[self.curve].place(self.point(curves))
    }
}

/// What an end of a curve joins.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Joint {
    /// No other end.
    Alone,
    /// One other end, over a gap (m).
    To(End, f64),
    /// More than one.
    Crowded,
}

/// For each end the other one that is the same but for rounding.
fn same(curves: &[Curve], join: f64) -> Vec<Joint> {
    let mut joints = vec![Joint::Alone; 2 * curves.len()];
    for [a, b] in near((0..joints.len()).map(End::new).collect(), curves, join) {
        for (from, to) in [(a, b), (b, a)] {
            let joint = &mut joints[from.index()];
            *joint = if *joint == Joint::Alone { Joint::To(to, 0.0) } else { Joint::Crowded };
        }
    }
    joints
}

/// Pairs of ends that are no farther apart than a distance (m).
fn near<'a>(
    ends: Vec<End>,
    curves: &'a [Curve],
    most: f64,
) -> impl Iterator<Item = [End; 2]> + use<'a> {
    let mut sorted: Vec<([f64; 2], End)> =
        ends.into_iter().map(|end| (end.point(curves), end)).collect();
    sorted.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    (0..sorted.len()).flat_map(move |n| {
        let (at, end) = sorted[n];
        let next = sorted[n + 1..].iter().take_while(|(b, _)| b[0] - at[0] <= most);
        let pairs = next.filter(|(b, _)| apart(at, *b) <= most).map(|(_, other)| [end, *other]);
        // an end among very many is crowded, however many they are
        pairs.take(MOST_NEAR + 1).collect::<Vec<_>>()
    })
}

/// Joins the ends that are alone over gaps up to a width (m), the narrowest first; both move to the middle of their gap.
fn over_gaps(curves: &mut [Curve], extents: &[f64], joints: &mut [Joint], gap: f64) {
    let alone = (0..joints.len()).filter(|end| joints[*end] == Joint::Alone).map(End::new);
    // a line that is no longer than a gap does not close in itself
    let apart_enough = |[a, b]: &[End; 2]| a.curve != b.curve || extents[a.curve] > 2.0 * gap;
    let mut pairs: Vec<(f64, [End; 2])> = near(alone.collect(), curves, gap)
        .filter(apart_enough)
        .map(|pair| (apart(pair[0].point(curves), pair[1].point(curves)), pair))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (width, [a, b]) in pairs {
        if [a, b].iter().any(|end| joints[end.index()] != Joint::Alone) {
            continue;
        }
        let (p, q) = (a.point(curves), b.point(curves));
        let middle = [0, 1].map(|n| 0.5 * (p[n] + q[n]));
        for (from, to) in [(a, b), (b, a)] {
            joints[from.index()] = Joint::To(to, width);
            let points = &mut curves[from.curve].points;
            let end = if from.last { points.len() - 1 } else { 0 };
            points[end] = middle;
        }
    }
}

/// Follows curves from end to end: each belongs to a closed line, or to what is open.
fn trace(curves: &[Curve], joints: &[Joint], found: &mut Chained) {
    let mut used = vec![false; curves.len()];
    for start in 0..curves.len() {
        if used[start] {
            continue;
        }
        let mut ring = Ring::new();
        let mut gaps = Vec::new();
        let mut layers = BTreeSet::new();
        let placed = &curves[start].placed;
        let mut of_one = true;
        // from the first end of a curve to its other one, on to that end's partner, and so around
        let mut begin = End { curve: start, last: false };
        let stuck = loop {
            let curve = &curves[begin.curve];
            used[begin.curve] = true;
            layers.insert(curve.layer.clone());
            of_one &= curve.placed == *placed;
            let from = curve.points.len() - 1;
            // the end is the partner's beginning
            if begin.last {
                ring.extend(curve.points[1..].iter().rev());
            } else {
                ring.extend(&curve.points[..from]);
            }
            let Some(next) = partner(joints, begin.other()) else { break Some(begin.other()) };
            if let Joint::To(_, gap) = joints[next.index()] {
                gaps.extend(Some(gap).filter(|gap| *gap > 0.0));
            }
            begin = next;
            if begin.curve == start {
                break None;
            }
        };
        let Some(end) = stuck else {
            let place = curves[start].place(curves[start].points[0]);
            let placed = if of_one { placed.clone() } else { Placed::default() };
            found.closed.push(Closed { ring, place, layers, placed, gaps });
            continue;
        };
        // what is behind the start is open too
        let mut back = End { curve: start, last: false };
        while let Some(next) = partner(joints, back).filter(|next| !used[next.curve]) {
            used[next.curve] = true;
            back = next.other();
        }
        found.open.extend([end, back].map(|end| Open {
            place: end.place(curves),
            is_crowded: joints[end.index()] != Joint::Alone,
            order: end.index(),
        }));
    }
    found.open.sort_by_key(|open| (!open.is_crowded, open.order));
}

/// The end that an end joins, and that joins it.
fn partner(joints: &[Joint], end: End) -> Option<End> {
    let joined = |end: End| match joints[end.index()] {
        Joint::To(other, _) => Some(other),
        Joint::Alone | Joint::Crowded => None,
    };
    joined(end).filter(|other| joined(*other) == Some(end))
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
