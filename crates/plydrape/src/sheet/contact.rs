//! Contact with the mold, and what holds a touching node along it.
//!
//! Contact is a penalty, ½ k · area · d² of a negative distance d. A node that touches has its *anchor* there, and a
//! spring along the mold pulls it back there. The force of the spring is at most (τ₀ + μ · pressure) · area, beyond which
//! the anchor follows; stick is no such bound. A node that is clear of the mold again has no anchor.

use super::system::{System, add};
use crate::geometry::matrix3::{Matrix3, outer};
use crate::geometry::vector::{along, distance, dot, norm, sub};
use crate::layup::Friction;
use crate::mold::Mold;

/// Where a node touched the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Anchor {
    point: [f64; 3],
    normal: [f64; 3],
}

/// A node that may touch.
#[derive(Debug, Clone)]
struct Point {
    node: usize,
    area: f64,
    /// Whether friction holds it; a gripper on a rigid mount is stronger.
    rubs: bool,
    /// Where the mold was last looked for (m), and how far it was (m): nearer than that no contact can be.
    seen: [f64; 3],
    clear: f64,
    anchor: Option<Anchor>,
    /// Largest force of the spring along the mold (N).
    bound: f64,
    /// Whether the mold pressed it, and whether it slipped, when forces were added last.
    acts: [bool; 2],
}

/// Contact of all nodes that grippers do not hold.
#[derive(Debug, Clone)]
pub struct Contact<'a> {
    mold: &'a Mold,
    /// Pressure per depth k (Pa/m).
    stiffness: f64,
    /// Shear stress per way along the mold (Pa/m).
    shear_stiffness: f64,
    /// Distance (m) at which an anchor is lost.
    release: f64,
    friction: Friction,
    tack: f64,
    points: Vec<Point>,
    /// Whether other nodes were pressed or slipped when forces were added last than the time before.
    pub changed: bool,
}

impl<'a> Contact<'a> {
    /// Of nodes with their areas (m²), and whether friction holds each of them.
    pub fn new(
        mold: &'a Mold,
        [stiffness, shear_stiffness]: [f64; 2],
        release: f64,
        friction: Friction,
        tack: f64,
        nodes: impl Iterator<Item = (usize, f64, bool)>,
    ) -> Self {
        let point = |(node, area, rubs)| Point {
            node,
            area,
            rubs,
            seen: [0.0; 3],
            clear: f64::NEG_INFINITY,
            anchor: None,
            bound: 0.0,
            acts: [false; 2],
        };
        Contact {
            mold,
            stiffness,
            shear_stiffness,
            release,
            friction,
            tack,
            points: nodes.map(point).collect(),
            changed: true,
        }
    }

    /// Goes on from the contact of the same ply with its nodes at `x` (m), before pads let go of some of them. Those that pads
    /// had pressed on the mold, as near as a node that is not clear of it, are anchored where they are.
    pub fn take_over(&mut self, before: &Contact, x: &[[f64; 3]]) {
        let mut known = before.points.iter().peekable();
        for n in 0..self.points.len() {
            let (node, rubs) = (self.points[n].node, self.points[n].rubs);
            while known.next_if(|old| old.node < node).is_some() {}
            if let Some(old) = known.peek().filter(|old| old.node == node && old.rubs == rubs) {
                self.points[n] = (*old).clone();
                continue;
            }
            let closest = self.mold.closest_point(x[node]);
            if rubs && !closest.beyond && closest.distance <= self.release {
                let bound = self.bound(-closest.distance, self.points[n].area);
                let point = &mut self.points[n];
                point.anchor = Some(Anchor { point: closest.point, normal: closest.normal });
                point.bound = bound;
            }
        }
    }

    /// Largest force (N) of the spring along the mold of a node with its area (m²) at a depth (m).
    fn bound(&self, depth: f64, area: f64) -> f64 {
        let pressure = self.stiffness * depth.max(0.0);
        match self.friction {
            Friction::Coulomb(mu) => (self.tack + mu * pressure) * area,
            Friction::Stick | Friction::StickForEver => f64::INFINITY,
        }
    }

