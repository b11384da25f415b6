//! The energy of the ply as a sum of terms that all have one interface, eq. (19) and (19g) of `docs/theory/sheet.md`.

use super::bending::Bending;
use super::configuration::Configuration;
use super::contact::Contact;
use super::inertia::Inertia;
use super::mount::Mounts;
use super::pads::Pads;
use super::shear::Shear;
use super::stretch::Stretch;
use super::system::System;
use super::table::Table;
use super::weight::Weight;
use super::{Sheet, SheetTuning};

/// How much of the stiffness of an energy, its second derivative, is added: the positive part of each element, and a share of
/// the negative one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Share of the negative parts.
    negative: f64,
}

impl Stiffness {
    /// All of it, with which Newton's iteration converges fastest; the matrix may not be positive definite.
    pub const WHOLE: Self = Stiffness { negative: 1.0 };
    /// The positive part of each element, a positive semi-definite matrix.
    pub const POSITIVE: Self = Stiffness { negative: 0.0 };

    /// The next smaller share of the negative parts, where the matrix is not positive definite with this one; `None` below the
    /// positive parts alone.
    pub fn less(self) -> Option<Self> {
        let half = Stiffness { negative: 0.5 };
        match self.negative {
            0.0 => None,
            1.0 => Some(half),
            _ => Some(Self::POSITIVE),
        }
    }

    /// What is added of a coefficient that makes its part of an element positive or negative.
    pub fn keep(self, coefficient: f64) -> f64 {
        coefficient.max(0.0) + self.negative * coefficient.min(0.0)
    }

    /// The share of the negative parts.
    pub fn negative(self) -> f64 {
        self.negative
    }
}

/// A term of the energy.
pub trait Energy {
    /// The value in a configuration (J).
    fn value(&self, now: &Configuration) -> f64;

    /// Adds gradient (N) and stiffness (N/m) to the linear system. The two share their geometry, so they are found together.
    /// Elements whose nodes all stay where they are ([`System::skips`]) may be left out.
    fn linearize(&self, now: &Configuration, stiffness: Stiffness, system: &mut System);
}

/// What a motion of the ply does, which decides which terms act and which nodes are unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The ply is hung at its start: nothing rubs.
    Hang,
    /// The grippers move: nodes that lie among others are left out of the linear systems.
    Follow,
    /// The grippers stand until the ply is at rest: all nodes are unknowns.
    Rest,
}

/// All terms of the energy of a ply.
#[derive(Debug)]
pub struct Energies<'a> {
    /// Inertia over the time step.
    pub inertia: Inertia,
    /// Weight.
    pub weight: Weight,
    /// Stretch of the yarns.
    pub stretch: Stretch,
    /// Shear of the cells.
    pub shear: Shear,
    /// Bending of the lines.
    pub bending: Bending,
    /// Contact with the mold, and friction there; `None` without a mold.
    pub contact: Option<Contact<'a>>,
    /// Mounts and tilt limits of the pads.
    pub mounts: Mounts<'a>,
    /// The table on which the ply lies; `None` once the ply has left it.
    pub table: Option<Table>,
}

impl<'a> Energies<'a> {
    /// The terms of a sheet that is held by pads, whose unknowns are those of `system`.
    pub fn new(sheet: &'a Sheet, tuning: &SheetTuning, pads: &Pads, system: &System) -> Self {
        let fabric = &sheet.fabric;
        let masses: Vec<f64> = fabric.areas.iter().map(|area| area * sheet.areal_mass).collect();
        Energies {
            inertia: Inertia::new(&masses),
            weight: Weight::new(masses, sheet.gravity),
            stretch: Stretch::new(&fabric.segments, sheet.tension.clone(), system),
            shear: Shear::new(sheet, system),
            bending: Bending::new(sheet, pads, system),
            contact: sheet
                .mold
                .as_ref()
                .map(|mold| Contact::new(sheet, mold, tuning, pads, system)),
            mounts: Mounts::new(sheet, tuning, pads, system),
            table: Table::new(sheet, tuning, system),
        }
    }

    /// The terms of the ply's energy, eq. (19): all but inertia.
    pub fn potential(&self) -> impl Iterator<Item = &dyn Energy> {
        let Energies { weight, stretch, shear, bending, mounts, .. } = self;
        let elastic: [&dyn Energy; 4] = [weight, stretch, shear, bending];
        let contact = self.contact.as_ref().map(|contact| contact as &dyn Energy);
        let table = self.table.as_ref().map(|table| table as &dyn Energy);
        elastic.into_iter().chain(contact).chain([mounts as &dyn Energy]).chain(table)
    }

    /// The terms of the incremental potential, eq. (19g).
    pub fn incremental(&self) -> impl Iterator<Item = &dyn Energy> {
        [&self.inertia as &dyn Energy].into_iter().chain(self.potential())
    }
}
