//! The nearest pair along a motion, found with a bound that no sampling misses.
//!
//! Between two times the distance d of two bodies changes by no more than L, what a point of one of them can go as seen from the
//! other ([`Moves::change`]). So in between `d ≥ (d₀ + d₁ − L)/2`, and intervals in which that could be nearer than the nearest pair
//! are halved: first from sample to sample of the motion, with L the sum over the samples between, then between two samples. Balls
//! and capsules around the bodies give the first bounds, and the pairs that are nearest at a few times the first distance to compare with.

use super::moves::{Legs, Moves, Origin, Planned, Reach, Straight};
use super::over_mold::OverMold;
use super::poses::Poses;
use super::tuning::TUNING;
use crate::arm::Angles;
use crate::bodies::{Apart, Mount, Obstacle, Solid, Solids, Surface, between_segments};
use crate::geometry::Point;
use crate::geometry::vector::norm;
use crate::layup::Layup;
use crate::mold::{Pose, distance};
use crate::motion::{Attitudes, Motion, TimedMotion};
use crate::ply::{Ply, gripper_name};
use crate::tool::Posture;
use rayon::prelude::*;

/// A body of one gripper, of the flange or of the arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Index of the body in [`crate::bodies::Bodies::bodies`].
    pub body: usize,
    /// Index of its gripper; `None` on the flange and on the arm.
    pub gripper: Option<usize>,
}

/// What a body is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Near {
    /// Another body.
    Part(Part),
    /// An obstacle by its index in [`crate::bodies::Bodies::obstacles`].
    Obstacle(usize),
    /// The mold.
    Mold,
}

/// The nearest pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Their distance (m); minus the depth where they penetrate each other.
    pub distance: f64,
    /// A body.
    pub part: Part,
    /// What it is near to.
    pub near: Near,
    /// The middle between their nearest points, of the mold the body's nearest point (m).
    pub place: Point,
    /// When (s, or the share of a step).
    pub time: f64,
}

impl Nearest {
    /// Who is near whom, by name.
    #[must_use]
    pub fn label(&self, layup: &Layup) -> String {
        label(layup, self.part, self.near)
    }
}

/// A body and what it is near to, by name.
pub fn label(layup: &Layup, part: Part, near: Near) -> String {
    let name = |part: Part| part_label(part, layup, &layup.ply);
    match near {
        Near::Part(other) => format!("{} and {}", name(part), name(other)),
        Near::Obstacle(n) => {
            format!("{} and obstacle {}", name(part), layup.bodies.obstacles()[n].name)
        }
        Near::Mold => format!("{} and the mold", name(part)),
    }
}

fn part_label(Part { body, gripper }: Part, layup: &Layup, ply: &Ply) -> String {
    let name = &layup.bodies.bodies()[body].name;
    match gripper {
        Some(n) => format!("{name} of {}", gripper_name(ply.id(n))),
        None => name.clone(),
    }
}

/// The nearest pair at some poses, with 0 for its time, resolved by a share of a `limit` (m); `None` for a layup without bodies, or without anything that they could meet.
#[must_use]
pub fn at_poses(layup: &Layup, limit: f64, poses: &Poses) -> Option<Nearest> {
    along(layup, limit, &Straight::new(poses, poses), &[0.0], f64::INFINITY)
}

/// The nearest pair between two steps, with the share of the step as its time.
#[must_use]
pub fn between_steps(layup: &Layup, limit: f64, from: &Poses, to: &Poses) -> Option<Nearest> {
    along(layup, limit, &Straight::new(from, to), &[0.0, 1.0], f64::INFINITY)
}

/// The distance of bodies from obstacles (m) at one time, if it is below `least` (m).
#[must_use]
pub fn from_obstacles(layup: &Layup, poses: &Poses, least: f64) -> Option<f64> {
    let moves = Straight::new(poses, poses);
    let mut search = Search::among(layup, least, &moves, None);
    let hulls = search.hulls(0.0);
    let mut found = least;
    for body in 0..hulls.len() {
        for obstacle in 0..search.obstacles.len() {
            let pair = (body, Other::Obstacle(obstacle));
            if search.gap(pair, &hulls, found) < found {
                found = found.min(search.distance(pair, 0.0));
            }
        }
    }
    (found < least).then_some(found)
}

