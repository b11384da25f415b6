//! The nearest pair along a motion, found with a bound that no sampling misses.
//!
//! Between two times the distance d of two bodies changes by no more than L, what a point of one of them can go as seen from the
//! other: the way of their origins as seen from each other, and for each body its reach times its turn. So in between
//! `d ≥ (d₀ + d₁ − L)/2`, and intervals in which that could be nearer than the nearest pair are halved. Balls around
//! the bodies give the first bounds.

use super::body::{Mount, Solids};
use super::moves::{Legs, Moves, Origin, Planned, Straight};
use super::over_mold::OverMold;
use super::poses::Poses;
use super::solid::Apart;
use super::tuning::TUNING;
use crate::draping::spans::Point;
use crate::mold::vector::norm;
use crate::mold::{Pose, distance};
use crate::motion::{Attitudes, TimedMotion};
use crate::ply::{Ply, gripper_name};
use crate::scene::Scene;

/// A body of one gripper, or of the flange.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Index of the body in [`super::Bodies::bodies`].
    pub body: usize,
    /// Index of its gripper; none on the flange.
    pub gripper: Option<usize>,
}

/// What a body is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Near {
    /// Another body.
    Part(Part),
    /// An obstacle by its index in [`super::Bodies::obstacles`].
    Obstacle(usize),
    /// The mold.
    Mold,
}

/// The nearest pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Their distance (m); negative where they penetrate each other, by so much.
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
    pub fn label(&self, scene: &Scene) -> String {
        label(scene, self.part, self.near)
    }
}

/// A body and what it is near to, by name.
pub(crate) fn label(scene: &Scene, part: Part, near: Near) -> String {
    let name = |part: Part| part_label(part, scene, &scene.ply);
    match near {
        Near::Part(other) => format!("{} and {}", name(part), name(other)),
        Near::Obstacle(n) => {
            format!("{} and obstacle {}", name(part), scene.bodies.obstacles()[n].name)
        }
        Near::Mold => format!("{} and the mold", name(part)),
    }
}

fn part_label(Part { body, gripper }: Part, scene: &Scene, ply: &Ply) -> String {
    let name = &scene.bodies.bodies()[body].name;
    match gripper {
        Some(n) => format!("{name} of {}", gripper_name(ply.id(n))),
        None => name.clone(),
    }
}

/// The nearest pair at one time, with its time 0; none of a scene without bodies, or without anything that they could meet.
#[must_use]
pub fn at(scene: &Scene, poses: &Poses) -> Option<Nearest> {
    along(scene, &Straight::new(poses, poses), &[0.0])
}

/// The nearest pair between two steps, with the share of the step as its time.
#[must_use]
pub(crate) fn between_steps(scene: &Scene, from: &Poses, to: &Poses) -> Option<Nearest> {
    along(scene, &Straight::new(from, to), &[0.0, 1.0])
}

/// The nearest pair along the steps of a search, by the lines between the grippers; its time counts steps, from 0.
#[must_use]
pub(crate) fn along_positions(scene: &Scene, positions: &[Vec<Point>]) -> Option<Nearest> {
    if scene.bodies.is_empty() {
        return None;
    }
    let neighbours = scene.ply.neighbours();
    let poses = |step: &Vec<Point>| Poses::by_neighbours(scene, &neighbours, step);
    let poses: Vec<Poses> = positions.iter().map(poses).collect();
    if let [only] = &poses[..] {
        return at(scene, only);
    }
    let legs = poses.windows(2).map(|pair| Straight::new(&pair[0], &pair[1])).collect();
    let times: Vec<f64> = (0..positions.len()).map(|n| n as f64).collect();
    along(scene, &Legs(legs), &times)
}

/// The distance of bodies from obstacles (m) at one time, if it is below `least` (m).
#[must_use]
pub(crate) fn from_obstacles(scene: &Scene, poses: &Poses, least: f64) -> Option<f64> {
    let moves = Straight::new(poses, poses);
    let mut search = Search::among(scene, &moves, None);
    let balls = search.balls(0.0);
    let mut found = least;
    for body in 0..balls.len() {
        for obstacle in 0..search.obstacles.len() {
            let pair = (body, Other::Obstacle(obstacle));
            if search.gap(pair, &balls) < found {
                found = found.min(search.distance(pair, 0.0));
            }
        }
    }
    (found < least).then_some(found)
}

impl Nearest {
    /// The nearest pair of a planned motion; of a tool, straight from sample to sample of the motion as it is written.
    #[must_use]
    pub(crate) fn of_motion(
        scene: &Scene,
        motion: &TimedMotion,
        attitudes: &Attitudes,
    ) -> Option<Nearest> {
        Nearest::of_motion_within(scene, motion, attitudes, [0.0, motion.duration()])
    }

