//! How what bodies are mounted on moves between two times, and bounds of it.

use super::poses::Poses;
use crate::geometry::rotation::continued;
use crate::geometry::vector::{along, between, cross, norm, sub};
use crate::mold::Pose;
use crate::motion::{Attitudes, TimedMotion, slerp, turn};

/// What a body is mounted on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// The pad of a gripper.
    Pad(usize),
    /// The stem of a gripper.
    Stem(usize),
    /// The flange.
    Flange,
    /// A link of the arm.
    Link(usize),
}

/// A motion of everything that bodies are mounted on.
pub(crate) trait Moves {
    /// Where something is at a time.
    fn pose(&self, origin: Origin, time: f64) -> Pose;

    /// How far something goes at most between two times (m), as seen from another thing that is not turned, or in space.
    fn travel(&self, origin: Origin, seen_from: Option<Origin>, times: [f64; 2]) -> f64;

    /// By how much something turns at most between two times (rad).
    fn turn(&self, origin: Origin, times: [f64; 2]) -> f64;

    /// The most that the distance of two bodies can change between two times (m), each given by its origin and the distance of its
    /// farthest point from there (m); or of one body and what stands still.
    fn change(&self, one: Reach, other: Option<Reach>, times: [f64; 2]) -> f64 {
        let turned = |(origin, reach): Reach| reach * self.turn(origin, times);
        let travel = self.travel(one.0, other.map(|(origin, _)| origin), times);
        travel + turned(one) + other.map_or(0.0, turned)
    }

    /// Whether there is a flange.
    fn has_flange(&self) -> bool;

    /// How many links of an arm there are.
    fn links(&self) -> usize {
        0
    }
}

/// What a body is mounted on, and the distance of its farthest point from there (m).
pub(super) type Reach = (Origin, f64);

/// Straight from some poses at time 0 to others at time 1, turned along the shortest way.
pub(crate) struct Straight {
    pads: Vec<Leg>,
    stems: Vec<Leg>,
    flange: Option<Leg>,
    links: Vec<Leg>,
}

/// A straight way.
struct Leg {
    ends: [Pose; 2],
    quaternions: [[f64; 4]; 2],
    /// How much it turns (rad).
    turn: f64,
    /// Rotation vector of that turn (rad).
    spin: [f64; 3],
}

impl Leg {
    fn new([from, to]: [&Pose; 2]) -> Self {
        let a = from.quaternion();
        let b = continued(to.quaternion(), Some(a));
        let turn = turn(&a, &b);
        // the vector part of b a⁻¹: the axis times the sine of half the turn
        let part = sub(
            sub([0, 1, 2].map(|k| a[3] * b[k]), [0, 1, 2].map(|k| b[3] * a[k])),
            cross([b[0], b[1], b[2]], [a[0], a[1], a[2]]),
        );
        let length = norm(part);
        let spin = if length > 0.0 { part.map(|c| turn * c / length) } else { [0.0; 3] };
        Leg { ends: [*from, *to], quaternions: [a, b], turn, spin }
    }

    /// The pose at a share of the way.
    fn pose_at(&self, time: f64) -> Pose {
        let [from, to] = &self.ends;
        if time <= 0.0 {
            return *from;
        }
        if time >= 1.0 {
            return *to;
        }
        let position = between(from.position, to.position, time);
        if self.turn == 0.0 {
            return Pose { position, ..*from };
        }
        let [a, b] = &self.quaternions;
        Pose::of_quaternion(position, slerp(a, b, time))
    }

    fn displacement(&self) -> [f64; 3] {
        sub(self.ends[1].position, self.ends[0].position)
    }
}

impl Straight {
    /// Between the poses of two steps.
    #[must_use]
    pub fn new(from: &Poses, to: &Poses) -> Self {
        let legs = |a: &[Pose], b: &[Pose]| -> Vec<Leg> {
            a.iter().zip(b).map(|(a, b)| Leg::new([a, b])).collect()
        };
        let flange = from.flange.as_ref().zip(to.flange.as_ref());
        Straight {
            pads: legs(&from.pads, &to.pads),
            stems: legs(&from.stems, &to.stems),
            flange: flange.map(|(a, b)| Leg::new([a, b])),
            links: legs(&from.links, &to.links),
        }
    }

    fn leg(&self, origin: Origin) -> &Leg {
        match origin {
            Origin::Pad(n) => &self.pads[n],
            Origin::Stem(n) => &self.stems[n],
            // a body of the flange is judged only where there is one
            Origin::Flange => self.flange.as_ref().unwrap_or(&self.stems[0]),
            Origin::Link(n) => &self.links[n],
        }
    }
}

impl Moves for Straight {
    fn pose(&self, origin: Origin, time: f64) -> Pose {
        self.leg(origin).pose_at(time)
    }

