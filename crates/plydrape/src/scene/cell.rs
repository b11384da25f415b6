//! Named cells: what holds the ply and how far it may be off, with a source for each figure.
//!
//! A preset gives what a scene leaves out of its grippers, its release and its errors. It describes no machine: the figures are of usual size, and those of
//! your own cell are better.

use crate::errors::{Errors, Term};
use crate::layup::{Lip, PadSettings, ReleaseOrder, Settings};

/// What a scene takes of its cell where it does not say so itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// How grippers hold the ply; its radius is never that of a cell.
    pub pad: PadSettings,
    /// Largest tilt of the ball joints (rad).
    pub max_tilt: f64,
    /// In which order pads let go of a ply on a mold; `None` if they hold it to the end.
    pub release: Option<ReleaseOrder>,
    /// How long pads press before they let go (s).
    pub dwell: f64,
    /// How far the cell may be from the scene, if that is known.
    pub errors: Option<Errors>,
}

/// A cell that holds the ply rigidly and to the end, and has no errors.
impl Default for Cell {
    fn default() -> Self {
        let usual = Settings::default();
        Cell { pad: usual.pad, max_tilt: usual.max_tilt, release: None, dwell: 0.0, errors: None }
    }
}

/// A named cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellPreset {
    /// Vacuum cups with bellows on a robot, which let go of the ply, and the scatter of a ply.
    Usual,
    /// Rigid grippers that hold the ply to the end, and no errors.
    Ideal,
}

/// One figure of a named cell.
#[derive(Debug, Clone, Copy)]
pub struct CellFigure {
    /// Key in a scene, such as `grippers.slip_force`.
    pub key: &'static str,
    /// Value as a scene writes it, such as `10 N`.
    pub written: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// The value (SI); 0 of a word.
    value: f64,
    /// Where the value goes.
    set: fn(&mut Cell, f64),
}

/// A lip whose figures follow.
const NO_LIP: Lip = Lip { radius: 0.0, rigidity: 0.0 };

/// How large a cup is.
const CUP_SIZE: &str =
    "the cups of 30 mm whose forces the other figures are; a choice of this program";
/// How stiff its lip is.
const RUBBER: &str = "lips of vacuum cups are of rubber of 35 to 70 Shore A (Fluid Power Journal, Basic vacuum cup selection), which is a modulus of 1.5 to 10 MPa \
(Reuss: lg E = 0.0235 S - 0.64), and 0.5 to 1.5 mm thick, by experience: 2e-5 to 4e-3 N m; the value is the geometric mean of that range";
/// How far bellows give.
const BELLOWS: &str = "bellows of vacuum cups give by 1 to 5 N/mm, sideways and along their axis, by experience; the value is a \
choice of this program within that range";
/// What a cup holds.
const CUPS: &str = "vacuum cups of 30 mm hold 4 to 10 N along a porous ply and 14 to 28 N across it, by experience; the value is a choice of \
this program within that range";
/// The range of ball joints.
const JOINTS: &str =
    "a choice of this program, its default limit of ball joints; no source gives it";
/// How far a robot is off.
const ROBOT: &str = "a robot was within 0.65 mm of its place: M. Slamani, A. Nubiola, I. Bonev 2012, Assessment of the positioning performance \
of an industrial robot, ABB IRB 1600 by laser tracker; how much of that the grippers share is a choice of this program";
/// How far grippers are off from each other.
const GRIPPERS: &str = "robots repeat their place within 0.02 to 0.1 mm, that of Slamani, Nubiola, Bonev 2012 within 0.04 mm; that grippers \
differ from each other by as much is a choice of this program";
/// Where a ply is picked up.
const PICK_UP: &str = "a choice of this program: how far a cut ply is from its place on the table, as the frame; no source gives it";
/// When a cell lets go.
const LETS_GO: &str = "a cell switches its vacuum off before it takes the next ply, and what counts is the ply that then lies on the mold; the order is a choice of \
this program";
/// Scatter without a source.
const SCATTER: &str = "a choice of this program for a woven ply; no source gives it";
/// Scatter of shear.
const SHEAR: &str = "at 20 deg six laboratories measured 17 to 44 N/m of one plain weave in picture frames, and 6 to 11 N/m in bias extension: \
Cao et al. 2008, Composites Part A 39; the factor is a choice of this program";

