//! A span and the mold: its distance, its position error, and the slope at which it leaves the mold.

use super::tuning::TUNING;
use super::{PointDerivative, Quantity, Sensitivity};
use crate::draping::fabric;
use crate::draping::spans::{FreeSpan, Point};
use crate::geometry::vector::{along, dot, sub};
use crate::mold::{ClosestPoint, Mold};

impl Sensitivity<'_> {
    /// Gradient of the distance from the mold at a point.
    pub(super) fn distance_gradient(&self, point: Point, closest: &ClosestPoint) -> [f64; 3] {
        if closest.distance.abs() < TUNING.on_mold * self.layup.ply.shorter_side() {
            return closest.normal;
        }
        // beside an open border it points away from the border
        sub(point, closest.point).map(|c| c / closest.distance)
    }

    /// Distance from the mold (m) of a span at a fixed fraction `t` of its run; `None` without a mold. At a
    /// minimum along the span the gradient is that of the smallest distance.
    #[must_use]
    pub fn gap(&self, span: &FreeSpan, t: f64) -> Option<Quantity> {
        let place = self.place(span, t);
        let closest = self.layup.mold.as_ref()?.closest_point(place.point);
        let slope = place.along(self.distance_gradient(place.point, &closest));
        Some(Quantity { value: closest.distance, ..slope })
    }

    /// Where the ideal drape has a span's fabric at a share of its length (m); `None` where it is not known.
    #[must_use]
    pub fn ideal(&self, span: &FreeSpan, share: f64) -> Option<Point> {
        let (mold, target) = (self.layup.mold.as_ref()?, self.layup.target.as_ref()?);
        let whole =
            self.contacts[span.catenary].as_ref().map_or(span.length, |contact| contact.length);
        let share = (span.start + share * span.length) / whole;
        let at = fabric(self.layup, span.catenary, share);
        target.drape.as_ref()?.held_place(mold, &self.layup.ply, at)
    }

    /// Position error (m): from the ideal place of a span's fabric at a share of its length to where it is; its x and
    /// y are the error in plan. None where the ideal drape does not know the place.
    #[must_use]
    pub fn landing(&self, span: &FreeSpan, share: f64) -> Option<PointDerivative> {
        let ideal = self.ideal(span, share)?;
        let place = self.fabric_place(span, share);
        Some(PointDerivative { point: sub(place.point, ideal), ..place })
    }

    /// Slope by which a span leaves the mold at one of its ends, outward from there: the ply's minus the
    /// mold's, positive where the ply rises from it. The end is in contact, or is a gripper that
    /// stands on the mold. None without a mold or where the mold is upright.
    #[must_use]
    pub fn rise(&self, span: &FreeSpan, end: usize) -> Option<Quantity> {
        let mold = self.layup.mold.as_ref()?;
        let outward = if end == 0 { 1.0 } else { -1.0 };
        let mut ply = match (span.profile.is_some(), span.element) {
            (true, Some(element)) => {
                let gradient = self.row(element, 1 + end).clone();
                Quantity { value: span.slopes[end], gradient }
            }
            _ => self.slope(span, end as f64),
        };
        let gripper = self.gripper_at(span, end);
        let normal = match (&self.contacts[span.catenary], gripper) {
            (Some(contact), None) => contact.normal[span.segment],
            _ => mold.normal(span.ends[end]),
        };
        let ([x, y], run) = (span.heading(), span.run());
        if normal[2] <= 0.0 || run <= 0.0 {
            return None;
        }
        // the mold's slope along the heading, and what turning the heading does to it
        let slope = -(normal[0] * x + normal[1] * y) / normal[2];
        let across = (normal[0] * y - normal[1] * x) / normal[2] / run;
        for (at, sign) in [(0, -1.0), (1, 1.0)] {
            if let Some(gripper) = self.gripper_at(span, at) {
                ply.gradient.add_from(3 * gripper, -sign * across, [-y, x, 0.0]);
            }
        }
        if let Some(gripper) = gripper {
            let turn = slope_gradient(mold, span.ends[end], normal, [x, y], slope);
            ply.gradient.add_from(3 * gripper, -1.0, turn);
        }
        ply.value = outward * (ply.value - slope);
        ply.gradient.scale(outward);
        Some(ply)
    }
}

/// How the mold's slope along a heading changes with the point whose closest it is taken at (1/m).
fn slope_gradient(
    mold: &Mold,
    point: Point,
    normal: [f64; 3],
    [x, y]: [f64; 2],
    slope: f64,
) -> [f64; 3] {
    let (curvatures, distance) = (mold.curvatures(point), mold.signed_distance(point));
    // the slope −(n·e)/n_z changes by −(e + slope ẑ)·dn/n_z, and the normal by the curvatures out here
    let turned = [x, y, slope];
    let mut out = [0.0; 3];
    for (curvature, direction) in curvatures.principal.iter().zip(curvatures.directions) {
        let rate = curvature / (1.0 + curvature * distance);
        out = along(out, -rate * dot(turned, direction) / normal[2], direction);
    }
    out
}
