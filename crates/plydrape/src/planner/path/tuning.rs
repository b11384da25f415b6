//! The tuning constants of the search for whole trajectories.
//!
//! Lengths are in terms of a cell, the shorter side of a cell of the ply.

use std::f64::consts::{FRAC_PI_2, LN_10, PI};

/// Constants of each stage of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathTuning {
    /// The way from the start to the first formation of a front.
    pub transport: TransportTuning,
    /// Fronts and the trajectories that they give.
    pub front: FrontTuning,
    /// Preload of grippers on mounts.
    pub preload: PreloadTuning,
    /// The search for the best front.
    pub search: SearchTuning,
    /// The race of the best fronts, for grippers on mounts.
    pub race: RaceTuning,
    /// The walk from a good front, for grippers on mounts.
    pub walk: WalkTuning,
}

/// Constants of the way from the start to the first formation of a front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransportTuning {
    /// Distance that the ply keeps from the mold and from the table while it is carried (cells).
    pub margin: f64,
    /// Points of a cell along each side at which this distance is measured, the farther end not counted.
    pub divisions: usize,
    /// Halvings of the distance between two of these points that find the boundary of the mold between them, which may be
    /// upright.
    pub boundary_halvings: usize,
    /// Length of the way between two places at which the distance is measured (cells); several in a step, because corners of the
    /// way are rounded within two steps.
    pub sampling: f64,
    /// Most places at which the distance is measured on a way, and most lines along each axis that look for the boundary of the mold.
    pub most_samples: usize,
    /// How often the distance between these places is halved around the worst of them.
    pub halvings: usize,
    /// Rounds in which the height of the carried array is raised until it is kept where corners are rounded, too.
    pub rounds: usize,
    /// How much higher than it must be the array may then be carried (cells).
    pub spare: f64,
    /// Share of the margin that may be missing after these rounds.
    pub tolerance: f64,
    /// Height over the lowest place that is clear of the mold from which on the array is formed (cells).
    pub forming_height: f64,
    /// Height above the first formation at which the array has its shape (cells).
    pub formed_height: f64,
    /// Share of the steps in which the array is carried, for a way that is long beside that of forming; of a shorter
    /// way in proportion.
    pub carrying: f64,
    /// Share of the steps in which it is formed.
    pub forming: f64,
    /// Share of these steps after which lines between grippers have most of their change of length, and how much of it; they
    /// turn all the time.
    pub tight: [f64; 2],
    /// Share of the steps in which it comes down to the first formation. The front takes the other steps, because
    /// contacts are made there.
    pub descent: f64,
    /// Largest turn in a step (rad): 6°. A cubic spline whose control points are turned by θ a step draws the array in
    /// by θ²/6. This is compensated where knots are evenly spaced; where they are not, up to about a tenth of it is left:
    /// 0.02 % of an edge.
    pub turn: f64,
    /// Share of the steps up to which that largest turn makes the way longer.
    pub most_turning: f64,
}

/// Constants of fronts and their trajectories.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrontTuning {
    /// Radius over which the tip of the lifted mold at the start of the front is rounded (cells).
    pub tip: f64,
    /// Divisions of a cell of the net on the lifted mold; even, so that the middle of a cell is a node.
    pub divisions: usize,
    /// Nodes of the height grid of the lifted mold along each axis.
    pub height_nodes: usize,
    /// Margin of that height grid around the drape, as a share of its size; of a table of a formula without borders, too.
    pub height_margin: f64,
    /// Vertical part of the mold's normal at its border below which the mold is not continued more steeply.
    pub upright_border: f64,
    /// Rounds in which the height of the tangent plane at the border is found.
    pub border_rounds: usize,
    /// Parts of a line between two grippers, between whose ends the front's crossing is found.
    pub line_parts: usize,
    /// Rounds over all lines at most in which they are made taut.
    pub tightenings: usize,
    /// Difference of a line and its chord, as a share of its length, at which it is taut; small beside the slack that
    /// lets a cell sag visibly, some 1e-5.
    pub taut: f64,
    /// Nodes of the table of a mold that is a formula along each axis.
    pub table_nodes: usize,
    /// Error up to which this table is used (cells).
    pub table_error: f64,
    /// How far the front runs beyond the last gripper, as a share of its path.
    pub beyond: f64,
    /// Formations per step from which steps of equal length are cut, where a move limit asks for them.
    pub finer: usize,
    /// Difference of the principal curvatures of a mold, as a share of the larger, up to which it curves alike in all directions.
    pub umbilic: f64,
    /// Steepest slope that is tried first: steeper ones make the ply fold at the front.
    pub steepest: f64,
    /// Steepest slope that is tried first for grippers on mounts.
    pub steepest_on_mounts: f64,
    /// Slopes of the low fronts among the first candidates on mounts, as shares of the steepest one.
    pub low_slopes: [f64; 2],
    /// Squareness of the rhombic fronts among the first candidates on mounts.
    pub rhombic: f64,
    /// Pull and press of the taut ones among the first candidates on mounts.
    pub pulled: [f64; 2],
    /// Ratio of axes and curvature of the ellipses that race first on a mold that curves one way more than the other.
    pub elongated: [f64; 2],
    /// Their slopes, as shares of the steepest one.
    pub elongated_slopes: [f64; 2],
    /// Ratio to the limit of the tilt, by the grippers alone, up to which slopes are raised: the ply hangs between them
    /// and tilts those at its boundary more.
    pub tilt_share: f64,
    /// Rounds in which that slope is found.
    pub slope_rounds: usize,
    /// Ranges of [`super::Strategy`]: start, ln ratio, angle, ln curvature, ln slope, pretension. Ratios go up to e⁵, which is a line on
    /// any ply; curvatures per cell from 0.02 to 8, slopes from 0.02 to 1.
    pub ranges: [[f64; 2]; 7],
}

