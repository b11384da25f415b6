//! How fast to take the bends, and how hard to start and stop: the fastest of a few answers.
//!
//! Bends and the law share the bounds while the law starts and stops, and a short path never reaches its
//! top speed. So a few shares are tried for the cruising speed, for what bends may use, and for the law.
//! Each answer is stretched in time by the least factor λ that keeps the bounds,
//! and the shortest motion wins. Ours.

use super::Bounds;
use super::law::Law;
use super::path::{Path, Vector};
use super::peaks::{Peaks, peaks};
use super::spacing::spacing;

/// Cruising speed ṡ as a share of the limit.
const CRUISE: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];
/// Acceleration and jerk of bends as shares of their limits.
const BEND: [f64; 3] = [1.0, 0.7, 0.5];
/// Acceleration of the law as a share of the limit.
const ACCELERATION: [f64; 3] = [1.0, 0.7, 0.5];
/// Jerk of the law as a share of the limit.
const JERK: [f64; 4] = [1.0, 0.7, 0.5, 0.35];
/// How well the peaks are known while answers are compared, and in the end (1).
const TOLERANCE: [f64; 2] = [1e-2, 1e-4];

/// Path, law and peaks of the shortest motion found; none without shares to try.
pub(super) fn fastest(steps: &[&[Vector]], bounds: &Bounds) -> Option<(Path, Law, Peaks)> {
    let tries = CRUISE.iter().flat_map(|cruise| BEND.map(|bend| [*cruise, bend, bend]));
    let answers = tries.filter_map(|shares| {
        let cruise = share(bounds, shares);
        let path = Path::new(steps, &spacing(steps, &cruise));
        let law = starting(&path, cruise.speed, bounds)?;
        Some((path, law))
    });
    let (path, law) = answers.min_by(|a, b| a.1.duration.total_cmp(&b.1.duration))?;

    // The peaks are known to the tolerance: so much longer, no limit is passed in between.
    let tolerance = TOLERANCE[1];
    let stretch = peaks(&path, &law, tolerance).stretch(bounds);
    let law = law.stretched(stretch * (1.0 + tolerance));
    let peaks = peaks(&path, &law, tolerance);
    Some((path, law, peaks))
}

/// The shortest law along a path with a top speed ṡ (m/s), all but within bounds.
fn starting(path: &Path, speed: f64, bounds: &Bounds) -> Option<Law> {
    let tries = ACCELERATION.iter().flat_map(|acceleration| JERK.map(|jerk| [*acceleration, jerk]));
    let laws = tries.map(|[acceleration, jerk]| {
        let own = Bounds { speed, ..share(bounds, [1.0, acceleration, jerk]) };
        let law = Law::new(path.length(), &own);
        law.stretched(peaks(path, &law, TOLERANCE[0]).stretch(bounds))
    });
    laws.min_by(|a, b| a.duration.total_cmp(&b.duration))
}

/// Shares of bounds.
fn share(bounds: &Bounds, [speed, acceleration, jerk]: [f64; 3]) -> Bounds {
    Bounds {
        speed: speed * bounds.speed,
        acceleration: acceleration * bounds.acceleration,
        jerk: jerk * bounds.jerk,
    }
}
