//! Preload of grippers on mounts: where they are commanded beyond the places where the ply shall be.
//!
//! While the ply is free, the grippers pull it taut, so that an error of their places makes no line slack: each is commanded
//! beyond its place by what the pull of its lines does to its mount. The lines along the ply's border, which have fabric on
//! one side alone, are pulled harder. The pull is given up as a gripper comes to its place: of a line over a hollow, which it
//! would keep off the mold, wholly, of others in part.
//!
//! As they land, they press: a line of grippers hangs higher than the middles of the cells beside it, which land first and
//! catch the fabric that crosses the line. A mount gives, so its gripper can be commanded to come down earlier and deeper
//! than a rigid one: the line lands with its surroundings, and an error of height does not leave the gripper above the mold.
//! Over a hollow grippers do not press: a pad that sticks early keeps its lines from the length that the hollow needs.
//!
//! Where a pad lets go as its gripper comes to its place, its ply falls into the hollow: the gripper stays above the mold, and of a
//! ply that sticks its lines are left slack, so that no errors of the grippers pull them taut. So the middle of a line touches
//! first, the ply rolls on from there to its ends, and no error of a gripper remains in it, because nothing holds these ends.

use super::strategy::Strategy;
use super::tuning::TUNING;
use crate::geometry::Point;
use crate::geometry::vector::{along, direction, sub};
use crate::layup::{Friction, ReleaseOrder};
use crate::measure::Name;
use crate::mold::distance;
use crate::ply::Neighbors;
use crate::scene::Scene;
use crate::sheet::release::spans_hollow;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// A line between neighboring grippers, and the pull that it bears (N).
struct PulledLine {
    pair: Neighbors,
    most: f64,
}

/// The preload of a strategy's grippers; none for rigid ones.
pub struct Preload<'a> {
    scene: &'a Scene,
    lines: Vec<PulledLine>,
    targets: &'a [Point],
    /// How far a mount gives along x, y and z (m/N).
    compliance: [f64; 3],
    /// Pull of a line inside the ply (N).
    pull: f64,
    /// Pull of a line along the border, as a multiple of it.
    border: f64,
    /// Share of the pull that is left at a gripper's place of a line over no hollow.
    kept: f64,
    /// How slack a line over a hollow is left, by the pull that would make it taut again (N).
    slack: f64,
    /// Load with which a gripper presses when it lands (N).
    press: f64,
    /// The same at its place.
    seat: f64,
    /// How far above the mold grippers stay over a hollow (m), into which their ply falls.
    fall: f64,
}

/// Pull of a line and press of a gripper (N) at which errors of the grippers make hardly a line slack and leave hardly a pad above
/// the mold. An error of two grippers changes the pull of the line between them, on two mounts in series, by k (e₁ − e₂)/2, whose
/// deviation is kσ/√2; an error of height changes the load with which a pad presses by that of one mount, kσ.
pub(super) fn against_errors(scene: &Scene) -> [f64; 2] {
    let deviation = scene.errors.map_or(0.0, |errors| errors.gripper.position.deviation());
    let pad = &scene.layup.settings.pad;
    let [lateral, axial] = [pad.lateral_stiffness, pad.axial_stiffness]
        .map(|k| TUNING.preload.deviations * deviation * k.unwrap_or(0.0));
    [lateral * FRAC_1_SQRT_2, axial]
}

/// Largest load (N) along and across the ply that a gripper may carry.
pub(super) fn loads(scene: &Scene) -> [f64; 2] {
    let most = |name| scene.limits.most(name);
    let any = most(Name::GripperLoad).min(most(Name::GripperForce));
    let slip = scene.layup.settings.pad.slip_force.unwrap_or(f64::INFINITY);
    [any.min(most(Name::GripperPull)).min(slip / scene.limits.grip_safety), any]
}

impl<'a> Preload<'a> {
    /// The preload of a strategy.
    #[must_use]
    pub fn new(scene: &'a Scene, strategy: &Strategy) -> Option<Self> {
        let target = scene.layup.target.as_ref().filter(|_| scene.layup.settings.pad.gives())?;
        let pad = &scene.layup.settings.pad;
        let gives = |stiffness: Option<f64>| stiffness.map_or(0.0, |k| 1.0 / k);
        let [lateral, axial] = [pad.lateral_stiffness, pad.axial_stiffness].map(gives);
        let [lateral_load, axial_load] = loads(scene);
        let pull = strategy.pull * TUNING.preload.pull * lateral_load;
        // a corner bears two lines of the border, and what its error adds to them
        let [needed, _] = against_errors(scene);
        let spare = TUNING.preload.corner * (lateral_load / SQRT_2 - needed);
        let border =
            if pull > 0.0 { (spare / pull).clamp(1.0, TUNING.preload.border) } else { 1.0 };
        let kept = if pull > 0.0 { (needed / pull).clamp(TUNING.preload.kept, 1.0) } else { 0.0 };
        let order = scene.layup.release.as_ref().map(|rule| rule.order);
        let falls = order == Some(ReleaseOrder::HollowsFirst);
        let sticks = !matches!(scene.layup.settings.contact.friction, Friction::Coulomb(_));
        let cell = scene.layup.ply.shorter_side();
        Some(Preload {
            scene,
            lines: pulled_lines(scene, strategy.pretension),
            targets: &target.grippers,
            compliance: [lateral, lateral, axial],
            pull,
            border,
            kept,
            slack: if falls && sticks { TUNING.preload.slack * needed } else { 0.0 },
            press: strategy.press * TUNING.preload.press * axial_load,
            seat: strategy.press.max(TUNING.preload.seat[0]) * TUNING.preload.press * axial_load,
            fall: if falls { strategy.press * TUNING.preload.fall * cell } else { 0.0 },
        })
    }

