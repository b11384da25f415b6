//! The layup of one real cell.
//!
//! The commanded motion p_i(t) of gripper i becomes its real one in this order:
//!
//! 1. gripper: p + a_i + s_i (p(t) − p(0)), the shift a_i and the shares s_i along the axes;
//! 2. tool frame: turned about the mean of all grippers of the step, then shifted;
//! 3. mold: moved by the inverse of the mold's motion about the middle of the target.
//!
//! An error of the pick-up moves no gripper: other fabric is where the layup's points are ([`Ply::held_off`]).
//!
//! The motion is moved and not the mold, because the ideal drape belongs to the mold: positions are judged against it
//! where the mold really is. Seen from the mold, gravity would be inclined by the mold's tilt; that is neglected, because it
//! changes the weight across the ply by the square of the tilt and puts a share of the weight along it that is as
//! small as the tilt. Limits stay as they are, those of the workspace too.

use super::draw::{Draw, MaterialError, RelativeError, RigidError};
use crate::geometry::vector::{along, between, sub, turned};
use crate::layup::{Layup, Release};
use crate::material::{Material, Section};
use crate::mold::{Mold, Raised};
use crate::motion::Motion;
use crate::ply::Ply;
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
        Ply { material, length_factor, pick_up_error: self.pick_up, ..ply.clone() }
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
