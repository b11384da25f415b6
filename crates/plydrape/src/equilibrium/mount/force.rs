//! The force of the ply on each pad, and how it changes along a direction.
//!
//! A span pulls at its ends with its horizontal force and with its vertical end forces: with w the weight per length, c the
//! chord and M = EI z'' the end moments, `V₀ = (H h + M₀ − M₁)/ℓ − w c/2` and `V₁ = V₀ + w c`. Each edge counts with its
//! tributary share, so that the loads of a hanging ply add up to its weight. Diagonals are no fibres; what a cell's shear
//! takes pulls along its stretched diagonal ([`crate::ply::shear::force`]).

use super::super::direction::Direction;
use super::super::sensitivity::StateTangent;
use super::super::solver::Solver;
use crate::catenary::{Profile, SpanState};
use crate::mold::vector::{sub, unit};
use crate::ply::{Catenary, ContactSegment, Grid, Kind, shear};

/// A point in space (m), or a force (N).
type Vector = [f64; 3];

/// A solved ply between pads.
#[derive(Clone, Copy)]
pub(super) struct Held<'a> {
    /// The solver, as it was left by the solve.
    pub solver: &'a Solver,
    /// Where the pads hold the fabric (m).
    pub pads: &'a [Vector],
    /// Contact segment of each catenary.
    pub contacts: &'a [Option<ContactSegment>],
}

/// An end of an edge, or of a stretched diagonal, at a pad.
struct Pull {
    /// The gripper.
    gripper: usize,
    /// 1 if its span starts there, −1 if it ends there.
    sign: f64,
}

impl<'a> Held<'a> {
    fn grid(&self) -> Grid {
        self.solver.ply().grid
    }

    /// The two ends of a free segment of a catenary (m), and the pads among them.
    fn ends(&self, catenary: usize, segment: usize) -> ([Vector; 2], [Option<Pull>; 2]) {
        let (grid, contact) = (self.grid(), self.contacts[catenary].as_ref());
        let Catenary { from, to, .. } = grid.catenary(catenary);
        let [a, b] = [from, to].map(|id| grid.index(id));
        let mut ends = [self.pads[a], self.pads[b]];
        let pull = |gripper: usize, end: usize| Pull { gripper, sign: 1.0 - 2.0 * end as f64 };
        let mut pulls = [Some(pull(a, 0)), Some(pull(b, 1))];
        if let Some(contact) = contact {
            ends[1 - segment] = contact.point()[segment];
            pulls[1 - segment] = None;
        }
        (ends, pulls)
    }

    /// The forces of the ply on all pads (N), and the largest force of a single span (N). None where a line that does not
    /// stretch is taut, so that its force is not known.
    pub fn forces(&self) -> Option<(Vec<Vector>, f64)> {
        let mut out = vec![[0.0; 3]; self.pads.len()];
        let mut largest = 0.0_f64;
        let mut put = |pulls: [Option<Pull>; 2], force: [Vector; 2]| {
            for (pull, force) in pulls.iter().zip(force) {
                largest = force.iter().fold(largest, |most, c| most.max(c.abs()));
                if let Some(pull) = pull {
                    (0..3).for_each(|n| out[pull.gripper][n] += pull.sign * force[n]);
                }
            }
        };
        let edges = self.grid().edges();
        for (n, element) in self.solver.problem().elements.iter().enumerate() {
            if element.catenary >= edges {
                continue;
            }
            let share = self.solver.ply().tributary(element.catenary);
            let (ends, pulls) = self.ends(element.catenary, element.segment);
            let Some(force) = self.solver.force(n) else {
                if element.run > self.solver.tuning().vertical_run * element.length {
                    return None;
                }
                let half = 0.5 * share * element.weight * element.length;
                put(pulls, [[0.0, 0.0, -half], [0.0, 0.0, half]]);
                continue;
            };
            let profile = Profile::new(&self.solver.span(n), force);
            let along = [0, 1].map(|c| share * force * (ends[1][c] - ends[0][c]) / element.run);
            put(
                pulls,
                [0.0, element.run]
                    .map(|x| [along[0], along[1], share * profile.station(x).vertical_force]),
            );
        }
        for cell in 0..self.grid().cells() {
            let Some(pull) = self.shear_pull(cell) else { continue };
            if !pull.force.is_finite() {
                return None;
            }
            for segment in pull.segments(self) {
                let (direction, pulls) = segment;
                let force = direction.map(|c| c * pull.force);
                put(pulls, [force, force]);
            }
        }
        Some((out, largest))
    }

