//! What all fronts over one mold share, and how steep they may be.

use super::formation::MoldHeights;
use super::geometry;
use super::strategy::Strategy;
use super::tabulation::tabulated;
use super::trajectory::trajectory;
use super::tuning::TUNING;
use crate::draping::spans::Point;
use crate::scene::Scene;
use std::borrow::Cow;

/// The fronts over the mold of a scene.
pub struct Fronts<'a> {
    scene: &'a Scene,
    /// The scene with its mold as a table, where that is faster.
    pub tabulated: Cow<'a, Scene>,
    heights: MoldHeights,
}

impl<'a> Fronts<'a> {
    /// Those of a scene; none without a mold or a target.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Option<Self> {
        let heights = MoldHeights::new(scene)?;
        Some(Fronts { scene, tabulated: tabulated(scene), heights })
    }

    /// [`trajectory`] of a strategy (m).
    #[must_use]
    pub fn positions(&self, strategy: Strategy) -> Option<Vec<Vec<Point>>> {
        trajectory(&self.tabulated, &self.heights, strategy)
    }

    /// [`geometry::excess`] of a strategy.
    #[must_use]
    pub fn excess(&self, strategy: Strategy) -> f64 {
        let positions = self.positions(strategy);
        positions.map_or(f64::INFINITY, |positions| geometry::excess(self.scene, &positions))
    }

    /// The steepest slope of a front of this shape at which no gripper tilts too far, by bisection.
    #[must_use]
    pub fn steepest(&self, shape: Strategy) -> f64 {
        let keeps =
            |slope: f64| self.excess(Strategy { slope, ..shape }) <= TUNING.front.tilt_share;
        if keeps(shape.slope) {
            return shape.slope;
        }
        let (mut low, mut high) = (0.0, shape.slope);
        for _ in 0..TUNING.front.slope_rounds {
            let middle = 0.5 * (low + high);
            *(if keeps(middle) { &mut low } else { &mut high }) = middle;
        }
        // a mold as steep as the limit leaves nothing
        low.max(flattest())
    }
}

/// The flattest slope of a front that a search tries.
#[must_use]
pub fn flattest() -> f64 {
    TUNING.front.ranges[5][0].exp()
}
