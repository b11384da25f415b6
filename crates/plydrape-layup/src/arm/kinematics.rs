//! Where links and flange are by the angles of the joints, and how the flange moves with them.

use super::{Angles, Arm, JOINTS, Joint};
use crate::geometry::Pose;
use crate::geometry::vector::{along, cross, dot, norm, sub, turned};
use nalgebra::{SMatrix, Vector6};

impl Joint {
    /// Where what it carries is in the frame of the joint before, at an angle (rad).
    fn pose_at(&self, angle: f64) -> Pose {
        let turn = self.axis.map(|c| angle * c);
        self.pose
            .compose(&Pose { position: [0.0; 3], axes: Pose::ORIGIN.axes.map(|a| turned(turn, a)) })
    }

    /// How far an angle (rad) is from the nearer end; negative beyond it.
    pub(super) fn margin(&self, angle: f64) -> f64 {
        (angle - self.range[0]).min(self.range[1] - angle)
    }
}

impl Arm {
    /// Where each link is in the frame of the foot: the foot itself, and what each joint carries.
    #[must_use]
    pub fn links(&self, angles: &Angles) -> [Pose; JOINTS + 1] {
        let mut links = [Pose::ORIGIN; JOINTS + 1];
        for (n, (joint, angle)) in self.joints.iter().zip(angles).enumerate() {
            links[n + 1] = links[n].compose(&joint.pose_at(*angle));
        }
        links
    }

    /// Where the flange is in the frame of the foot.
    #[must_use]
    pub fn flange_at(&self, angles: &Angles) -> Pose {
        self.links(angles)[JOINTS].compose(&self.flange)
    }

    /// The length of the chain from the second joint to the flange (m), which nothing beyond is reached from.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let joints = self.joints[2..].iter().map(|joint| norm(joint.pose.position));
        joints.sum::<f64>() + norm(self.flange.position)
    }

    /// The axis that each joint turns about (unit vector) and a point on it (m), in the frame of the foot.
    pub(super) fn axes(&self, links: &[Pose; JOINTS + 1]) -> [([f64; 3], [f64; 3]); JOINTS] {
        std::array::from_fn(|n| (links[n + 1].turn(self.joints[n].axis), links[n + 1].position))
    }

    /// On which side shoulder, elbow and wrist are, of an arm whose last three joints meet in one point, as controllers name it: whether the wrist is
    /// behind the foot's axis, whether the forearm is bent back, and whether the fifth joint is below zero.
    #[must_use]
    pub fn sides(&self, angles: &Angles) -> [bool; 3] {
        let links = self.links(angles);
        // where the arm looks, in the frame of the first link, is where its flange is at zero
        let zero = self.links(&[0.0; JOINTS]);
        let ahead = zero[1].local(zero[JOINTS].compose(&self.flange).position);
        let wrist = links[1].local(links[5].position);
        let up = self.joints[0].axis;
        let level = |v: [f64; 3]| along(v, -dot(v, up), up);
        let behind = dot(level(wrist), level(ahead)) < 0.0;
        // the turn from the upper arm to the forearm, about the elbow's axis
        let [shoulder, elbow, wrist] = [2, 3, 5].map(|n| links[n].position);
        let bend = cross(sub(elbow, shoulder), sub(wrist, elbow));
        let bent_back = dot(bend, links[3].turn(self.joints[2].axis)) < 0.0;
        [behind, bent_back, angles[4] < 0.0]
    }

    /// How the flange moves (in units of the reach) and turns (rad) with each joint (rad).
    #[must_use]
    pub fn jacobian(&self, angles: &Angles) -> SMatrix<f64, 6, 6> {
        let links = self.links(angles);
        let flange = links[JOINTS].compose(&self.flange).position;
        let reach = self.reach();
        let mut jacobian = SMatrix::<f64, 6, 6>::zeros();
        for (n, (axis, point)) in self.axes(&links).into_iter().enumerate() {
            let moves = cross(axis, sub(flange, point)).map(|c| c / reach);
            let column = [moves[0], moves[1], moves[2], axis[0], axis[1], axis[2]];
            jacobian.set_column(n, &Vector6::from(column));
        }
        jacobian
    }

    /// The least singular value of [`Arm::jacobian`]: how little the flange moves in its worst direction where the joints move by one. Zero where
    /// the arm cannot move that way at all.
    #[must_use]
    pub fn least_singular(&self, angles: &Angles) -> f64 {
        self.jacobian(angles).singular_values().min()
    }
}
