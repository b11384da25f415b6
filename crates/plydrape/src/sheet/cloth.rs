//! The ply in motion: one implicit time step.
//!
//! The positions after a time step Δt are the least of the incremental potential
//! Σ m/(2 Δt²) |x − x̂|² + E(x), x̂ = x + Δt v, by Newton's iteration. Its first step moves the grippers within the linear
//! system; the tension that turns segments is the one that the linear step before predicts ([`super::stretch`]), so that
//! full steps are taken.

use super::Sheet;
use super::bending::Bending;
use super::contact::Contact;
use super::gripper::{Gripper, Pad};
use super::shear::Shear;
use super::stretch::{Stretch, direction};
use super::system::{Carrier, System, add};
use super::tuning::Tuning;
use crate::geometry::matrix3::{Matrix3, outer, plus, scaled, times, transposed};
use crate::geometry::vector::{along, cross, dot, norm, sub};
use crate::layup::Friction;

/// What moves: positions, speeds and pads.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Positions of the nodes (m).
    pub x: Vec<[f64; 3]>,
    /// Their velocities (m/s).
    pub v: Vec<[f64; 3]>,
    /// The grippers' pads.
    pub pads: Vec<Pad>,
}

impl Motion {
    /// Takes over all of another motion of the same ply, in the memory that this one has.
    fn copy_from(&mut self, other: &Motion) {
        self.x.copy_from_slice(&other.x);
        self.v.copy_from_slice(&other.v);
        self.pads.clone_from_slice(&other.pads);
    }
}

/// A gripper, its pad, and the nodes that it holds with their distance from its middle (m).
type Held<'a> = ((&'a Gripper, &'a Pad), &'a Vec<(usize, [f64; 2])>);

/// Why a time step was not solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// Newton's iteration did not come to an end.
    Iterations,
    /// The first step turns segments too far to be linear.
    Turn,
    /// A node came to the mold from too far away.
    Landing,
    /// The matrix is not positive definite, or a number is not finite.
    Singular,
}

/// The ply in motion.
#[derive(Debug)]
pub struct Cloth<'a> {
    sheet: &'a Sheet,
    tuning: Tuning,
    system: System,
    stretch: Stretch,
    shear: Shear,
    bending: Bending,
    /// Contact with the mold; none where there is none.
    pub contact: Option<Contact<'a>>,
    /// Mass of each node (kg).
    masses: Vec<f64>,
    /// Nodes of each gripper with their distance from its middle (m).
    held: Vec<Vec<(usize, [f64; 2])>>,
    /// Whether a gripper holds each node.
    pub gripped: Vec<bool>,
    /// Positions, speeds and pads.
    pub now: Motion,
    before: Motion,
    inertial: Vec<[f64; 3]>,
    /// The linear step of each node (m), and the turn (rad) and shift (m) of each pad in it.
    step: Vec<[f64; 3]>,
    /// Whether the second derivative is whole, or reduced to its positive parts.
    whole: bool,
    turns: Vec<([f64; 3], [f64; 3])>,
    /// Gradient that acts on blocks of unknowns themselves.
    own: Vec<(u32, [f64; 3])>,
    /// Whether nodes that lie on the mold among others are no unknowns.
    pub leaves_out: bool,
    /// Time steps for which each node has hardly moved.
    quiet: Vec<u32>,
    /// Whether each node lies on the mold, or is held by a gripper that stands.
    lies: Vec<bool>,
    /// Pairs of nodes that a term couples.
    pairs: Vec<[u32; 2]>,
    /// Whether each node is among nodes that lie.
    pub still: Vec<bool>,
    /// Solved linear systems.
    pub solves: usize,
}

impl<'a> Cloth<'a> {
    /// At rest with its nodes at `x` (m), held by all of its pads.
    pub fn new(sheet: &'a Sheet, tuning: Tuning, x: Vec<[f64; 3]>, pads: Vec<Pad>) -> Self {
        let v = vec![[0.0; 3]; x.len()];
        Cloth::held_at(sheet, tuning, Motion { x, v, pads }, sheet.held())
    }