    /// The same between two times of the motion (s).
    #[must_use]
    pub(crate) fn of_motion_within(
        scene: &Scene,
        motion: &TimedMotion,
        attitudes: &Attitudes,
        [from, to]: [f64; 2],
    ) -> Option<Nearest> {
        let within = |times: &[f64]| -> Vec<f64> {
            let inner = times.iter().copied().filter(|t| from < *t && *t < to);
            [from].into_iter().chain(inner).chain((from < to).then_some(to)).collect()
        };
        if scene.tool.is_none() {
            let times = within(motion.times());
            return along(scene, &Planned { motion, attitudes }, &times);
        }
        let times = within(&motion.samples(scene.plan.rate).ok()?);
        let poses = |t: &f64| {
            let positions = motion.at(*t);
            Poses::of(scene, &positions, &attitudes.at(*t), &positions)
        };
        let poses: Vec<Poses> = times.iter().map(poses).collect();
        let legs: Vec<Straight> =
            poses.windows(2).map(|pair| Straight::new(&pair[0], &pair[1])).collect();
        if legs.is_empty() {
            return at(scene, poses.first()?);
        }
        let counts: Vec<f64> = (0..times.len()).map(|n| n as f64).collect();
        let nearest = along(scene, &Legs(legs), &counts)?;
        let n = (nearest.time as usize).min(times.len() - 2);
        let time = times[n] + (nearest.time - n as f64) * (times[n + 1] - times[n]);
        Some(Nearest { time, ..nearest })
    }
}

/// The nearest pair along a motion through ascending times (s). No pair comes nearer in between than the resolution allows.
#[must_use]
pub(crate) fn along(scene: &Scene, moves: &dyn Moves, times: &[f64]) -> Option<Nearest> {
    if scene.bodies.is_empty() {
        return None;
    }
    let mut search = Search::new(scene, moves);
    // all samples first, so that the search can drop most intervals at once
    for time in times {
        search.sample(*time);
    }
    for pair in times.windows(2) {
        search.interval([pair[0], pair[1]]);
    }
    search.best
}

/// A body that is judged.
struct Judged {
    part: Part,
    origin: Origin,
    mount: Mount,
    /// Middle of a ball around it in the coordinates of its origin (m), and the ball's radius (m).
    ball: (Point, f64),
    /// Distance of its farthest point from its origin at most (m).
    reach: f64,
}

struct Search<'a> {
    moves: &'a dyn Moves,
    solids: &'a Solids,
    judged: Vec<Judged>,
    /// Where each obstacle stands.
    obstacles: Vec<Pose>,
    /// The mold, if a body could meet it.
    mold: Option<OverMold<'a>>,
    /// The limit (m).
    limit: f64,
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

/// Where the balls of all bodies are at one time.
type Balls = Vec<Point>;

impl<'a> Search<'a> {
    fn new(scene: &'a Scene, moves: &'a dyn Moves) -> Self {
        let solids = scene.bodies.made();
        let meets_mold = scene.bodies.bodies().iter().any(|body| body.on != Mount::Pad);
        let mold = scene.mold.as_ref().filter(|_| meets_mold);
        Search::among(scene, moves, mold.map(|mold| OverMold::new(mold, solids)))
    }

    /// Over a mold, if it counts.
    fn among(scene: &'a Scene, moves: &'a dyn Moves, mold: Option<OverMold<'a>>) -> Self {
        let solids = scene.bodies.made();
        let mut judged = Vec::new();
        for (n, body) in scene.bodies.bodies().iter().enumerate() {
            let ball = solids.bodies[n].ball;
            let mut add = |gripper: Option<usize>, origin: Origin| {
                let part = Part { body: n, gripper };
                let reach = norm(ball.0) + ball.1;
                judged.push(Judged { part, origin, mount: body.on, ball, reach });
            };
            let grippers = 0..scene.ply.grippers();
            match body.on {
                Mount::Pad => grippers.for_each(|g| add(Some(g), Origin::Pad(g))),
                Mount::Stem => grippers.for_each(|g| add(Some(g), Origin::Stem(g))),
                Mount::Flange if moves.has_flange() => add(None, Origin::Flange),
                Mount::Flange => {}
            }
        }
        Search {
            moves,
            solids,
            judged,
            obstacles: scene.bodies.obstacles().iter().map(|obstacle| obstacle.pose).collect(),
            mold,
            limit: scene.limits.clearance,
            best: None,
        }
    }

    /// The nearest distance that is known (m).
    fn least(&self) -> f64 {
        self.best.map_or(f64::INFINITY, |best| best.distance)
    }

    /// By how much a pair may come nearer than is reported (m).
    fn resolution(&self) -> f64 {
        let least = self.least();
        TUNING.resolution * if least.is_finite() { least.abs().max(self.limit) } else { self.limit }
    }