/// The obstacles that stand deeper in the mold than its tolerance of contact, by their index, and how deep (m).
#[must_use]
pub fn standing_in_mold(layup: &Layup) -> Vec<(usize, f64)> {
    let Some(mold) = &layup.mold else { return Vec::new() };
    let solids = layup.bodies.made();
    let over_mold = OverMold::new(mold, solids);
    let tolerance = layup.settings.contact.tolerance;
    let obstacles = layup.bodies.obstacles().iter().zip(&solids.obstacles);
    let depth = |(obstacle, solid): (&Obstacle, &Solid)| {
        let surface = Surface::new(&obstacle.shape);
        -over_mold.apart(solid, &surface, &obstacle.pose, tolerance).distance
    };
    obstacles.map(depth).enumerate().filter(|(_, depth)| *depth > tolerance).collect()
}

impl Nearest {
    /// The nearest pair of a planned motion; of a tool, straight from sample to sample of the motion as it is written.
    #[must_use]
    pub fn of_motion(
        layup: &Layup,
        limit: f64,
        rate: f64,
        motion: &TimedMotion,
        attitudes: &Attitudes,
    ) -> Option<Nearest> {
        Nearest::of_motion_within(
            layup,
            limit,
            rate,
            motion,
            attitudes,
            [0.0, motion.duration()],
            f64::INFINITY,
        )
    }

    /// The nearest pair between two times of a planned motion (s), as [`Self::of_motion`], if it is nearer than `below` (m).
    #[must_use]
    pub fn of_motion_within(
        layup: &Layup,
        limit: f64,
        rate: f64,
        motion: &TimedMotion,
        attitudes: &Attitudes,
        [from, to]: [f64; 2],
        below: f64,
    ) -> Option<Nearest> {
        let within = |times: &[f64]| -> Vec<f64> {
            let inner = times.iter().copied().filter(|t| from < *t && *t < to);
            [from].into_iter().chain(inner).chain((from < to).then_some(to)).collect()
        };
        // grippers by themselves move in straight lines between the times of the motion
        if layup.tool.is_none() {
            let times = within(motion.times());
            return along(layup, limit, &Planned { motion, attitudes }, &times, below);
        }
        // a robot goes straight from point to point of its file, and the frame turns the shortest way
        let times = within(&motion.samples(rate).ok()?);
        let poses = |t: &f64| {
            let positions = motion.at(*t);
            Poses::new(layup, &positions, &attitudes.at(*t), &positions)
        };
        let mut poses: Vec<Poses> = times.par_iter().map(poses).collect();
        // the arm begins where the motion does, also where a part of it is asked for
        if let Some(tool) = layup.tool.as_ref().filter(|tool| tool.arm.is_some()) {
            let mut all = [&motion.samples(rate).ok()?[..], &times].concat();
            all.sort_by(f64::total_cmp);
            all.dedup();
            let postures: Vec<Posture> =
                all.par_iter().map(|t| tool.posture(&motion.at(*t))).collect();
            let course = tool.arm_along(&all, &postures, &[])?;
            for (poses, time) in poses.iter_mut().zip(&times) {
                let n = all.partition_point(|t| t < time);
                poses.links = tool.links(&course.angles[n]);
            }
        }
        straight(layup, limit, &times, &poses, below)
    }