    /// How the forces on the pads change along a direction that moves the pads and changes the state: calls `put` with the
    /// catenary, the gripper and the change of the force on it (N) by that catenary.
    pub fn changes(
        &self,
        direction: &Direction,
        tangent: &StateTangent,
        mut put: impl FnMut(usize, usize, Vector),
    ) {
        let edges = self.grid().edges();
        for (n, element) in self.solver.problem().elements.iter().enumerate() {
            let Some(force) = self.solver.force(n).filter(|_| element.catenary < edges) else {
                if element.catenary < edges {
                    self.vertical_change(n, tangent, &mut put);
                }
                continue;
            };
            debug_assert!(element.state != SpanState::Straight);
            let share = self.solver.ply().tributary(element.catenary);
            let (ends, pulls) = self.ends(element.catenary, element.segment);
            let velocity = |end: usize| {
                let pull = pulls[end].as_ref();
                pull.map_or([0.0; 3], |pull| direction.grippers[pull.gripper])
            };
            let (moving, run) = (sub(velocity(1), velocity(0)), element.run);
            let ([d_run, d_rise, _], d_force) = (tangent.spans[n], tangent.force[n]);
            let heading = [0, 1].map(|c| (ends[1][c] - ends[0][c]) / run);
            let along = [0, 1].map(|c| {
                share * (d_force * heading[c] + force * (moving[c] - heading[c] * d_run) / run)
            });
            // V₀ = (H h + M₀ − M₁)/ℓ − w c/2, V₁ = V₀ + w c
            let profile = Profile::new(&self.solver.span(n), force);
            let moments = [0.0, run].map(|x| profile.station(x).moment);
            let (rise, chord) = (element.rise, run.hypot(element.rise));
            let lever = (force * rise + moments[0] - moments[1]) / run;
            let [d_first, d_second] = tangent.moments[n];
            let d_lever =
                (d_force * rise + force * d_rise + d_first - d_second - lever * d_run) / run;
            let d_weight = tangent.loads[n][0] * chord
                + element.weight * (run * d_run + rise * d_rise) / chord;
            for (end, pull) in pulls.iter().enumerate() {
                let Some(pull) = pull else { continue };
                let vertical = share * (d_lever + (end as f64 - 0.5) * d_weight);
                let change = [along[0], along[1], vertical].map(|c| pull.sign * c);
                put(element.catenary, pull.gripper, change);
            }
        }
        for cell in 0..self.grid().cells() {
            self.shear_change(cell, direction, tangent, &mut put);
        }
    }

    /// The same of an upright line, which hangs on its ends by half of its weight each.
    fn vertical_change(
        &self,
        n: usize,
        tangent: &StateTangent,
        put: &mut impl FnMut(usize, usize, Vector),
    ) {
        let element = &self.solver.problem().elements[n];
        let share = 0.5 * self.solver.ply().tributary(element.catenary);
        let change = tangent.loads[n][0] * element.length + element.weight * tangent.spans[n][2];
        for pull in self.ends(element.catenary, element.segment).1.iter().flatten() {
            put(element.catenary, pull.gripper, [0.0, 0.0, -share * change]);
        }
    }

    /// The force in the stretched diagonal of a cell, where its material resists shear.
    fn shear_pull(&self, cell: usize) -> Option<ShearPull> {
        let curve = self.solver.ply().material.shear_curve.as_ref()?;
        let (path, falling) = self.solver.problem().shearing[cell]?;
        let sides = self.solver.ply().sides(cell, self.contacts);
        let angle = shear::angle(sides, path);
        let (per_length, slope) = curve.force(angle);
        let catenary = self.grid().edges() + 2 * cell + usize::from(falling);
        debug_assert!(!falling || self.grid().catenary(catenary).kind == Kind::Falling);
        let force = shear::force(angle, path, per_length);
        Some(ShearPull { catenary, force, sides, path, angle, per_length, slope })
    }

    fn shear_change(
        &self,
        cell: usize,
        direction: &Direction,
        tangent: &StateTangent,
        put: &mut impl FnMut(usize, usize, Vector),
    ) {
        let Some(pull) = self.shear_pull(cell) else { return };
        let [along_u, along_v, _] = direction.length;
        let ([a, b], d_path) = (pull.sides, tangent.paths[cell]);
        let d_angle =
            shear::angle_tangent(pull.sides, pull.path, [a * along_u, b * along_v, d_path]);
        let (sine, cosine) = pull.angle.sin_cos();
        let d_force = (pull.slope * d_angle * pull.path + pull.per_length * d_path) / cosine
            + pull.force * sine / cosine * d_angle;
        for segment in 0..2 {
            if segment == 1 && self.contacts[pull.catenary].is_none() {
                break;
            }
            let (ends, pulls) = self.ends(pull.catenary, segment);
            let line = sub(ends[1], ends[0]);
            let Some(towards) = unit(line) else { continue };
            let length = line.iter().map(|c| c * c).sum::<f64>().sqrt();
            let velocity = |end: usize| {
                let pull = pulls[end].as_ref();
                pull.map_or([0.0; 3], |pull| direction.grippers[pull.gripper])
            };
            let moving = sub(velocity(1), velocity(0));
            let ahead: f64 = (0..3).map(|n| moving[n] * towards[n]).sum();
            let change = [0, 1, 2].map(|n| {
                d_force * towards[n] + pull.force * (moving[n] - ahead * towards[n]) / length
            });
            for end in pulls.iter().flatten() {
                put(pull.catenary, end.gripper, change.map(|c| end.sign * c));
            }
        }
    }
}

/// The force along the stretched diagonal of a cell.
struct ShearPull {
    catenary: usize,
    /// The force (N).
    force: f64,
    sides: [f64; 2],
    path: f64,
    angle: f64,
    /// Shear force per length (N/m) and its derivative to the angle.
    per_length: f64,
    slope: f64,
}

impl ShearPull {
    /// The directions in which it pulls at its pads: from gripper to gripper, or from each one to the end of the contact.
    fn segments(&self, held: &Held) -> Vec<(Vector, [Option<Pull>; 2])> {
        let count = if held.contacts[self.catenary].is_some() { 2 } else { 1 };
        let one = |segment: usize| {
            let (ends, pulls) = held.ends(self.catenary, segment);
            Some((unit(sub(ends[1], ends[0]))?, pulls))
        };
        (0..count).filter_map(one).collect()
    }
}