    /// In motion, with the nodes that each gripper holds; one that holds none has let go.
    fn held_at(
        sheet: &'a Sheet,
        tuning: Tuning,
        now: Motion,
        held: Vec<Vec<(usize, [f64; 2])>>,
    ) -> Self {
        let fabric = &sheet.fabric;
        let nodes = fabric.places.len();
        let mut carriers = vec![None; nodes];
        let mut blocks: Vec<[f64; 2]> = Vec::with_capacity(nodes);
        let tilts = sheet.tool.as_ref().is_none_or(|tool| tool.fixed_pads.is_none());
        for (gripper, (g, nodes)) in sheet.grippers.iter().zip(&held).enumerate() {
            let gripper = gripper as u32;
            if nodes.is_empty() {
                continue;
            }
            if nodes.len() == 1 {
                if g.mount.is_none() {
                    carriers[nodes[0].0] = Some(Carrier::Held { gripper });
                }
                continue;
            }
            let mut block = || {
                blocks.push(g.place);
                blocks.len() as u32 - 1
            };
            let turn = tilts.then(&mut block);
            let shift = g.mount.map(|_| block());
            for (node, _) in nodes {
                carriers[*node] = Some(Carrier::Pad { gripper, turn, shift });
            }
        }
        let carriers: Vec<Carrier> = carriers
            .into_iter()
            .zip(&fabric.places)
            .map(|(carrier, place)| {
                carrier.unwrap_or_else(|| {
                    blocks.push(*place);
                    Carrier::Free { block: blocks.len() as u32 - 1 }
                })
            })
            .collect();

        let segments = fabric.segments.iter().map(|s| s.nodes);
        let bends = fabric.bends.iter().map(|b| [b.nodes[0], b.nodes[2]]);
        let cells = fabric.cells.iter().flat_map(|c| {
            let [p, q, r, s] = c.nodes;
            [[p, q], [q, r], [r, s], [s, p], [p, r], [q, s]]
        });
        let pairs = segments.chain(bends).chain(cells);
        let pairs: Vec<[u32; 2]> = pairs.collect();
        let system = System::new(&fabric.places, carriers, &blocks, pairs.iter().copied());
        let contact = sheet.mold.as_ref().map(|mold| {
            let free = |n: &usize| !matches!(system.carrier(*n), Carrier::Held { .. });
            let rubs = |n: usize| !matches!(system.carrier(n), Carrier::Pad { shift: None, .. });
            let points = (0..nodes).filter(free).map(|n| (n, fabric.areas[n], rubs(n)));
            // that under which the weight moves a point by a share of the pitch
            let stiffness = |share: f64| sheet.areal_mass * sheet.gravity / (share * sheet.pitch);
            let along = match sheet.friction {
                Friction::Coulomb(_) => tuning.slip,
                Friction::Stick | Friction::StickForEver => tuning.contact_depth,
            };
            let stiffness = [tuning.contact_depth, along].map(stiffness);
            let clear = tuning.release * sheet.pitch;
            Contact::new(mold, stiffness, clear, sheet.friction, sheet.tack, points)
        });
        let mut gripped = vec![false; nodes];
        for (node, _) in held.iter().flatten() {
            gripped[*node] = true;
        }
        let still = vec![[0.0; 3]; nodes];
        Cloth {
            stretch: Stretch::new(&fabric.segments, sheet.tension.clone(), &system),
            shear: Shear::new(&fabric.cells, sheet.shear.clone(), &system),
            bending: Bending::new(&fabric.bends, sheet.rigidity, &sheet.moment, &system),
            contact,
            masses: fabric.areas.iter().map(|area| area * sheet.areal_mass).collect(),
            gripped,
            held,
            before: now.clone(),
            now,
            inertial: still.clone(),
            step: still,
            whole: true,
            turns: vec![Default::default(); sheet.grippers.len()],
            own: Vec::new(),
            system,
            sheet,
            tuning,
            leaves_out: false,
            quiet: vec![0; nodes],
            lies: vec![false; nodes],
            pairs,
            still: vec![false; nodes],
            solves: 0,
        }
    }

    /// Lets go of the ply with the pads of some grippers, from now on. Their nodes move and touch as all others do; those of
    /// them that lie on the mold now stay where they are as far as friction holds them.
    pub fn release(&mut self, grippers: &[usize]) {
        let (mut held, mut now) = (self.held.clone(), self.now.clone());
        let mut quiet = self.quiet.clone();
        for gripper in grippers {
            for (node, _) in held[*gripper].drain(..) {
                quiet[node] = 0;
            }
            let pad = &mut now.pads[*gripper];
            (pad.position, pad.slip) = (pad.target, [0.0; 3]);
        }
        let mut cloth = Cloth::held_at(self.sheet, self.tuning, now, held);
        match (&mut cloth.contact, &self.contact) {
            (Some(contact), Some(before)) => contact.take_over(before, &self.now.x),
            (contact, _) => *contact = None,
        }
        (cloth.quiet, cloth.leaves_out, cloth.solves) = (quiet, self.leaves_out, self.solves);
        *self = cloth;
    }

