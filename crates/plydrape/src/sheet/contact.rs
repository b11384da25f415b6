//! Contact with the mold, eq. (19e) and (19f) of `docs/theory/sheet.md`.
//!
//! Contact is a penalty, ½ k · area · d² of a negative distance d. A node that touches has its *anchor* there, and a spring
//! along the mold pulls it back there ([`super::friction`]). A node that is clear of the mold again has no anchor.
//!
//! [`Contact::find`] looks where nodes are, [`Energy::linearize`] adds what acts on them, and [`Contact::anchor`] moves the
//! anchors after the time step.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::friction::{Anchor, FrictionLaw, penalty};
use super::pads::Pads;
use super::rim::Rim;
use super::system::{System, add};
use super::tuning::SheetTuning;
use super::unknowns::Carrier;
use crate::geometry::vector::{distance, dot, norm, sub};
use crate::mold::Mold;
use crate::sheet::matrix3::{outer, scaled};

/// The mold under a node that it presses.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Press {
    /// Distance from the mold (m), negative.
    distance: f64,
    /// Gradient of the distance.
    normal: [f64; 3],
}

/// A node that may touch.
#[derive(Debug, Clone)]
struct Point {
    node: usize,
    area: f64,
    /// Force per depth (N/m).
    stiffness: f64,
    /// Whether friction holds it; a gripper on a rigid mount is stronger.
    rubs: bool,
    /// Where the mold was last looked for (m), and how far it was (m): nearer than that no contact can be.
    seen: [f64; 3],
    clear: f64,
    anchor: Option<Anchor>,
    /// Largest force of the spring along the mold (N).
    bound: f64,
    /// How the mold pressed it when contacts were found last; `None` if it did not.
    press: Option<Press>,
    /// Whether it slipped when contacts were found last.
    slips: bool,
}

impl Point {
    /// Pressure of the mold (Pa) at a depth (m).
    fn pressure(&self, depth: f64) -> f64 {
        self.stiffness * depth.max(0.0) / self.area
    }

    /// Whether nothing of the mold can be at the node in a place (m), by where it was last looked for.
    fn is_clear(&self, x: [f64; 3]) -> bool {
        self.clear > 0.0 && distance(x, self.seen) < self.clear
    }

    /// Looks for the mold at a place `x` (m); returns how it presses the node, if it does. An anchor that `lasts` holds the node
    /// along the normal instead.
    fn look(&mut self, mold: Rim, x: [f64; 3], lasts: bool) -> Option<Press> {
        let closest = mold.closest_point(x);
        let distance = closest.distance;
        (self.seen, self.clear) = (x, distance);
        // the blended normal of a mesh would leave a node outside that it should bring to the surface
        let press = || Press { distance, normal: mold.distance_gradient(x, &closest) };
        (distance < 0.0 && !lasts).then(press)
    }

    /// Anchors it where it lies, at a place `x` (m) that is nearer to the mold than the distance at which an anchor is lost (m).
    fn lie(&mut self, mold: Rim, friction: &FrictionLaw, release: f64, x: [f64; 3]) {
        let closest = mold.closest_point(x);
        if self.rubs && closest.distance <= release {
            let pressure = self.pressure(-closest.distance);
            self.anchor = Some(Anchor { point: closest.point, normal: closest.normal });
            self.bound = friction.bound(pressure, self.area);
        }
    }
}

/// Contact of all nodes that grippers do not hold.
#[derive(Debug, Clone)]
pub struct Contact<'a> {
    mold: Rim<'a>,
    /// What holds nodes along the mold.
    friction: FrictionLaw,
    /// Distance (m) at which an anchor is lost.
    release: f64,
    points: Vec<Point>,
    /// Whether other nodes were pressed or slipped when contacts were found last than the time before.
    pub switched: bool,
}

