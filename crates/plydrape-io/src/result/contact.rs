//! Contact in a result file: in each step what is new.
//!
//! Fabric in contact stays where it is, so a contact segment is written when it grows, and only its new points. A
//! segment that is another one than before is written whole.

use super::step::{alike, line};
use plydrape::draping::record::{CatenaryState, ContactState};
use serde::{Deserialize, Serialize};

/// The contact segment of each catenary in the step before.
pub(super) type Known = Vec<Option<ContactState>>;

/// Contact segments that are others than in the step before.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ContactColumns {
    catenary: Vec<usize>,
    /// Whether the points of the step before stay.
    grown: Vec<bool>,
    /// How many of the new points come before them.
    before: Vec<usize>,
    /// New points (m), first to last.
    points: Vec<Vec<[f64; 3]>>,
    /// Their fabric arc lengths from the first gripper (m).
    arc: Vec<Vec<f64>>,
    /// Their distances from their places in the ideal drape (mm).
    landing_error_mm: Vec<Option<Vec<Option<f64>>>>,
    // its key before version 0.1.0, read until 0.2.0
    #[serde(alias = "fibre_angle_deg")]
    fiber_angle_deg: Vec<Option<f64>>,
}

impl ContactColumns {
    /// What is new in the contact of some catenaries, which is known from then on.
    pub(super) fn since(known: &mut Known, lines: &[CatenaryState]) -> Self {
        known.resize(lines.len(), None);
        let mut out = ContactColumns::default();
        for (n, (old, line)) in known.iter_mut().zip(lines).enumerate() {
            if *old != line.contact {
                out.push(n, old.as_ref(), line.contact.as_ref());
                old.clone_from(&line.contact);
            }
        }
        out
    }

    fn push(&mut self, n: usize, old: Option<&ContactState>, new: Option<&ContactState>) {
        let place = old.zip(new).and_then(|(old, new)| within(old, new));
        let known = place.map_or(0..0, |first| first..first + old.map_or(0, |old| old.arc.len()));
        self.catenary.push(n);
        self.grown.push(place.is_some());
        self.before.push(known.start);
        self.points.push(new.map_or_else(Vec::new, |new| outside(&new.points, &known)));
        self.arc.push(new.map_or_else(Vec::new, |new| outside(&new.arc, &known)));
        let errors = new.and_then(|new| new.landing_error_mm.as_ref());
        self.landing_error_mm.push(errors.map(|errors| outside(errors, &known)));
        self.fiber_angle_deg.push(new.and_then(|new| new.fiber_angle_deg));
    }

    /// Gives some catenaries the contact that is known and new.
    pub(super) fn fill(self, known: &mut Known, lines: &mut [CatenaryState]) -> Result<(), String> {
        known.resize(lines.len(), None);

        // all columns have one entry for each contact segment that changed
        let found = [
            self.grown.len(),
            self.before.len(),
            self.points.len(),
            self.arc.len(),
            self.landing_error_mm.len(),
            self.fiber_angle_deg.len(),
        ];
        alike("contact segments", self.catenary.len(), &found)?;
        let angles = self.fiber_angle_deg.into_iter().zip(self.grown).zip(self.before);
        let columns = self.points.into_iter().zip(self.arc).zip(self.landing_error_mm).zip(angles);
        for (n, (((points, arc), errors), ((angle, grown), before))) in
            self.catenary.into_iter().zip(columns)
        {
            line(lines, n)?;
            // each new point has an arc length, and a landing error if there are any
            let count = points.len();
            let new = [arc.len(), errors.as_ref().map_or(count, Vec::len)];
            alike("numbers of contact points", count, &new)?;
            // a segment that has grown keeps its old points; another one replaces them
            let old = known[n].take().filter(|_| grown);
            if before > count || (grown && old.is_none()) {
                return Err(format!("the contact of catenary {n} has not grown"));
            }
            let mut contact =
                ContactState { points, arc, landing_error_mm: errors, fiber_angle_deg: angle };
            // the old points come after the first `before` of the new ones
            if let Some(old) = old {
                contact.points.splice(before..before, old.points);
                contact.arc.splice(before..before, old.arc);
                if let (Some(all), Some(old)) =
                    (&mut contact.landing_error_mm, old.landing_error_mm)
                {
                    all.splice(before..before, old);
                }
            }
            known[n] = Some(contact).filter(|contact| !contact.arc.is_empty());
        }

        // a segment that did not change is that of the step before
        for (line, contact) in lines.iter_mut().zip(known) {
            line.contact.clone_from(contact);
        }
        Ok(())
    }
}

/// From which of its points on a segment holds an earlier one.
fn within(old: &ContactState, new: &ContactState) -> Option<usize> {
    let count = old.arc.len();
    let errors = |contact: &ContactState, from: usize| {
        contact.landing_error_mm.as_ref().map(|errors| errors[from..from + count].to_vec())
    };
    (0..=new.arc.len().checked_sub(count)?).find(|&from| {
        new.arc[from..from + count] == old.arc[..]
            && new.points[from..from + count] == old.points[..]
            && errors(new, from) == errors(old, 0)
    })
}

/// The entries of a list outside of a range.
fn outside<T: Clone>(list: &[T], without: &std::ops::Range<usize>) -> Vec<T> {
    [&list[..without.start], &list[without.end..]].concat()
}