    /// Whether each gripper's pad holds the ply.
    pub fn holds(&self) -> Vec<bool> {
        self.held.iter().map(|nodes| !nodes.is_empty()).collect()
    }

    /// Energy without inertia (J).
    pub fn energy(&self) -> f64 {
        let x = &self.now.x;
        let height = |(m, x): (&f64, &[f64; 3])| m * self.sheet.gravity * x[2];
        let weight: f64 = self.masses.iter().zip(x).map(height).sum();
        let mounts = self.sheet.grippers.iter().zip(&self.now.pads).zip(&self.held);
        let mount = |((g, pad), nodes): Held| {
            if nodes.is_empty() {
                return 0.0;
            }
            let at = if nodes.len() == 1 { x[nodes[0].0] } else { pad.position };
            let off = sub(sub(at, pad.target), pad.slip);
            g.mount.map_or(0.0, |k| (0..3).map(|n| 0.5 * k[n] * off[n] * off[n]).sum())
        };
        weight
            + self.stretch.energy(x)
            + self.shear.energy(x)
            + self.bending.energy(x)
            + mounts.map(mount).sum::<f64>()
            + self.contact.as_ref().map_or(0.0, |contact| contact.energy(x))
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self) -> f64 {
        self.masses.iter().zip(&self.now.v).map(|(m, v)| 0.5 * m * dot(*v, *v)).sum()
    }

    /// Tension of a segment per width (N/m).
    pub fn tension(&self, segment: usize) -> f64 {
        self.stretch.tension(segment, &self.now.x)
    }

    /// One time step of `dt` (s) that moves the grippers to `targets` (m), solved to steps of `tolerance` (m). Returns
    /// the iterations; on failure nothing has moved.
    pub fn advance(
        &mut self,
        targets: &[[f64; 3]],
        dt: f64,
        tolerance: f64,
    ) -> Result<usize, Failure> {
        self.before.copy_from(&self.now);
        for (inertial, (x, v)) in self.inertial.iter_mut().zip(self.now.x.iter().zip(&self.now.v)) {
            *inertial = [0, 1, 2].map(|n| x[n] + dt * v[n]);
        }
        let mut found = self.iterate(targets, dt, tolerance);
        if found.is_ok() && self.lands_too_far() {
            found = Err(Failure::Landing);
        }
        if found.is_err() {
            self.now.copy_from(&self.before);
            return found;
        }
        for (v, (x, before)) in self.now.v.iter_mut().zip(self.now.x.iter().zip(&self.before.x)) {
            *v = [0, 1, 2].map(|n| (x[n] - before[n]) / dt);
        }
        for ((gripper, nodes), pad) in
            self.sheet.grippers.iter().zip(&self.held).zip(&mut self.now.pads)
        {
            if nodes.is_empty() {
                continue;
            }
            let at = if nodes.len() == 1 { self.now.x[nodes[0].0] } else { pad.position };
            if let Some(hold) = gripper.hold(pad, at) {
                add(&mut pad.slip, 1.0, hold.slides);
            }
        }
        let most = self.tuning.lying_movement * self.sheet.mesh;
        for (quiet, (x, before)) in self.quiet.iter_mut().zip(self.now.x.iter().zip(&self.before.x))
        {
            *quiet = if norm(sub(*x, *before)) <= most { *quiet + 1 } else { 0 };
        }
        if let Some(contact) = &mut self.contact {
            contact.update(&self.now.x);
        }
        found
    }

    /// Longest time step (s), if not longer than `enough`, in which free nodes come to the mold by no more than the way that
    /// [`Tuning::contact_way`] allows, if they go on as in the last one.
    pub fn longest_step(&mut self, enough: f64) -> f64 {
        let most = self.tuning.contact_way * self.sheet.pitch;
        let Motion { x, v, .. } = &self.now;
        match &mut self.contact {
            Some(contact) => contact.longest_time(x, v, most, enough),
            None => enough,
        }
    }

    /// Largest movement of a node in the last time step (m).
    pub fn movement(&self) -> f64 {
        let moved = self.now.x.iter().zip(&self.before.x).map(|(a, b)| norm(sub(*a, *b)));
        moved.fold(0.0, f64::max)
    }