    fn balls(&self, time: f64) -> Balls {
        let place = |body: &Judged| self.moves.pose(body.origin, time).place(body.ball.0);
        self.judged.iter().map(place).collect()
    }

    /// The nearest pairs at one time.
    fn sample(&mut self, time: f64) {
        let balls = self.balls(time);
        let pairs = self.near(&balls, 0.0);
        for pair in pairs {
            if self.gap(pair, &balls) < self.least() {
                self.distance(pair, time);
            }
        }
    }

    /// Pairs that could be nearer than the nearest one that is known if each body goes no farther than `way` (m).
    fn near(&self, balls: &Balls, way: f64) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let least = self.least();
        // along x: who is farther off in x alone is no candidate, nor is anyone behind
        let mut order: Vec<usize> = (0..balls.len()).collect();
        order.sort_by(|&a, &b| balls[a][0].total_cmp(&balls[b][0]).then(a.cmp(&b)));
        let largest = self.judged.iter().map(|body| body.ball.1).fold(0.0, f64::max);
        for (n, &a) in order.iter().enumerate() {
            let one = &self.judged[a];
            for &b in &order[n + 1..] {
                let other = &self.judged[b];
                let apart = balls[b][0] - balls[a][0] - one.ball.1;
                if apart - largest - 2.0 * way >= least {
                    break;
                }
                let grippers = one.part.gripper.zip(other.part.gripper);
                if grippers.is_some_and(|(own, its)| own != its)
                    && apart - other.ball.1 - 2.0 * way < least
                {
                    pairs.push((a.min(b), Other::Body(a.max(b))));
                }
            }
        }
        for body in 0..self.judged.len() {
            pairs.extend((0..self.obstacles.len()).map(|n| (body, Other::Obstacle(n))));
            if self.mold.is_some() && self.judged[body].mount != Mount::Pad {
                pairs.push((body, Other::Mold));
            }
        }
        pairs
    }

    /// A distance (m) that two do not fall short of, by the balls around bodies and the boxes around obstacles.
    fn gap(&self, (body, other): Pair, balls: &Balls) -> f64 {
        let own = self.judged[body].ball.1;
        match other {
            Other::Body(b) => distance(balls[body], balls[b]) - own - self.judged[b].ball.1,
            Other::Obstacle(n) => {
                let [low, high] = self.solids.obstacles[n].bounds;
                let p = self.obstacles[n].local(balls[body]);
                norm([0, 1, 2].map(|c| (low[c] - p[c]).max(p[c] - high[c]).max(0.0))) - own
            }
            Other::Mold => {
                self.mold.as_ref().map_or(f64::INFINITY, |mold| mold.gap(balls[body], own))
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
        let turned = |body: &Judged| body.reach * self.moves.turn(body.origin, times);
        let one = &self.judged[body];
        match other {
            Other::Body(b) => {
                let other = &self.judged[b];
                let way = self.moves.way(one.origin, Some(other.origin), times);
                way + turned(one) + turned(other)
            }
            Other::Obstacle(_) | Other::Mold => {
                self.moves.way(one.origin, None, times) + turned(one)
            }
        }
    }

    /// The nearest pairs between two times.
    fn interval(&mut self, times: [f64; 2]) {
        let ends = times.map(|time| self.balls(time));
        let farthest = |body: &Judged| {
            self.moves.way(body.origin, None, times)
                + body.reach * self.moves.turn(body.origin, times)
        };
        let way = self.judged.iter().map(farthest).fold(0.0, f64::max);
        for pair in self.near(&ends[0], way) {
            let change = self.change(pair, times);
            let bound = |from: f64, to: f64| 0.5 * (from + to - change);
            let [from, to] = [0, 1].map(|n| self.gap(pair, &ends[n]));
            if bound(from, to) >= self.least() - self.resolution() {
                continue;
            }
            let [from, to] = times.map(|time| self.distance(pair, time));
            self.halve(pair, (times[0], from), (times[1], to), TUNING.halvings);
        }
    }

    /// Halves an interval in which two could come nearer than the nearest pair that is known.
    fn halve(&mut self, pair: Pair, (t0, from): (f64, f64), (t1, to): (f64, f64), depth: u32) {
        let least = 0.5 * (from + to - self.change(pair, [t0, t1]));
        // what is found of the mold has half of the resolution
        let resolution = match pair.1 {
            Other::Mold => 0.5 * self.resolution(),
            _ => self.resolution(),
        };
        if depth == 0 || least >= self.least() - resolution {
            return;
        }
        let time = 0.5 * (t0 + t1);
        let middle = self.distance(pair, time);
        self.halve(pair, (t0, from), (time, middle), depth - 1);
        self.halve(pair, (time, middle), (t1, to), depth - 1);
    }
}