    /// The nearest pair of the arm of a tool and what stands in the cell, straight from step to step of a motion; `None` where the arm or its bodies are
    /// not known.
    #[must_use]
    pub fn of_arm(layup: &Layup, limit: f64, motion: &Motion) -> Option<Nearest> {
        let tool = layup.tool.as_ref()?;
        let postures: Vec<Posture> =
            motion.positions.par_iter().map(|places| tool.posture(places)).collect();
        let course = tool.arm_along(&motion.times, &postures, &[])?;
        let links = |angles: &Angles| Poses {
            pads: Vec::new(),
            stems: Vec::new(),
            flange: None,
            links: tool.links(angles),
        };
        let poses: Vec<Poses> = course.angles.iter().map(links).collect();
        let layup = Layup { bodies: layup.bodies.of_arm(), ..layup.clone() };
        straight(&layup, limit, &motion.times, &poses, f64::INFINITY)
    }
}

/// The nearest pair straight from pose to pose at ascending times (s), if it is nearer than `below` (m).
fn straight(
    layup: &Layup,
    limit: f64,
    times: &[f64],
    poses: &[Poses],
    below: f64,
) -> Option<Nearest> {
    let legs: Vec<Straight> =
        poses.par_windows(2).map(|pair| Straight::new(&pair[0], &pair[1])).collect();
    if legs.is_empty() {
        return at_poses(layup, limit, poses.first()?);
    }
    // legs are counted, and the count of the nearest is a time
    let counts: Vec<f64> = (0..times.len()).map(|n| n as f64).collect();
    let nearest = along(layup, limit, &Legs(legs), &counts, below)?;
    let n = (nearest.time as usize).min(times.len() - 2);
    let time = times[n] + (nearest.time - n as f64) * (times[n + 1] - times[n]);
    Some(Nearest { time, ..nearest })
}

/// The nearest pair along a motion through ascending times (s), if it is nearer than `below` (m). No pair comes nearer in between than
/// the resolution allows.
#[must_use]
pub fn along(
    layup: &Layup,
    limit: f64,
    moves: &dyn Moves,
    times: &[f64],
    below: f64,
) -> Option<Nearest> {
    if layup.bodies.is_empty() || times.is_empty() {
        return None;
    }
    let mut search = Search::new(layup, limit, moves);
    search.below = below;
    let hulls: Vec<Hulls> = times.iter().map(|time| search.hulls(*time)).collect();
    let samples = Samples { times, hulls: &hulls, ways: search.ways(times) };
    let pairs = search.pairs();
    // the nearest at a few times first, so that the search can drop most intervals at once
    search.sample(&pairs, &samples);
    for pair in pairs {
        if !search.stays_apart(pair, &samples) {
            search.pair(pair, &samples);
        }
    }
    search.best
}

/// A motion at its samples.
struct Samples<'a> {
    /// When they are (s).
    times: &'a [f64],
    hulls: &'a [Hulls],
    /// How far any point of a body goes at most from each to the next (m).
    ways: Vec<f64>,
}

/// One pair at the samples.
struct PairCourse<'a> {
    samples: &'a Samples<'a>,
    pair: Pair,
    /// The most that its distance can change from the first sample to each (m).
    change: Vec<f64>,
    /// Distance where it was asked for (m); none is known otherwise.
    found: Vec<Option<f64>>,
}

/// A body that is judged.
struct Judged {
    part: Part,
    origin: Origin,
    mount: Mount,
    /// Middle of a ball around it in the coordinates of its origin (m), and the ball's radius (m).
    ball: (Point, f64),
    /// Axis of a capsule around it in these coordinates (m), and the capsule's radius (m).
    capsule: ([Point; 2], f64),
    /// Distance of its farthest point from its origin at most (m).
    reach: f64,
}

impl Judged {
    fn reach(&self) -> Reach {
        (self.origin, self.reach)
    }
}

struct Search<'a> {
    moves: &'a dyn Moves,
    solids: &'a Solids,
    judged: Vec<Judged>,
    /// Where each obstacle stands.
    obstacles: Vec<Pose>,
    /// The obstacle on which the ply lies, which pads stand on.
    table: Option<usize>,
    /// The mold, if a body could meet it.
    mold: Option<OverMold<'a>>,
    /// The limit (m).
    limit: f64,
    /// Only what is nearer is of interest (m).
    below: f64,
    best: Option<Nearest>,
}

