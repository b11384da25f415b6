//! Why there is no law, sheet, drape, plan or corrected plan.

use crate::LayupError;
use crate::ply::{GripperId, gripper_name};
use std::fmt;

/// Why a test gives no law, a scene cannot be draped or planned, or a plan cannot be corrected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A mold, an ideal drape or a motion cannot be had.
    #[error(transparent)]
    Layup(#[from] LayupError),

    /// A specimen, or a test, has too few points.
    #[error("{what} has {found} points; expected {expected}")]
    FitTooFew {
        /// Which specimen or test.
        what: String,
        /// How many it has.
        found: usize,
        /// How many it needs.
        expected: usize,
    },
    /// A point of a record shows what no specimen does.
    #[error("{what}, point {}: {fault}", point + 1)]
    FitPoint {
        /// Which specimen.
        what: String,
        /// Index of the point.
        point: usize,
        /// What it shows.
        fault: PointFault,
    },
    /// A record lies beyond what its specimen can do.
    #[error(
        "the displacements of {what} are from {:.1} to {:.1} mm, and its specimen shears between 0 and {:.1} mm",
        1e3 * found[0], 1e3 * found[1], 1e3 * largest
    )]
    FitReach {
        /// Which specimen.
        what: String,
        /// Smallest and largest displacement (m).
        found: [f64; 2],
        /// The largest that the specimen allows (m).
        largest: f64,
    },
    /// A quantity of a test makes no sense.
    #[error("{what} is {value} {unit}; it must be {range}")]
    FitRange {
        /// What quantity.
        what: &'static str,
        /// Value (SI).
        value: f64,
        /// The unit of the value.
        unit: &'static str,
        /// What it may be.
        range: &'static str,
    },
    /// The tests do not show how resin resists shear.
    #[error("the forces of these strips do not depend on how fast they are pulled")]
    FitNoRate,
    /// The points of a specimen lie on no curve of a heavy strip.
    #[error("the points of {what} fit no heavy strip: {reason}")]
    FitNoStrip {
        /// Which specimen.
        what: String,
        /// Why.
        reason: String,
    },

    /// The material of a sheet does not say how it shears.
    #[error(
        "material {material} has no shear curve; the sheet needs one, which a picture-frame or bias-extension test gives"
    )]
    SheetNoShear {
        /// Name of the material.
        material: String,
    },
    /// The material of a sheet does not say how its yarns stretch.
    #[error(
        "material {material} has no tension; the sheet needs the tensile stiffness per width, which a strip tensile test gives"
    )]
    SheetNoTension {
        /// Name of the material.
        material: String,
    },
    /// The mesh of a sheet has no line of nodes between two pads.
    #[error(
        "a mesh of {mesh_mm:.3} mm puts no line of nodes into the {between_mm:.3} mm of fabric between neighboring pads; at most {most_mm:.3} mm does"
    )]
    SheetCoarse {
        /// The mesh (mm).
        mesh_mm: f64,
        /// Fabric between two pads (mm).
        between_mm: f64,
        /// The largest mesh (mm).
        most_mm: f64,
    },
    /// Two pads on a sheet are in each other's way.
    #[error("pads of {radius_mm:.3} mm radius overlap: grippers are {pitch_mm:.3} mm apart")]
    SheetPadsOverlap {
        /// Radius of a pad (mm).
        radius_mm: f64,
        /// Distance of the grippers (mm).
        pitch_mm: f64,
    },
    /// A pad on a sheet reaches beyond the fabric.
    #[error(
        "pads of {radius_mm:.3} mm radius hang over the boundary: the fabric ends {overhang_mm:.3} mm beyond the outermost grippers"
    )]
    SheetPadsOverhang {
        /// Radius of a pad (mm).
        radius_mm: f64,
        /// Fabric beyond the outermost grippers (mm).
        overhang_mm: f64,
    },
    /// A pad is not on the sheet as a whole.
    #[error(
        "the pad of gripper {} has a radius of {radius_mm:.3} mm and its middle is {inside_mm:.3} mm inside the boundary of the ply",
        gripper_name(*gripper)
    )]
    SheetPadOff {
        /// The gripper.
        gripper: GripperId,
        /// Radius of its pad (mm).
        radius_mm: f64,
        /// How far inside the boundary its middle is (mm); negative beyond it.
        inside_mm: f64,
    },
    /// A pad between lines of nodes of a sheet holds too few of them.
    #[error(
        "the pad of gripper {}, of {radius_mm:.3} mm radius, holds no three nodes of a mesh of {mesh_mm:.3} mm: grippers that are not in rows along the yarns need pads larger than the mesh",
        gripper_name(*gripper)
    )]
    SheetPadSmall {
        /// The gripper.
        gripper: GripperId,
        /// Radius of its pad (mm).
        radius_mm: f64,
        /// The mesh (mm).
        mesh_mm: f64,
    },
    /// A pad without a joint holds one point of a sheet, which has no direction.
    #[error(
        "pads without joints hold the ply in their direction, and the pad of gripper {} holds one point of it",
        gripper_name(*gripper)
    )]
    SheetPadPoint {
        /// The gripper.
        gripper: GripperId,
    },
    /// A quantity of a sheet is no number, or has the wrong sign.
    #[error("{what} is {value}; it must be {range}")]
    SheetRange {
        /// What quantity.
        what: &'static str,
        /// Value (SI).
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The tension table of a sheet is none.
    #[error(
        "the tension table of material {material} needs as many strains as forces, at least two, ascending from zero"
    )]
    SheetTensionTable {
        /// Name of the material.
        material: String,
    },
    /// The moment–curvature table of a sheet is none.
    #[error(
        "the moment table of material {material} needs as many curvatures as moments, at least two, both ascending from zero"
    )]
    SheetMomentTable {
        /// Name of the material.
        material: String,
    },
    /// The motion of a sheet has no steps, or steps with another number of grippers.
    #[error("the motion has no steps for {grippers} grippers")]
    SheetNoMotion {
        /// Grippers of the ply.
        grippers: usize,
    },

    /// No catenaries hang in the ply.
    #[error("no catenaries hang between the grippers of this ply; the sheet can drape it")]
    NoCatenaries,
    /// The ply is lifted from a table, which catenaries do not know.
    #[error("catenaries know no table from which a ply could be lifted")]
    CatenariesPickUp,
    /// Grippers are on mounts that give, which catenaries do not follow.
    #[error(
        "catenaries hold their grippers rigidly, and the mounts of these grippers give: {}",
        stiffness(*.lateral, *.axial)
    )]
    CatenariesMounts {
        /// Stiffness of the mounts along the ply (N/m); `None` if rigid.
        lateral: Option<f64>,
        /// Stiffness of the mounts across the ply (N/m); `None` if rigid.
        axial: Option<f64>,
    },

    /// An offset is to be had from one point, or none.
    #[error("how the ply is turned takes two points or more, and their number is {found}")]
    OffsetTooFew {
        /// How many there are.
        found: usize,
    },
    /// The points of an offset lie too close together.
    #[error(
        "the planned points are all within {:.3} mm of their middle, and points are trusted to {:.3} mm: they do not say how the ply is turned",
        1e3 * .reach, 1e3 * .tolerance
    )]
    OffsetTooClose {
        /// Distance of the farthest from the middle (m).
        reach: f64,
        /// What points may be off by (m).
        tolerance: f64,
    },
    /// No offset brings the planned points to the seen ones.
    #[error(
        "point {} is {:.2} mm from where the others put it, more than {:.2} mm: the ply is not where a shift and a turn put it",
        .point + 1, 1e3 * .residual, 1e3 * .tolerance
    )]
    OffsetDistorted {
        /// The point that is farthest off, from 0.
        point: usize,
        /// How far it is off (m).
        residual: f64,
        /// What points may be off by (m).
        tolerance: f64,
    },

    /// The mold of a scene has no point at the place of the ply.
    #[error("the mold has no point at x = {} m, y = {} m", place[0], place[1])]
    MoldNoPoint {
        /// Where the middle of the ply should lie (m).
        place: [f64; 2],
    },
    /// The ideal drape has no place on the mold for some grippers.
    #[error("{missing} grippers have no place on the mold: the ply reaches beyond it, or folds")]
    GrippersOffMold {
        /// How many.
        missing: usize,
    },

    /// The scene has no mold.
    #[error("the scene has no mold to lay the ply on")]
    NoMold,
    /// The scene has no target.
    #[error("the scene has no target: a plan needs to know where the ply shall end")]
    NoTarget,
    /// A checkpoint is for other grippers or other fabric.
    #[error(
        "the earlier plan is for {earlier} grippers, or for other places in the fabric, and the scene has {now}: plan anew"
    )]
    CheckpointOtherPly {
        /// Grippers of the earlier plan.
        earlier: usize,
        /// Grippers of the scene.
        now: usize,
    },
    /// A checkpoint has numbers that no search writes.
    #[error(
        "the earlier plan holds a strategy or positions that no search can have left: plan anew"
    )]
    CheckpointNumbers,
    /// A comparison was ended before the drape of a strategy was complete.
    #[error("interrupted before its drape was complete")]
    ComparisonInterrupted,

    /// A plan was corrected before.
    #[error("the plan was corrected for another pick-up already")]
    ReplanAgain,
    /// Nothing was recorded of the ply of a plan on its way.
    #[error("the result has no states of the ply on its way to the mold")]
    ReplanNoShapes,
    /// The sheet of a plan was draped with its inertia.
    #[error(
        "the sheet of the plan was draped in real time, and how it swings is another thing along another motion"
    )]
    ReplanRealTime,
    /// The drape of a plan ended early.
    #[error("the plan was draped in {steps} of {planned} steps: how its ply lands is not known")]
    ReplanUnfinished {
        /// Steps done.
        steps: usize,
        /// Steps of the motion.
        planned: usize,
    },
    /// The ply of a plan is on the mold before an offset could be taken out.
    #[error("{}", no_transport(*.clear, *.first))]
    ReplanNoTransport {
        /// First step, from 1, in which the ply is clear of what it may lie on.
        clear: usize,
        /// First step in which it touches the mold.
        first: Option<usize>,
    },
    /// The offset of a corrected plan is no number, or beyond all cells.
    #[error("the offset is no number, or a shift beyond 10⁶ m, or a yaw beyond half a turn")]
    ReplanOffset,
    /// The ply of a corrected plan would touch the mold on the way.
    #[error(
        "{at} would touch the mold before the planned landing, in step {step}: it is {distance_mm:.2} mm from it at ({:.1}, {:.1}, {:.1}) mm, and closer than {tolerance_mm} mm counts as touching",
        1e3 * .place[0], 1e3 * .place[1], 1e3 * .place[2]
    )]
    ReplanTouches {
        /// Which part of the ply.
        at: String,
        /// In which step, or on the way to it, from 1.
        step: usize,
        /// Where (m).
        place: [f64; 3],
        /// How far from the mold it is (mm), negative inside it.
        distance_mm: f64,
        /// Distance that counts as touching (mm).
        tolerance_mm: f64,
    },
    /// The turn of a corrected plan is too large for the steps that the transport has.
    #[error(
        "the grippers would pull at the ply in step {step}: the distance of two of them changes by {:.3} %, more than {:.3} %",
        1e2 * .change, 1e2 * .limit
    )]
    ReplanNotRigid {
        /// In which step, from 1.
        step: usize,
        /// Change of the distance as a share of it.
        change: f64,
        /// The largest share that is accepted.
        limit: f64,
    },
    /// Pads of a corrected plan press on the way, and the motion must be slower.
    #[error(
        "the motion would have to take {longer:.3} times as long, and pads that let go on the way after a dwell would do so elsewhere"
    )]
    ReplanDwells {
        /// How many times as long.
        longer: f64,
    },
    /// The positions of a corrected plan cannot become a motion.
    #[error(transparent)]
    ReplanMotion(LayupError),
}