impl<'a> Contact<'a> {
    /// The contact of a sheet with its mold: of all nodes but those that a rigid gripper holds at a point. A mount presses its
    /// node far harder than the ply's weight, so the mold is stiff against it there, too.
    pub fn new(
        sheet: &Sheet,
        mold: &'a Mold,
        tuning: &SheetTuning,
        pads: &Pads,
        system: &System,
    ) -> Self {
        // under its own weight a node sinks in by a small share of the pitch; under a mount it must be stiff against the mount
        let pressure = penalty(sheet, tuning.contact_depth);
        let mut stiffness: Vec<f64> = sheet.fabric.areas.iter().map(|a| pressure * a).collect();
        for (n, gripper) in sheet.grippers.iter().enumerate() {
            let [_, _, axial] = gripper.mount.unwrap_or_default();
            for (node, share) in pads.shares(n) {
                stiffness[node] = stiffness[node].max(tuning.mount_contact * axial * share);
            }
        }
        // a point begins far from the mold, without an anchor
        let point = |node: usize, rubs: bool| Point {
            node,
            area: sheet.fabric.areas[node],
            stiffness: stiffness[node],
            rubs,
            seen: [0.0; 3],
            clear: f64::NEG_INFINITY,
            anchor: None,
            bound: 0.0,
            press: None,
            slips: false,
        };
        // a node that a rigid gripper holds at a point cannot move; those of a pad on a rigid mount do not rub, because the mount is
        // stronger than friction
        let points = (0..sheet.fabric.places.len()).filter_map(|node| match system.carrier(node) {
            Carrier::Held { .. } => None,
            Carrier::Pad { shift: None, .. } => Some(point(node, false)),
            _ => Some(point(node, true)),
        });
        Contact {
            mold: Rim::new(mold, sheet.mesh),
            friction: FrictionLaw::new(sheet, tuning),
            release: tuning.release * sheet.pitch,
            points: points.collect(),
            switched: true,
        }
    }

    /// Goes on from the contact of the same ply with its nodes at `x` (m), before pads let go of some of them. Those that pads
    /// had pressed on the mold, as near as a node that is not clear of it, are anchored where they are.
    pub fn take_over(&mut self, before: Contact, x: &[[f64; 3]]) {
        let mut known = before.points.into_iter().peekable();
        for point in &mut self.points {
            while known.next_if(|old| old.node < point.node).is_some() {}
            if let Some(old) = known.next_if(|old| old.node == point.node && old.rubs == point.rubs)
            {
                *point = old;
                continue;
            }
            point.lie(self.mold, &self.friction, self.release, x[point.node]);
        }
    }

    /// Begins with a ply that lies with its nodes at `x` (m): those that are not clear of the mold are anchored where they are.
    pub fn begin_lying(&mut self, x: &[[f64; 3]]) {
        for point in &mut self.points {
            point.lie(self.mold, &self.friction, self.release, x[point.node]);
        }
    }

    /// Finds where the mold presses nodes, and which of them slip, with the nodes at `x` (m). Nodes for which `skips` holds
    /// stay where they are.
    pub fn find(&mut self, x: &[[f64; 3]], skips: impl Fn(usize) -> bool) {
        let Contact { mold, friction, points, switched, .. } = self;
        *switched = false;
        for point in points {
            let x = x[point.node];
            if skips(point.node) {
                continue;
            }
            let slips = point
                .anchor
                .is_some_and(|anchor| friction.spring(anchor, x, point.area, point.bound).slips);
            let lasts = friction.lasts() && point.anchor.is_some();
            let press = if point.is_clear(x) { None } else { point.look(*mold, x, lasts) };
            *switched |= (press.is_some(), slips) != (point.press.is_some(), point.slips);
            (point.press, point.slips) = (press, slips);
        }
    }

    /// After a time step: nodes that touch the mold get an anchor where they are, so that it stores no energy, those that
    /// are clear lose it, and those that slipped take it along.
    pub fn anchor(&mut self, x: &[[f64; 3]]) {
        for point in &mut self.points {
            let x = x[point.node];
            if point.is_clear(x) && point.anchor.is_none() {
                continue;
            }
            let closest = self.mold.closest_point(x);
            let depth = -closest.distance;
            point.bound = self.friction.bound(point.pressure(depth), point.area);
            point.anchor = match point.anchor {
                Some(anchor) if self.friction.lasts() => Some(anchor),
                Some(_) if depth < -self.release => None,
                Some(anchor) => {
                    Some(self.friction.follow(self.mold, anchor, x, point.area, point.bound))
                }
                None if depth >= 0.0 && point.rubs => {
                    Some(Anchor { point: closest.point, normal: closest.normal })
                }
                None => None,
            };
        }
    }

