//! Curves that are joined end to end into closed lines.

use super::entity::Curve;
use super::place::{Place, mm};
use crate::error::Fault;
use plydrape::ply::Ring;

/// A closed line, and a curve of it for messages.
#[derive(Debug)]
pub struct Closed {
    /// Its points (m).
    pub ring: Ring,
    /// A curve and a point of it.
    pub place: Place,
}

/// All closed lines of curves, of which ends join within a distance (m).
///
/// # Errors
/// [`Fault`] for an end that meets none, or more than one.
pub fn closed(curves: Vec<Curve>, join: f64) -> Result<Vec<Closed>, Fault> {
    let mut found = Vec::new();
    let mut open = Vec::new();
    for mut curve in curves {
        let first = curve.points[0];
        let last = curve.points[curve.points.len() - 1];
        let extent = curve.points.iter().map(|p| apart(first, *p)).fold(0.0, f64::max);
        if extent <= join {
            // a line of no length
            continue;
        }
        if curve.points.len() > 1 && apart(first, last) <= join {
            curve.points.pop();
            curve.closed = true;
        }
        if curve.closed {
            found.push(Closed { place: curve.place(first), ring: curve.points });
        } else {
            open.push(curve);
        }
    }
    let partners = partners(&open, join)?;
    let mut used = vec![false; open.len()];
    for start in 0..open.len() {
        if used[start] {
            continue;
        }
        let place = open[start].place(open[start].points[0]);
        let mut ring = Ring::new();
        // from the first end of a curve to its other one, on to that end's partner, and so around
        let mut end = End { curve: start, last: false };
        while !used[end.curve] {
            used[end.curve] = true;
            let points = &open[end.curve].points;
            let from = points.len() - 1;
            // the end is the partner's beginning
            if end.last {
                ring.extend(points[1..].iter().rev());
            } else {
                ring.extend(&points[..from]);
            }
            end = partners[End { last: !end.last, ..end }.index()];
        }
        found.push(Closed { ring, place });
    }
    Ok(found)
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

    fn at(self, curves: &[Curve]) -> [f64; 2] {
        let points = &curves[self.curve].points;
        if self.last { points[points.len() - 1] } else { points[0] }
    }

    fn place(self, curves: &[Curve]) -> Place {
        curves[self.curve].place(self.at(curves))
    }
}

/// For each end the one that it joins.
fn partners(curves: &[Curve], join: f64) -> Result<Vec<End>, Fault> {
    let ends = |curve| [false, true].map(|last| End { curve, last });
    let all: Vec<End> = (0..curves.len()).flat_map(ends).collect();
    let mut sorted: Vec<([f64; 2], End)> = all.iter().map(|end| (end.at(curves), *end)).collect();
    sorted.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut partners: Vec<Option<End>> = vec![None; all.len()];
    for (n, (at, end)) in sorted.iter().enumerate() {
        for (other_at, other) in sorted[n + 1..].iter().take_while(|(b, _)| b[0] - at[0] <= join) {
            if apart(*at, *other_at) > join {
                continue;
            }
            for (a, b) in [(end, other), (other, end)] {
                if partners[a.index()].replace(*b).is_some() {
                    let count = all.iter().filter(|c| apart(c.at(curves), *at) <= join).count();
                    let place = end.place(curves);
                    return Err(Fault::new(
                        format!("{count} curves end at {}, one of them {place}", mm(place.at)),
                        "remove lines that are drawn twice, or choose the layer that has the outline alone",
                    ));
                }
            }
        }
    }
    let alone = |end: &&End| partners[end.index()].is_none();
    if let Some(end) = all.iter().find(alone) {
        let at = end.at(curves);
        let others = all.iter().filter(alone).filter(|other| *other != end);
        let far = |other: &&End| apart(at, other.at(curves));
        let next = others.min_by(|a, b| far(a).total_cmp(&far(b)));
        let next = next.map_or(at, |next| next.at(curves));
        let place = end.place(curves);
        return Err(Fault::new(
            format!(
                "{place} is not closed: it ends {:.3} mm from the nearest other open end, which is at {}",
                apart(at, next) * 1e3,
                mm(next)
            ),
            "join the ends in the drawing, or choose the layer that has the outline alone",
        ));
    }
    Ok(partners.into_iter().flatten().collect())
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
