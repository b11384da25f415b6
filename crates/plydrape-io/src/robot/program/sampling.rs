//! Adaptive sampling: which samples of a motion a controller needs, so that what it interpolates between them is near enough.
//!
//! Controllers go from point to point on straight lines, turn on the shortest way, and move external axes along with it. From
//! one point that is kept the next is the farthest for which all samples between them are met at their own times:
//!
//! - the position error is that of the tool's center and of every pad. A pad that the error turns with the tool is
//!   displaced by its lever arm, so far pads need more points; the errors of its own axes, which are at right angles, are added;
//! - the angle error is that of the tool.
//!
//! Controllers refuse points that are too near to each other, so a point is [`Tolerance::least_time`] behind the one before and
//! [`Tolerance::least_way`] away from it, whatever error that leaves. The largest errors are measured over all samples and are stated in
//! the heads of the files.
//!
//! Where another controller moves the axes of the array, it follows the *progress* of the motion, which that of the arm interpolates as
//! one more axis: the share of the time in which something moves.

use super::Program;
use super::pose::{angle, interpolated};
use crate::Error;
use plydrape::geometry::Pose;
use plydrape::geometry::vector::{distance, dot, sub};
use plydrape::ply::gripper_name;

/// How far interpolated poses may be from the program's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Of the tool's center and of the pads (m). As a default 0.1 mm: large robots come back to a point to within 0.05 mm to
    /// 0.1 mm (the repeatability of ISO 9283 in their data sheets), so that less could not be told from it, and it is a
    /// small share of the error of 0.5 mm or so that a plan has to tolerate in any cell.
    pub position: f64,
    /// Of the tool's orientation (rad). As a default 0.1°: what it does to the pads counts in the position already, so
    /// this matters only for a tool without pads far from its center.
    pub angle: f64,
    /// Least way between two points (m), of the tool's center or of the pad that moves farthest; as a default 1 mm. Controllers of ABB refuse
    /// points that are too near to each other (error 50078), without saying how near that is.
    pub least_way: f64,
    /// Least time between two points (s); as a default 0.1 s, in which every controller plans a point.
    pub least_time: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        let angle = 0.1_f64.to_radians();
        Tolerance { position: 1e-4, angle, least_way: 1e-3, least_time: 0.1 }
    }
}

impl Tolerance {
    /// Refuses what no sampling could keep.
    ///
    /// # Errors
    /// [`Error::NotPossible`] if an error is no number above 0, or a least distance is below 0.
    pub fn check(&self) -> Result<(), Error> {
        for (what, value) in [("way", self.least_way), ("time", self.least_time)] {
            if !(value.is_finite() && value >= 0.0) {
                let message = format!("the least {what} between points cannot be {value}");
                return Err(Error::not_possible(message, "give 0 or a number above it"));
            }
        }
        for (what, value) in [("position error", self.position), ("angle error", self.angle)] {
            if !(value.is_finite() && value > 0.0) {
                let message = format!("a {what} of {value} cannot be kept");
                return Err(Error::not_possible(message, "give a number above 0"));
            }
        }
        Ok(())
    }
}

/// Error of what is interpolated between samples.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Of a place (m).
    pub position: f64,
    /// Of an orientation (rad).
    pub angle: f64,
}

impl Deviation {
    /// The larger position and the larger angle of two errors.
    pub fn max(self, other: Self) -> Self {
        Deviation {
            position: self.position.max(other.position),
            angle: self.angle.max(other.angle),
        }
    }

    /// Whether both are small enough.
    fn is_within(self, tolerance: &Tolerance) -> bool {
        self.position <= tolerance.position && self.angle <= tolerance.angle
    }
}

/// The samples that are kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampling {
    /// Their indices, the first and the last sample among them.
    pub kept: Vec<usize>,
    /// The largest error between them, each sample at its own time.
    pub error: Deviation,
}

/// A movement this small, as a share of the tolerance, is none: the cell rests.
const REST: f64 = 1e-6;

/// A program by what a controller interpolates: the center of the tool and the axes.
#[derive(Debug)]
pub(crate) struct Track<'a> {
    pub program: &'a Program,
    /// Whether the controller moves the axes of the array too; if not, their own controller follows the progress.
    pub moves_axes: bool,
    /// The center of the tool in the frame of the mold, if there is a flange.
    pub center: Option<Vec<Pose>>,
    /// The share of the time of movement that is over, at each sample: from 0 to 1, the same while everything rests.
    pub progress: Vec<f64>,
    /// For each gripper its pad, if it has one, and its axes.
    grippers: Vec<(Option<usize>, Vec<usize>)>,
}

