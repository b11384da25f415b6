//! What a measure sees: the ply of one step, the layup, and what has been before.

use super::{Limits, Most, TUNING};
use crate::clearance::Poses;
use crate::geometry::Point;
use crate::layup::Layup;
use crate::state::{GripperState, LineState, PlyState, Site};
use std::collections::VecDeque;

/// The ply of one step as a measure sees it.
#[derive(Debug, Clone, Copy)]
pub struct Observation<'a> {
    /// What is draped.
    pub layup: &'a Layup,
    /// The limits of the scene; some measures count from one.
    pub limits: &'a Limits,
    /// The ply of the step.
    pub state: &'a PlyState,
    /// The steps before it; `None` in the first step.
    pub past: Option<&'a Past>,
}

/// The steps before one, as far as rates and ways ask for them.
#[derive(Debug, Clone, PartialEq)]
pub struct Past {
    /// Time of the step before (s).
    pub time: f64,
    /// Gripper positions of the step before (m).
    pub positions: Vec<Point>,
    /// Where the robot held the grippers in the step before (m).
    pub commanded: Vec<Point>,
    /// Orientations of the grippers in the step before (x, y, z, w).
    pub quaternions: Vec<[f64; 4]>,
    /// Times (s) and orientations of earlier steps, back to a window before the last one and to the step before that.
    earlier: VecDeque<(f64, Vec<[f64; 4]>)>,
}

impl Past {
    /// The past of the step that follows a state, which itself followed `before`. `duration` (s) is that of the whole motion.
    #[must_use]
    pub fn after(state: &PlyState, before: Option<Past>, duration: f64) -> Past {
        let points = |place: fn(&GripperState) -> Point| state.grippers.iter().map(place).collect();
        let mut earlier = VecDeque::new();
        if let Some(before) = before {
            earlier = before.earlier;
            earlier.push_back((before.time, before.quaternions));
        }
        // one step from before the window is enough
        while earlier.len() > 1 && state.time - earlier[1].0 >= rate_window(duration) {
            earlier.pop_front();
        }
        Past {
            time: state.time,
            positions: points(|gripper| gripper.position),
            commanded: points(|gripper| gripper.commanded),
            quaternions: state.grippers.iter().map(|gripper| gripper.quaternion).collect(),
            earlier,
        }
    }

    /// Where everything was that bodies are mounted on.
    #[must_use]
    pub fn poses(&self, layup: &Layup) -> Poses {
        Poses::new(layup, &self.positions, &self.quaternions, &self.commanded)
    }

    /// Times (s) and orientations (x, y, z, w) of the steps before, the last one at the end.
    pub(super) fn turned(&self) -> impl DoubleEndedIterator<Item = (f64, &[[f64; 4]])> + Clone {
        let earlier = self.earlier.iter().map(|(time, turned)| (*time, turned.as_slice()));
        earlier.chain([(self.time, self.quaternions.as_slice())])
    }
}

impl Observation<'_> {
    /// Where everything is that bodies are mounted on.
    #[must_use]
    pub fn poses(&self) -> Poses {
        let grippers = &self.state.grippers;
        let positions: Vec<Point> = grippers.iter().map(|gripper| gripper.position).collect();
        let turned: Vec<[f64; 4]> = grippers.iter().map(|gripper| gripper.quaternion).collect();
        Poses::new(self.layup, &positions, &turned, &self.commanded())
    }

    /// Where the robot holds the grippers (m).
    #[must_use]
    pub fn commanded(&self) -> Vec<Point> {
        self.state.grippers.iter().map(|gripper| gripper.commanded).collect()
    }

    /// The lines that are catenaries or segments of them, each with the index of its catenary.
    pub(super) fn catenaries(&self) -> impl Iterator<Item = (usize, &LineState)> {
        self.state.lines.iter().filter_map(|line| Some((line.catenary?, line)))
    }

    /// The catenaries along fibers, or segments of them, each with the index of its catenary.
    pub(super) fn edges(&self) -> impl Iterator<Item = (usize, &LineState)> {
        self.catenaries().filter(|(_, line)| line.is_fiber)
    }

    /// The largest value of a segment of an edge.
    pub(super) fn most_of_edges(&self, value: impl Fn(&LineState) -> f64) -> Most {
        let mut most = Most::default();
        for (_, line) in self.edges() {
            most.meet(value(line), line.site, line.place);
        }
        most
    }

    /// The largest value of a gripper that holds the ply.
    pub(super) fn most_of_grippers(&self, value: impl Fn(&GripperState) -> f64) -> Most {
        let mut most = Most::default();
        for (n, gripper) in self.state.grippers.iter().enumerate() {
            if gripper.holds {
                most.meet(value(gripper), Site::Gripper(n), gripper.position);
            }
        }
        most
    }

    /// The largest height of the ply over the mold (m); zero of what lies on it or in it.
    pub(super) fn highest(&self) -> Most {
        let mut most = Most::default();
        for point in &self.state.points {
            if let Some(height) = point.height {
                // a height that is no number stays it
                let height = if height <= 0.0 { 0.0 } else { height };
                most.meet(height, point.site, point.place);
            }
        }
        most
    }

    /// Duration of the whole motion (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.layup.motion.times.last().copied().unwrap_or(0.0)
    }
}

/// Time (s) over which a rate is taken at least: a share of the duration of the motion (s).
#[must_use]
pub(super) fn rate_window(duration: f64) -> f64 {
    TUNING.rate_window * duration
}
