//! Mounts of the pads that give, and the limits of their tilt: ½ dᵀ k d of the distance d of a pad from where the robot holds
//! it, and ½ k (φ − φ_max)² of a tilt φ beyond its limit, terms of eq. (19) of `docs/theory/sheet.md`.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::gripper::{Gripper, Pad};
use super::pads::{HeldNodes, Pads, mean};
use super::system::{Pair, System, add};
use super::tuning::SheetTuning;
use super::unknowns::Carrier;
use crate::geometry::vector::{cross, norm};
use crate::sheet::matrix3::{IDENTITY, outer, scaled};

/// What the mount of a gripper acts on.
#[derive(Debug)]
enum Grip {
    /// The mean of free nodes on a mount that gives.
    Fabric {
        /// The nodes, each with its share.
        nodes: Vec<(usize, f64)>,
        /// Pairs of them, each with the product of their shares.
        pairs: Vec<(Pair, f64)>,
    },
    /// A pad, by the blocks of its unknowns.
    Pad {
        /// Block of the turn, if it has a joint.
        turn: Option<u32>,
        /// Block of the shift, if its mount gives.
        shift: Option<u32>,
    },
}

/// Mounts and tilt limits of all pads that hold the ply.
#[derive(Debug)]
pub struct Mounts<'a> {
    grippers: &'a [Gripper],
    /// What grippers act on; those that hold nothing, or are rigid pins, are not among them.
    grips: Vec<(usize, Grip)>,
    /// Stiffness against the turn of any pad (N·m/rad), because nodes on one line leave a turn about it free.
    turn_stiffness: f64,
    /// Stiffness against a tilt beyond its limit (N·m/rad).
    tilt_stiffness: f64,
}

impl<'a> Mounts<'a> {
    /// The mounts of the pads of a sheet, whose unknowns are those of `system`.
    pub fn new(sheet: &'a Sheet, tuning: &SheetTuning, pads: &Pads, system: &System) -> Self {
        let grip = |(n, held): (usize, &HeldNodes)| {
            let (node, _) = *held.first()?;
            match system.carrier(node) {
                Carrier::Free { .. } => {
                    let nodes = pads.bearing[n].clone();
                    let each = nodes.iter().enumerate();
                    let pairs = each.flat_map(|(n, a)| nodes[..n].iter().map(move |b| [*b, *a]));
                    let pairs =
                        pairs.map(|[(i, s), (j, t)]| (system.pair([i as u32, j as u32]), s * t));
                    Some((n, Grip::Fabric { pairs: pairs.collect(), nodes }))
                }
                Carrier::Held { .. } => None,
                Carrier::Pad { turn, shift, .. } => Some((n, Grip::Pad { turn, shift })),
            }
        };
        let weight = sheet.areal_mass * sheet.gravity * sheet.pitch.powi(3);
        Mounts {
            grippers: &sheet.grippers,
            grips: pads.held().iter().enumerate().filter_map(grip).collect(),
            turn_stiffness: tuning.turn_stiffness * weight,
            tilt_stiffness: tuning.tilt_stiffness * weight,
        }
    }

    /// Tilt of a pad beyond the limit of its gripper (rad) and the axis about which it tilts; `None` within the limit.
    fn tilt_beyond(gripper: &Gripper, pad: &Pad) -> Option<(f64, [f64; 3])> {
        let beyond = pad.tilt() - gripper.max_tilt;
        let axis = cross(pad.stem, pad.normal());
        let size = norm(axis).max(f64::MIN_POSITIVE);
        (beyond > 0.0).then(|| (beyond, axis.map(|c| c / size)))
    }
}

impl Energy for Mounts<'_> {
    fn value(&self, now: &Configuration) -> f64 {
        let energy = |(n, grip): &(usize, Grip)| {
            let (gripper, pad) = (&self.grippers[*n], &now.pads[*n]);
            let spring = |x| gripper.hold(pad, x).map_or(0.0, |hold| hold.energy);
            match grip {
                Grip::Fabric { nodes, .. } => spring(mean(nodes, &now.x)),
                Grip::Pad { turn, .. } => {
                    let tilt = turn.and_then(|_| Mounts::tilt_beyond(gripper, pad));
                    let tilt = tilt.map_or(0.0, |(beyond, _)| beyond * beyond);
                    spring(pad.position) + 0.5 * self.tilt_stiffness * tilt
                }
            }
        };
        self.grips.iter().map(energy).sum()
    }

    /// The stiffness is positive as it is: of a tilt beyond its limit it is that about the axis of the tilt, and of fabric that
    /// slides under a tilted pad the symmetric positive part.
    fn linearize(&self, now: &Configuration, _: Stiffness, system: &mut System) {
        for (n, grip) in &self.grips {
            let (gripper, pad) = (&self.grippers[*n], &now.pads[*n]);
            match grip {
                Grip::Fabric { nodes, pairs } => {
                    let Some(hold) = gripper.hold(pad, mean(nodes, &now.x)) else { continue };
                    for (node, share) in nodes {
                        add(&mut system.gradient[*node], *share, hold.force);
                        system.stiffen(*node, &scaled(share * share, &hold.stiffness));
                    }
                    if system.wants_matrix() {
                        for (pair, product) in pairs {
                            system.couple(*pair, &scaled(*product, &hold.stiffness));
                        }
                    }
                }
                Grip::Pad { turn, shift } => {
                    if let (Some(hold), Some(shift)) = (gripper.hold(pad, pad.position), *shift) {
                        system.add_to_block(shift, hold.force, &hold.stiffness);
                    }
                    let Some(turn) = *turn else { continue };
                    let least = scaled(self.turn_stiffness, &IDENTITY);
                    system.add_to_block(turn, [0.0; 3], &least);
                    if let Some((beyond, axis)) = Mounts::tilt_beyond(gripper, pad) {
                        let k = self.tilt_stiffness;
                        let torque = axis.map(|c| k * beyond * c);
                        system.add_to_block(turn, torque, &scaled(k, &outer(axis, axis)));
                    }
                }
            }
        }
    }
}
