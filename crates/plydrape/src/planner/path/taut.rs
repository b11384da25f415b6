//! Taut lines of the ply between neighboring grippers, while a front passes over the mold.
//!
//! The net on the lifted mold follows its curvature, but a free line hangs from gripper to gripper along a chord, so the
//! net leaves slack. Here grippers are moved sideways, at the height that they have, until every free line is as long as
//! its chord: from gripper to gripper, or from a gripper to where the front crosses the line on the mold. The slack that
//! is taken away would hang down, touch the mold first and stay as a ridge.
//!
//! Lines are shortened and lengthened one after the other until all fit (Müller et al. 2007, "Position based dynamics").

use super::tuning::TUNING;
use crate::geometry::Point;
use crate::geometry::vector::{between, distance};
use crate::ply::Neighbors;
use crate::scene::Scene;

/// The lines between neighboring grippers of a scene, as they shall lie on the mold.
#[derive(Debug, Clone)]
pub struct Lines(Vec<TautLine>);

#[derive(Debug, Clone)]
struct TautLine {
    /// Grippers at both ends.
    grippers: [usize; 2],
    /// Fabric length (m).
    length: f64,
    /// Places on the mold (m), evenly spaced in the fabric.
    places: Vec<Point>,
}

/// A free part of a line.
struct Free {
    gripper: usize,
    other: End,
    length: f64,
}

/// The far end of a free part.
enum End {
    Gripper(usize),
    Mold(Point),
}

impl Lines {
    /// The lines of a scene; `None` where its ideal drape is not known.
    #[must_use]
    pub fn new(scene: &Scene) -> Option<Self> {
        let (mold, drape) =
            (scene.layup.mold.as_ref()?, scene.layup.target.as_ref()?.drape.as_ref()?);
        let ply = &scene.layup.ply;
        let parts = TUNING.front.line_parts;
        let line = |pair: Neighbors| {
            let [a, b] = pair.grippers.map(|n| ply.place(n));
            let place = |k: usize| {
                let t = k as f64 / parts as f64;
                drape.place(mold, [0, 1].map(|c| a[c] + t * (b[c] - a[c])))
            };
            let places: Vec<Point> = (0..=parts).map(place).collect::<Option<_>>()?;
            let length = match pair.fiber {
                Some(_) => ply.length_factor * (b[0] - a[0]).hypot(b[1] - a[1]),
                // a line across the yarns becomes as long as the shear of the ideal drape makes it
                None => places.windows(2).map(|pair| distance(pair[0], pair[1])).sum(),
            };
            Some(TautLine { grippers: pair.grippers, length, places })
        };
        ply.neighbors().into_iter().map(line).collect::<Option<_>>().map(Lines)
    }

    /// Moves grippers (m) that are not in contact sideways until all free lines are taut, `stretch` beyond their length.
    /// `radius` is the distance of a place from where the front started, `front` how far it has come (m).
    pub fn tighten(
        &self,
        grippers: &mut [Point],
        landed: &[bool],
        radius: impl Fn(Point) -> f64,
        front: f64,
        stretch: f64,
    ) {
        // only what the front has not passed can slacken
        let free = self.free(&radius, front, stretch);
        for _ in 0..TUNING.front.tightenings {
            let mut worst = 0.0_f64;
            for part in &free {
                let other = match part.other {
                    End::Gripper(other) => grippers[other],
                    End::Mold(place) => place,
                };
                // what has landed stays; of two free grippers each goes half of the way
                let moves = [
                    !landed[part.gripper],
                    matches!(part.other, End::Gripper(other) if !landed[other]),
                ];
                let Some(share) = (match moves {
                    [true, true] => Some(0.5),
                    [false, false] => None,
                    _ => Some(1.0),
                }) else {
                    continue;
                };
                let here = grippers[part.gripper];
                let way = [here[0] - other[0], here[1] - other[1]];
                let run = way[0].hypot(way[1]);
                if run <= 0.0 {
                    continue;
                }
                // the run that a taut line of this length has at its rise
                let rise = here[2] - other[2];
                let error = (part.length * part.length - rise * rise).max(0.0).sqrt() - run;
                worst = worst.max(error.abs() / part.length);
                for axis in 0..2 {
                    let by = share * error * way[axis] / run;
                    if moves[0] {
                        grippers[part.gripper][axis] += by;
                    }
                    if let (true, End::Gripper(other)) = (moves[1], &part.other) {
                        grippers[*other][axis] -= by;
                    }
                }
            }
            // lines share grippers, so tightening one slackens others: repeat until all are taut
            if worst < TUNING.front.taut {
                break;
            }
        }
    }