/// Two of them: the index of a body, and what it could meet.
type Pair = (usize, Other);

/// What a body could meet.
#[derive(Clone, Copy)]
enum Other {
    Body(usize),
    Obstacle(usize),
    Mold,
}

/// What is around all bodies at one time: the middle of each ball and the axis of each capsule (m).
type Hulls = Vec<(Point, [Point; 2])>;

impl<'a> Search<'a> {
    fn new(layup: &'a Layup, limit: f64, moves: &'a dyn Moves) -> Self {
        let solids = layup.bodies.made();
        let meets_mold = layup.bodies.bodies().iter().any(|body| body.on != Mount::Pad);
        let mold = layup.mold.as_ref().filter(|_| meets_mold);
        Search::among(layup, limit, moves, mold.map(|mold| OverMold::new(mold, solids)))
    }

    /// Over a mold, if it counts.
    fn among(
        layup: &'a Layup,
        limit: f64,
        moves: &'a dyn Moves,
        mold: Option<OverMold<'a>>,
    ) -> Self {
        let solids = layup.bodies.made();
        let mut judged = Vec::new();
        // bodies on pads and stems are there once for each gripper
        for (n, body) in layup.bodies.bodies().iter().enumerate() {
            let Solid { ball, capsule, .. } = solids.bodies[n];
            let mut add = |gripper: Option<usize>, origin: Origin| {
                let part = Part { body: n, gripper };
                let reach = norm(ball.0) + ball.1;
                judged.push(Judged { part, origin, mount: body.on, ball, capsule, reach });
            };
            let grippers = 0..layup.ply.grippers();
            match body.on {
                Mount::Pad => grippers.for_each(|g| add(Some(g), Origin::Pad(g))),
                Mount::Stem => grippers.for_each(|g| add(Some(g), Origin::Stem(g))),
                Mount::Flange if moves.has_flange() => add(None, Origin::Flange),
                // the foot stands still, on whatever carries it
                Mount::Link(n) if 0 < n && n < moves.links() => add(None, Origin::Link(n)),
                Mount::Flange | Mount::Link(_) => {}
            }
        }
        Search {
            moves,
            solids,
            judged,
            obstacles: layup.bodies.obstacles().iter().map(|obstacle| obstacle.pose).collect(),
            table: layup.pick_up.and_then(|pick_up| pick_up.table),
            mold,
            limit,
            below: f64::INFINITY,
            best: None,
        }
    }

    /// The nearest distance that is known (m).
    fn least(&self) -> f64 {
        self.best.map_or(self.below, |best| best.distance)
    }

    /// By how much a pair may come nearer than is reported (m).
    fn resolution(&self) -> f64 {
        let least = self.least();
        TUNING.resolution * if least.is_finite() { least.abs().max(self.limit) } else { self.limit }
    }

    /// The resolution for one pair; distances to the mold are found with half of it.
    fn resolution_of(&self, pair: Pair) -> f64 {
        match pair.1 {
            Other::Mold => 0.5 * self.resolution(),
            _ => self.resolution(),
        }
    }

    fn hulls(&self, time: f64) -> Hulls {
        let place = |body: &Judged| {
            let pose = self.moves.pose(body.origin, time);
            (pose.place(body.ball.0), body.capsule.0.map(|end| pose.place(end)))
        };
        self.judged.iter().map(place).collect()
    }

    /// All pairs that are judged.
    fn pairs(&self) -> Vec<Pair> {
        let mut pairs = Vec::new();
        for (a, one) in self.judged.iter().enumerate() {
            for (b, other) in self.judged.iter().enumerate().skip(a + 1) {
                let grippers = one.part.gripper.zip(other.part.gripper);
                if grippers.is_some_and(|(own, its)| own != its) {
                    pairs.push((a, Other::Body(b)));
                }
            }
            let stands_on = |n: &usize| one.mount == Mount::Pad && self.table == Some(*n);
            let obstacles = (0..self.obstacles.len()).filter(|n| !stands_on(n));
            pairs.extend(obstacles.map(|n| (a, Other::Obstacle(n))));
            if self.mold.is_some() && one.mount != Mount::Pad {
                pairs.push((a, Other::Mold));
            }
        }
        pairs
    }

