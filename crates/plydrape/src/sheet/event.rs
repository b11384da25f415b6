//! What the vacuum of the pads does along a motion.

use crate::ply::GripperId;

/// What happens to the hold of some pads, all at one time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Event {
    /// When it happens, in the time of the motion (s); the release after its end comes later than its last step.
    pub time: f64,
    /// What happens.
    pub kind: EventKind,
    /// The grippers whose pads they are, in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<GripperId>,
}

/// What happens to the hold of a pad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum EventKind {
    /// The vacuum is on, at the pick-up.
    Grip,
    /// The pad begins to press the ply before it lets go; there is none where it does not dwell.
    Press,
    /// The vacuum is off: the pad is gone.
    Release,
}

/// When the last pads let go (s); `None` if they hold to the end.
#[must_use]
pub fn last_release(events: &[Event]) -> Option<f64> {
    events.iter().rfind(|event| event.kind == EventKind::Release).map(|event| event.time)
}

/// Whether a gripper's pad holds the ply at a time (s): from its grip on, and until it lets go.
#[must_use]
pub fn holds(events: &[Event], gripper: GripperId, time: f64) -> bool {
    let gone = |event: &Event| {
        let is_off = match event.kind {
            EventKind::Grip => time < event.time,
            EventKind::Press => false,
            EventKind::Release => event.time <= time,
        };
        is_off && event.grippers.contains(&gripper)
    };
    !events.iter().any(gone)
}
