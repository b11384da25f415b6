//! When pads let go: the rule of the layup, applied to the ply as it comes to lie.
//!
//! A pad's *surroundings* are the nodes of ply no farther from its middle, in the fabric, than neighboring grippers stand
//! apart, those that it holds among them. They lie when the height of each over the mold is one that the layup accepts at
//! the end; ply that hangs beyond the mold never does. With [`ReleaseOrder::Landed`] a pad whose surroundings have lain
//! for the dwell, in the time of the motion, lets go. After the motion all pads that still hold press for the dwell, lying
//! or not, and let go together. Where the layup says when pads let go, as in drapes of cells with errors, they do so then.

use super::cloth::Cloth;
use super::event::{Event, EventKind};
use super::model::Sheet;
use crate::layup::{Layup, Release, ReleaseOrder};
use crate::mold::Mold;
use crate::ply::Ply;

/// What pads have done so far, and what they do next.
#[derive(Debug)]
pub struct Releases<'a> {
    rule: &'a Release,
    /// The end of the motion (s).
    end: f64,
    ply: &'a Ply,
    mold: Option<&'a Mold>,
    /// Height (m) up to which a node lies.
    low: f64,
    /// The nodes around each gripper, the farthest first, because they come to lie last.
    surroundings: Vec<Vec<usize>>,
    /// Since when they lie (s).
    lying_since: Vec<Option<f64>>,
    /// Whether each pad holds.
    holds: Vec<bool>,
    events: Vec<Event>,
}

impl<'a> Releases<'a> {
    /// By the rule of a layup, for the pads of its sheet, which grip the ply as the motion begins; `None` if they hold it to the end.
    /// Nodes up to `low` (m) over the mold lie.
    pub fn new(layup: &'a Layup, sheet: &'a Sheet, low: f64) -> Option<Self> {
        let (rule, ply) = (layup.release.as_ref()?, &layup.ply);
        let times = &layup.motion.times;
        let grippers = sheet.grippers.len();
        let mut releases = Releases {
            rule,
            end: times[times.len() - 1],
            ply,
            mold: sheet.mold.as_ref(),
            low: low.max(layup.settings.contact.tolerance),
            surroundings: (0..grippers).map(|n| surroundings(sheet, n)).collect(),
            lying_since: vec![None; grippers],
            holds: vec![true; grippers],
            events: Vec::new(),
        };
        releases.note(times[0], EventKind::Grip, (0..grippers).collect());
        Some(releases)
    }

    /// The earliest time (s) at which a pad lets go on the way if what lies goes on lying.
    pub fn due(&self) -> Option<f64> {
        let pressing = (0..self.holds.len()).filter_map(|n| self.presses_since(n));
        pressing.map(|since| since + self.rule.dwell).min_by(f64::total_cmp)
    }

    /// Since when the pad of a gripper presses that lets go on the way (s); `None` if it holds on, or has let go.
    fn presses_since(&self, gripper: usize) -> Option<f64> {
        let since = match &self.rule.times {
            Some(times) => {
                Some(times[gripper]).filter(|t| *t < self.end).map(|t| t - self.rule.dwell)
            }
            None => self.lying_since[gripper],
        };
        since.filter(|_| self.holds[gripper] && self.rule.order == ReleaseOrder::Landed)
    }

    /// Looks at the ply at a time (s) of the motion; returns the grippers that let go now. What is due within `rounding` (s)
    /// is due.
    pub fn see(&mut self, time: f64, rounding: f64, cloth: &Cloth) -> Vec<usize> {
        let (ReleaseOrder::Landed, Some(mold)) = (self.rule.order, self.mold) else {
            return Vec::new();
        };
        let lies = |node: usize| {
            let closest = mold.closest_point(cloth.now.x[node]);
            !closest.beyond && closest.distance <= self.low
        };
        for (n, since) in self.lying_since.iter_mut().enumerate() {
            if self.holds[n] && self.rule.times.is_none() {
                let lying = self.surroundings[n].iter().all(|node| lies(*node));
                *since = lying.then(|| since.unwrap_or(time));
            }
        }
        let is_due = |since: f64| since + self.rule.dwell <= time + rounding;
        let pressing = (0..self.holds.len()).map(|n| (n, self.presses_since(n)));
        let due = pressing.filter_map(|(n, since)| Some((n, since.filter(|t| is_due(*t))?)));
        let due: Vec<(usize, f64)> = due.collect();
        for (n, since) in &due {
            self.let_go(vec![*n], *since);
        }
        due.into_iter().map(|(n, _)| n).collect()
    }

    /// Ends the motion: all that still hold press and let go. Returns them, and when they do (s).
    pub fn end(&mut self) -> (Vec<usize>, f64) {
        let all: Vec<usize> = (0..self.holds.len()).filter(|n| self.holds[*n]).collect();
        self.let_go(all.clone(), self.end);
        (all, self.end + self.rule.dwell)
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
        if self.rule.dwell > 0.0 {
            self.note(from, EventKind::Press, grippers.clone());
        }
        self.note(from + self.rule.dwell, EventKind::Release, grippers);
    }

    fn note(&mut self, time: f64, kind: EventKind, grippers: Vec<usize>) {
        if !grippers.is_empty() {
            let grippers = grippers.into_iter().map(|n| self.ply.id(n)).collect();
            self.events.push(Event { time, kind, grippers });
        }
    }
}

/// The nodes of ply around a gripper, as far as its nearest neighbor may stand, and those that it holds; the farthest first.
fn surroundings(sheet: &Sheet, gripper: usize) -> Vec<usize> {
    let [u, v] = sheet.grippers[gripper].place;
    let reach = sheet.pitch * (1.0 + 1e-9);
    let away = |node: usize| {
        let [p, q] = sheet.fabric.places[node];
        (p - u).hypot(q - v)
    };
    let within = |node: &usize| sheet.fabric.inside[*node] && away(*node) <= reach;
    let mut nodes: Vec<usize> = (0..sheet.fabric.places.len()).filter(within).collect();
    nodes.sort_by(|a, b| away(*b).total_cmp(&away(*a)));
    nodes
}
