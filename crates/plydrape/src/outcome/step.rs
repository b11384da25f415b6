//! The record of one step: the grippers and the measures, and what the catenaries add where they drape.

use crate::LayupError;
use crate::draping::record::CatenaryStep;
use crate::geometry::distance;
use crate::geometry::rotation::normal;
use crate::layup::Layup;
use crate::measure::Measures;
use crate::motion::Attitudes;
use crate::ply::GripperId;
use crate::state::PlyState;

/// The ply in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// Counts from 1, the start.
    pub step: usize,
    /// Time (s).
    pub time: f64,
    /// Grippers, i running fastest.
    pub grippers: Vec<Gripper>,
    /// Worst values of this step, each with its place.
    pub measures: Measures,
    /// The catenaries; `None` where the sheet drapes.
    pub catenaries: Option<CatenaryStep>,
}

/// A gripper in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// Grid indices.
    pub id: GripperId,
    /// Where it holds the fabric (m).
    pub position: [f64; 3],
    /// Where the robot holds it (m): its position if its mount is rigid.
    pub commanded: [f64; 3],
    /// Orientation (x, y, z, w): z axis along the ply's normal, x axis along u.
    pub quaternion: [f64; 4],
    /// Angle between the ply's normal and the stem of the gripper, which is upright unless a tool turns it (°); 0 of a pad without a
    /// joint.
    pub tilt_deg: f64,
    /// Force of the ply on it (N).
    pub force: [f64; 3],
    /// How far the fabric has slid under the pad since the start (mm).
    pub slide_mm: f64,
    /// Whether the pad holds the ply; it does until it is released.
    pub holds: bool,
    /// Distance from where the ideal drape puts it (mm); `None` if that is not known.
    pub target_distance_mm: Option<f64>,
}

impl Gripper {
    /// Unit normal of the ply at the gripper: the z axis of the orientation.
    #[must_use]
    pub fn normal(&self) -> [f64; 3] {
        normal(self.quaternion)
    }

    /// What it holds against gravity (N); negative where the ply pushes it up.
    #[must_use]
    pub fn load(&self) -> f64 {
        -self.force[2]
    }

    /// Horizontal force of the ply on it (N).
    #[must_use]
    pub fn pull(&self) -> f64 {
        self.force[0].hypot(self.force[1])
    }
}

impl Step {
    /// The record of a state of the ply in a layup, with what was measured of it.
    #[must_use]
    pub fn new(
        layup: &Layup,
        state: &PlyState,
        measures: Measures,
        catenaries: Option<CatenaryStep>,
    ) -> Self {
        let tilts = layup.tilts();
        let target = layup.target.as_ref();
        let grippers = state.grippers.iter().enumerate().map(|(n, gripper)| Gripper {
            id: layup.ply.id(n),
            position: gripper.position,
            commanded: gripper.commanded,
            quaternion: gripper.quaternion,
            tilt_deg: if tilts { gripper.tilt.to_degrees() } else { 0.0 },
            force: gripper.force,
            slide_mm: gripper.slide * 1e3,
            holds: gripper.holds,
            target_distance_mm: target
                .and_then(|target| target.grippers.get(n))
                .map(|target| distance(gripper.position, *target) * 1e3),
        });
        let grippers = grippers.collect();
        Step { step: state.step, time: state.time, grippers, measures, catenaries }
    }

    /// Whether its equilibrium and contact were found; the sheet ends where a step is not solved.
    #[must_use]
    pub fn is_solved(&self) -> bool {
        self.catenaries.as_ref().is_none_or(|catenaries| catenaries.solver.found())
    }
}

/// Orientations of the grippers between the steps of a drape.
///
/// # Errors
/// The errors of [`Attitudes::new`] if there are no steps.
pub fn attitudes(steps: &[Step]) -> Result<Attitudes, LayupError> {
    let times: Vec<f64> = steps.iter().map(|step| step.time).collect();
    let quaternions: Vec<Vec<[f64; 4]>> = steps
        .iter()
        .map(|step| step.grippers.iter().map(|gripper| gripper.quaternion).collect())
        .collect();
    Attitudes::new(&times, &quaternions)
}
