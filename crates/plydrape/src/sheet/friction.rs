//! What holds a touching node along the mold: a spring to its anchor, eq. (19f) of `docs/theory/sheet.md`.
//!
//! The force of the spring is at most (τ₀ + μ · pressure) · area, beyond which the anchor follows; stick has no such bound.
//! The bound is that of the time step before, so that within a time step spring and bound are an energy: quadratic up to the
//! bound, linear beyond it.

use super::Sheet;
use super::rim::Rim;
use super::tuning::SheetTuning;
use crate::geometry::vector::{along, dot, norm, sub};
use crate::layup::Friction;
use crate::sheet::matrix3::{IDENTITY, Matrix3, outer, plus, scaled};

/// Where a node touched the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// The point of the mold (m).
    pub point: [f64; 3],
    /// Normal of the mold there.
    pub normal: [f64; 3],
}

/// How nodes of an area are held along the mold.
#[derive(Debug, Clone)]
pub struct FrictionLaw {
    friction: Friction,
    /// Shear stress per way along the mold (Pa/m).
    stiffness: f64,
    /// Shear stress of the tack τ₀ (Pa).
    tack: f64,
}

/// The spring from a node to its anchor.
#[derive(Debug, Clone, Copy)]
pub struct Spring {
    /// Way from the anchor to the node (m), along the mold.
    off: [f64; 3],
    /// Length of that way (m).
    size: f64,
    /// Stiffness up to the bound (N/m).
    k: f64,
    /// Largest force (N).
    bound: f64,
    /// Whether the force is at its bound.
    pub slips: bool,
}

impl Spring {
    /// Energy of the spring (J): beyond the bound it grows with the way.
    pub fn energy(&self) -> f64 {
        match self.slips {
            true => self.bound * (self.size - 0.5 * self.bound / self.k),
            false => 0.5 * self.k * self.size * self.size,
        }
    }

    /// Force per way (N/m): the stiffness, and less where the spring slips.
    fn secant(&self) -> f64 {
        if self.slips { self.bound / self.size } else { self.k }
    }
}

impl FrictionLaw {
    /// How the nodes of a sheet are held along its mold.
    pub fn new(sheet: &Sheet, tuning: &SheetTuning) -> Self {
        let share = match sheet.friction {
            Friction::Coulomb(_) => tuning.slip,
            Friction::Stick | Friction::StickForEver => tuning.contact_depth,
        };
        let (friction, tack) = (sheet.friction, sheet.tack);
        FrictionLaw { friction, stiffness: penalty(sheet, share), tack }
    }

    /// Largest force (N) of the spring of a node with its area (m²) under a pressure (Pa).
    pub fn bound(&self, pressure: f64, area: f64) -> f64 {
        match self.friction {
            Friction::Coulomb(mu) => (self.tack + mu * pressure) * area,
            Friction::Stick | Friction::StickForEver => f64::INFINITY,
        }
    }

    /// The spring of a node at a place `x` (m) to its anchor, with its area (m²) and the bound of its force (N).
    pub fn spring(&self, anchor: Anchor, x: [f64; 3], area: f64, bound: f64) -> Spring {
        let off = self.offset(anchor, x);
        let (size, k) = (norm(off), self.stiffness * area);
        let slips = matches!(self.friction, Friction::Coulomb(_)) && k * size > bound;
        Spring { off, size, k, bound, slips }
    }

    /// Gradient (N) and stiffness (N/m) of a spring to an anchor; `None` if it holds nothing.
    pub fn derivatives(&self, spring: &Spring, anchor: Anchor) -> Option<([f64; 3], Matrix3)> {
        let secant = spring.secant();
        if secant == 0.0 {
            return None;
        }
        let stiff = |unit: [f64; 3]| outer(unit.map(|c| secant * c), unit);
        let mut k = scaled(secant, &IDENTITY);
        if !self.lasts() {
            k = plus(&k, -1.0, &stiff(anchor.normal));
        }
        // beyond the bound the force stays along the way, and only turns aside
        if spring.slips {
            k = plus(&k, -1.0, &stiff(spring.off.map(|c| c / spring.size)));
        }
        Some((spring.off.map(|c| secant * c), k))
    }

    /// An anchor that follows a node at `x` (m) with its area (m²) so that the force of the spring is within its bound (N).
    pub fn follow(&self, mold: Rim, anchor: Anchor, x: [f64; 3], area: f64, bound: f64) -> Anchor {
        let most = bound / (self.stiffness * area);
        let off = self.offset(anchor, x);
        let size = norm(off);
        if size <= most {
            return anchor;
        }
        let closest = mold.closest_point(along(anchor.point, 1.0 - most / size, off));
        Anchor { point: closest.point, normal: closest.normal }
    }

    /// How far a node at `x` (m) is from its anchor, along the mold (m).
    fn offset(&self, anchor: Anchor, x: [f64; 3]) -> [f64; 3] {
        let off = sub(x, anchor.point);
        match self.friction {
            Friction::StickForEver => off,
            _ => along(off, -dot(off, anchor.normal), anchor.normal),
        }
    }

    /// Whether an anchor stays where it is as long as its node touches.
    pub fn sticks(&self) -> bool {
        !matches!(self.friction, Friction::Coulomb(_))
    }

    /// Whether an anchor stays for ever, and holds its node along the normal too.
    pub fn lasts(&self) -> bool {
        self.friction == Friction::StickForEver
    }
}

/// Stiffness of a penalty (Pa/m) under which the ply's own weight moves a point by a share of the pitch.
pub fn penalty(sheet: &Sheet, share: f64) -> f64 {
    sheet.areal_mass * sheet.gravity / (share * sheet.pitch)
}