    /// How far any point of a body goes at most between neighboring times (m).
    fn ways(&self, times: &[f64]) -> Vec<f64> {
        let farthest = |times: &[f64]| {
            let change_of =
                |body: &Judged| self.moves.change(body.reach(), None, [times[0], times[1]]);
            self.judged.iter().map(change_of).fold(0.0, f64::max)
        };
        times.windows(2).map(farthest).collect()
    }

    /// The nearest pairs at a few times, those that could be nearest first.
    fn sample(&mut self, pairs: &[Pair], samples: &Samples) {
        let last = samples.times.len() - 1;
        let mut few: Vec<usize> =
            (0..=TUNING.first).map(|n| last * n / TUNING.first.max(1)).collect();
        few.dedup();
        let mut open: Vec<(f64, Pair, usize)> = Vec::new();
        for n in few {
            let gap = |pair: &Pair| (self.gap(*pair, &samples.hulls[n], self.below), *pair, n);
            open.extend(pairs.iter().map(gap).filter(|(gap, ..)| *gap < self.below));
        }
        open.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (gap, pair, n) in open {
            if gap >= self.least() {
                break;
            }
            self.distance(pair, samples.times[n]);
        }
    }

    /// Whether two bodies are too far from each other at all times by what is around them alone.
    fn stays_apart(&self, pair: Pair, samples: &Samples) -> bool {
        let Other::Body(_) = pair.1 else { return false };
        let least = self.least();
        samples.hulls.iter().enumerate().all(|(n, hulls)| {
            // both go no farther than that
            let around = [n.checked_sub(1), Some(n)].into_iter().flatten();
            let way = around.filter_map(|n| samples.ways.get(n)).copied().fold(0.0, f64::max);
            self.gap(pair, hulls, least + way) - way >= least
        })
    }

    /// The nearest two of a pair along the motion.
    fn pair(&mut self, pair: Pair, samples: &Samples) {
        let mut change = vec![0.0; samples.times.len()];
        for (n, times) in samples.times.windows(2).enumerate() {
            change[n + 1] = change[n] + self.change(pair, [times[0], times[1]]);
        }
        let found = vec![None; samples.times.len()];
        let mut course = PairCourse { samples, pair, change, found };
        let last = samples.times.len() - 1;
        for n in [0, last] {
            self.meet(&mut course, n);
        }
        if last > 0 {
            self.samples(&mut course, [0, last]);
        }
    }

    /// The distance of a pair at a sample, unless what is around them is too far apart.
    fn meet(&mut self, course: &mut PairCourse, n: usize) {
        if self.known(course, n) < self.least() {
            self.found(course, n);
        }
    }

    /// The distance of a pair at a sample (m).
    fn found(&mut self, course: &mut PairCourse, n: usize) -> f64 {
        match course.found[n] {
            Some(found) => found,
            None => {
                let found = self.distance(course.pair, course.samples.times[n]);
                course.found[n] = Some(found);
                found
            }
        }
    }

    /// A distance that a pair does not fall short of at a sample (m).
    fn known(&self, course: &PairCourse, n: usize) -> f64 {
        let gap = || self.gap(course.pair, &course.samples.hulls[n], f64::INFINITY);
        course.found[n].unwrap_or_else(gap)
    }

