//! What is wrong with a drape, how much and where: slack, overstretch, bridging, shear, tilt, force,
//! landing errors.

use super::Snapshot;
use super::attitude::Attitude;
use super::landing::Landing;
use super::reach::{self, closest, outside};
use super::record::{CatenaryDirection, CatenaryKind, Measures, Worst};
use super::spans::{FreeSpan, Point};
use crate::mold::{Mold, Strand, distance};
use crate::ply::{Kind, Laid};
use crate::scene::Scene;

/// Fit of one free or lying rest between what holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Fabric length (m).
    pub length: f64,
    /// Path between its ends, straight or along the mold (m).
    pub path: f64,
    /// Middle of its ends (m).
    pub place: Point,
}

impl Fit {
    /// Fabric beyond the path (m), not negative.
    #[must_use]
    pub fn slack(&self) -> f64 {
        // what rounding leaves of a taut line is none
        let slack = self.length - self.path;
        if slack > 1e-12 * self.length { slack } else { 0.0 }
    }

    /// Slack as a share of the fabric length.
    #[must_use]
    pub fn slack_ratio(&self) -> f64 {
        if self.length > 0.0 { self.slack() / self.length } else { 0.0 }
    }

    /// Amplitude of the wrinkle that the slack makes (m): (2/π)√(path·slack), a shallow sine.
    #[must_use]
    pub fn wrinkle(&self) -> f64 {
        std::f64::consts::FRAC_2_PI * (self.path * self.slack()).sqrt()
    }

    /// Path beyond the fabric (m), not negative.
    #[must_use]
    pub fn overstretch(&self) -> f64 {
        let excess = self.path - self.length;
        if excess > 1e-12 * self.path { excess } else { 0.0 }
    }
}

fn middle(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|n| 0.5 * (a[n] + b[n]))
}

/// How a free span fits between its ends.
pub fn fit(span: &FreeSpan) -> Fit {
    let [a, b] = span.ends;
    Fit { length: span.length, path: span.chord(), place: middle(a, b) }
}

/// A rest of a catenary that does not hang: one that lies, or one of no length whose gripper has moved on.
pub struct LyingRest {
    /// 0 before the contact segment, 1 after it; none for a catenary that lies whole.
    pub which: Option<usize>,
    /// How its fabric fits.
    pub fit: Fit,
    /// The taut line between its ends, from first to last.
    pub line: Strand,
}

/// The rests of a catenary that do not hang.
///
/// A gripper within `tolerance` (m) of the mold counts as standing on it; one that has lifted off pulls
/// straight.
pub fn lying_rests(
    laid: &Laid,
    grippers: [Point; 2],
    mold: &Mold,
    tolerance: f64,
) -> Vec<LyingRest> {
    let straight = |a, b| Strand { points: vec![a, b], arc: vec![0.0, distance(a, b)] };
    let feet = grippers.map(|gripper| {
        let foot = mold.foot(gripper);
        (foot.distance <= tolerance).then_some(foot.point)
    });
    let rest = |which, length, line: Strand| {
        let place = middle(line.points[0], line.end());
        LyingRest { which, fit: Fit { length, path: line.length(), place }, line }
    };
    if laid.is_whole() {
        let line = match feet {
            [Some(a), Some(b)] => mold.path(a, b).unwrap_or_else(|| straight(a, b)),
            _ => straight(grippers[0], grippers[1]),
        };
        return vec![rest(None, laid.length, line)];
    }
    (0..2)
        .filter(|&which| !laid.hangs(which))
        .map(|which| {
            let end = laid.point()[which];
            let along = |a, b| mold.path(a, b).unwrap_or_else(|| straight(a, b));
            let line = match (feet[which], which) {
                (Some(foot), 0) => along(foot, end),
                (Some(foot), _) => along(end, foot),
                (None, 0) => straight(grippers[0], end),
                (None, _) => straight(end, grippers[1]),
            };
            rest(Some(which), laid.rest(which), line)
        })
        .collect()
}

