//! One free span: its force, length, slopes and places.
//!
//! At a fixed fraction of its run a span moves with its ends and with its closed form. At a fixed share
//! of its fabric the fraction t follows from the arc length, s(t)/s(1) = const, so that
//! dt = −(ds(t) − s(t)/s(1) ds(1)) / (ℓ√(1+z'²)).

use super::tuning::TUNING;
use super::{Quantity, Row, Sensitivity};
use crate::catenary::{Graded, Profile};
use crate::draping::misfit;
use crate::draping::spans::{FreeSpan, Point};
use crate::geometry::vector::{along, direction, dot, sub, unit};

/// A point with its gradient to all gripper positions.
#[derive(Debug, Clone, PartialEq)]
pub struct PointDerivative {
    /// The point (m).
    pub point: Point,
    /// Derivatives of x, y and z, each as in [`Quantity::gradient`].
    pub gradient: [Row; 3],
}

impl PointDerivative {
    /// Part along a fixed direction (m).
    #[must_use]
    pub fn along(&self, direction: [f64; 3]) -> Quantity {
        let mut gradient = Row::default();
        for (part, row) in direction.iter().zip(&self.gradient) {
            gradient.add(*part, row);
        }
        Quantity { value: dot(self.point, direction), gradient }
    }
}

impl Sensitivity<'_> {
    /// Gradient of a quantity of a span's closed form to the gripper positions.
    pub(super) fn chain(&self, element: usize, graded: &Graded) -> Row {
        let mut gradient = Row::default();
        // force, slopes, run and rise are the first five variables of both
        for row in 0..5 {
            gradient.add(graded.gradient[row], self.row(element, row));
        }
        gradient
    }

    /// The closed form of a span and its element, if it hangs.
    pub(super) fn hanging<'s>(&self, span: &'s FreeSpan) -> Option<(&'s Profile, usize)> {
        Some((span.profile.as_ref()?, span.element?))
    }

    /// Horizontal force (N); `None` where the model gives none.
    #[must_use]
    pub fn force(&self, span: &FreeSpan) -> Option<Quantity> {
        let (value, element) = (span.force?, span.element?);
        Some(Quantity { value, gradient: self.row(element, 0).clone() })
    }

    /// Path between its ends minus its fabric length (m), see `docs/theory/measures.md`; negative is slack.
    #[must_use]
    pub fn overstretch(&self, span: &FreeSpan) -> Quantity {
        let mut gradient = Row::default();
        let contact = self.contacts[span.catenary].as_ref();
        let [a, b] = span.ends;
        let mut chord = direction(sub(b, a)).unwrap_or([0.0; 3]);
        if let Some(contact) = contact {
            // behind the contact the path grows along the tangent out of it
            let sense = if span.segment == 0 { -1.0 } else { 1.0 };
            let (outward, gripper) = (contact.outward[span.segment], sub(b, a).map(|c| sense * c));
            let ahead = dot(gripper, outward);
            if ahead < 0.0 {
                let across = unit(along(gripper, -ahead, outward)).unwrap_or([0.0; 3]);
                chord = along(outward, 1.0, across).map(|c| sense * c);
            }
        }
        for (end, sign) in [(0, -1.0), (1, 1.0)] {
            if let Some(gripper) = self.gripper_at(span, end) {
                gradient.add_from(3 * gripper, sign, chord);
            }
        }
        match span.element {
            Some(element) => gradient.add(-1.0, self.row(element, 5)),
            // a stretched diagonal without contact is as long as its path
            None if self.contacts[span.catenary].is_none() => gradient = Row::default(),
            None => {}
        }
        Quantity { value: -misfit(span, contact).excess(), gradient }
    }

    /// Slope at a fraction `t` of its run, along its heading.
    #[must_use]
    pub fn slope(&self, span: &FreeSpan, t: f64) -> Quantity {
        if let Some((profile, element)) = self.hanging(span) {
            let slope = profile.stations().slope(t);
            return Quantity { value: slope.value, gradient: self.chain(element, &slope) };
        }
        let (run, value) = (span.run(), span.slope(t));
        let mut gradient = Row::default();
        if run > 0.0 {
            let [x, y] = span.heading();
            let by_end = [-value * x / run, -value * y / run, 1.0 / run];
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                if let Some(gripper) = self.gripper_at(span, end) {
                    gradient.add_from(3 * gripper, sign, by_end);
                }
            }
        }
        Quantity { value, gradient }
    }

    /// Point at a fixed fraction `t` of its run (m).
    #[must_use]
    pub fn place(&self, span: &FreeSpan, t: f64) -> PointDerivative {
        let mut gradient: [Row; 3] = Default::default();
        let hanging = self.hanging(span);
        for (end, share) in [(0, 1.0 - t), (1, t)] {
            if let Some(gripper) = self.gripper_at(span, end) {
                for n in 0..2 {
                    gradient[n].add_at(3 * gripper + n, share);
                }
                // a hanging span's height counts from its first end
                let rise = match (hanging, end) {
                    (Some(_), 0) => 1.0,
                    (Some(_), _) => 0.0,
                    (None, _) => share,
                };
                gradient[2].add_at(3 * gripper + 2, rise);
            }
        }
        if let Some((profile, element)) = hanging {
            let height = self.chain(element, &profile.stations().height(t));
            gradient[2].add(1.0, &height);
        }
        PointDerivative { point: span.point(t), gradient }
    }

    /// Point at a fixed share of its fabric from its first end (m).
    #[must_use]
    pub fn fabric_place(&self, span: &FreeSpan, share: f64) -> PointDerivative {
        let t = fraction(span, share);
        let mut place = self.place(span, t);
        let Some((profile, element)) = self.hanging(span) else {
            return place;
        };
        let stations = profile.stations();
        let (part, whole) = (stations.arc(t), stations.arc(1.0));
        let slope = profile.station(t * span.run()).slope;
        let rate = span.run() * slope.hypot(1.0);
        let mut along = self.chain(element, &part);
        along.add(-part.value / whole.value, &self.chain(element, &whole));
        let [a, b] = span.ends;
        let velocity = [b[0] - a[0], b[1] - a[1], span.run() * slope];
        for n in 0..3 {
            place.gradient[n].add(-velocity[n] / rate, &along);
        }
        place
    }
}

/// The fraction of a span's run at which a share of its fabric lies.
pub(super) fn fraction(span: &FreeSpan, share: f64) -> f64 {
    let Some(profile) = &span.profile else {
        return share;
    };
    let run = span.run();
    let goal = share * profile.length_to(run);
    let (mut low, mut high, mut t) = (0.0, 1.0, share);
    // Newton's method, kept within its bracket
    for _ in 0..TUNING.fraction_steps {
        let residual = profile.length_to(t * run) - goal;
        if residual > 0.0 {
            high = t
        } else {
            low = t
        }
        let next = t - residual / (run * profile.station(t * run).slope.hypot(1.0));
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - t).abs() < TUNING.fraction || share <= 0.0 || share >= 1.0 {
            break;
        }
        t = next;
    }
    t
}