    /// Energy (J) of depth and of springs along the mold.
    pub fn energy(&self, x: &[[f64; 3]]) -> f64 {
        let one = |point: &Point| {
            let at = x[point.node];
            let k = self.stiffness * point.area;
            let mut energy = 0.0;
            if let Some(anchor) = point.anchor {
                let k = self.shear_stiffness * point.area;
                let off = self.offset(anchor, at);
                let size = norm(off);
                energy += match self.friction {
                    Friction::Coulomb(_) if k * size > point.bound => {
                        point.bound * (size - 0.5 * point.bound / k)
                    }
                    _ => 0.5 * k * size * size,
                };
            }
            if !self.is_clear(point, at) {
                let closest = self.mold.closest_point(at);
                if closest.distance < 0.0 && !self.holds_for_ever(point) {
                    energy += 0.5 * k * closest.distance * closest.distance;
                }
            }
            energy
        };
        self.points.iter().map(one).sum()
    }

    /// Adds gradient and second derivative.
    pub fn add(&mut self, x: &[[f64; 3]], system: &mut System) {
        self.changed = false;
        for n in 0..self.points.len() {
            let at = x[self.points[n].node];
            if system.skips(&[self.points[n].node]) {
                continue;
            }
            let slips = self.points[n]
                .anchor
                .is_some_and(|anchor| self.hold(&self.points[n], anchor, at, system));
            let acts = [self.press(n, at, system), slips];
            self.changed |= acts != self.points[n].acts;
            self.points[n].acts = acts;
        }
    }

    /// Adds the pressure of the mold on a node, if there is any.
    fn press(&mut self, n: usize, at: [f64; 3], system: &mut System) -> bool {
        if self.is_clear(&self.points[n], at) {
            return false;
        }
        let closest = self.mold.closest_point(at);
        let distance = if closest.beyond { f64::INFINITY } else { closest.distance };
        let point = &mut self.points[n];
        (point.seen, point.clear) = (at, if closest.beyond { 0.0 } else { distance });
        let (node, k) = (point.node, self.stiffness * point.area);
        if distance >= 0.0 || self.holds_for_ever(&self.points[n]) {
            return false;
        }
        // the blended normal of a mesh would leave a node outside that it should bring to the surface
        let normal = self.mold.distance_gradient(at, &closest);
        add(&mut system.gradient[node], k * distance, normal);
        let normal = outer(normal, normal);
        system.stiffen(node, &normal.map(|row| row.map(|c| k * c)));
        true
    }

    /// Adds the spring along the mold; returns whether the node slips.
    fn hold(&self, point: &Point, anchor: Anchor, at: [f64; 3], system: &mut System) -> bool {
        let k = self.shear_stiffness * point.area;
        let off = self.offset(anchor, at);
        let size = norm(off);
        let mut spring: Matrix3 = [[0.0; 3]; 3];
        let slips = matches!(self.friction, Friction::Coulomb(_)) && k * size > point.bound;
        let stiffness = if slips { point.bound / size } else { k };
        if stiffness == 0.0 {
            return slips;
        }
        add(&mut system.gradient[point.node], stiffness, off);
        for n in 0..3 {
            spring[n][n] = stiffness;
        }
        if self.friction != Friction::StickForEver {
            subtract(&mut spring, stiffness, anchor.normal);
        }
        if slips {
            subtract(&mut spring, stiffness, off.map(|c| c / size));
        }
        system.stiffen(point.node, &spring);
        slips
    }

