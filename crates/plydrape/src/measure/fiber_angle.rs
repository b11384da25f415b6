//! Fiber angle: the largest angle along the mold, at the end, between fabric that has landed and the same fabric in the ideal drape. Of a
//! line it is that from end to end of what has landed of it, of a cell that of its two mid-lines.

use super::out_of_plane::parts;
use super::{Bound, DEGREE, Description, Found, Measure, Most, Observation, Practice, Scope, Unit};
use crate::geometry::vector::{cross, dot, norm, unit};
use crate::layup::Layup;

/// Fiber angle; see the head of this file.
pub struct FiberAngle;

impl Measure for FiberAngle {
    fn description(&self) -> Description {
        let own = Description::new("fiber_angle", "fiber_angle_deg", "fiber angle", Unit::DEGREE);
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::angle("Angle along the mold between landed fibers and those of the ideal drape")
                .found(Practice::LEAN)
                .usually(3.0 * DEGREE, "a usual tolerance of ply angles, ±3°"),
        )
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
            let ply = &seen.layup.ply;
            for cell in &seen.state.cells {
                let Some((_, uv)) = cell.directions else { continue };
                let Some(parts) = parts(cell, mold) else { continue };
                let Some(fibers) = ideal.held_fibers(mold, ply, uv) else { continue };
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

#[cfg(test)]
mod tests {
    use super::super::{Limits, Name, sample};
    use super::*;
    use crate::net::{self, EdgeRule, Generators, Net};
    use crate::ply::PickUpError;
    use std::sync::Arc;

    /// A flat layup whose ideal drape runs along x turned by 10°.
    fn turned_by_ten() -> Layup {
        let mut layup = sample::layup();
        let net = net::Placement {
            nodes: [11; 2],
            mesh: [0.01; 2],
            origin: [0.0; 2],
            seed: [0; 2],
            place: [0.0; 3],
            heading: 10_f64.to_radians(),
            shear: 0.0,
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
        };
        let net = Net::drape(layup.mold.as_ref().unwrap(), net).unwrap();
        layup.target.as_mut().unwrap().drape = Some(Arc::new(net));
        layup
    }

    /// A cell along x is off the ideal drape by 10°, however steep it stands, and one that is turned by 14° by 4°. A landed line counts with the
    /// angle that the model gives it.
    #[test]
    fn fibers_are_compared_along_the_mold() {
        let layup = turned_by_ten();
        let limits = Limits::usual(&layup);
        let mut state = sample::state(&layup);
        let turned = |heading: f64, rise: f64| {
            let (s, c) = heading.to_radians().sin_cos();
            let (up, flat) = rise.to_radians().sin_cos();
            Some(([[c * flat, s * flat, up], [-s, c, 0.0]], [0.03, 0.04]))
        };
        let mut angle = |heading: f64, rise: f64, line: Option<f64>| {
            state.cells[0].directions = turned(heading, rise);
            state.lines[0].fiber_angle = line.map(f64::to_radians);
            let seen = Observation { layup: &layup, limits: &limits, state: &state, past: None };
            Name::FiberAngle.measure().evaluate(&seen).unwrap().value
        };
        assert!((angle(0.0, 0.0, None) - 10.0).abs() < 1e-9);
        assert!((angle(0.0, 30.0, None) - 10.0).abs() < 1e-9);
        assert!((angle(14.0, 0.0, None) - 4.0).abs() < 1e-9);
        assert!((angle(14.0, 0.0, Some(6.0)) - 6.0).abs() < 1e-9);
    }

    /// An array that was turned on the ply by an angle has yarns across its lines that should run farther on by that angle.
    #[test]
    fn a_ply_that_is_held_turned_has_its_fibers_off_by_that_angle() {
        let mut layup = turned_by_ten();
        let yaw = 0.5_f64.to_radians().tan();
        layup.ply.pick_up_error = PickUpError { offset: [1e-3, 0.0], yaw };
        let limits = Limits::usual(&layup);
        let mut state = sample::state(&layup);
        state.cells[0].directions = Some(([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.03, 0.04]));
        state.lines[0].fiber_angle = None;
        let seen = Observation { layup: &layup, limits: &limits, state: &state, past: None };
        let found = Name::FiberAngle.measure().evaluate(&seen).unwrap().value;
        assert!((found - 10.5).abs() < 1e-9, "{found}");
    }
}
