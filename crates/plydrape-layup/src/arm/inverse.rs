//! The angles of the joints that bring the flange to a pose.
//!
//! What is left of a pose is a vector of twelve: how far the flange is from its place, in units of the reach, and how far each of its axes is
//! from where it should point. Its derivative is exact, and it has no zero but the pose itself, so that the method of Levenberg and
//! Marquardt, by the crate `levenberg-marquardt`, finds the angles wherever it begins near enough; where the pose is out of reach it
//! ends as near to it as the arm comes.

use super::tuning::{REACHED, SAME, STARTS};
use super::{Angles, Arm, JOINTS};
use crate::geometry::Pose;
use crate::geometry::vector::{cross, sub};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{SMatrix, SVector, U6, U12, Vector6};
use std::f64::consts::{PI, TAU};

/// Angles, and what they leave of a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    pub angles: Angles,
    /// In units of the reach.
    pub left: f64,
}

impl Found {
    pub fn reaches(&self) -> bool {
        self.left <= REACHED
    }
}

/// A pose to reach.
struct Search<'a> {
    arm: &'a Arm,
    reach: f64,
    pose: &'a Pose,
    angles: Vector6<f64>,
}

impl LeastSquaresProblem<f64, U12, U6> for Search<'_> {
    type ResidualStorage = Owned<f64, U12>;
    type JacobianStorage = Owned<f64, U12, U6>;
    type ParameterStorage = Owned<f64, U6>;

    fn set_params(&mut self, angles: &Vector6<f64>) {
        self.angles = *angles;
    }

    fn params(&self) -> Vector6<f64> {
        self.angles
    }

    fn residuals(&self) -> Option<SVector<f64, 12>> {
        let flange = self.arm.flange_at(&self.angles.into());
        let place = sub(flange.position, self.pose.position).map(|c| c / self.reach);
        let axes = [0, 1, 2].map(|n| sub(flange.axes[n], self.pose.axes[n]));
        Some(SVector::from_iterator(place.into_iter().chain(axes.into_iter().flatten())))
    }

    fn jacobian(&self) -> Option<SMatrix<f64, 12, 6>> {
        let links = self.arm.links(&self.angles.into());
        let flange = links[JOINTS].compose(&self.arm.flange);
        let mut jacobian = SMatrix::<f64, 12, 6>::zeros();
        for (n, (axis, point)) in self.arm.axes(&links).into_iter().enumerate() {
            let place = cross(axis, sub(flange.position, point)).map(|c| c / self.reach);
            let axes = flange.axes.map(|own| cross(axis, own));
            let column = place.into_iter().chain(axes.into_iter().flatten());
            jacobian.set_column(n, &SVector::<f64, 12>::from_iterator(column));
        }
        Some(jacobian)
    }
}

impl Arm {
    /// The angles near `from` that bring the flange to a pose in the frame of the foot, or as near to it as the arm comes.
    pub(super) fn nearest(&self, pose: &Pose, from: &Angles) -> Found {
        let search = Search { arm: self, reach: self.reach(), pose, angles: Vector6::from(*from) };
        let (search, report) = LevenbergMarquardt::new().minimize(search);
        Found { angles: search.angles.into(), left: (2.0 * report.objective_function).sqrt() }
    }

    /// Every configuration that the search finds for a pose in the frame of the foot, with angles from −π to π; or the angles that come
    /// nearest to it, where none reaches it.
    pub(super) fn configurations(&self, pose: &Pose) -> Vec<Found> {
        let mut found: Vec<Found> = Vec::new();
        let mut nearest: Option<Found> = None;
        for start in self.starts(pose) {
            let mut trial = self.nearest(pose, &start);
            trial.angles = trial.angles.map(|angle| angle - TAU * (angle / TAU).round());
            if nearest.is_none_or(|nearest| trial.left < nearest.left) {
                nearest = Some(trial);
            }
            let is_new = found.iter().all(|other| {
                let apart = other.angles.iter().zip(trial.angles).map(|(a, b)| {
                    let between = (a - b).abs();
                    between.min(TAU - between)
                });
                apart.fold(0.0, f64::max) > SAME
            });
            if trial.reaches() && is_new {
                found.push(trial);
            }
        }
        if found.is_empty() { nearest.into_iter().collect() } else { found }
    }

    /// Angles from which the search for configurations begins: the foot turned to the place and away from it, and the other joints by a grid.
    fn starts(&self, pose: &Pose) -> Vec<Angles> {
        let (sense, zero) = self.first_joint();
        // the foot's own zero need not look along x
        let toward = pose.position[1].atan2(pose.position[0]) - zero;
        let mut starts: Vec<Vec<f64>> =
            [0.0, PI].iter().map(|half| vec![sense * (toward + half)]).collect();
        for grid in STARTS {
            starts = starts
                .iter()
                .flat_map(|start| grid.iter().map(|share| [&start[..], &[share * TAU]].concat()))
                .collect();
        }
        starts.iter().filter_map(|start| <Angles>::try_from(&start[..]).ok()).collect()
    }

    /// Which way the first joint turns about the upright (1 or −1), and where the arm looks at its zero (rad).
    fn first_joint(&self) -> (f64, f64) {
        let up = self.joints[0].pose.turn(self.joints[0].axis)[2];
        let flange = self.flange_at(&[0.0; JOINTS]).position;
        (if up < 0.0 { -1.0 } else { 1.0 }, flange[1].atan2(flange[0]))
    }
}