impl<'a> Track<'a> {
    pub fn new(program: &'a Program, moves_axes: bool) -> Self {
        let tool = &program.frames.tool;
        let center = program.flange.as_ref();
        let center = center.map(|flange| flange.iter().map(|pose| pose.compose(tool)).collect());
        let mut names = program.grippers();
        let mut grippers: Vec<_> = (0..names.len()).map(|n| (Some(n), Vec::new())).collect();
        for (n, axis) in program.axes.iter().enumerate() {
            let name = gripper_name(axis.gripper);
            let known = names.iter().position(|other| *other == name).unwrap_or_else(|| {
                names.push(name);
                grippers.push((None, Vec::new()));
                grippers.len() - 1
            });
            grippers[known].1.push(n);
        }
        let mut track = Track { program, moves_axes, center, progress: vec![0.0], grippers };
        let times = &program.times;
        let mut moving = 0.0;
        for k in 1..times.len() {
            if !track.rests(k - 1, k, &Tolerance::default()) {
                moving += times[k] - times[k - 1];
            }
            track.progress.push(moving);
        }
        if moving > 0.0 {
            track.progress.iter_mut().for_each(|share| *share /= moving);
        }
        track
    }

    /// The error at sample k of what is interpolated from sample a to sample b, at the sample's own time.
    pub fn deviation(&self, a: usize, b: usize, k: usize) -> Deviation {
        let times = &self.program.times;
        self.deviation_at(a, b, k, (times[k] - times[a]) / (times[b] - times[a]))
    }

    /// The error at sample k of what is interpolated from sample a to sample b, where that passes nearest to it.
    pub fn passing(&self, a: usize, b: usize, k: usize) -> Deviation {
        let timely = self.deviation(a, b, k);
        let Some(center) = &self.center else { return timely };
        let [from, to, at] = [a, b, k].map(|n| center[n].position);
        let (way, part) = (sub(to, from), sub(at, from));
        let square = dot(way, way);
        if square == 0.0 {
            return timely;
        }
        let near = self.deviation_at(a, b, k, (dot(part, way) / square).clamp(0.0, 1.0));
        if near.position < timely.position { near } else { timely }
    }

    fn deviation_at(&self, a: usize, b: usize, k: usize, share: f64) -> Deviation {
        let values = |axis: usize| &self.program.axes[axis].values;
        let progress = self.progress[a] + share * (self.progress[b] - self.progress[a]);
        let axis = |n: usize| match self.moves_axes {
            true => values(n)[a] + share * (values(n)[b] - values(n)[a]),
            false => self.followed(n, progress),
        };
        let pose = self.center.as_ref().map(|c| interpolated(&c[a], &c[b], share));
        self.deviation_of(k, pose.as_ref(), &axis)
    }

    /// The error at sample k of a pose of the center and of the axes (m).
    pub fn deviation_of(
        &self,
        k: usize,
        pose: Option<&Pose>,
        axis: &impl Fn(usize) -> f64,
    ) -> Deviation {
        let Program { axes, pads, .. } = self.program;
        let off = |n: usize| axis(n) - axes[n].values[k];
        let (Some(pose), Some(center)) = (pose, &self.center) else {
            return Deviation { position: self.largest(off), angle: 0.0 };
        };
        let of_gripper = |(pad, own): &(Option<usize>, Vec<usize>)| {
            let carried = pad.map_or(0.0, |pad| {
                let place = pads[pad].poses[k].position;
                distance(pose.place(center[k].local(place)), place)
            });
            carried + length(own, &off)
        };
        let pads = self.grippers.iter().map(of_gripper).fold(0.0, f64::max);
        Deviation {
            position: pads.max(distance(pose.position, center[k].position)),
            angle: angle(pose, &center[k]),
        }
    }

    /// Where an axis is (m) that follows the progress as a cam, on straight lines between the samples.
    pub fn followed(&self, axis: usize, progress: f64) -> f64 {
        let (all, values) = (&self.progress, &self.program.axes[axis].values);
        let after = all.partition_point(|p| *p < progress).min(all.len() - 1);
        let before = after.saturating_sub(1);
        let span = all[after] - all[before];
        let share =
            if span > 0.0 { ((progress - all[before]) / span).clamp(0.0, 1.0) } else { 1.0 };
        values[before] + share * (values[after] - values[before])
    }

