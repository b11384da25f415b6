//! The layup of one real cell.
//!
//! The commanded motion p_i(t) of gripper i becomes the motion of the fabric point that the layup calls the gripper's, in this order:
//!
//! 1. gripper: p + a_i + s_i (p(t) − p(0)), the shift a_i and the shares s_i along the axes;
//! 2. tool frame: turned about the mean of all grippers of the step, then shifted;
//! 3. mold: moved by the inverse of the mold's motion about the middle of the target;
//! 4. pick-up: less δ_u e_u + δ_v e_v, because the gripper holds the fabric point δ away from where it should. δ is the offset, and
//!    the yaw times the distance from the middle of the array at a right angle. e_u and e_v are the unit chords between neighbors.
//!
//! The motion is moved and not the mold, because the ideal drape belongs to the mold: positions are judged against it
//! where the mold really is. Seen from the mold, gravity would be inclined by the mold's tilt; that is neglected, because it
//! changes the weight across the ply by the square of the tilt and puts a share of the weight along it that is as
//! small as the tilt. Limits stay as they are, those of the workspace too.

use super::draw::{Draw, MaterialError, PickUpError, RelativeError, RigidError};
use crate::geometry::vector::{along, between, sub, turned};
use crate::layup::{Layup, Release};
use crate::material::{Material, Section};
use crate::mold::{Mold, Raised};
use crate::motion::Motion;
use crate::ply::{Ply, tangents};
use crate::sheet::release::times;
use crate::tool::Tool;
use std::sync::Arc;

/// Least share of a nominal value of the ply that an error leaves of it: a normal law has no bound, and a ply without
/// mass or with a negative rigidity is none.
const LEAST_SHARE: f64 = 0.1;

impl Draw {
    /// The layup as the real cell would run it, with the same commanded motion.
    ///
    /// Masses, rigidities, shear forces and lengths never fall below a tenth of the nominal ones. Grippers beyond those
    /// that were drawn have no error of their own.
    #[must_use]
    pub fn apply(&self, layup: &Layup) -> Layup {
        let (carried, _) = layup.carried();
        // a robot lets go when its program says, wherever it is
        let release = layup.release.clone().map(|rule| Release { times: times(&carried), ..rule });
        Layup {
            release,
            ply: self.ply(&layup.ply),
            mold: layup.mold.as_ref().map(|mold| self.mold(mold)),
            motion: self.motion(&carried),
            // errors are of what the tool has made: it does not take them back
            tool: layup.tool.clone().map(|tool| Tool { with_errors: true, ..tool }),
            ..layup.clone()
        }
    }

    fn ply(&self, ply: &Ply) -> Ply {
        let material = self.material.apply(&ply.material);
        let length_factor = ply.length_factor * (1.0 + self.material.length).max(LEAST_SHARE);
        Ply { material, length_factor, ..ply.clone() }
    }

    fn mold(&self, mold: &Mold) -> Mold {
        match self.mold.waves.filter(|waves| waves.amplitude != 0.0) {
            Some(waves) => Mold::Wavy(Arc::new(Raised { mold: mold.clone(), relief: waves })),
            None => mold.clone(),
        }
    }

    fn motion(&self, layup: &Layup) -> Motion {
        let Motion { times, positions } = &layup.motion;
        let landed = match &layup.target {
            Some(target) => Some(&target.grippers),
            None => positions.last(),
        };
        let middle = landed.map_or([0.0; 3], |grippers| mean(grippers));
        let start = layup.start();
        // pads grip the flat ply where they are: errors begin to act while they lift it
        let lift_steps = layup.pick_up.map_or(0, |pick_up| pick_up.lift_steps);
        let acting =
            |step: usize| if step < lift_steps { step as f64 / lift_steps as f64 } else { 1.0 };
        let real = |(k, step): (usize, &Vec<[f64; 3]>)| {
            let mut at = step.clone();
            for (n, (p, error)) in at.iter_mut().zip(&self.grippers).enumerate() {
                for axis in 0..3 {
                    let way = step[n][axis] - start[n][axis];
                    p[axis] += error.position[axis] + error.stroke[axis] * way;
                }
            }
            self.frame.apply(&mut at);
            self.mold.motion.inverse(&mut at, middle);
            self.pick_up.apply(&layup.ply, &mut at);
            step.iter().zip(at).map(|(nominal, at)| between(*nominal, at, acting(k))).collect()
        };
        Motion { times: times.clone(), positions: positions.iter().enumerate().map(real).collect() }
    }
}

/// What is left of a nominal value, as a share, by a relative error.
fn share(error: RelativeError) -> f64 {
    error.ratio().max(LEAST_SHARE)
}

/// The mean of points (m).
fn mean(points: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|n| points.iter().map(|p| p[n]).sum::<f64>() / points.len().max(1) as f64)
}

impl RigidError {
    /// Turns points (m) about their mean, then shifts them.
    fn apply(&self, points: &mut [[f64; 3]]) {
        if *self == RigidError::default() {
            return;
        }
        let middle = mean(points);
        for p in points {
            let q = turned(self.turn, sub(*p, middle));
            *p = [0, 1, 2].map(|n| middle[n] + q[n] + self.shift[n]);
        }
    }

    /// Undoes a turn of the mold about `middle` (m) and a shift after it.
    fn inverse(&self, points: &mut [[f64; 3]], middle: [f64; 3]) {
        if *self == RigidError::default() {
            return;
        }
        let back = self.turn.map(|x| -x);
        for p in points {
            let q = [0, 1, 2].map(|n| p[n] - self.shift[n] - middle[n]);
            *p = along(middle, 1.0, turned(back, q));
        }
    }
}

impl PickUpError {
    /// Moves the fabric points that the grippers should hold, off the grippers at `points` (m).
    fn apply(&self, ply: &Ply, points: &mut [[f64; 3]]) {
        if *self == PickUpError::default() {
            return;
        }
        let [low, high] = ply.held_bounds();
        let middle = [0, 1].map(|n| 0.5 * (low[n] + high[n]));
        let neighbors = ply.neighbors();
        let at = points.to_vec();
        for (n, p) in points.iter_mut().enumerate() {
            let place = ply.place(n);
            let off = [0, 1].map(|axis| place[axis] - middle[axis]);
            let delta = [self.offset[0] - self.yaw * off[1], self.offset[1] + self.yaw * off[0]];
            let [u, v] = tangents(ply, &neighbors, &at, n);
            *p = along(along(*p, -delta[0], u), -delta[1], v);
        }
    }
}

impl MaterialError {
    /// The material with these errors.
    fn apply(&self, material: &Material) -> Material {
        let [mass_share, bending, shear] = [self.areal_mass, self.bending, self.shear].map(share);
        let section = match material.section {
            Section::Line { mass, flexural_rigidity } => Section::Line {
                mass: mass_share * mass,
                flexural_rigidity: bending * flexural_rigidity,
            },
            Section::Areal { mass, warp_rigidity, weft_rigidity } => Section::Areal {
                mass: mass_share * mass,
                warp_rigidity: bending * warp_rigidity,
                weft_rigidity: bending * weft_rigidity,
            },
        };
        let moment = material.moment.clone().map(|curve| curve.map(|curve| curve.times(bending)));
        Material { section, moment, ..material.with_shear(shear) }
    }
}
