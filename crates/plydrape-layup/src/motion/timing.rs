//! Shares of the bounds for bends and for the time law: the shortest motion of a few.
//!
//! Bends and the time law share the bounds while the motion starts and stops, and a short path never reaches its
//! top speed. So a few shares are tried for the cruising speed, for the bends, and for the time law.
//! Each motion is stretched in time by the least factor λ that keeps the bounds,
//! and the shortest is taken. This is not in the paper.

use super::Bounds;
use super::path::{Path, Vector};
use super::peaks::peaks;
use super::spacing::spacing;
use super::time_law::TimeLaw;
use super::tuning::TUNING;

/// Path and time law of the shortest motion found; none without shares to try.
pub(super) fn fastest(steps: &[&[Vector]], bounds: &Bounds) -> Option<(Path, TimeLaw)> {
    let tries =
        TUNING.cruise.iter().flat_map(|cruise| TUNING.bend.map(|bend| [*cruise, bend, bend]));
    let motions = tries.filter_map(|shares| {
        let cruise = share(bounds, shares);
        let path = Path::new(steps, &spacing(steps, &cruise));
        let law = starting(&path, cruise.speed, bounds)?;
        Some((path, law))
    });
    let (path, law) = motions.min_by(|a, b| a.1.duration.total_cmp(&b.1.duration))?;

    // The peaks are known to the tolerance: so much longer, no limit is passed in between.
    let tolerance = TUNING.tolerance;
    let stretch = peaks(&path, &law, tolerance).stretch(bounds);
    let law = law.stretched(stretch * (1.0 + tolerance));
    Some((path, law))
}

/// The shortest time law along a path with a top speed ṡ (m/s), all but within bounds.
fn starting(path: &Path, speed: f64, bounds: &Bounds) -> Option<TimeLaw> {
    let tries = TUNING
        .acceleration
        .iter()
        .flat_map(|acceleration| TUNING.jerk.map(|jerk| [*acceleration, jerk]));
    let laws = tries.map(|[acceleration, jerk]| {
        let own = Bounds { speed, ..share(bounds, [1.0, acceleration, jerk]) };
        let law = TimeLaw::new(path.length(), &own);
        law.stretched(peaks(path, &law, TUNING.trial_tolerance).stretch(bounds))
    });
    laws.min_by(|a, b| a.duration.total_cmp(&b.duration))
}

/// Each bound times its share.
fn share(bounds: &Bounds, [speed, acceleration, jerk]: [f64; 3]) -> Bounds {
    Bounds {
        speed: speed * bounds.speed,
        acceleration: acceleration * bounds.acceleration,
        jerk: jerk * bounds.jerk,
    }
}