    /// Whether grippers and a node that came to the mold went farther in the last time step than twice what
    /// [`Tuning::contact_way`] allows.
    fn lands_too_far(&self) -> bool {
        let most = 2.0 * self.tuning.contact_way * self.sheet.pitch;
        let pads = self.now.pads.iter().zip(&self.before.pads);
        let far = pads.into_iter().any(|(a, b)| norm(sub(a.target, b.target)) > most);
        let landing = |contact: &Contact| contact.landing_way(&self.before.x, &self.now.x) > most;
        far && self.contact.as_ref().is_some_and(landing)
    }

    fn iterate(&mut self, targets: &[[f64; 3]], dt: f64, tolerance: f64) -> Result<usize, Failure> {
        self.stretch.start(&self.now.x);
        self.aim(targets);
        self.whole = true;
        self.assemble(dt, true);
        self.leave_out();
        for iteration in 0..self.tuning.iterations {
            let mut turn = self.solve();
            if turn.is_err() && self.whole {
                self.whole = false;
                self.assemble(dt, iteration == 0);
                turn = self.solve();
            }
            let turn = turn?;
            if iteration == 0 && turn > self.tuning.turn {
                return Err(Failure::Turn);
            }
            // contact and friction that switch to and fro settle in shorter steps
            let switched = self.contact.as_ref().is_some_and(|contact| contact.changed);
            let late = iteration >= self.tuning.full_iterations;
            let most = if late && switched { 0.5 } else { 1.0 };
            let share = (self.tuning.turn / turn).min(most);
            let largest = self.take(share);
            if !largest.is_finite() {
                return Err(Failure::Singular);
            }
            if share == most && largest <= tolerance && iteration > 0 {
                return Ok(iteration + 1);
            }
            self.assemble(dt, false);
            // what a linear step neglects is the square of its turn
            let small = share == 1.0 && turn * turn * self.sheet.pitch <= tolerance;
            if small && self.is_solved(tolerance) {
                return Ok(iteration + 1);
            }
        }
        Err(Failure::Iterations)
    }

    /// Whether another step, with the matrix of the step before, moves no node by more than the tolerance (m) while the same
    /// nodes touch; it is taken then.
    fn is_solved(&mut self, tolerance: f64) -> bool {
        if self.contact.as_ref().is_some_and(|contact| contact.changed) {
            return false;
        }
        self.system.solve();
        let small =
            self.linear_step().is_ok() && self.step.iter().all(|step| norm(*step) <= tolerance);
        if small {
            self.take(1.0);
        }
        small
    }

    /// Leaves nodes out of the linear systems of this time step that lie on the mold, hardly moved in the last ones, and
    /// have only such nodes around them.
    fn leave_out(&mut self) {
        self.lies.fill(false);
        let sticks = |contact: &&Contact| self.leaves_out && contact.sticks();
        if let Some(contact) = self.contact.as_ref().filter(sticks) {
            let most = self.tuning.lying_movement * self.sheet.mesh;
            for node in contact.lying(&self.now.x, &self.system.gradient, most) {
                self.lies[node] = true;
            }
            let weight = self.sheet.gravity * self.tuning.lying_force;
            for (node, lies) in self.lies.iter_mut().enumerate() {
                *lies |= match self.system.carrier(node) {
                    Carrier::Free { .. } => {
                        norm(self.system.gradient[node]) <= weight * self.masses[node]
                    }
                    _ => norm(self.system.moved[node]) <= most,
                };
                *lies &= self.quiet[node] >= self.tuning.lying_steps;
            }
        }
        self.still.copy_from_slice(&self.lies);
        for [a, b] in self.pairs.iter().map(|pair| pair.map(|node| node as usize)) {
            self.still[a] &= self.lies[b];
            self.still[b] &= self.lies[a];
        }
        self.system.keep_still(&self.still);
    }