impl Error {
    /// What would help where an offset cannot be had or taken out; empty of other errors.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            // points that give no offset
            Error::OffsetTooFew { .. } => "three points near the corners of the ply are best",
            Error::OffsetTooClose { .. } => {
                "choose points that are far apart, such as the corners of the ply"
            }
            Error::OffsetDistorted { .. } => {
                "see whether two points are swapped, or whether the ply is distorted, which no replanned motion puts right"
            }
            // plans that cannot be corrected
            Error::ReplanAgain => {
                "replan the plan that it came from: the offset is from where that one picks the ply up"
            }
            Error::ReplanNoShapes => "plan again, and keep `sheet.npz` beside the result",
            Error::ReplanRealTime => {
                "plan with time = \"quasi-static\" in [sheet], or plan again with [grippers] where the ply lies"
            }
            Error::ReplanUnfinished { .. } => "replan a plan that was draped to its end",
            Error::ReplanNoTransport { .. } => {
                "plan a pick-up farther from the mold or higher above it, or plan again with [grippers] where the ply lies"
            }
            // offsets that the motion of this plan cannot take out
            Error::ReplanOffset => "give a shift in mm and a yaw up to 180 deg",
            Error::ReplanTouches { .. } => {
                "lay the ply down nearer to where it was planned, or plan again with [grippers] where it lies"
            }
            Error::ReplanNotRigid { .. } => {
                "plan with more `steps`, lay the ply down with less yaw, or plan again with [grippers] where it lies"
            }
            Error::ReplanDwells { .. } => {
                "plan with lower limits of speed and acceleration, or without a dwell"
            }
            Error::ReplanMotion(_) => "this is a fault of the plan: plan anew",
            _ => "",
        }
    }
}