    fn travel(&self, origin: Origin, seen_from: Option<Origin>, [from, to]: [f64; 2]) -> f64 {
        let other = seen_from.map_or([0.0; 3], |other| self.leg(other).displacement());
        norm(sub(self.leg(origin).displacement(), other)) * (to - from)
    }

    fn turn(&self, origin: Origin, [from, to]: [f64; 2]) -> f64 {
        self.leg(origin).turn * (to - from)
    }

    /// Also as seen from a turning body: with the distance q of the origins, its rate v and the turns ω, the origin of b moves by
    /// `v − ω_a × q` as seen from a, and b turns by ω_b − ω_a. Of bodies that one tool turns, that is what axes and joints do.
    fn change(&self, one: Reach, other: Option<Reach>, [from, to]: [f64; 2]) -> f64 {
        let ((origin, reach), takes) = (one, to - from);
        let a = self.leg(origin);
        let Some((other, its_reach)) = other else {
            return takes * (norm(a.displacement()) + reach * a.turn);
        };
        let b = self.leg(other);
        let rate = sub(b.displacement(), a.displacement());
        let still = norm(rate) + reach * a.turn + its_reach * b.turn;
        let begin = sub(b.ends[0].position, a.ends[0].position);
        // q is linear, and so is the rate: it is largest at an end
        let ends = [from, to].map(|time| along(begin, time, rate));
        let seen = |spin: [f64; 3]| {
            ends.map(|q| norm(sub(rate, cross(spin, q)))).into_iter().fold(0.0, f64::max)
        };
        let turned = norm(sub(b.spin, a.spin));
        let from_a = seen(a.spin) + its_reach * turned;
        let from_b = seen(b.spin) + reach * turned;
        takes * still.min(from_a).min(from_b)
    }

    fn has_flange(&self) -> bool {
        self.flange.is_some()
    }

    fn links(&self) -> usize {
        self.links.len()
    }
}

/// Straight from step to step, the first at time 0, the next at time 1, and so on.
pub(super) struct Legs(pub Vec<Straight>);

impl Legs {
    fn leg(&self, time: f64) -> (&Straight, f64) {
        let n = (time.max(0.0) as usize).min(self.0.len() - 1);
        (&self.0[n], time - n as f64)
    }

    /// The leg of an interval within it, and the times in it.
    fn within(&self, [from, to]: [f64; 2]) -> (&Straight, [f64; 2]) {
        let (leg, begin) = self.leg(from);
        (leg, [begin, begin + to - from])
    }
}

impl Moves for Legs {
    fn pose(&self, origin: Origin, time: f64) -> Pose {
        let (leg, time) = self.leg(time);
        leg.pose(origin, time)
    }

    fn travel(&self, origin: Origin, seen_from: Option<Origin>, times: [f64; 2]) -> f64 {
        let (leg, times) = self.within(times);
        leg.travel(origin, seen_from, times)
    }

    fn turn(&self, origin: Origin, times: [f64; 2]) -> f64 {
        let (leg, times) = self.within(times);
        leg.turn(origin, times)
    }

    fn change(&self, one: Reach, other: Option<Reach>, times: [f64; 2]) -> f64 {
        let (leg, times) = self.within(times);
        leg.change(one, other, times)
    }

    fn has_flange(&self) -> bool {
        self.0[0].has_flange()
    }

    fn links(&self) -> usize {
        self.0[0].links.len()
    }
}

/// A planned motion in time, with stems upright.
pub(crate) struct Planned<'a> {
    /// Where the grippers are.
    pub motion: &'a TimedMotion,
    /// How their pads are turned.
    pub attitudes: &'a Attitudes,
}

impl Planned<'_> {
    fn gripper(origin: Origin) -> usize {
        match origin {
            Origin::Pad(n) | Origin::Stem(n) => n,
            Origin::Flange | Origin::Link(_) => 0,
        }
    }
}

impl Moves for Planned<'_> {
    fn pose(&self, origin: Origin, time: f64) -> Pose {
        let position = self.motion.gripper_at(Self::gripper(origin), time);
        match origin {
            Origin::Pad(n) => Pose::of_quaternion(position, self.attitudes.gripper_at(n, time)),
            Origin::Stem(_) | Origin::Flange | Origin::Link(_) => Pose::upright(position),
        }
    }

    fn travel(&self, origin: Origin, seen_from: Option<Origin>, times: [f64; 2]) -> f64 {
        self.motion.travel(Self::gripper(origin), seen_from.map(Self::gripper), times)
    }

    fn turn(&self, origin: Origin, times: [f64; 2]) -> f64 {
        match origin {
            Origin::Pad(n) => self.attitudes.turn(n, times),
            Origin::Stem(_) | Origin::Flange | Origin::Link(_) => 0.0,
        }
    }

    fn has_flange(&self) -> bool {
        false
    }
}
