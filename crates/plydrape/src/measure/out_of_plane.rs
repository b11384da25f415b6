//! Fiber angle out of plane: the largest angle at the end between a fiber of the ply and the tangent plane of the mold under it.

use super::{Bound, DEGREE, Description, Found, Measure, Most, Observation, Practice, Scope, Unit};
use crate::geometry::Point;
use crate::geometry::vector::{along, dot, norm};
use crate::layup::Layup;
use crate::mold::Mold;
use crate::state::CellState;

/// Fiber angle out of plane; see the head of this file.
pub struct OutOfPlane;

impl Measure for OutOfPlane {
    fn description(&self) -> Description {
        let own = Description::of_sheet(
            "out_of_plane",
            "out_of_plane_deg",
            "fiber angle out of plane",
            Unit::DEGREE,
        );
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::angle("Angle between the fibers of the ply and the mold at the end")
                .found(Practice::LEAN)
                .usually(
                    3.0 * DEGREE,
                    "our choice: the usual tolerance of ply angles, taken out of the plane too",
                ),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mold = seen.layup.mold.as_ref()?;
        let mut most = Most::default();
        for cell in &seen.state.cells {
            for (rise, flat) in parts(cell, mold).into_iter().flatten() {
                most.meet(rise.abs().atan2(norm(flat)).to_degrees(), cell.site, cell.place);
            }
        }
        most.found()
    }
}

/// The directions of the two mid-lines of a cell in parts: across the tangent plane of the mold under it, and along that plane. `None` where
/// the model gives no directions, and beyond the boundary of the mold.
pub(super) fn parts(cell: &CellState, mold: &Mold) -> Option<[(f64, Point); 2]> {
    let (directions, _) = cell.directions?;
    let closest = mold.closest_point(cell.place);
    (!closest.beyond).then(|| {
        directions.map(|direction| {
            let rise = dot(direction, closest.normal);
            (rise, along(direction, -rise, closest.normal))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Limits, Name, sample};
    use super::*;
    use crate::state::PlyState;

    /// A cell that is turned about v by 7° over a flat mold is out of plane by 7° along u and by nothing along v; one without directions
    /// has no angle.
    #[test]
    fn a_cell_that_is_tilted_is_out_of_plane_by_its_tilt() {
        let layup = sample::layup();
        let limits = Limits::usual(&layup);
        let mut state = sample::state(&layup);
        let angle = |state: &PlyState| {
            let seen = Observation { layup: &layup, limits: &limits, state, past: None };
            Name::OutOfPlane.measure().evaluate(&seen).map(|found| found.value)
        };
        let (s, c) = 7_f64.to_radians().sin_cos();
        state.cells[0].directions = Some(([[c, 0.0, s], [0.0, 1.0, 0.0]], [0.05, 0.05]));
        assert!((angle(&state).unwrap() - 7.0).abs() < 1e-12);
        state.cells[0].directions = None;
        assert_eq!(angle(&state), None);
    }
}
