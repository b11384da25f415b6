//! The ply in motion: its configuration, the terms of its energy, and the linear system of its unknowns.
//!
//! [`super::newton`] moves it by time steps.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energies, Phase};
use super::gripper::Pad;
use super::pads::Pads;
use super::resting::Resting;
use super::system::System;
use super::tuning::SheetTuning;
use super::unknowns::{carriers, coupled_pairs};

/// The ply in motion.
#[derive(Debug)]
pub struct Cloth<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) tuning: SheetTuning,
    /// What the motion does.
    pub phase: Phase,
    /// Where the ply is.
    pub now: Configuration,
    /// Where the ply was before the last time step.
    pub(super) before: Configuration,
    /// The pads, and the nodes that they hold.
    pub pads: Pads<'a>,
    /// The terms of the energy.
    pub energies: Energies<'a>,
    /// The linear system of the unknowns.
    pub(super) system: System,
    /// Which nodes lie.
    pub resting: Resting,
    /// Solved linear systems.
    pub solves: usize,
}

impl<'a> Cloth<'a> {
    /// The ply of a sheet at rest with its nodes at `x` (m), held by all of its pads.
    pub fn new(sheet: &'a Sheet, tuning: SheetTuning, x: Vec<[f64; 3]>, pads: Vec<Pad>) -> Self {
        let now = Configuration::at_rest(x, pads);
        let pads = Pads::new(sheet);
        let system = system(sheet, &pads);
        Cloth {
            sheet,
            tuning,
            phase: Phase::Rest,
            before: now.clone(),
            now,
            energies: Energies::new(sheet, &tuning, &pads, &system),
            pads,
            system,
            resting: Resting::new(sheet, &tuning),
            solves: 0,
        }
    }

    /// Lets go of the ply with the pads of some grippers, from now on. Their nodes move and touch as all others do; those of
    /// them that lie on the mold now stay where they are as far as friction holds them.
    pub fn release(&mut self, grippers: &[usize]) {
        for gripper in grippers {
            let nodes = self.pads.let_go(*gripper, &mut self.now);
            self.resting.wake(&nodes);
        }

        // there are other unknowns now; the mold knows where the nodes were
        self.system = system(self.sheet, &self.pads);
        let energies = Energies::new(self.sheet, &self.tuning, &self.pads, &self.system);
        let before = std::mem::replace(&mut self.energies, energies);
        self.energies.shear.take_over(before.shear);
        if before.table.is_none() {
            self.energies.table = None;
        }
        if let (Some(contact), Some(before)) = (&mut self.energies.contact, before.contact) {
            contact.take_over(before, &self.now.x);
        }
    }

    /// Energy without inertia (J).
    pub fn energy(&self) -> f64 {
        self.energies.potential().map(|term| term.value(&self.now)).sum()
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self) -> f64 {
        self.energies.inertia.kinetic_energy(&self.now)
    }

    /// Tension of a segment per width (N/m).
    pub fn tension(&self, segment: usize) -> f64 {
        self.energies.stretch.tension(segment, &self.now.x)
    }

    /// Force of the ply on each gripper (N); zero on one that has let go.
    pub fn forces(&mut self) -> Vec<[f64; 3]> {
        self.linearize_potential();
        self.pads.forces(&self.now, &self.system.gradient)
    }

    /// The nodes that touch the mold.
    pub fn touching(&self) -> impl Iterator<Item = usize> {
        self.energies.contact.iter().flat_map(|contact| contact.touching())
    }

    /// Largest movement of a node in the last time step (m).
    pub fn movement(&self) -> f64 {
        self.now.movements(&self.before).fold(0.0, f64::max)
    }

    /// Longest time step (s), if not longer than `enough`, in which free nodes come to the mold by no more than the way that
    /// [`SheetTuning::contact_way`] allows, if they go on as in the last one.
    pub fn longest_step(&mut self, enough: f64) -> f64 {
        let most = self.tuning.contact_way * self.sheet.pitch;
        match &mut self.energies.contact {
            Some(contact) => contact.longest_time(&self.now.x, &self.now.v, most, enough),
            None => enough,
        }
    }
}

/// The linear system of a sheet that is held by pads.
fn system(sheet: &Sheet, pads: &Pads) -> System {
    let (carriers, blocks) = carriers(sheet, pads.held());
    System::new(carriers, blocks, pads.held().len(), &coupled_pairs(sheet))
}