fn no_transport(clear: usize, first: Option<usize>) -> String {
    match first {
        Some(first) => format!(
            "the ply is clear of what it may lie on from step {clear} on and touches the mold in step {first}: the offset cannot be taken out in between"
        ),
        None => format!(
            "the ply is clear of what it may lie on only from step {clear} on: the offset cannot be taken out after it"
        ),
    }
}

/// How stiff mounts are, in N/mm: `2 N/mm along the ply, 5 N/mm across it`.
fn stiffness(lateral: Option<f64>, axial: Option<f64>) -> String {
    let along = |(k, axis): (Option<f64>, &str)| Some(format!("{} N/mm {axis}", k? / 1e3));
    let axes = [(lateral, "along the ply"), (axial, "across it")];
    axes.into_iter().filter_map(along).collect::<Vec<_>>().join(", ")
}

/// What no specimen does, at a point of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PointFault {
    /// The displacement or curvature is below zero.
    Backwards,
    /// The force or moment is below zero, and more than that by noise.
    BelowZero,
    /// A force or moment where nothing is deformed yet.
    NotZero,
    /// The displacement or curvature goes back and forth: another cycle, or another specimen.
    Returns,
    /// The displacement or curvature falls from the first point on.
    Falls,
    /// The force or moment falls from a peak before which there are fewer than three points.
    FallsEarly,
    /// A point of a hanging strip is behind its edge.
    BehindEdge,
    /// A strip bends upwards.
    Upwards,
    /// The time does not rise.
    Untimely,
}

