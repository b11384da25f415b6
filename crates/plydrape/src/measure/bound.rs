//! How a scene may bound a measure: what schema and guide say of the limit, which values make sense, and the limit unless a scene sets one.

use super::UsualLimit;
use std::f64::consts::FRAC_PI_2;

/// How a scene may bound a measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// What is bounded, in a clause without a stop: `Height of the ply over the mold at the end`.
    pub about: &'static str,
    /// Which bounds make sense.
    pub range: Range,
    /// Which bounds are found in practice; `None` if a plain number of any size is believed.
    pub practice: Option<Practice>,
    /// The limit unless a scene sets another.
    pub usual: Usual,
    /// A bound that somebody would set (SI).
    pub example: f64,
}

/// The bounds that make sense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The smallest (SI).
    pub least: f64,
    /// The largest (SI), infinite if there is none.
    pub most: f64,
    /// Whether a bound lies between these two and is neither.
    pub open: bool,
    /// What other bounds are too small or too large for: `a gripper`.
    pub of: &'static str,
}

/// Which bounds are found in practice: a plain number that is far from them was meant in another unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Practice {
    /// What a value makes, before the value: `a speed of`.
    pub what: &'static str,
    /// The smallest and the largest (SI); a smallest of zero leaves small values alone.
    pub found: [f64; 2],
    /// Both in words.
    pub words: &'static str,
}

/// The limit of a measure unless a scene sets another, as far as it is known without a layup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Usual {
    /// A number.
    Always(UsualLimit),
    /// What it is in the layup, in words without a comma: `the tolerance of contact`.
    OfLayup(&'static str),
    /// None.
    Never,
}

/// Why a layup has no such limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Refusal {
    /// What is in its way.
    pub why: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// Smallest and largest size of anything in a scene (m).
const SIZES: [f64; 2] = [1e-6, 1e4];

impl Practice {
    /// Heights, gaps and errors of position that someone would accept.
    pub const GAP: Practice = Practice {
        what: "a limit of",
        found: [0.0, 0.01],
        words: "limits of heights, gaps and positions are up to 10 mm",
    };
    /// Room between grippers, or between bodies and what they must not touch.
    pub const ROOM: Practice = Practice {
        what: "a distance of",
        found: [0.001, 0.5],
        words: "such distances are 1 mm to 500 mm",
    };
    /// What robots do.
    pub const SPEED: Practice = Practice {
        what: "a speed of",
        found: [1e-3, 2.0],
        words: "grippers move at 1 mm/s to 2 m/s",
    };
    /// What robots do that carry a tool; the fastest pick small parts with more.
    pub const ACCELERATION: Practice = Practice {
        what: "an acceleration of",
        found: [0.01, 50.0],
        words: "robots accelerate with 0.01 m/s^2 to 50 m/s^2",
    };
    /// What robots do.
    pub const JERK: Practice = Practice {
        what: "a jerk of",
        found: [0.05, 1e3],
        words: "robots have jerks of 0.05 m/s^3 to 1000 m/s^3",
    };
    /// How long a ply is carried.
    pub const DURATION: Practice = Practice {
        what: "a duration of",
        found: [0.1, 300.0],
        words: "motions take 0.1 s to 300 s",
    };
    /// What a gripper bears.
    pub const FORCE: Practice = Practice {
        what: "a force of",
        found: [0.01, 500.0],
        words: "grippers bear 0.01 N to 500 N",
    };
    /// How far yarns may be stretched.
    pub const STRETCH: Practice = Practice {
        what: "a strain of",
        found: [0.0, 0.1],
        words: "limits of strains are up to 10 %",
    };
    /// How far fibers may be from their angle.
    pub const LEAN: Practice = Practice {
        what: "an angle of",
        found: [0.0, 0.35],
        words: "limits of fiber angles are up to 0.35 rad, 20 deg",
    };
    /// Fabric that is not drawn taut.
    pub const SLACK: Practice = Practice {
        what: "a share of slack of",
        found: [0.0, 0.02],
        words: "limits of slack are up to 2 %",
    };
    /// Half a turn a second is fast for a gripper that holds fabric.
    pub const TURN: Practice = Practice {
        what: "a rate of",
        found: [1e-3, 3.5],
        words: "grippers and frames turn at 0.001 rad/s to 3.5 rad/s",
    };
}

impl Bound {
    /// A bound between two (SI) that are bounds themselves; others are too small or too large for what it is `of`.
    #[must_use]
    pub const fn within(about: &'static str, [least, most]: [f64; 2], of: &'static str) -> Self {
        let range = Range { least, most, open: false, of };
        Bound { about, range, practice: None, usual: Usual::Never, example: most }
    }

    /// A small length of zero or more, such as a gap.
    #[must_use]
    pub const fn gap(about: &'static str) -> Self {
        Bound::within(about, [0.0, f64::INFINITY], "a limit").found(Practice::GAP)
    }

    /// A small length above zero, such as a depth.
    #[must_use]
    pub const fn depth(about: &'static str) -> Self {
        Bound::within(about, SIZES, "a limit").found(Practice::GAP)
    }

    /// A distance above zero.
    #[must_use]
    pub const fn distance(about: &'static str) -> Self {
        Bound::within(about, SIZES, "a limit").found(Practice::ROOM)
    }

    /// A share from 0 to 1.
    #[must_use]
    pub const fn share(about: &'static str) -> Self {
        Bound::within(about, [0.0, 1.0], "a share")
    }

    /// An angle above zero and below a right angle.
    #[must_use]
    pub const fn angle(about: &'static str) -> Self {
        Bound::within(about, [0.0, FRAC_PI_2], "an angle").between()
    }

    /// A force above zero.
    #[must_use]
    pub const fn force(about: &'static str) -> Self {
        Bound::within(about, [0.0, f64::INFINITY], "a force").found(Practice::FORCE).between()
    }

    /// Without the ends of its range.
    const fn between(mut self) -> Self {
        self.range.open = true;
        self
    }

    /// With what is found in practice.
    #[must_use]
    pub const fn found(mut self, practice: Practice) -> Self {
        self.practice = Some(practice);
        self
    }

    /// With a limit (SI) unless a scene sets another, and the reason.
    #[must_use]
    pub const fn usually(mut self, value: f64, reason: &'static str) -> Self {
        self.usual = Usual::Always(UsualLimit { value, reason });
        self.example = value;
        self
    }

    /// With a limit that follows from the layup unless a scene sets another, in words, and an example (SI).
    #[must_use]
    pub const fn follows(mut self, words: &'static str, example: f64) -> Self {
        self.usual = Usual::OfLayup(words);
        self.example = example;
        self
    }

    /// Without a limit unless a scene sets one, as this one (SI).
    #[must_use]
    pub const fn such_as(mut self, example: f64) -> Self {
        self.example = example;
        self
    }
}