    /// After a time step: nodes that touch the mold get an anchor where they are, so that it stores no energy, those that
    /// are clear lose it, and those that slipped take it along.
    pub fn update(&mut self, x: &[[f64; 3]]) {
        for n in 0..self.points.len() {
            let point = &self.points[n];
            let at = x[point.node];
            if self.is_clear(point, at) && point.anchor.is_none() {
                continue;
            }
            let closest = self.mold.closest_point(at);
            let depth = if closest.beyond { f64::NEG_INFINITY } else { -closest.distance };
            let bound = self.bound(depth, point.area);
            let anchor = match point.anchor {
                Some(anchor) if self.friction == Friction::StickForEver => Some(anchor),
                Some(_) if depth < -self.release => None,
                Some(anchor) => {
                    Some(self.slipped(anchor, at, bound / (self.shear_stiffness * point.area)))
                }
                None if depth >= 0.0 && point.rubs => {
                    Some(Anchor { point: closest.point, normal: closest.normal })
                }
                None => None,
            };
            let point = &mut self.points[n];
            (point.anchor, point.bound) = (anchor, bound);
        }
    }

    /// An anchor that follows a node so that it is no farther behind than `most` (m).
    fn slipped(&self, anchor: Anchor, at: [f64; 3], most: f64) -> Anchor {
        let off = self.offset(anchor, at);
        let size = norm(off);
        if size <= most {
            return anchor;
        }
        let closest = self.mold.closest_point(along(anchor.point, 1.0 - most / size, off));
        Anchor { point: closest.point, normal: closest.normal }
    }

    /// How far a node is from its anchor, along the mold (m).
    fn offset(&self, anchor: Anchor, at: [f64; 3]) -> [f64; 3] {
        let off = sub(at, anchor.point);
        match self.friction {
            Friction::StickForEver => off,
            _ => along(off, -dot(off, anchor.normal), anchor.normal),
        }
    }

    /// Whether nothing of the mold can be at a node, by where it was last looked for.
    fn is_clear(&self, point: &Point, at: [f64; 3]) -> bool {
        point.clear > 0.0 && distance(at, point.seen) < point.clear
    }

    fn holds_for_ever(&self, point: &Point) -> bool {
        self.friction == Friction::StickForEver && point.anchor.is_some()
    }

    /// Longest time (s) in which no node that is free of the mold goes farther than its distance from it, or farther than
    /// `most` (m) where it is nearer than that. Nodes go with the velocities `v` (m/s). No times above `enough` (s) are told
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
                point.clear = if closest.beyond { 0.0 } else { closest.distance };
            }
            longest = longest.min(point.clear.max(most) / speed);
        }
        longest
    }

    /// Farthest way (m) from `before` to `now` of a node that came to the mold in between.
    pub fn landing_way(&self, before: &[[f64; 3]], now: &[[f64; 3]]) -> f64 {
        let lands = |point: &&Point| point.anchor.is_none() && point.rubs && point.clear < 0.0;
        let way = |point: &Point| distance(before[point.node], now[point.node]);
        self.points.iter().filter(lands).map(way).fold(0.0, f64::max)
    }

    /// Whether an anchor stays where it is as long as its node touches.
    pub fn sticks(&self) -> bool {
        !matches!(self.friction, Friction::Coulomb(_))
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
            let k = self.stiffness * point.area;
            // what the mold has to carry: the pressure of now, and what is out of balance
            let normal = (-k * dot(off, anchor.normal)).max(0.0) + dot(total, anchor.normal);
            let pressed = point.acts[0] && normal > 0.0 || self.holds_for_ever(point);
            pressed && norm(total) <= most * k
        };
        self.points.iter().filter(lies).map(|point| point.node)
    }

    /// The nodes that touch.
    pub fn touching(&self) -> impl Iterator<Item = usize> {
        self.points.iter().filter(|point| point.anchor.is_some()).map(|point| point.node)
    }
}

/// m −= s n nᵀ.
fn subtract(m: &mut Matrix3, s: f64, n: [f64; 3]) {
    for i in 0..3 {
        for j in 0..3 {
            m[i][j] -= s * n[i] * n[j];
        }
    }
}