    /// The largest displacement of a gripper by its axes, from that of each axis.
    pub fn largest(&self, of_axis: impl Fn(usize) -> f64) -> f64 {
        self.grippers.iter().map(|(_, own)| length(own, &of_axis)).fold(0.0, f64::max)
    }

    /// The largest movement from sample a to sample b: of the center or an axis of the array (m), and the turn (rad).
    pub fn movement(&self, a: usize, b: usize) -> Deviation {
        let axes = self.program.axes.iter().map(|axis| (axis.values[b] - axis.values[a]).abs());
        let axes = axes.fold(0.0, f64::max);
        self.center.as_ref().map_or(Deviation { position: axes, angle: 0.0 }, |center| Deviation {
            position: axes.max(distance(center[a].position, center[b].position)),
            angle: angle(&center[a], &center[b]),
        })
    }

    /// Distance of the center from sample a to sample b, or of an axis without one (m).
    pub fn distance(&self, a: usize, b: usize) -> f64 {
        let center = self.center.as_ref();
        center.map_or_else(
            || self.movement(a, b).position,
            |center| distance(center[a].position, center[b].position),
        )
    }

    /// Whether the cell rests from sample a to sample b.
    pub fn rests(&self, a: usize, b: usize, tolerance: &Tolerance) -> bool {
        let small = |t: f64| REST * t;
        let (position, angle) = (small(tolerance.position), small(tolerance.angle));
        let rest = Tolerance { position, angle, ..*tolerance };
        (a..b).all(|k| self.movement(a, k + 1).is_within(&rest))
    }

    /// Whether sample b is so far behind sample a that both can be points.
    pub fn is_apart(&self, a: usize, b: usize, tolerance: &Tolerance) -> bool {
        let Program { times, pads, .. } = self.program;
        let pads = pads.iter().map(|pad| distance(pad.poses[a].position, pad.poses[b].position));
        let way = pads.fold(self.movement(a, b).position, f64::max);
        // times of samples are sums of rounded ones
        way >= tolerance.least_way && times[b] - times[a] >= tolerance.least_time * (1.0 - REST)
    }

    /// The samples at which a program stops for events at the `forced` indices and for rests: both ends of each.
    pub fn stops(&self, forced: &[usize], tolerance: &Tolerance) -> Vec<usize> {
        let count = self.program.times.len();
        let mut stops = forced.to_vec();
        let mut from = 0;
        for k in 1..=count {
            if k < count && self.rests(k - 1, k, tolerance) {
                continue;
            }
            // a rest of one interval alone is the beginning or the end of a movement
            if k - from > 2 {
                stops.extend([from, k - 1]);
            }
            from = k;
        }
        stops.push(count - 1);
        stops.sort_unstable();
        stops.dedup();
        stops
    }

    /// The samples that are kept, those at the `stops` among them.
    pub fn sampling(&self, stops: &[usize], tolerance: &Tolerance) -> Sampling {
        let apart = |a, b| self.is_apart(a, b, tolerance);
        let count = self.program.times.len();
        thin(count, stops, tolerance, apart, |a, b, k| self.deviation(a, b, k))
    }
}

/// The length of a way along some axes at right angles to each other.
fn length(axes: &[usize], of_axis: &impl Fn(usize) -> f64) -> f64 {
    axes.iter().map(|axis| of_axis(*axis).powi(2)).sum::<f64>().sqrt()
}

/// The sample nearest to a time (s).
pub(crate) fn nearest(times: &[f64], time: f64) -> usize {
    let after = times.partition_point(|t| *t < time).min(times.len() - 1);
    if after > 0 && time - times[after - 1] <= times[after] - time { after - 1 } else { after }
}