    /// New places of the mounts; rigid ones move their nodes in the first step.
    fn aim(&mut self, targets: &[[f64; 3]]) {
        self.system.moved.fill([0.0; 3]);
        let tool = self.sheet.tool.as_ref();
        let stem = tool.map(|tool| tool.direction(targets));
        let fixed = tool.and_then(|tool| tool.pads(targets)).map(|axes| transposed(&axes));
        let grippers = self.sheet.grippers.iter().zip(&self.held);
        for ((pad, target), (gripper, nodes)) in self.now.pads.iter_mut().zip(targets).zip(grippers)
        {
            let moved = sub(*target, pad.target);
            pad.target = *target;
            pad.stem = stem.unwrap_or(pad.stem);
            if nodes.is_empty() {
                pad.position = *target;
            }
            if gripper.mount.is_none() {
                for (node, _) in nodes {
                    self.system.moved[*node] = moved;
                }
            }
            if let Some(turn) = fixed {
                let before = std::mem::replace(&mut pad.turn, turn);
                let swings = plus(&turn, -1.0, &before);
                for (node, off) in nodes {
                    add(&mut self.system.moved[*node], 1.0, times(&swings, [off[0], off[1], 0.0]));
                }
            }
        }
    }

    /// Gradient and second derivative of the incremental potential.
    fn assemble(&mut self, dt: f64, predicts: bool) {
        let Cloth { system, now, .. } = self;
        system.begin(predicts, !predicts, |node, gripper| {
            sub(now.x[node], now.pads[gripper as usize].position)
        });
        for (node, mass) in self.masses.iter().enumerate() {
            let rate = mass / (dt * dt);
            let off = sub(now.x[node], self.inertial[node]);
            add(&mut system.gradient[node], rate, off);
            system.stiffen_scalar(node, rate);
        }
        self.add_energies();
        self.hold_pads();
        self.system.end(&self.own, self.whole);
    }

    /// Gradient and second derivative of the energy.
    fn add_energies(&mut self) {
        let Cloth { system, now, .. } = self;
        for (gradient, mass) in system.gradient.iter_mut().zip(&self.masses) {
            gradient[2] += mass * self.sheet.gravity;
        }
        self.stretch.add(&now.x, self.whole, system);
        self.shear.add(&now.x, self.whole, system);
        self.bending.add(&now.x, system);
        if let Some(contact) = &mut self.contact {
            contact.add(&now.x, system);
        }
        for ((gripper, pad), nodes) in self.sheet.grippers.iter().zip(&now.pads).zip(&self.held) {
            // a pin on a spring is a free node
            let [(node, _)] = nodes.as_slice() else { continue };
            if let Some(hold) = gripper.hold(pad, now.x[*node]) {
                add(&mut system.gradient[*node], 1.0, hold.force);
                system.stiffen(*node, &hold.stiffness);
            }
        }
    }

    /// The linear step of all nodes; returns the largest turn of a segment in it (rad).
    fn solve(&mut self) -> Result<f64, Failure> {
        self.solves += 1;
        self.system.factorize().map_err(|_| Failure::Singular)?;
        self.system.solve();
        self.linear_step()
    }

    /// Reads the linear step of all nodes; returns the largest turn of a segment in it (rad).
    fn linear_step(&mut self) -> Result<f64, Failure> {
        let system = &self.system;
        for (node, step) in self.step.iter_mut().enumerate() {
            *step = match system.carrier(node) {
                Carrier::Free { block } => system.step(block),
                Carrier::Held { .. } => system.moved[node],
                Carrier::Pad { gripper, turn, shift } => {
                    let shift = shift.map_or([0.0; 3], |shift| system.step(shift));
                    let moved = along(system.moved[node], 1.0, shift);
                    let arm = sub(self.now.x[node], self.now.pads[gripper as usize].position);
                    // the arms of a pad without a joint have swung with the frame, its middle has not
                    let (turn, middle) = match turn {
                        Some(turn) => (system.step(turn), moved),
                        None => ([0.0; 3], shift),
                    };
                    self.turns[gripper as usize] = (turn, middle);
                    sub(moved, cross(arm, turn))
                }
            };
        }
        let mut most = 0.0_f64;
        for s in &self.sheet.fabric.segments {
            let [a, b] = s.nodes.map(|node| node as usize);
            let (unit, _) = direction(self.now.x[a], self.now.x[b]);
            let aside = cross(unit, sub(self.step[b], self.step[a]));
            let turn = norm(aside) / s.length;
            // NaN is the largest of all
            if turn > most || turn.is_nan() {
                most = turn;
            }
        }
        if most.is_finite() { Ok(most.max(f64::MIN_POSITIVE)) } else { Err(Failure::Singular) }
    }