impl fmt::Display for PointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PointFault::Backwards => "the displacement is below zero",
            PointFault::BelowZero => "the specimen pushes back: the load is below zero",
            PointFault::NotZero => "there is a load where nothing is deformed yet",
            PointFault::Returns => "the record goes back and begins to rise again",
            PointFault::Falls => "the displacement falls from the first point on",
            PointFault::FallsEarly => {
                "the load falls here from a peak, and fewer than three points are before it"
            }
            PointFault::BehindEdge => "a point of the strip lies behind the edge",
            PointFault::Upwards => "the strip bends upwards",
            PointFault::Untimely => "the time does not rise",
        })
    }
}

impl PointFault {
    /// What would be right.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        match self {
            PointFault::Backwards => {
                "let the displacement begin at zero where the loading begins, and rise from there; see whether its sign is right"
            }
            PointFault::BelowZero => {
                "the sign or the zero of the load is wrong: change the sign of the column, or subtract what the load cell shows without a specimen"
            }
            PointFault::NotZero => {
                "the zero of the load is wrong: subtract what the load cell shows without a specimen"
            }
            PointFault::Returns => {
                "give each specimen a file of its own, and of several cycles the first loading"
            }
            PointFault::Falls => {
                "give the rows of the loading in the order of time; see whether the sign of the displacement is right"
            }
            PointFault::FallsEarly => {
                "remove the rows that are no part of the loading, such as a jump of the load cell at the start"
            }
            PointFault::BehindEdge => "x goes away from the edge: change the sign of the column",
            PointFault::Upwards => {
                "z goes up, so that a strip that hangs has points below zero: change the sign of the column"
            }
            PointFault::Untimely => {
                "give the rows in the order of time, with as many digits of the time as tell them apart"
            }
        }
    }
}