/// The fewest samples, taken from the first on, between which `deviation(a, b, k)` of all others is within a tolerance; those
/// at the `forced` indices among them, and none but these nearer to the one before than `is_apart` says.
pub(crate) fn thin(
    count: usize,
    forced: &[usize],
    tolerance: &Tolerance,
    is_apart: impl Fn(usize, usize) -> bool,
    deviation: impl Fn(usize, usize, usize) -> Deviation,
) -> Sampling {
    let mut stops: Vec<usize> = forced.iter().copied().filter(|k| *k < count).collect();
    stops.push(count - 1);
    stops.sort_unstable();
    stops.dedup();
    let is_near = |a: usize, b: usize| (a + 1..b).all(|k| deviation(a, b, k).is_within(tolerance));
    let (mut kept, mut a) = (vec![0], 0);
    for stop in stops {
        while a < stop {
            // the way that is near enough doubles until one is not, and is then halved in on
            let (mut good, mut step) = (a + 1, 2);
            let mut bad = None;
            while good < stop && bad.is_none() {
                let next = (a + step).min(stop);
                if is_near(a, next) {
                    good = next
                } else {
                    bad = Some(next)
                }
                step *= 2;
            }
            while let Some(far) = bad.filter(|far| far - good > 1) {
                let middle = good + (far - good) / 2;
                if is_near(a, middle) { good = middle } else { bad = Some(middle) }
            }
            // no nearer than points may be to each other, and to the stop
            while good < stop && !is_apart(a, good) {
                good += 1;
            }
            let back = (a + 1..=good).rev();
            let fits = |k: &usize| *k == stop || is_apart(a, *k) && is_apart(*k, stop);
            good = back.take_while(|k| is_apart(a, *k) || *k == good).find(fits).unwrap_or(stop);
            kept.push(good);
            a = good;
        }
    }
    Sampling { error: largest(&kept, deviation), kept }
}

/// The largest deviation of the samples between those that are kept.
pub(crate) fn largest(
    kept: &[usize],
    deviation: impl Fn(usize, usize, usize) -> Deviation,
) -> Deviation {
    let mut error = Deviation::default();
    for pair in kept.windows(2) {
        for k in pair[0] + 1..pair[1] {
            error = error.max(deviation(pair[0], pair[1], k));
        }
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chord over the angle θ of a circle of radius r is r (1 − cos θ/2) from it, so as many points are needed as chords
    /// of that height go round.
    #[test]
    fn a_circle_gets_as_many_chords_as_its_sagitta_needs() {
        let (radius, count) = (0.5, 20_001);
        let on_circle = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / (count - 1) as f64;
            [radius * angle.cos(), radius * angle.sin()]
        };
        let off = |a: usize, b: usize, k: usize| {
            let share = (k - a) as f64 / (b - a) as f64;
            let [p, q, r] = [a, b, k].map(on_circle);
            let off = [0, 1].map(|n| p[n] + share * (q[n] - p[n]) - r[n]);
            Deviation { position: off[0].hypot(off[1]), angle: 0.0 }
        };
        for position in [1e-3, 1e-4, 1e-5] {
            let tolerance = Tolerance { position, ..Tolerance::default() };
            let sampling = thin(count, &[], &tolerance, |_, _| true, off);
            let chord = 2.0 * (1.0 - position / radius).acos();
            let needed = std::f64::consts::TAU / chord;
            let found = (sampling.kept.len() - 1) as f64;
            // the last chord may be short, and each is cut to whole samples
            assert!((needed..1.02 * needed + 1.0).contains(&found), "{found} {needed}");
            assert!(sampling.error.position <= position);
            assert!(sampling.error.position > 0.95 * position);
        }
    }

    /// Forced samples are kept, and a straight way needs no others.
    #[test]
    fn a_straight_way_keeps_its_ends_and_what_is_forced() {
        let none = |_, _, _| Deviation::default();
        let near = Tolerance::default();
        let kept = |forced: &[usize]| thin(1000, forced, &near, |_, _| true, none).kept;
        assert_eq!(kept(&[]), [0, 999]);
        assert_eq!(kept(&[700, 0, 30, 700]), [0, 30, 700, 999]);
        assert_eq!(thin(1, &[], &near, |_, _| true, none).kept, [0]);
    }

    /// Where every way is too far, points are as near to each other as they may be, and the last one before a stop leaves room for it.
    #[test]
    fn points_are_never_nearer_than_they_may_be() {
        let far = |_, _, _| Deviation { position: 1.0, angle: 0.0 };
        let apart = |a: usize, b: usize| b - a >= 10;
        let kept = thin(100, &[34, 38, 60], &Tolerance::default(), apart, far).kept;
        // 30 would leave 4 to the stop; the stops themselves are where they are
        assert_eq!(kept, [0, 10, 20, 34, 38, 48, 60, 70, 80, 99]);
    }

    #[test]
    fn the_nearest_sample_is_on_either_side() {
        let times = [0.0, 1.0, 2.0, 4.0];
        let found = [-1.0, 0.4, 0.6, 2.9, 3.1, 9.0].map(|time| nearest(&times, time));
        assert_eq!(found, [0, 0, 1, 2, 3, 3]);
    }
}