    /// Longest time (s) in which no node that is free of the mold goes farther than its distance from it, or farther than
    /// `most` (m) where it is nearer than that. Nodes go with the velocities `v` (m/s). No times above `enough` (s) are found
    /// apart.
    pub fn longest_time(&mut self, x: &[[f64; 3]], v: &[[f64; 3]], most: f64, enough: f64) -> f64 {
        let mut longest = enough;
        for point in &mut self.points {
            let (at, speed) = (x[point.node], norm(v[point.node]));
            if point.anchor.is_some() || speed * longest <= most {
                continue;
            }
            if speed * longest > point.clear - distance(at, point.seen) {
                let closest = self.mold.closest_point(at);
                point.seen = at;
                point.clear = closest.distance;
            }
            longest = longest.min(point.clear.max(most) / speed);
        }
        longest
    }

    /// Farthest way (m) from `before` to `now` of a node that came to the mold in between.
    pub fn landing_way(&self, before: &[[f64; 3]], now: &[[f64; 3]]) -> f64 {
        let lands = |point: &&Point| point.anchor.is_none() && point.rubs && point.clear < 0.0;
        let moved = |point: &Point| distance(before[point.node], now[point.node]);
        self.points.iter().filter(lands).map(moved).fold(0.0, f64::max)
    }

    /// Whether an anchor stays where it is as long as its node touches.
    pub fn sticks(&self) -> bool {
        self.friction.sticks()
    }

    /// The nodes that stay on the mold by themselves, if all of their neighbors stay: those that are anchored and pressed,
    /// and which the forces on them, whose gradient is given (N), neither lift nor move by more than `most` (m).
    pub fn lying(
        &self,
        x: &[[f64; 3]],
        gradient: &[[f64; 3]],
        most: f64,
    ) -> impl Iterator<Item = usize> {
        let lies = move |point: &&Point| {
            let Some(anchor) = point.anchor else { return false };
            let (off, total) = (sub(x[point.node], anchor.point), gradient[point.node]);
            let k = point.stiffness;
            // what the mold has to carry: the pressure of now, and what is out of balance
            let normal = (-k * dot(off, anchor.normal)).max(0.0) + dot(total, anchor.normal);
            let pressed = point.press.is_some() && normal > 0.0 || self.friction.lasts();
            pressed && norm(total) <= most * k
        };
        self.points.iter().filter(lies).map(|point| point.node)
    }

    /// The nodes that touch.
    pub fn touching(&self) -> impl Iterator<Item = usize> {
        self.points.iter().filter(|point| point.anchor.is_some()).map(|point| point.node)
    }
}

impl Energy for Contact<'_> {
    fn value(&self, now: &Configuration) -> f64 {
        let energy = |point: &Point| {
            let x = now.x[point.node];
            let spring = |anchor| self.friction.spring(anchor, x, point.area, point.bound).energy();
            let spring = point.anchor.map_or(0.0, spring);
            if point.is_clear(x) || self.friction.lasts() && point.anchor.is_some() {
                return spring;
            }
            let depth = self.mold.closest_point(x).distance.min(0.0);
            spring + 0.5 * point.stiffness * depth * depth
        };
        self.points.iter().map(energy).sum()
    }

    fn linearize(&self, now: &Configuration, _: Stiffness, system: &mut System) {
        for point in &self.points {
            let node = point.node;
            if system.skips(&[node]) {
                continue;
            }
            if let Some(anchor) = point.anchor {
                let spring = self.friction.spring(anchor, now.x[node], point.area, point.bound);
                if let Some((gradient, k)) = self.friction.derivatives(&spring, anchor) {
                    add(&mut system.gradient[node], 1.0, gradient);
                    system.stiffen(node, &k);
                }
            }
            if let Some(Press { distance, normal }) = point.press {
                let k = point.stiffness;
                add(&mut system.gradient[node], k * distance, normal);
                system.stiffen(node, &scaled(k, &outer(normal, normal)));
            }
        }
    }
}
