//! What published data say of the strength that an angle of the fibers costs. It is information beside a measured angle: no limit, and no prediction for any laminate.
//!
//! | plane | source | angle | loss of strength | of what |
//! |---|---|---|---|---|
//! | in the ply | US Army TM 1-1500-204-23-11, 5-6 e (1) | 5° | 20 % | a ply that is turned, stated in a repair manual without its tests |
//! | | | 10° | up to 50 % | |
//! | out of it | Adams and Hyer 1993 | not given | up to 36 % | compression tests of T300/P1700 carbon/polysulfone cross-ply, one wavy layer |
//!
//! Only what was read is carried: of Adams and Hyer the abstract, of the manual a web copy that has lost its degree signs. Tests
//! with measured wrinkle angles exist (Mukhopadhyay, Jones and Hallett 2015 among others); their figures were not read.

use super::Name;

/// Which way fibers are turned from where they should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// In the plane of the ply: its direction.
    InPlane,
    /// Out of it: a wave or wrinkle.
    OutOfPlane,
}

/// Published losses of strength over an angle.
#[derive(Debug, Clone, Copy)]
pub struct Published {
    /// Which way the fibers are turned.
    pub plane: Plane,
    /// What it says, from its subject to the loss.
    pub says: &'static str,
    /// Of what it holds.
    pub range: &'static str,
    /// Author, title, year and place.
    pub source: &'static str,
    /// Angles (rad), ascending, and the share of the strength that is lost there; none where it gives no angle.
    pub losses: &'static [(f64, f64)],
    /// Largest share that it reports.
    pub most: f64,
}

/// Where an angle stands among published ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Loss {
    /// Between two of them, or at one: the shares lost at both.
    Between([f64; 2]),
    /// Below the smallest of them: this angle (rad), and the share lost there.
    Below(f64, f64),
    /// Beyond the largest of them: this angle (rad), and the share lost there.
    Beyond(f64, f64),
    /// The source gives no angle: the largest share that it reports.
    NoAngle(f64),
}

/// So many degrees (rad).
const fn degrees(angle: f64) -> f64 {
    angle * std::f64::consts::PI / 180.0
}

impl Published {
    /// Everything that is carried.
    pub const ALL: &[Published] = &[
        Published {
            plane: Plane::InPlane,
            says: "a published repair manual says that a ply turned by 5° can lose 20 % of its strength, by 10° as much as 50 %",
            range: "it names neither the load nor the laminate, and no tests",
            source: "US Army TM 1-1500-204-23-11, General Aircraft Maintenance, Sheet Metal Shop, paragraph 5-6 e (1)",
            losses: &[(degrees(5.0), 0.2), (degrees(10.0), 0.5)],
            most: 0.5,
        },
        Published {
            plane: Plane::OutOfPlane,
            says: "published tests found up to 36 % less static compression strength with a wave in one layer",
            range: "T300/P1700 carbon/polysulfone, cross-ply, waves up to 1.5 layer thicknesses in amplitude and down to 9 in length; the wavy layer bears 20 % of the load",
            source: "Adams and Hyer 1993, Effects of Layer Waviness on the Compression Strength of Thermoplastic Composite Laminates, J. Reinf. Plast. Compos. 12(4), 414-429, abstract",
            losses: &[],
            most: 0.36,
        },
    ];

    /// What is carried of one way of turning.
    pub fn of(plane: Plane) -> impl Iterator<Item = &'static Published> {
        Self::ALL.iter().filter(move |published| published.plane == plane)
    }

    /// Where an angle (rad, not negative) stands in it; none of an angle that is no number.
    #[must_use]
    pub fn loss(&self, angle: f64) -> Option<Loss> {
        if !angle.is_finite() {
            return None;
        }
        let (Some(first), Some(last)) = (self.losses.first(), self.losses.last()) else {
            return Some(Loss::NoAngle(self.most));
        };
        if angle < first.0 {
            return Some(Loss::Below(first.0, first.1));
        }
        if angle > last.0 {
            return Some(Loss::Beyond(last.0, last.1));
        }
        let below = self.losses.iter().rev().find(|(at, _)| *at <= angle)?;
        let above = self.losses.iter().find(|(at, _)| *at >= angle)?;
        Some(Loss::Between([below.1, above.1]))
    }
}

impl Plane {
    /// Which way fibers are turned by the angle that a measure gives, if it is one.
    #[must_use]
    pub fn of(name: Name) -> Option<Plane> {
        match name {
            Name::FibreAngle => Some(Plane::InPlane),
            Name::OutOfPlane | Name::SlackAngle | Name::WrinkleAngle => Some(Plane::OutOfPlane),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The manual's two angles: between them both shares, outside the nearer end and where it is.
    #[test]
    fn an_angle_outside_the_published_ones_is_told_from_one_between() {
        let [manual] = Published::of(Plane::InPlane).collect::<Vec<_>>()[..] else { panic!() };
        let at = |angle: f64| manual.loss(degrees(angle));
        assert_eq!(at(7.0), Some(Loss::Between([0.2, 0.5])));
        assert_eq!(at(5.0), Some(Loss::Between([0.2, 0.2])));
        assert_eq!(at(10.0), Some(Loss::Between([0.5, 0.5])));
        assert_eq!(at(4.99), Some(Loss::Below(degrees(5.0), 0.2)));
        assert_eq!(at(10.01), Some(Loss::Beyond(degrees(10.0), 0.5)));
        assert_eq!(manual.loss(f64::NAN), None);
        let [waves] = Published::of(Plane::OutOfPlane).collect::<Vec<_>>()[..] else { panic!() };
        assert_eq!(waves.loss(degrees(3.0)), Some(Loss::NoAngle(0.36)));
    }

    /// Angles ascend, losses do not fall, and no share is beyond the largest that the source reports.
    #[test]
    fn published_losses_grow_with_the_angle() {
        for published in Published::ALL {
            assert!(published.losses.is_sorted_by(|a, b| a.0 < b.0 && a.1 <= b.1));
            assert!(published.losses.iter().all(|(_, share)| *share <= published.most));
            assert!(published.most < 1.0 && !published.source.is_empty());
        }
    }
}