/// Fabric length of a catenary that lies on the mold (m).
pub fn lying_length(laid: &Laid) -> f64 {
    let rests: f64 = (0..2).filter(|&r| laid.lying[r]).map(|r| laid.rest(r)).sum();
    laid.line.length() + rests
}

/// A catenary in words.
pub fn name(scene: &Scene, catenary: usize) -> String {
    let c = scene.ply.grid.catenary(catenary);
    let kind = if c.kind.is_edge() { "edge" } else { "diagonal" };
    format!("{kind} [{},{}]–[{},{}]", c.from[0], c.from[1], c.to[0], c.to[1])
}

/// Collects the worst of a measure; words are made only for what is worst.
struct Most<K> {
    value: f64,
    key: Option<(K, Point)>,
}

impl<K> Default for Most<K> {
    fn default() -> Self {
        Most { value: 0.0, key: None }
    }
}

impl<K> Most<K> {
    fn meet(&mut self, value: f64, key: K, place: Point) {
        if self.key.is_none() || value > self.value {
            self.value = value;
            self.key = Some((key, place));
        }
    }

    fn worst(self, unit: f64, words: impl Fn(K) -> String) -> Option<Worst> {
        let Most { value, key } = self;
        key.map(|(key, place)| Worst { value: value / unit, at: words(key), place })
    }
}

/// What landed where it should not.
#[derive(Clone, Copy)]
enum Landed {
    Catenary(usize),
    Gripper(usize),
}