    /// The free parts of all lines.
    fn free(&self, radius: &impl Fn(Point) -> f64, front: f64, stretch: f64) -> Vec<Free> {
        let mut out = Vec::with_capacity(2 * self.0.len());
        for line in &self.0 {
            let [first, last] = line.grippers;
            let parts = line.places.len() - 1;
            let radii: Vec<f64> = line.places.iter().map(|place| radius(*place)).collect();
            let inside = |k: &usize| radii[*k] <= front;
            let (Some(from), Some(to)) = ((0..=parts).find(inside), (0..=parts).rfind(inside))
            else {
                let length = line.length * (1.0 + stretch);
                out.push(Free { gripper: first, other: End::Gripper(last), length });
                continue;
            };
            // where the front crosses the line between two of its places
            let crossing = |out: usize, into: usize| {
                let t = (front - radii[out]) / (radii[into] - radii[out]);
                let share = out as f64 + t * (into as f64 - out as f64);
                (share / parts as f64, between(line.places[out], line.places[into], t))
            };
            let mut part = |gripper: usize, place: Point, share: f64| {
                let length = line.length * share * (1.0 + stretch);
                out.push(Free { gripper, other: End::Mold(place), length });
            };
            if from > 0 {
                let (share, place) = crossing(from - 1, from);
                part(first, place, share);
            }
            if to < parts {
                let (share, place) = crossing(to + 1, to);
                part(last, place, 1.0 - share);
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vector::distance;
    use crate::ply::Grid;

    const GRID: Grid = Grid { nu: 4, nv: 4 };

    /// Where grippers of a cell of 100 mm belong on the plane z = 0 (m), its middle at the origin.
    fn target([i, j]: [usize; 2]) -> Point {
        let [x, y] = [i, j].map(|k| 0.1 * (k as f64 - 1.5));
        [x, y, 0.0]
    }

    fn lines() -> Lines {
        let graph = crate::ply::Lines::array(GRID, [0.1; 2]);
        let line = |n: usize| {
            let ends = graph.ends(n);
            let [a, b] = ends.map(|gripper| target(GRID.id(gripper)));
            let places = (0..=16).map(|k| between(a, b, f64::from(k) / 16.0)).collect();
            TautLine { grippers: ends, length: 0.1, places }
        };
        Lines((0..graph.edges()).map(line).collect())
    }

    fn radius(p: Point) -> f64 {
        p[0].hypot(p[1])
    }

    /// Ahead of a ring the ply rises with a slope of 0.5 from where it would lie: made taut, every free line is as long as its
    /// chord to 1e-5, with the pretension; no height has changed, and grippers on the mold have not moved.
    #[test]
    fn free_lines_are_as_long_as_their_chords() {
        for (front, stretch) in [(0.0, 0.0), (0.04, 6e-4), (0.1, 0.0), (0.17, 6e-4), (0.3, 0.0)] {
            let targets: Vec<Point> = (0..16).map(|n| target(GRID.id(n))).collect();
            let landed: Vec<bool> = targets.iter().map(|p| radius(*p) <= front).collect();
            let raised = |p: &Point| [p[0], p[1], 0.5 * (radius(*p) - front).max(0.0)];
            let before: Vec<Point> = targets.iter().map(raised).collect();
            let mut grippers = before.clone();
            let lines = lines();
            lines.tighten(&mut grippers, &landed, radius, front, stretch);
            let free = lines.free(&radius, front, stretch);
            assert_eq!(free.is_empty(), front > 0.25, "{front}");
            for part in free {
                let other = match part.other {
                    End::Gripper(other) => grippers[other],
                    End::Mold(place) => place,
                };
                let chord = distance(grippers[part.gripper], other);
                let error = (chord / part.length - 1.0).abs();
                assert!(
                    error < 1e-5,
                    "{front}: a line of {} m has a chord of {chord} m",
                    part.length
                );
            }
            for ((now, before), landed) in grippers.iter().zip(&before).zip(landed) {
                assert_eq!(now[2], before[2], "{front}");
                assert!(!landed || now == before, "{front}");
            }
        }
    }
}