/// Constants of the preload of grippers on mounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PreloadTuning {
    /// Pull of a line inside the ply, as a share of the load that a gripper may carry, where the pull of a front is 1.
    pub pull: f64,
    /// Largest pull of a front.
    pub most_pull: f64,
    /// Pull of a line along the border of the ply, as a multiple of that of a line inside: it alone keeps the border straight.
    pub border: f64,
    /// Share of the load of a corner that its two lines of the border may take; the shear of the ply and the grippers' errors add to it.
    pub corner: f64,
    /// Distance of a gripper to its place from which on its pull is given up (cells).
    pub release: f64,
    /// Share of the pull that is left at its place of a line over no hollow, because an error of the gripper makes its lines slack there first.
    pub kept: f64,
    /// Share of the steps in which the pull comes up.
    pub growing: f64,
    /// Largest load with which a gripper presses, as a share of the one that it may carry.
    pub press: f64,
    /// Distance of a gripper to its place from which on it presses (cells).
    pub press_reach: f64,
    /// Least load with which a gripper presses at its place, as a share of the largest, because a ply that hangs above the mold when its pad lets
    /// go draws back; and the distance from which on it does (cells).
    pub seat: [f64; 2],
    /// How slack a line over a hollow is left, as a multiple of what errors of its grippers could make it shorter: a line that is taut is lifted off, and
    /// what is slack lies down beyond the gripper.
    pub slack: f64,
    /// Largest height from which a ply falls into a hollow (cells).
    pub fall: f64,
    /// Deviations of the grippers' errors against which the first members pull and press: three, because one line of a few dozen
    /// that goes slack makes a ridge.
    pub deviations: f64,
}

/// Constants of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchTuning {
    /// Score below which a plan keeps every limit with so wide a margin that the search ends. A score of 1 just keeps them.
    pub good: f64,
    /// Score of a ranking below which a plan is decided on: first, and once the error of the coarse mesh is known. Above 1,
    /// because of that error.
    pub promising: [f64; 2],
    /// Score of a ranking of grippers on mounts below which a plan is decided on: below 1, because it is a mean of few cells.
    pub promising_on_mounts: f64,
    /// Ratio of a measure to its limit by the grippers alone beyond which a candidate is not draped: above 1, because the
    /// ply tilts a gripper less or more than the lines to its neighbors.
    pub excess: f64,
    /// First candidates that are draped before the best of them is decided on: whole pairs, for two cores.
    pub batch: usize,
    /// Candidates that are kept to be decided on.
    pub kept: usize,
    /// First step of the evolution, in shares of each range: of a coarse ranking, which explores around the best member of a
    /// family, and of the one with the mesh of the scene, which mends what is left.
    pub steps: [f64; 2],
    /// Score of the best first candidate up to which it is near to a plan, so that all other drapes are ranked with the mesh of the
    /// scene.
    pub near: f64,
    /// Share of the drapes after the first candidates that is ranked with the mesh of the scene, where the coarse one led to no
    /// plan that is good enough.
    pub fine: f64,
    /// Candidates of a generation: whole pairs, for two cores.
    pub generation: usize,
    /// Rounds of first candidates, or generations, without a gain after which an accepted plan is good enough.
    pub patience: usize,
    /// Ratio of scores that is a gain.
    pub gain: f64,
    /// Plans that a sample of the scene judges: few, because who draws often enough wins.
    pub samples: usize,
}

