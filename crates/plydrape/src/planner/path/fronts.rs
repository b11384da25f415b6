//! What all fronts over one mold share: their positions, how they are ranked, and how steep they may be.

use super::formation::MoldHeights;
use super::geometry;
use super::strategy::Strategy;
use super::tabulation::tabulated;
use super::trajectory::trajectory;
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::Point;
use crate::planner::evaluation::{self, Bias, Drapes, Mesh};
use crate::planner::journal;
use crate::planner::search_state::SearchState;
use crate::planner::tuning;
use crate::scene::Scene;
use std::borrow::Cow;

/// The fronts over the mold of a scene.
pub struct Fronts<'a> {
    scene: &'a Scene,
    /// The scene with its mold as a table, where that is faster.
    tabulated: Cow<'a, Scene>,
    heights: MoldHeights,
}

impl<'a> Fronts<'a> {
    /// The fronts of a scene; `None` without a mold or a target.
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

    /// The score of positions of grippers (m) and their drapes with a mesh, by which candidates are ranked. Positions whose grippers alone
    /// exceed a limit too far have no drape, and a score worse than that of any drape.
    ///
    /// # Errors
    /// The errors of [`evaluation::drape`] if the model that decides cannot drape the scene.
    pub fn rank(
        &self,
        positions: &[Vec<Point>],
        mesh: Mesh,
        bias: &Bias,
        state: &SearchState,
    ) -> Result<(f64, Option<Drapes>), Error> {
        let excess = geometry::excess(self.scene, positions);
        if excess > TUNING.search.excess {
            return Ok((tuning::TUNING.missing_weight * excess, None));
        }
        let key = journal::key(positions, Some(mesh), &state.cells());
        let drapes =
            state.ranked(key, || evaluation::drape(&self.tabulated, positions, mesh, state))?;
        Ok((drapes.score(bias), Some(drapes)))
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
