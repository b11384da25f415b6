//! Straight lines between places, and the headings of the lines of edges in plan.

use crate::equilibrium::Number;
use crate::ply::Lines;

/// A straight line from one place to another.
#[derive(Clone, Copy)]
pub struct StraightLine<T> {
    delta: [T; 2],
    /// Horizontal length ℓ (m).
    pub run: T,
    /// Height of its second end above its first h (m).
    pub rise: T,
    /// Length √(ℓ²+h²) (m).
    pub chord: T,
}

/// √(x²), which at 0 has the derivative 0.
fn root<T: Number>(square: T) -> T {
    if square.re() > 0.0 { square.sqrt() } else { T::from(0.0) }
}

impl<T: Number> StraightLine<T> {
    /// From one place to another (m).
    pub fn new(from: [T; 3], to: [T; 3]) -> StraightLine<T> {
        let delta = [to[0] - from[0], to[1] - from[1]];
        let rise = to[2] - from[2];
        let square = delta[0] * delta[0] + delta[1] * delta[1];
        StraightLine { delta, run: root(square), rise, chord: root(square + rise * rise) }
    }

    /// Slope from the first end to the second; 0 if they coincide.
    pub fn slope(&self) -> T {
        if self.run.re() > 0.0 { self.rise / self.run } else { T::from(0.0) }
    }

    /// From the first end to the second (m).
    pub fn vector(&self) -> [T; 3] {
        [self.delta[0], self.delta[1], self.rise]
    }

    /// Horizontal unit vector from the first end to the second; zero if it is upright.
    pub fn heading(&self) -> [T; 2] {
        if self.run.re() > 0.0 { self.delta.map(|d| d / self.run) } else { [T::from(0.0); 2] }
    }
}

/// Horizontal unit vector of the line through a gripper along a direction (0: u, 1: v): from the gripper
/// before it to the one behind it.
pub fn heading<T: Number>(
    lines: &Lines,
    positions: &[[T; 3]],
    gripper: usize,
    direction: usize,
) -> Option<[T; 2]> {
    let [before, after] = lines.neighbors(gripper, direction);
    let line = StraightLine::new(positions[before], positions[after]);
    (line.run.re() > 0.0).then(|| line.heading())
}