    /// Mounts and tilt limits of pads.
    fn hold_pads(&mut self) {
        self.own.clear();
        let weight = self.sheet.areal_mass * self.sheet.gravity * self.sheet.pitch.powi(3);
        for ((gripper, pad), nodes) in
            self.sheet.grippers.iter().zip(&self.now.pads).zip(&self.held)
        {
            let Some((node, _)) = nodes.first() else { continue };
            let Carrier::Pad { turn, shift, .. } = self.system.carrier(*node) else { continue };
            if let (Some(hold), Some(shift)) = (gripper.hold(pad, pad.position), shift) {
                self.system.stiffen_block(shift as usize, &hold.stiffness);
                self.own.push((shift, hold.force));
            }
            let Some(turn) = turn else { continue };
            // nodes on one line leave a turn about it free, which a small stiffness holds
            let least = self.tuning.turn_stiffness * weight;
            self.system.stiffen_block(turn as usize, &diagonal([least; 3]));
            let beyond = pad.tilt() - gripper.max_tilt;
            if beyond > 0.0 {
                let axis = cross(pad.stem, pad.normal());
                let size = norm(axis).max(f64::MIN_POSITIVE);
                let axis = axis.map(|c| c / size);
                let k = self.tuning.tilt_stiffness * weight;
                self.own.push((turn, axis.map(|c| k * beyond * c)));
                self.system.stiffen_block(turn as usize, &scaled(k, &outer(axis, axis)));
            }
        }
    }

    /// Takes a share of the linear step; returns the largest movement of a node (m).
    fn take(&mut self, share: f64) -> f64 {
        let step = &self.step;
        self.stretch.predict(&self.now.x, |n| step[n], share);
        for ((pad, nodes), (turn, moved)) in
            self.now.pads.iter_mut().zip(&self.held).zip(&self.turns)
        {
            let Some((node, _)) = nodes.first() else { continue };
            if let Carrier::Pad { turn: joint, shift, .. } = self.system.carrier(*node) {
                match (joint, shift) {
                    (None, None) => pad.position = pad.target,
                    _ => add(&mut pad.position, share, *moved),
                }
                if joint.is_some() {
                    pad.rotate(turn.map(|c| share * c));
                }
                for (node, off) in nodes {
                    self.now.x[*node] = along(pad.position, 1.0, pad.arm(*off));
                }
                continue;
            }
            if let Carrier::Free { .. } = self.system.carrier(*node) {
                add(&mut self.now.x[*node], share, self.step[*node]);
            } else {
                self.now.x[*node] = pad.target;
            }
            pad.position = self.now.x[*node];
        }
        let mut largest = 0.0_f64;
        let nodes = self.now.x.iter_mut().zip(&self.step).zip(&self.gripped);
        for ((x, step), gripped) in nodes {
            if !gripped {
                add(x, share, *step);
            }
            let moved = norm(*step);
            if moved > largest || moved.is_nan() {
                largest = moved;
            }
        }
        // in the steps that follow the grippers stand
        self.system.moved.fill([0.0; 3]);
        largest
    }

    /// Gradient of the energy at each node (N).
    #[cfg(test)]
    pub fn gradient(&mut self) -> Vec<[f64; 3]> {
        self.evaluate();
        self.system.gradient.clone()
    }

    /// The whole second derivative times a direction at each free node.
    #[cfg(test)]
    pub fn second_derivative_times(&mut self, direction: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.stretch.start(&self.now.x);
        self.whole = true;
        self.evaluate();
        self.system.multiply(direction)
    }

    /// Gradient and second derivative of the energy alone.
    fn evaluate(&mut self) {
        let now = &self.now;
        let arm = |node: usize, gripper: u32| sub(now.x[node], now.pads[gripper as usize].position);
        self.system.begin(false, false, arm);
        self.add_energies();
    }

    /// Force of the ply on each gripper (N); none on one that has let go.
    pub fn forces(&mut self) -> Vec<[f64; 3]> {
        self.evaluate();
        let gripper = |((gripper, pad), nodes): Held| match nodes.as_slice() {
            [(node, _)] if gripper.mount.is_some() => {
                let hold = gripper.hold(pad, self.now.x[*node]);
                hold.map_or([0.0; 3], |hold| hold.force)
            }
            _ => {
                nodes.iter().fold([0.0; 3], |sum, (node, _)| sub(sum, self.system.gradient[*node]))
            }
        };
        let pads = self.sheet.grippers.iter().zip(&self.now.pads).zip(&self.held);
        pads.map(gripper).collect()
    }
}

fn diagonal(k: [f64; 3]) -> Matrix3 {
    [[k[0], 0.0, 0.0], [0.0, k[1], 0.0], [0.0, 0.0, k[2]]]
}
