//! The force of the ply on each pad, and how it changes along a direction.
//!
//! A span pulls at its ends with its horizontal force and with its vertical end forces: with w the weight per length, c the
//! chord and M = EI z'' the end moments, `V₀ = (H h + M₀ − M₁)/ℓ − w c/2` and `V₁ = V₀ + w c`. Each edge counts with its
//! tributary share, so that the loads of a hanging ply add up to its weight. Diagonals are no fibers; what a cell's shear
//! takes acts along both of its diagonals.

use super::super::direction::Direction;
use super::super::sensitivity::StateTangent;
use super::super::solver::Solver;
use crate::catenary::{Profile, SpanState};
use crate::geometry::vector::{dot, sub, unit};
use crate::ply::{ContactSegment, Lines, shear};

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

/// An end of a fiber line, or of a bias line, at a pad.
struct Pull {
    /// The gripper.
    gripper: usize,
    /// 1 if its span starts there, −1 if it ends there.
    sign: f64,
}

impl<'a> Held<'a> {
    fn graph(&self) -> &'a Lines {
        self.solver.lines()
    }

    /// The two ends of a free segment of a catenary (m), and the pads among them.
    fn ends(&self, catenary: usize, segment: usize) -> ([Vector; 2], [Option<Pull>; 2]) {
        let contact = self.contacts[catenary].as_ref();
        let [a, b] = self.graph().ends(catenary);
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
        let edges = self.graph().edges();
        for (n, element) in self.solver.problem().elements.iter().enumerate() {
            if element.catenary >= edges {
                continue;
            }
            let share = self.graph().tributary(element.catenary);
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
        for cell in 0..self.graph().cells().len() {
            let Some(resistance) = self.shear_resistance(cell) else { continue };
            for (n, diagonal) in resistance.lines() {
                let force = resistance.force(n, diagonal);
                if !force.is_finite() {
                    return None;
                }
                for (direction, pulls) in self.pulling(diagonal.catenary) {
                    put(pulls, [direction.map(|c| c * force); 2]);
                }
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
        let edges = self.graph().edges();
        for (n, element) in self.solver.problem().elements.iter().enumerate() {
            let Some(force) = self.solver.force(n).filter(|_| element.catenary < edges) else {
                if element.catenary < edges {
                    self.vertical_change(n, tangent, &mut put);
                }
                continue;
            };
            debug_assert!(element.state != SpanState::Straight);
            let share = self.graph().tributary(element.catenary);
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
        for cell in 0..self.graph().cells().len() {
            self.shear_change(cell, direction, &mut put);
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
        let share = 0.5 * self.graph().tributary(element.catenary);
        let change = tangent.loads[n][0] * element.length + element.weight * tangent.spans[n][2];
        for pull in self.ends(element.catenary, element.segment).1.iter().flatten() {
            put(element.catenary, pull.gripper, [0.0, 0.0, -share * change]);
        }
    }

    /// What a cell does against its shear, where its material resists.
    fn shear_resistance(&self, cell: usize) -> Option<ShearResistance> {
        let curve = self.solver.ply().material.shear_curve.as_ref()?;
        let cell = &self.graph().cells()[cell];
        let bias = cell.bias.each_ref().map(|bias| {
            let mut lines = bias.list().iter().map(|n| self.bias_line(*n));
            Bias { lines: [lines.next(), lines.next()] }
        });
        let sides = self.solver.ply().trellis(cell, self.contacts);
        let angle = shear::difference_angle(sides, bias.each_ref().map(Bias::path));
        let (size, slope) = curve.force(angle);
        Some(ShearResistance { bias, sides, angle, per_length: size.copysign(angle), slope })
    }

    fn bias_line(&self, catenary: usize) -> BiasLine {
        let lying = self.contacts[catenary].as_ref().map_or(0.0, |contact| {
            contact.line.length() + contact.excess_length[0] + contact.excess_length[1]
        });
        let free: f64 = self.lines(catenary).map(|(line, _)| length(line)).sum();
        BiasLine { catenary, path: free + lying, lying }
    }

    /// The straight lines of a diagonal, and the pads at their ends: from gripper to gripper, or from each one to the end of
    /// the contact.
    fn lines(&self, catenary: usize) -> impl Iterator<Item = (Vector, [Option<Pull>; 2])> {
        let count = if self.contacts[catenary].is_some() { 2 } else { 1 };
        (0..count).map(move |segment| {
            let (ends, pulls) = self.ends(catenary, segment);
            (sub(ends[1], ends[0]), pulls)
        })
    }

    /// The directions in which a diagonal pulls, and the pads at which it does.
    fn pulling(&self, catenary: usize) -> impl Iterator<Item = (Vector, [Option<Pull>; 2])> {
        self.lines(catenary).filter_map(|(line, pulls)| Some((unit(line)?, pulls)))
    }

    fn shear_change(
        &self,
        cell: usize,
        direction: &Direction,
        put: &mut impl FnMut(usize, usize, Vector),
    ) {
        let Some(resistance) = self.shear_resistance(cell) else { return };
        let moving = |pulls: &[Option<Pull>; 2]| {
            let velocity = |pull: &Option<Pull>| {
                pull.as_ref().map_or([0.0; 3], |pull| direction.grippers[pull.gripper])
            };
            sub(velocity(&pulls[1]), velocity(&pulls[0]))
        };
        let [along_u, along_v, along_bias] = direction.length;
        let d_path = |line: &BiasLine| {
            let ahead = |(towards, pulls): (Vector, _)| dot(moving(&pulls), towards);
            let free: f64 = self.pulling(line.catenary).map(ahead).sum();
            free + along_bias * line.lying
        };
        let d_paths = resistance.bias.each_ref().map(|bias| bias.path_change(d_path));
        let [a, b] = resistance.sides;
        let d_angle = resistance.angle_change([a * along_u, b * along_v], d_paths);
        for (n, diagonal) in resistance.lines() {
            let force = resistance.force(n, diagonal);
            let d_force = resistance.force_change(n, diagonal, d_angle, d_path(diagonal));
            for (line, pulls) in self.lines(diagonal.catenary) {
                let Some(towards) = unit(line) else { continue };
                let moving = moving(&pulls);
                let ahead = dot(moving, towards);
                let change = [0, 1, 2].map(|n| {
                    d_force * towards[n] + force * (moving[n] - ahead * towards[n]) / length(line)
                });
                for end in pulls.iter().flatten() {
                    put(diagonal.catenary, end.gripper, change.map(|c| end.sign * c));
                }
            }
        }
    }
}

fn length(line: Vector) -> f64 {
    dot(line, line).sqrt()
}

/// A bias line of a cell.
struct BiasLine {
    catenary: usize,
    /// Length (m) of its taut path, and of the part of it that lies on the mold.
    path: f64,
    lying: f64,
}

/// The bias lines of a cell in one direction: a diagonal, or two sides.
struct Bias {
    lines: [Option<BiasLine>; 2],
}

impl Bias {
    fn list(&self) -> impl Iterator<Item = &BiasLine> {
        self.lines.iter().flatten()
    }

    /// The path (m) that shears the cell: of two sides the mean by their squares.
    fn path(&self) -> f64 {
        match &self.lines {
            [Some(one), Some(other)] => {
                (0.5 * (one.path * one.path + other.path * other.path)).sqrt()
            }
            [one, _] => one.as_ref().map_or(0.0, |one| one.path),
        }
    }

    /// How that path changes with those of the lines.
    fn path_change(&self, change: impl Fn(&BiasLine) -> f64) -> f64 {
        match &self.lines {
            [Some(one), Some(other)] => {
                let sum = one.path * change(one) + other.path * change(other);
                0.5 * sum / self.path()
            }
            [one, _] => one.as_ref().map_or(0.0, change),
        }
    }
}

/// What a cell does against its shear: τ(γ) with sin γ = (d₁² − d₂²)/4ab from its rising and its falling bias lines d₁, d₂,
/// and a, b the sides of its trellis. The one pulls its pads together, the other one pushes them apart.
struct ShearResistance {
    /// The rising bias lines, and the falling ones.
    bias: [Bias; 2],
    sides: [f64; 2],
    /// Shear angle γ (rad), positive where the rising bias lines are the longer ones.
    angle: f64,
    /// Shear force τ per length (N/m) of the sign of the angle, and its derivative to the angle.
    per_length: f64,
    slope: f64,
}

impl ShearResistance {
    /// All bias lines, each with its direction: 0 rising, 1 falling.
    fn lines(&self) -> impl Iterator<Item = (usize, &BiasLine)> {
        self.bias.iter().enumerate().flat_map(|(n, bias)| bias.list().map(move |line| (n, line)))
    }

    /// Tension (N) in a bias line, the derivative of the cell's energy to it. A cell of fiber sides has the area ab, one of fiber
    /// diagonals 2ab and two sides in each direction; in both it is ∂(area ∫τ dγ)/∂d = ±τ d/(2 cos γ). Infinite where the cell has
    /// folded.
    fn force(&self, direction: usize, line: &BiasLine) -> f64 {
        let sign = 1.0 - 2.0 * direction as f64;
        sign * self.per_length * line.path / (2.0 * self.angle.cos())
    }

    /// How that tension changes with the shear angle and the bias line.
    fn force_change(&self, direction: usize, line: &BiasLine, d_angle: f64, d_path: f64) -> f64 {
        let sign = 1.0 - 2.0 * direction as f64;
        let (sine, cosine) = self.angle.sin_cos();
        let change = self.slope * d_angle * line.path + self.per_length * d_path;
        (sign * change / 2.0 + self.force(direction, line) * sine * d_angle) / cosine
    }

    /// How the shear angle changes with the sides of the trellis and the bias lines.
    fn angle_change(&self, [da, db]: [f64; 2], d_paths: [f64; 2]) -> f64 {
        let ([a, b], [rising, falling]) = (self.sides, self.bias.each_ref().map(Bias::path));
        let (sine, cosine) = self.angle.sin_cos();
        let change = (rising * d_paths[0] - falling * d_paths[1]) / (2.0 * a * b);
        (change - sine * (da / a + db / b)) / cosine
    }
}
