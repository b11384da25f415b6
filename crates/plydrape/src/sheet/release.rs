//! When pads let go: the rule of the layup, applied to its motion.
//!
//! With [`ReleaseOrder::HollowsFirst`] a pad over a hollow of the mold lets go when its gripper has come to its last place and
//! stood there for the dwell, while others still move. After the motion all pads that still hold press for the dwell and let go
//! together. So the times follow from the motion alone: no sensor looks at the ply, and a cell with errors lets go when its
//! program says.

use super::event::{Event, EventKind};
use super::model::Sheet;
use super::model::pitch;
use crate::geometry::vector::{between, distance};
use crate::layup::{Layup, Release, ReleaseOrder};
use crate::mold::Mold;
use crate::ply::Ply;
use std::sync::Arc;

/// How near a gripper is to its last place when it has come to it, as a share of the shortest distance of neighbors in the fabric: the pull
/// of its lines turns a little while their other grippers move.
const PLACED: f64 = 5e-3;

/// Height over the mold of the middle of a line between two places on it, as a share of its length, above which it spans a hollow.
const HOLLOW: f64 = 1e-3;

/// What pads have done so far, and what they do next.
#[derive(Debug)]
pub struct Releases<'a> {
    ply: &'a Ply,
    /// How long a pad presses before it lets go (s).
    dwell: f64,
    /// The end of the motion (s).
    end: f64,
    /// When each pad lets go (s).
    times: Arc<[f64]>,
    /// Whether each pad holds.
    holds: Vec<bool>,
    events: Vec<Event>,
}

impl<'a> Releases<'a> {
    /// By the rule of a layup, for the pads of its sheet, which grip the ply as the motion begins; `None` if they hold it to the end.
    pub fn new(layup: &'a Layup, sheet: &Sheet) -> Option<Self> {
        let Release { dwell, times: program, .. } = layup.release.as_ref()?;
        let motion = &layup.motion.times;
        let (grippers, end) = (sheet.grippers.len(), motion[motion.len() - 1]);
        let times = program.clone().or_else(|| times(layup))?;
        let mut releases = Releases {
            ply: &layup.ply,
            dwell: *dwell,
            end,
            times,
            holds: vec![true; grippers],
            events: Vec::new(),
        };
        releases.note(motion[0], EventKind::Grip, (0..grippers).collect());
        Some(releases)
    }

    /// When pads let go (s) that still hold and do so on the way.
    fn coming(&self) -> impl Iterator<Item = (usize, f64)> {
        let times = self.times.iter().copied().enumerate();
        times.filter(|(n, time)| self.holds[*n] && *time < self.end)
    }

    /// The earliest time (s) at which a pad lets go on the way.
    pub fn due(&self) -> Option<f64> {
        self.coming().map(|(_, due)| due).min_by(f64::total_cmp)
    }

    /// Comes to a time (s) of the motion; returns the grippers that let go now. What is due within `rounding` (s) is due.
    pub fn come_to(&mut self, time: f64, rounding: f64) -> Vec<usize> {
        let due: Vec<(usize, f64)> =
            self.coming().filter(|(_, due)| *due <= time + rounding).collect();
        for (n, due) in &due {
            self.let_go(vec![*n], due - self.dwell);
        }
        due.into_iter().map(|(n, _)| n).collect()
    }

    /// Ends the motion: all that still hold press and let go. Returns them, and when they do (s).
    pub fn end(&mut self) -> (Vec<usize>, f64) {
        let all: Vec<usize> = (0..self.holds.len()).filter(|n| self.holds[*n]).collect();
        self.let_go(all.clone(), self.end);
        (all, self.end + self.dwell)
    }

    /// Everything so far, in the order of time.
    pub fn events(mut self) -> Vec<Event> {
        self.events.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.kind.cmp(&b.kind)));
        // what happens to several pads at once is one event
        self.events.dedup_by(|next, event| {
            let same = next.time == event.time && next.kind == event.kind;
            if same {
                event.grippers.append(&mut next.grippers);
            }
            same
        });
        self.events
    }

    /// Pads that press from a time (s) on let go after the dwell.
    fn let_go(&mut self, grippers: Vec<usize>, from: f64) {
        for n in &grippers {
            self.holds[*n] = false;
        }
        if self.dwell > 0.0 {
            self.note(from, EventKind::Press, grippers.clone());
        }
        self.note(from + self.dwell, EventKind::Release, grippers);
    }

    fn note(&mut self, time: f64, kind: EventKind, grippers: Vec<usize>) {
        if !grippers.is_empty() {
            let grippers = grippers.into_iter().map(|n| self.ply.id(n)).collect();
            self.events.push(Event { time, kind, grippers });
        }
    }
}

/// When the pad of each gripper of a layup lets go (s), whose motion is that of the grippers; `None` if they hold to the end.
pub fn times(layup: &Layup) -> Option<Arc<[f64]>> {
    let Release { order, dwell, .. } = layup.release.as_ref()?;
    let (times, steps) = (&layup.motion.times, &layup.motion.positions);
    let (end, last) = (*times.last()?, steps.last()?);
    let over_hollow = match (order, &layup.mold) {
        (ReleaseOrder::HollowsFirst, Some(mold)) => over_hollow(&layup.ply, mold, last),
        _ => vec![false; last.len()],
    };
    let near = PLACED * pitch(&layup.ply);
    let time = |n: usize| {
        let placed = placed(steps, n, near).filter(|_| over_hollow[n]);
        let time = placed.map(|step| times[step] + dwell).filter(|time| *time < end);
        time.unwrap_or(end + dwell)
    };
    Some((0..last.len()).map(time).collect())
}

/// Whether a line of ply from each gripper to a neighbor spans a hollow of the mold, where the grippers are at `places` (m).
fn over_hollow(ply: &Ply, mold: &Mold, places: &[[f64; 3]]) -> Vec<bool> {
    let on: Vec<[f64; 3]> = places.iter().map(|p| mold.closest_point(*p).point).collect();
    let mut over = vec![false; places.len()];
    for pair in ply.neighbors() {
        if spans_hollow(mold, pair.grippers.map(|n| on[n])) {
            pair.grippers.iter().for_each(|n| over[*n] = true);
        }
    }
    over
}

/// Whether the line between two places on a mold (m) spans a hollow.
pub fn spans_hollow(mold: &Mold, [a, b]: [[f64; 3]; 2]) -> bool {
    mold.signed_distance(between(a, b, 0.5)) > HOLLOW * distance(a, b)
}

/// The step in which a gripper has come to within a distance (m) of its last place for good; `None` if it stands there from the
/// first one on, and so has not come.
fn placed(steps: &[Vec<[f64; 3]>], gripper: usize, near: f64) -> Option<usize> {
    let last = steps.last()?[gripper];
    steps.iter().rposition(|step| distance(step[gripper], last) > near).map(|away| away + 1)
}