/// The figures of the usual cell.
const USUAL: &[CellFigure] = &[
    figure("grippers.lip.radius", "15 mm", 0.015, CUP_SIZE, |cell, x| {
        cell.pad.lip = Some(Lip { radius: x, ..cell.pad.lip.unwrap_or(NO_LIP) });
    }),
    figure("grippers.lip.rigidity", "0.0003 N m", 3e-4, RUBBER, |cell, x| {
        cell.pad.lip = Some(Lip { rigidity: x, ..cell.pad.lip.unwrap_or(NO_LIP) });
    }),
    figure("grippers.stiffness.lateral", "2 N/mm", 2e3, BELLOWS, |cell, x| {
        cell.pad.lateral_stiffness = Some(x);
    }),
    figure("grippers.stiffness.axial", "2 N/mm", 2e3, BELLOWS, |cell, x| {
        cell.pad.axial_stiffness = Some(x);
    }),
    figure("grippers.slip_force", "10 N", 10.0, CUPS, |cell, x| cell.pad.slip_force = Some(x)),
    figure("grippers.holding_force", "20 N", 20.0, CUPS, |cell, x| {
        cell.pad.holding_force = Some(x)
    }),
    figure("grippers.max_tilt", "40 deg", 40_f64.to_radians(), JOINTS, |cell, x| cell.max_tilt = x),
    figure("release.order", "hollows-first", 0.0, LETS_GO, |cell, _| {
        cell.release = Some(ReleaseOrder::HollowsFirst);
    }),
    figure("errors.frame.position.bound", "0.5 mm", 5e-4, ROBOT, |cell, x| {
        errors(cell).frame.position = Term::Bound(x);
    }),
    figure("errors.gripper.position.deviation", "0.1 mm", 1e-4, GRIPPERS, |cell, x| {
        errors(cell).gripper.position = Term::Deviation(x);
    }),
    figure("errors.pick_up.offset.bound", "0.5 mm", 5e-4, PICK_UP, |cell, x| {
        errors(cell).pick_up.offset = Term::Bound(x);
    }),
    figure("errors.pick_up.yaw.bound", "0.2 deg", 0.2_f64.to_radians(), PICK_UP, |cell, x| {
        errors(cell).pick_up.yaw = Term::Bound(x);
    }),
    figure("errors.material.areal_mass.deviation", "5 %", 0.05, SCATTER, |cell, x| {
        errors(cell).material.areal_mass = Term::Deviation(x);
    }),
    figure("errors.material.bending.deviation", "30 %", 0.3, SCATTER, |cell, x| {
        errors(cell).material.bending = Term::Deviation(x);
    }),
    figure("errors.material.shear.factor", "2", 2.0, SHEAR, |cell, x| {
        errors(cell).material.shear = Term::Factor(x);
    }),
    figure("errors.material.length.deviation", "0.05 %", 5e-4, SCATTER, |cell, x| {
        errors(cell).material.length = Term::Deviation(x);
    }),
];

const fn figure(
    key: &'static str,
    written: &'static str,
    value: f64,
    source: &'static str,
    set: fn(&mut Cell, f64),
) -> CellFigure {
    CellFigure { key, written, source, value, set }
}

/// The errors of a cell that has some.
fn errors(cell: &mut Cell) -> &mut Errors {
    cell.errors.get_or_insert_default()
}

impl CellPreset {
    /// All of them.
    pub const ALL: &[CellPreset] = &[CellPreset::Usual, CellPreset::Ideal];

    /// Name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            CellPreset::Usual => "usual",
            CellPreset::Ideal => "ideal",
        }
    }

    /// What it is, in a line.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            CellPreset::Usual => {
                "vacuum cups with bellows and lips, which let go of the ply, and errors of usual size"
            }
            CellPreset::Ideal => {
                "grippers that are rigid and hold any load to the end, without errors"
            }
        }
    }

    /// Figures, each with its source; the ideal cell has none.
    #[must_use]
    pub fn figures(self) -> &'static [CellFigure] {
        match self {
            CellPreset::Usual => USUAL,
            CellPreset::Ideal => &[],
        }
    }

    /// The cell of these figures.
    #[must_use]
    pub fn cell(self) -> Cell {
        let mut cell = Cell::default();
        for figure in self.figures() {
            (figure.set)(&mut cell, figure.value);
        }
        cell
    }
}