/// The measures of one step. `points` are the stations of each free span (m), `landings` how each
/// catenary has landed.
pub fn measures(
    scene: &Scene,
    snapshot: &Snapshot,
    attitudes: &[Attitude],
    points: &[Vec<Point>],
    landings: &[Option<Landing>],
) -> Measures {
    const MM: f64 = 1e-3;
    let grid = scene.ply.grid;
    let (mut slack, mut ratio, mut wrinkle) = (Most::default(), Most::default(), Most::default());
    let (mut stretch, mut stretch_share) = (Most::default(), Most::default());
    // slack of a catenary is that of all its rests; its place that of the largest
    let mut loose = vec![(0.0, 0.0, [0.0; 3]); grid.catenaries()];
    let mut judge = |catenary: usize, whole: f64, fit: &Fit| {
        slack.meet(fit.slack(), catenary, fit.place);
        wrinkle.meet(fit.wrinkle(), catenary, fit.place);
        let (sum, largest, place) = &mut loose[catenary];
        *sum += fit.slack() / whole;
        if fit.slack() >= *largest {
            (*largest, *place) = (fit.slack(), fit.place);
        }
        if catenary < grid.edges() {
            stretch.meet(fit.overstretch(), catenary, fit.place);
            stretch_share.meet(fit.overstretch() / whole, catenary, fit.place);
        }
    };
    for span in &snapshot.shape.spans {
        let whole = snapshot.laid[span.catenary].as_ref().map_or(span.length, |laid| laid.length);
        judge(span.catenary, whole, &fit(span));
    }
    let (mut lying, mut total) = (0.0, 0.0);
    let (mut landing, mut fibre) = (Most::default(), Most::default());
    let mut bridging = Most::default();
    for (catenary, laid) in snapshot.laid.iter().enumerate() {
        let edge = catenary < grid.edges();
        let c = grid.catenary(catenary);
        if edge {
            total += scene.ply.flat_length(c.kind);
        }
        if let Some(bridge) = &snapshot.bridges[catenary] {
            bridging.meet(bridge.gap, catenary, bridge.place);
        }
        let (Some(laid), Some(mold)) = (laid, &scene.mold) else {
            continue;
        };
        let grippers = [c.from, c.to].map(|g| snapshot.positions[grid.index(g)]);
        for rest in lying_rests(laid, grippers, mold, scene.settings.contact.tolerance) {
            judge(catenary, laid.length, &rest.fit);
        }
        if edge {
            lying += lying_length(laid);
        }
        if let Some(found) = &landings[catenary] {
            if let Some((error, place)) = found.worst(&laid.line) {
                landing.meet(error, Landed::Catenary(catenary), place);
            }
            if let Some((angle, place)) = found.fibre_angle {
                fibre.meet(angle.to_degrees(), catenary, place);
            }
        }
    }

    for (catenary, (sum, _, place)) in loose.into_iter().enumerate() {
        ratio.meet(sum, catenary, place);
    }

    let (mut tilt, mut force, mut gap) = (Most::default(), Most::default(), Most::default());
    for (gripper, attitude) in attitudes.iter().enumerate() {
        let place = snapshot.positions[gripper];
        tilt.meet(attitude.tilt.to_degrees(), gripper, place);
        let landed = scene
            .mold
            .as_ref()
            .is_some_and(|mold| mold.signed_distance(place) <= scene.settings.contact.tolerance);
        if let (true, Some(target)) = (landed, &scene.target) {
            let error = distance(place, target.grippers[gripper]);
            landing.meet(error, Landed::Gripper(gripper), place);
        }
    }
    for (span, points) in snapshot.shape.spans.iter().zip(points) {
        if let Some(value) = span.force {
            force.meet(value.abs(), span.catenary, points[points.len() / 2]);
        }
        if let Some(mold) = &scene.mold {
            for point in points {
                gap.meet(mold.signed_distance(*point).max(0.0), span.catenary, *point);
            }
        }
    }
    let shear = shear(scene, snapshot);

    let catenary = |n: usize| name(scene, n);
    let gripper = |n: usize| format!("gripper {}", reach::id(grid, n));
    let has_mold = scene.mold.is_some();
    let nothing = |at: &str| Worst { value: 0.0, at: at.into(), place: [0.0; 3] };
    Measures {
        slack_mm: slack.worst(MM, catenary),
        slack_ratio: ratio.worst(1.0, catenary),
        wrinkle_mm: wrinkle.worst(MM, catenary),
        overstretch: stretch_share.worst(1.0, catenary),
        overstretch_mm: stretch.worst(MM, catenary),
        bridging_mm: bridging.worst(MM, catenary).or(has_mold.then(|| nothing("nowhere"))),
        shear_deg: shear
            .worst(1.0, |n: usize| format!("cell [{},{}]", n % (grid.nu - 1), n / (grid.nu - 1))),
        tilt_deg: tilt.worst(1.0, gripper),
        force_n: force.worst(1.0, catenary),
        landing_error_mm: landing.worst(MM, |landed| match landed {
            Landed::Catenary(n) => catenary(n),
            Landed::Gripper(n) => gripper(n),
        }),
        fibre_angle_deg: fibre.worst(1.0, catenary),
        gap_mm: gap.worst(MM, catenary).or(has_mold.then(|| nothing("nowhere"))),
        gripper_distance_mm: closest(grid, &snapshot.positions),
        workspace_mm: (scene.limits.workspace)
            .and_then(|workspace| outside(grid, &snapshot.positions, workspace)),
        contact_share: has_mold.then_some(lying / total),
    }
}

fn shear(scene: &Scene, snapshot: &Snapshot) -> Most<usize> {
    let grid = scene.ply.grid;
    let mut most = Most { value: 0.0, key: None };
    for (cell, angle) in snapshot.shear.iter().enumerate() {
        let [i, j] = [cell % (grid.nu - 1), cell / (grid.nu - 1)];
        let corner = |di: usize, dj: usize| snapshot.positions[grid.index([i + di, j + dj])];
        let place = middle(corner(0, 0), corner(1, 1));
        most.meet(angle.map_or(0.0, |shear| shear.angle.to_degrees()), cell, place);
    }
    most
}

/// The kind of a catenary as the record says it.
pub fn described(kind: Kind) -> (CatenaryKind, CatenaryDirection) {
    match kind {
        Kind::EdgeU => (CatenaryKind::Edge, CatenaryDirection::U),
        Kind::EdgeV => (CatenaryKind::Edge, CatenaryDirection::V),
        Kind::Rising => (CatenaryKind::Diagonal, CatenaryDirection::Rising),
        Kind::Falling => (CatenaryKind::Diagonal, CatenaryDirection::Falling),
    }
}
