//! One implicit time step, by Newton's method.
//!
//! The positions after a time step Δt are where the incremental potential Σ m/(2 Δt²) |x − x̂|² + E(x), x̂ = x + Δt v, is
//! stationary, eq. (19g) of `docs/theory/sheet.md`. The first linear step moves the grippers within the linear system; the
//! tension that turns segments is the one that the linear step before predicts ([`super::stretch`]), so that full steps are
//! taken. The numbers of the stages are those of the table on that page.

use super::cloth::Cloth;
use super::energy::{Energies, Phase, Stiffness};
use super::system::Parts;
use crate::geometry::vector::{norm, sub};

/// Why a time step was not solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Failure {
    /// Newton's iteration did not come to an end.
    Iterations,
    /// The first step turns segments by an angle (rad) that is too far to be linear.
    Turn(f64),
    /// A node came to the mold from too far away.
    Landing,
    /// The matrix is not positive definite, or a number is not finite.
    Singular,
}

impl Cloth<'_> {
    /// Moves the ply by one time step of `dt` (s) in which the grippers go to `targets` (m), solved to steps of `tolerance`
    /// (m). Returns the iterations.
    ///
    /// # Errors
    /// If the time step is not solved; nothing has moved then.
    pub fn advance(
        &mut self,
        targets: &[[f64; 3]],
        dt: f64,
        tolerance: f64,
    ) -> Result<usize, Failure> {
        self.before.copy_from(&self.now);

        // 1. inertia predicts where the nodes go without forces, and resin begins to flow; a ply that is hung has no time
        self.energies.inertia.predict(&self.now, dt);
        let flowing = if self.phase == Phase::Hang { f64::INFINITY } else { dt };
        self.energies.shear.begin(&self.now.x, flowing);

        // 2. the grippers aim at their next places
        self.pads.aim(targets, &mut self.now, &mut self.system);

        // 3. to 9. Newton's iteration
        let found = self.iterate(tolerance);
        self.system.free_all();

        // 10. a step that cannot be trusted is taken back
        let found = found.and_then(|iterations| self.check_landing().map(|()| iterations));
        if found.is_err() {
            self.now.copy_from(&self.before);
            return found;
        }

        // 11. the positions give the velocities, and what resin holds
        self.now.set_velocities(&self.before, dt);
        self.energies.shear.end(&self.now.x);

        // 12. fabric slides under pads
        self.pads.slide(&mut self.now);

        // 13. anchors follow nodes that touch
        if let Some(contact) = &mut self.energies.contact
            && self.phase != Phase::Hang
        {
            contact.anchor(&self.now.x);
        }

        // 14. a table that the ply has left is gone
        let Cloth { energies, now, phase, .. } = self;
        energies.table.take_if(|table| *phase == Phase::Follow && table.is_left(&now.x));

        // 15. nodes that did not move while the grippers did come to rest
        if self.phase == Phase::Follow {
            self.resting.count(&self.now, &self.before);
        }
        found
    }

    /// Finds the configuration in which the incremental potential is stationary, to steps of `tolerance` (m). Returns the
    /// iterations.
    fn iterate(&mut self, tolerance: f64) -> Result<usize, Failure> {
        let mut stiffness = Stiffness::WHOLE;
        self.energies.stretch.start(&self.now.x);

        // 3. gradient and stiffness of all terms
        self.find_contacts();
        self.assemble(stiffness, Parts::All);

        // 4. nodes that lie are no unknowns
        self.leave_out();

        let mut before = 0.0;
        for iteration in 0..self.tuning.iterations {
            // 5. the linear step, with less of the negative parts where the whole stiffness is not positive definite
            let turn = loop {
                match (self.solve(), stiffness.less()) {
                    (Err(_), Some(less)) => {
                        stiffness = less;
                        self.assemble(stiffness, Parts::All);
                    }
                    (found, _) => break found?,
                }
            };
            if iteration == 0 && turn > self.tuning.turn {
                return Err(Failure::Turn(turn));
            }

            // 6. the share of it that is taken
            let most = self.largest_share(iteration);
            let share = (self.tuning.turn / turn).min(most);

            // 7. the step is taken
            let largest = self.take(share)?;
            self.find_contacts();
            let left = self.left(iteration, largest, before, stiffness);
            if share == most && iteration > 0 && left <= tolerance {
                return Ok(iteration + 1);
            }
            // nothing is known after a part of a step
            before = if share == 1.0 { largest } else { 0.0 };

            // 8. one more step with the matrix of the step before, where what a linear step neglects, the square of its turn, is
            //    small; if it is small too, it is the last one
            let neglected = turn * turn * self.sheet.pitch;
            if share == 1.0 && neglected <= tolerance && !self.has_switched() {
                self.assemble(stiffness, Parts::Gradient);
                let correction = self.correct();
                if correction.is_some_and(|largest| largest <= tolerance) {
                    self.take(1.0)?;
                    return Ok(iteration + 1);
                }
            }

            // 9. nodes that hardly moved are no unknowns of the iterations that follow
            if share == 1.0 {
                self.narrow(tolerance);
            }

            // 3. again, where the nodes are now
            self.assemble(stiffness, Parts::All);
        }
        Err(Failure::Iterations)
    }

    /// What tells whether a whole step of an iteration was its last one (m), by the largest movement of a node in it and in the
    /// whole step before it (m).
    fn left(&self, iteration: usize, largest: f64, before: f64, stiffness: Stiffness) -> f64 {
        if self.has_switched() {
            return largest;
        }
        if stiffness == Stiffness::WHOLE {
            // each step goes with the square of the one before
            let next = largest * (largest / before).powi(2);
            return largest.min(self.tuning.next_step * next);
        }
        // a ply that buckles creeps, and goes on in the time steps that follow
        let creeps = iteration >= self.tuning.creep_iterations;
        if creeps { largest / self.tuning.creep } else { largest }
    }

    /// Finds where the mold presses nodes, and which of them slip.
    fn find_contacts(&mut self) {
        let Cloth { energies, system, now, .. } = self;
        if let Some(contact) = &mut energies.contact {
            contact.find(&now.x, |node| system.skips(&[node]));
        }
        if let Some(table) = &mut energies.table {
            table.find(&now.x);
        }
    }

    /// Assembles gradient and stiffness of the incremental potential (19g) with the contacts that were found last, or the gradient alone.
    fn assemble(&mut self, stiffness: Stiffness, parts: Parts) {
        self.system.begin(&self.now, parts);
        for term in self.energies.incremental() {
            term.linearize(&self.now, stiffness, &mut self.system);
        }
        self.system.end(stiffness);
    }

    /// Gradient and whole stiffness of the energy (19) alone, of all nodes.
    pub(super) fn linearize_potential(&mut self) {
        self.find_contacts();
        self.system.begin(&self.now, Parts::All);
        for term in self.energies.potential() {
            term.linearize(&self.now, Stiffness::WHOLE, &mut self.system);
        }
    }

    /// Leaves nodes that lie among others out of the linear systems of this time step, while the grippers move.
    fn leave_out(&mut self) {
        let contact = self.energies.contact.as_ref().filter(|_| self.phase == Phase::Follow);
        self.resting.leave_out(&self.now, contact, &self.energies.weight, &mut self.system);
    }

    /// Leaves nodes out of the linear systems that follow in this time step, while the grippers move, that no node near by moved
    /// beyond the tolerance (m) in the linear step.
    fn narrow(&mut self, tolerance: f64) {
        if self.phase == Phase::Follow {
            self.resting.narrow(tolerance, &mut self.system);
        }
    }

    /// Solves for the linear step of all nodes; returns the largest turn of a segment in it (rad).
    fn solve(&mut self) -> Result<f64, Failure> {
        self.solves += 1;
        self.system.factorize().map_err(|_| Failure::Singular)?;
        self.system.solve();
        self.largest_turn().ok_or(Failure::Singular)
    }

    /// Largest turn of a segment in the linear step (rad), above zero; `None` if a number is not finite.
    fn largest_turn(&self) -> Option<f64> {
        let turn = self.energies.stretch.largest_turn(&self.now.x, &self.system.step);
        turn.is_finite().then(|| turn.max(f64::MIN_POSITIVE))
    }

    /// Largest share of a linear step that is taken: contact and friction that switch to and fro converge in shorter steps.
    fn largest_share(&self, iteration: usize) -> f64 {
        let late = iteration >= self.tuning.full_iterations;
        if late && self.has_switched() { 0.5 } else { 1.0 }
    }

    /// Whether other nodes touch or slip than in the iteration before.
    fn has_switched(&self) -> bool {
        let Energies { contact, table, .. } = &self.energies;
        let of_mold = contact.as_ref().is_some_and(|contact| contact.switched);
        of_mold || table.as_ref().is_some_and(|table| table.switched)
    }

    /// Takes a share of the linear step; returns the largest movement of a node in a whole one (m).
    fn take(&mut self, share: f64) -> Result<f64, Failure> {
        let Cloth { energies, pads, system, now, .. } = self;
        energies.stretch.predict(&now.x, &system.step, share);
        pads.take(share, now, system);

        // in the steps that follow the grippers stand
        system.moved.fill([0.0; 3]);
        let largest = self.largest_step();
        if largest.is_finite() { Ok(largest) } else { Err(Failure::Singular) }
    }

    /// Solves once more with the matrix that was factorized last; returns the largest movement of a node in this linear step
    /// (m), `None` if a number is not finite.
    fn correct(&mut self) -> Option<f64> {
        self.system.solve();
        self.largest_turn().map(|_| self.largest_step())
    }

    /// Largest movement of a node in the linear step (m); `NaN` if a number is not finite.
    fn largest_step(&self) -> f64 {
        let largest = |most: f64, step: &[f64; 3]| {
            let moved = norm(*step);
            if moved > most || moved.is_nan() { moved } else { most }
        };
        self.system.step.iter().fold(0.0, largest)
    }

    /// Refuses a time step in which grippers and a node that came to the mold went farther than twice what
    /// [`super::SheetTuning::contact_way`] allows.
    fn check_landing(&self) -> Result<(), Failure> {
        let most = 2.0 * self.tuning.contact_way * self.sheet.pitch;
        let mut pads = self.now.pads.iter().zip(&self.before.pads);
        let far = pads.any(|(a, b)| norm(sub(a.target, b.target)) > most);
        let contact = self.energies.contact.as_ref().filter(|_| far);
        let way = contact.map(|contact| contact.landing_way(&self.before.x, &self.now.x));
        if way.is_some_and(|way| way > most) { Err(Failure::Landing) } else { Ok(()) }
    }

    /// Gradient of the energy at each node (N).
    #[cfg(test)]
    pub fn gradient(&mut self) -> Vec<[f64; 3]> {
        self.linearize_potential();
        self.system.gradient.clone()
    }
}