    /// Where the grippers are commanded (m) whose places are to be `places` (m) in a step; `grown` is the share of the pull that
    /// has come up since the start.
    #[must_use]
    pub fn commanded(&self, places: &[Point], grown: f64) -> Vec<Point> {
        let cell = self.scene.layup.ply.shorter_side();
        let preloaded = |(n, place): (usize, &Point)| {
            let away = distance(*place, self.targets[n]) / cell;
            let free = smooth(away / TUNING.preload.release);
            let (lines, over_hollow) = self.pull_of_lines(places, n, free);
            let pull = lines.map(|c| c * grown);
            // a pad that is pressed down early sticks before its lines have the length that a hollow needs
            let near = |reach: f64| 1.0 - smooth(away / reach);
            let [pressed, rise] = if over_hollow {
                [0.0, grown * self.fall]
            } else {
                let seated = (self.seat - self.press) * near(TUNING.preload.seat[1]);
                [self.press * near(TUNING.preload.press_reach) + seated, 0.0]
            };
            let mold = self.scene.layup.mold.as_ref();
            let normal = mold.map_or([0.0, 0.0, 1.0], |mold| mold.normal(self.targets[n]));
            let load = |c: usize| pull[c] + pressed * normal[c];
            [0, 1, 2].map(|c| place[c] - self.compliance[c] * load(c) + rise * normal[c])
        };
        places.iter().enumerate().map(preloaded).collect()
    }

    /// Whether the line between the places of two grippers on the mold bridges a hollow.
    fn is_over_hollow(&self, a: usize, b: usize) -> bool {
        let mold = self.scene.layup.mold.as_ref();
        mold.is_some_and(|mold| spans_hollow(mold, [a, b].map(|n| self.targets[n])))
    }

    /// Pull of its lines on a gripper (N), of which a share `free` is not yet given up; and whether one of them bridges a hollow.
    fn pull_of_lines(&self, places: &[Point], gripper: usize, free: f64) -> (Point, bool) {
        let (mut sum, mut over_hollow) = ([0.0; 3], false);
        let beside = self.lines.iter().filter(|line| line.pair.grippers.contains(&gripper));
        for PulledLine { pair, most } in beside {
            let other = pair.grippers[usize::from(pair.grippers[0] == gripper)];
            let way = direction(sub(places[other], places[gripper])).unwrap_or([0.0; 3]);
            let hollow = self.is_over_hollow(gripper, other);
            over_hollow |= hollow;
            let pull = if pair.border { self.border * self.pull } else { self.pull }.min(*most);
            let left = if hollow { -self.slack.min(*most) } else { pull * self.kept };
            sum = along(sum, pull * free + left * (1.0 - free), way);
        }
        (sum, over_hollow)
    }
}

/// The lines of a scene. One across the yarns shears the ply instead of pulling it taut, and is pulled no harder than stretches it by
/// `stretch`: a strip as wide as long, at an angle θ to yarns that do not stretch, bears G L ε/(sin θ cos θ)² at a strain ε.
fn pulled_lines(scene: &Scene, stretch: f64) -> Vec<PulledLine> {
    let ply = &scene.layup.ply;
    let slope = ply.material.shear_curve.as_ref().map_or(0.0, |curve| curve.force(0.0).1);
    let line = |pair: Neighbors| {
        let [a, b] = pair.grippers.map(|gripper| ply.place(gripper));
        let [du, dv] = [b[0] - a[0], b[1] - a[1]];
        let length = du.hypot(dv);
        let most = match pair.fiber {
            Some(_) => f64::INFINITY,
            None => slope * length * stretch * (length * length / (du * dv)).powi(2),
        };
        PulledLine { pair, most }
    };
    ply.neighbors().into_iter().map(line).collect()
}

/// Applies the preload to all steps (m) of a motion. The first step stays; the pretension grows in those after it.
pub fn commanded(scene: &Scene, strategy: &Strategy, steps: &mut [Vec<Point>]) {
    let Some(preload) = Preload::new(scene, strategy) else { return };
    let growing = (TUNING.preload.growing * steps.len() as f64).max(1.0);
    for (n, step) in steps.iter_mut().enumerate() {
        *step = preload.commanded(step, smooth(n as f64 / growing));
    }
}

/// Where the grippers are commanded at the end (m).
#[must_use]
pub fn ends(scene: &Scene, strategy: &Strategy) -> Vec<Point> {
    let targets =
        scene.layup.target.as_ref().map(|target| target.grippers.clone()).unwrap_or_default();
    match Preload::new(scene, strategy) {
        Some(preload) => preload.commanded(&targets, 1.0),
        None => targets,
    }
}

/// From 0 to 1 without a kink where it begins and where it ends.
fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
