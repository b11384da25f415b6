//! Landing errors: how far contact points are from the place of the same fabric in the ideal drape, and the angle of their fibers.

use super::spans::Point;
use super::tuning::TUNING;
use crate::geometry::vector::{cross, direction, dot, norm, sub};
use crate::layup::Layup;
use crate::mold::distance;
use crate::ply::ContactSegment;

/// The landing errors of a contact segment.
#[derive(Debug, Clone, PartialEq)]
pub struct Landing {
    /// Distance of each point of the segment from its ideal place (m), where that is known.
    pub errors: Vec<Option<f64>>,
    /// Angle between the segment, from end to end, and the same fabric in the ideal drape (rad), and the
    /// middle of its ends; for edges, where the segment is long enough to have a direction.
    pub fiber_angle: Option<(f64, Point)>,
}

/// Fabric coordinates (u, v) (m) of a catenary at a share of its length from its first gripper.
pub(crate) fn fabric(layup: &Layup, catenary: usize, share: f64) -> [f64; 2] {
    layup.ply.lines().point(catenary, share)
}

/// Compares a contact segment with the ideal drape; `None` if that is not known.
pub fn landing(layup: &Layup, catenary: usize, contact: &ContactSegment) -> Option<Landing> {
    let (mold, drape) = (layup.mold.as_ref()?, layup.target.as_ref()?.drape.as_ref()?);
    let line = &contact.line;
    let fabric_at = |arc: f64| fabric(layup, catenary, arc / contact.length);
    let place = |arc: f64| drape.held_place(mold, &layup.ply, fabric_at(arc));
    let errors = line
        .arc
        .iter()
        .zip(&line.points)
        .map(|(arc, point)| place(*arc).map(|ideal| distance(*point, ideal)))
        .collect();
    let fiber_angle = (catenary < layup.ply.lines().edges()).then(|| {
        let ([from, to], [a, b]) = (contact.arc(), contact.point());
        let landed = direction(sub(b, a))
            .filter(|_| to - from > TUNING.shortest_direction * contact.length)?;
        let ideal = direction(sub(place(to)?, place(from)?))?;
        // the arctangent of sine and cosine is exact for small angles, where the cosine alone is not
        let angle = norm(cross(landed, ideal)).atan2(dot(landed, ideal));
        Some((angle, [0, 1, 2].map(|n| 0.5 * (a[n] + b[n]))))
    });
    let fiber_angle = fiber_angle.flatten();
    Some(Landing { errors, fiber_angle })
}
