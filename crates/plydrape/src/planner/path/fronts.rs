//! What all fronts over one mold share: their positions, how they are ranked, and how steep they may be.

use super::formation::MoldHeights;
use super::geometry;
use super::strategy::Strategy;
use super::tabulation::tabulated;
use super::trajectory::trajectory;
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::Point;
use crate::planner::evaluation::{Bias, Draped, Drapes, Mesh};
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

    /// [`geometry::excess`] of positions of grippers (m) that is too far beyond a limit for a drape.
    #[must_use]
    pub fn too_far(&self, positions: &[Vec<Point>]) -> Option<f64> {
        Some(geometry::excess(self.scene, positions)).filter(|e| *e > TUNING.search.excess)
    }

    /// The score of positions of grippers (m) and their drapes with a mesh, by which candidates are ranked. Positions whose grippers alone
    /// exceed a limit too far have no drape, and a score worse than that of any drape.
    ///
    /// # Errors
    /// The errors of [`Draped::new`] if the model that decides cannot drape the scene.
    pub fn rank(
        &self,
        positions: &[Vec<Point>],
        mesh: Mesh,
        bias: &Bias,
        state: &SearchState,
    ) -> Result<(f64, Option<Drapes>), Error> {
        if let Some(excess) = self.too_far(positions) {
            return Ok((tuning::TUNING.missing_weight * excess, None));
        }
        let cells = state.cells();
        let key = journal::key(positions, Some(mesh), &cells);
        let drapes = state.ranked(key, || {
            let draped = self.draped(positions, mesh, state)?;
            Ok::<_, Error>(draped.in_cells(&cells, 0, state))
        })?;
        Ok((drapes.score(bias), Some(drapes)))
    }

    /// The drape without errors along positions of grippers (m).
    ///
    /// # Errors
    /// The errors of [`Draped::new`].
    pub fn draped(
        &self,
        positions: &[Vec<Point>],
        mesh: Mesh,
        state: &SearchState,
    ) -> Result<Draped<'_>, Error> {
        Draped::new(&self.tabulated, positions, mesh, state)
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