/// Constants of the race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RaceTuning {
    /// Fronts that begin.
    pub fronts: usize,
    /// Cells of the first round; each other round has twice as many as the one before.
    pub cells: usize,
    /// Fronts that come to the end.
    pub last: usize,
    /// Ratio of the mean scores of a front and of the one that leads, in the same cells, from which on it is given up.
    pub lag: f64,
}

impl RaceTuning {
    /// Cells of all rounds.
    #[must_use]
    pub const fn all_cells(&self) -> usize {
        let (mut fronts, mut count, mut all) = (self.fronts, self.cells, self.cells);
        while fronts > self.last {
            fronts = fronts.div_ceil(2);
            count *= 2;
            all += count;
        }
        all
    }
}

/// Constants of the walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WalkTuning {
    /// First step of the logarithm of the ratio of axes.
    pub ratio: f64,
    /// First step of the logarithm of what a front lacks of a square, 1 less its squareness.
    pub squareness: f64,
    /// How square a front may be, from a rhombus to nearly a rectangle.
    pub square: [f64; 2],
    /// First step of the logarithm of the curvature.
    pub curvature: f64,
    /// First step of the logarithm of the slope.
    pub slope: f64,
    /// First step of pull and press.
    pub load: f64,
    /// First step of the pretension.
    pub pretension: f64,
    /// First step of the direction (rad).
    pub angle: f64,
    /// First step of the start, as a share of the fabric.
    pub start: f64,
    /// Factor of a step that did not.
    pub shorter: f64,
    /// Shortest step, in first steps.
    pub shortest: f64,
    /// Ratio of scores that is a gain.
    pub gain: f64,
}

/// The constants in use.
pub const TUNING: PathTuning = PathTuning {
    transport: TransportTuning {
        margin: 0.1,
        divisions: 5,
        boundary_halvings: 24,
        sampling: 0.2,
        most_samples: 2000,
        halvings: 6,
        rounds: 8,
        spare: 0.02,
        tolerance: 1e-3,
        forming_height: 1.0,
        formed_height: 0.1,
        carrying: 0.12,
        forming: 0.17,
        tight: [0.4, 0.85],
        descent: 0.09,
        turn: PI / 30.0,
        most_turning: 0.4,
    },
    front: FrontTuning {
        tip: 1e-3,
        divisions: 4,
        height_nodes: 121,
        height_margin: 0.25,
        upright_border: 0.3,
        border_rounds: 4,
        line_parts: 16,
        tightenings: 500,
        taut: 1e-6,
        table_nodes: 161,
        table_error: 1e-6,
        beyond: 0.02,
        finer: 4,
        umbilic: 0.1,
        steepest: 0.6,
        steepest_on_mounts: 0.85,
        low_slopes: [0.25, 0.14],
        rhombic: -2.0,
        pulled: [1.5, 0.2],
        elongated: [1.9, 4.0],
        elongated_slopes: [0.4, 0.6],
        tilt_share: 0.95,
        slope_rounds: 6,
        ranges: [
            [0.0, 1.0],
            [0.0, 1.0],
            [0.0, 5.0],
            [-FRAC_PI_2, FRAC_PI_2],
            [-1.6 - LN_10, 4.4 - LN_10],
            [-4.0, 0.0],
            [0.0, 2.5e-3],
        ],
    },
    preload: PreloadTuning {
        pull: 0.25,
        most_pull: 2.0,
        border: 2.5,
        corner: 0.8,
        release: 0.4,
        kept: 0.7,
        growing: 0.1,
        press: 0.5,
        press_reach: 0.3,
        seat: [0.4, 0.015],
        slack: 2.0,
        fall: 0.1,
        deviations: 3.0,
    },
    search: SearchTuning {
        good: 0.8,
        promising: [1.4, 1.1],
        promising_on_mounts: 0.9,
        excess: 1.1,
        batch: 4,
        kept: 16,
        steps: [0.1, 0.05],
        near: 1.25,
        fine: 0.5,
        generation: 8,
        patience: 2,
        gain: 0.95,
        samples: 5,
    },
    race: RaceTuning { fronts: 16, cells: 4, last: 4, lag: 1.1 },
    walk: WalkTuning {
        ratio: 0.25,
        squareness: 0.5,
        square: [-4.0, 0.9],
        curvature: 0.35,
        slope: 0.25,
        load: 0.2,
        pretension: 5e-4,
        angle: 0.4,
        start: 0.1,
        shorter: 0.6,
        shortest: 0.3,
        gain: 0.985,
    },
};
