//! The input of a net: the fabric, where it starts on the mold, and how its generators run.

use super::edge::EdgeRule;
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::vector::{along, cross, dot, unit};
use crate::mold::Mold;
use crate::ply::Outline;

/// How the two generators run, the lines of nodes through the seed from which all others follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Generators {
    /// Straight on over the mold.
    #[default]
    Geodesic,
    /// Cell by cell so that each keeps the pre-shear, after Krogh et al. 2021.
    LeastShear,
}

/// A ply to be laid on a mold as a net.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Placement {
    /// Nodes along u and v.
    pub nodes: [usize; 2],
    /// Mesh widths: fabric between neighboring nodes along u and v (m).
    pub mesh: [f64; 2],
    /// Fabric coordinates of node [0, 0] (m).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub origin: [f64; 2],
    /// The node that is placed first.
    pub seed: [usize; 2],
    /// Where it lies on the mold (m).
    pub place: [f64; 3],
    /// Direction of u there, seen in plan from x towards y (rad): of its tangent, or of the first bar.
    pub heading: f64,
    /// Pre-shear γ (rad): v is at 90° − γ from u, to the left of u seen from outside.
    pub shear: f64,
    /// How the generators run.
    pub generators: Generators,
    /// How the fabric between neighboring nodes is measured.
    pub edges: EdgeRule,
}

/// Whether coordinates need not be written.
#[cfg(feature = "serde")]
fn is_zero(origin: &[f64; 2]) -> bool {
    *origin == [0.0; 2]
}

impl Placement {
    /// Fabric coordinates of a node (m).
    #[must_use]
    pub fn fabric(&self, node: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|n| self.origin[n] + node[n] as f64 * self.mesh[n])
    }

    /// The rectangle of all that the net covers; `None` for a strip without width.
    pub(super) fn outline(&self) -> Option<Outline> {
        Outline::rectangle(self.origin, self.fabric(self.nodes.map(|n| n - 1))).ok()
    }

    /// The node at a fabric point (m); `None` where there is none.
    #[must_use]
    pub fn node(&self, uv: [f64; 2]) -> Option<[usize; 2]> {
        let share = [0, 1].map(|n| (uv[n] - self.origin[n]) / self.mesh[n]);
        let is_node = |n: usize| {
            let nearest = share[n].round();
            (share[n] - nearest).abs() <= TUNING.boundary_rounding
                && nearest >= 0.0
                && nearest < self.nodes[n] as f64
        };
        (is_node(0) && is_node(1)).then(|| share.map(|s| s.round() as usize))
    }

    /// Whether a net can be begun: sensible numbers, and a seed on the mold.
    pub(super) fn check(&self, mold: &Mold) -> Result<(), Error> {
        let ([nu, nv], [du, dv], [i, j]) = (self.nodes, self.mesh, self.seed);
        if nu == 0 || nv == 0 {
            return Err(Error::NetNoNodes { nu, nv });
        }
        if ![du, dv].iter().all(|d| d.is_finite() && *d > 0.0) {
            return Err(Error::NetMeshWidth { du, dv });
        }
        if i >= nu || j >= nv {
            return Err(Error::NetSeedNode { i, j, nu, nv });
        }
        if !self.heading.is_finite()
            || self.shear.is_nan()
            || self.shear.abs() > TUNING.largest_shear
        {
            let [shear_deg, heading_deg] = [self.shear, self.heading].map(f64::to_degrees);
            return Err(Error::NetShear { shear_deg, heading_deg });
        }
        let closest = mold.closest_point(self.place);
        if closest.beyond
            || closest.distance.is_nan()
            || closest.distance.abs() > TUNING.seed_distance * du.min(dv)
        {
            return Err(Error::NetSeedPlace { distance_mm: closest.distance.abs() * 1e3 });
        }
        Ok(())
    }

    /// Unit tangents of u and v at the seed, where the mold has this unit normal.
    pub(super) fn directions(&self, normal: [f64; 3]) -> Result<[[f64; 3]; 2], Error> {
        let (sin, cos) = self.heading.sin_cos();
        if normal[2].abs() < TUNING.upright {
            return Err(Error::NetUpright);
        }
        // lifted straight up into the tangent plane
        let rise = -(cos * normal[0] + sin * normal[1]) / normal[2];
        let u = unit([cos, sin, rise]).unwrap_or([cos, sin, 0.0]);
        Ok([u, self.across(u, normal)])
    }

    /// Unit tangent of v beside the unit tangent `u`, turned left by 90° − γ.
    pub(super) fn across(&self, u: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let left = cross(normal, u);
        let (sin, cos) = self.shear.sin_cos();
        let v = along(left.map(|x| cos * x), sin, u);
        along(v, -dot(v, normal), normal)
    }
}