    /// The nearest two of a pair between two samples.
    fn samples(&mut self, course: &mut PairCourse, [from, to]: [usize; 2]) {
        let inner = to - from > 1;
        // what is reported is nearer than any sample to far less than the resolution between samples
        let slack = self.resolution_of(course.pair) * if inner { TUNING.sampled } else { 1.0 };
        let change = course.change[to] - course.change[from];
        let bound = |d0: f64, d1: f64| 0.5 * (d0 + d1 - change);
        let known = [from, to].map(|n| self.known(course, n));
        if bound(known[0], known[1]) >= self.least() - slack {
            return;
        }
        let ends = [from, to].map(|n| self.found(course, n));
        if !inner {
            let [t0, t1] = [from, to].map(|n| course.samples.times[n]);
            self.halve(course.pair, (t0, ends[0]), (t1, ends[1]), TUNING.halvings);
            return;
        }
        if bound(ends[0], ends[1]) >= self.least() - slack {
            return;
        }
        let middle = from.midpoint(to);
        self.meet(course, middle);
        self.samples(course, [from, middle]);
        self.samples(course, [middle, to]);
    }

    /// A distance (m) that two do not fall short of, by the balls around bodies and the boxes around obstacles; unless that is `enough`
    /// (m), by the capsules around bodies.
    fn gap(&self, (body, other): Pair, hulls: &Hulls, enough: f64) -> f64 {
        let own = self.judged[body].ball.1;
        match other {
            Other::Body(b) => {
                let ((middle, axis), (its_middle, its_axis)) = (&hulls[body], &hulls[b]);
                let (one, other) = (&self.judged[body], &self.judged[b]);
                let balls = distance(*middle, *its_middle) - own - other.ball.1;
                if balls >= enough {
                    return balls;
                }
                let capsules = between_segments(axis, its_axis) - one.capsule.1 - other.capsule.1;
                balls.max(capsules)
            }
            Other::Obstacle(n) => {
                let [low, high] = self.solids.obstacles[n].bounds;
                let p = self.obstacles[n].local(hulls[body].0);
                norm([0, 1, 2].map(|c| (low[c] - p[c]).max(p[c] - high[c]).max(0.0))) - own
            }
            Other::Mold => {
                self.mold.as_ref().map_or(f64::INFINITY, |mold| mold.gap(hulls[body].0, own))
            }
        }
    }

    /// The distance of two at a time (m), which is the nearest from now on if no other is nearer.
    fn distance(&mut self, (body, other): Pair, time: f64) -> f64 {
        let one = &self.judged[body];
        let own = self.moves.pose(one.origin, time);
        let solid = &self.solids.bodies[one.part.body];
        let (Apart { distance, place }, near) = match other {
            Other::Body(b) => {
                let other = &self.judged[b];
                let its = self.moves.pose(other.origin, time);
                let apart = solid.apart(&own, &self.solids.bodies[other.part.body], &its);
                (apart, Near::Part(other.part))
            }
            Other::Obstacle(n) => {
                let apart = solid.apart(&own, &self.solids.obstacles[n], &self.obstacles[n]);
                (apart, Near::Obstacle(n))
            }
            Other::Mold => {
                let Some(mold) = &self.mold else { return f64::INFINITY };
                let surface = &self.solids.surfaces[one.part.body];
                // half of it is for the motion
                (mold.apart(solid, surface, &own, 0.5 * self.resolution()), Near::Mold)
            }
        };
        if distance < self.least() {
            self.best = Some(Nearest { distance, part: one.part, near, place, time });
        }
        distance
    }

    /// The most that the distance of two can change between two times (m).
    fn change(&self, (body, other): Pair, times: [f64; 2]) -> f64 {
        let other = match other {
            Other::Body(b) => Some(self.judged[b].reach()),
            Other::Obstacle(_) | Other::Mold => None,
        };
        self.moves.change(self.judged[body].reach(), other, times)
    }

    /// Halves an interval in which two could come nearer than the nearest pair that is known.
    fn halve(&mut self, pair: Pair, (t0, from): (f64, f64), (t1, to): (f64, f64), depth: u32) {
        let least = 0.5 * (from + to - self.change(pair, [t0, t1]));
        if depth == 0 || least >= self.least() - self.resolution_of(pair) {
            return;
        }
        let time = 0.5 * (t0 + t1);
        let middle = self.distance(pair, time);
        self.halve(pair, (t0, from), (time, middle), depth - 1);
        self.halve(pair, (time, middle), (t1, to), depth - 1);
    }
}
