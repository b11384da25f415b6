//! Fiber angle: the largest angle along the mold, at the end, between fabric that has landed and the same fabric in the ideal drape. Of a
//! line it is that from end to end of what has landed of it, of a cell that of its two mid-lines.

use super::out_of_plane::parts;
use super::{Description, Found, Measure, Most, Observation, Scope, Unit, UsualLimit};
use crate::geometry::vector::{cross, dot, norm, unit};
use crate::layup::Layup;

/// Fiber angle; see the head of this file.
pub struct FibreAngle;

impl Measure for FibreAngle {
    fn description(&self) -> Description {
        let own = Description::new("fibre_angle", "fibre_angle_deg", "fiber angle", Unit::DEGREE);
        Description { scope: Scope::End, ..own }
    }

    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(3_f64.to_radians(), "a usual tolerance of ply angles, ±3°")
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for line in &seen.state.lines {
            if let Some(angle) = line.fiber_angle {
                most.meet(angle.to_degrees(), line.site, line.place);
            }
        }

        // cells against the ideal drape
        let ideal = seen.layup.target.as_ref().and_then(|target| target.drape.as_deref());
        if let (Some(mold), Some(ideal)) = (&seen.layup.mold, ideal) {
            for cell in &seen.state.cells {
                let Some((_, uv)) = cell.directions else { continue };
                let Some(parts) = parts(cell, mold) else { continue };
                let Some(fibers) = ideal.fibres(mold, uv) else { continue };
                for ((_, flat), fiber) in parts.into_iter().zip(fibers) {
                    // a fiber that stands upright has no direction along the mold
                    let Some(flat) = unit(flat) else { continue };
                    let angle = norm(cross(flat, fiber)).atan2(dot(flat, fiber));
                    most.meet(angle.to_degrees(), cell.site, cell.place);
                }
            }
        }
        most.found()
    }
}
