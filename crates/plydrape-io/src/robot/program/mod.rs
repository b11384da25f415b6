//! The program of a cell: what its flange, its axes and its vacuum do over time, and files of it that controllers run.
//!
//! 1. [`Program`] is made of a result and is all that the files need;
//! 2. `pose` says an orientation as each controller does: a quaternion, angles about z, y and x, a rotation vector;
//! 3. [`sampling`] leaves out the samples that a controller interpolates well enough by itself, and `spline` adds those that a spline needs;
//! 4. `blocks` parts what is kept at its stops, and says with which zone each point is passed;
//! 5. [`template`] writes a [`Robot`]'s files from templates, the shipped ones or a user's copies, with the variables of
//!    `context`, in the bounds of `render`;
//! 6. `names` makes the names of these files, and of what is in them, from the scene's title;
//! 7. [`wide`] is the program as one table, and [`cam`] what the axes of the array do as a cam of the arm's progress.

mod blocks;
pub mod cam;
mod context;
mod names;
pub(crate) mod pose;
mod render;
pub mod sampling;
mod spline;
pub mod template;
pub mod wide;

pub use render::LONGEST as LONGEST_TEMPLATE;
pub use sampling::Tolerance;
pub use template::{Robot, Template};

use crate::Error;
use crate::result::{ResultFile, Turned};
use crate::store::shown;
use crate::text::table;
use crate::write::csv;
use plydrape::LayupError;
use plydrape::arm::{Angles, Arm};
use plydrape::geometry::Pose;
use plydrape::geometry::vector::{cross, dot, norm};
use plydrape::measure::Name;
use plydrape::outcome::Summary;
use plydrape::ply::{GripperId, gripper_name};
use plydrape::scene::BookPly;
pub use plydrape::sheet::{Event, EventKind};
use plydrape::tool::{Posture, Tool};

/// What a cell does over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// Title of the scene.
    pub name: String,
    /// Which ply of a plybook it lays; `None` of a scene by itself.
    pub book_ply: Option<BookPly>,
    /// Whether the motion keeps all limits.
    pub accepted: bool,
    /// The verdict, in one line.
    pub verdict: String,
    /// Times (s), strictly ascending from 0.
    pub times: Vec<f64>,
    /// Samples a second (Hz) of a planned motion, which goes on smoothly between [`Self::times`]; none of a drape that is
    /// known in its steps alone.
    pub rate: Option<f64>,
    /// The flange in the frame of the mold at each time, if one arm holds the array.
    pub flange: Option<Vec<Pose>>,
    /// The axes that move grippers; those of one gripper are at right angles to each other.
    pub axes: Vec<Axis>,
    /// The pads.
    pub pads: Vec<Pad>,
    /// What the vacuum does, in the order of time.
    pub events: Vec<Event>,
    /// How long the vacuum of each pad is waited for at the grip (s); `None` if it is not.
    pub vacuum_timeout: Option<f64>,
    /// Where the frames are.
    pub frames: Frames,
    /// The joints of the arm; `None` where it is not known.
    pub arm: Option<ArmJoints>,
}

/// The joints of an arm over time.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmJoints {
    /// The arm.
    pub arm: Arm,
    /// The angle of each joint at each time (rad).
    pub angles: Vec<Angles>,
}

/// A linear axis that moves a gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the gripper and of the direction, as in `g2_0_z`.
    pub name: String,
    /// The gripper.
    pub gripper: GripperId,
    /// Where it is at each time (m).
    pub values: Vec<f64>,
    /// Least and largest value (m), where they are known.
    pub stroke: Option<[f64; 2]>,
    /// Largest speed (m/s).
    pub speed: f64,
}

/// The pad of a gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Pad {
    /// Name of the gripper, as in `g2_0`.
    pub name: String,
    /// Where the robot holds it in the frame of the mold at each time, turned as the ply turns it.
    pub poses: Vec<Pose>,
    /// How far its passive joint is tilted at each time (rad): from the direction of the tool, without one from upright. Zero
    /// without joints.
    pub tilts: Vec<f64>,
}

/// The frames of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frames {
    /// The mold's frame, which is the scene's, in the world.
    pub mold: Pose,
    /// The center of the tool in the frame of the flange.
    pub tool: Pose,
}

impl Default for Frames {
    fn default() -> Self {
        Frames { mold: Pose::ORIGIN, tool: Pose::ORIGIN }
    }
}

impl Program {
    /// The program of a result: of a plan sampled at its rate, of a simulated drape in its steps.
    ///
    /// # Errors
    /// [`Error`] if plan and steps do not belong together, or the times do not ascend.
    pub fn new(result: &ResultFile) -> Result<Self, Error> {
        let ply = &result.scene.ply;
        let rate = result.plan.as_ref().map(|plan| plan.rate);
        let (times, mut pads) = pads(result)?;
        let end = times.last().copied().unwrap_or_default();
        let all: Vec<GripperId> = (0..ply.grippers()).map(|n| ply.id(n)).collect();
        let event = |time, kind| Event { time, kind, grippers: all.clone() };

        let (arm, flange, axes, frames) = match &result.scene.tool {
            Some(tool) => {
                let places = |k: usize| -> Vec<[f64; 3]> {
                    pads.iter().map(|pad| pad.poses[k].position).collect()
                };
                let postures: Vec<Posture> =
                    (0..times.len()).map(|k| tool.posture(&places(k))).collect();
                let (flange, axes) = carried(tool, &postures, &mut pads, &all);
                let frames = Frames { mold: tool.world, tool: tool.flange.inverse() };
                (arm_joints(result, &times, &postures), Some(flange), axes, frames)
            }
            // every gripper is a gantry of its own
            None => {
                for pad in &mut pads {
                    pad.tilts = pad.poses.iter().map(|pose| tilt(pose, [0.0, 0.0, 1.0])).collect();
                }
                (
                    None,
                    None,
                    gantries(&pads, &all, result.scene.limits.most(Name::Speed)),
                    Frames::default(),
                )
            }
        };
        let events = match result.events() {
            [] => vec![event(0.0, EventKind::Grip), event(end, EventKind::Release)],
            events => events.to_vec(),
        };

        let judged = result.judged_again();
        let program = Program {
            name: result.scene.title.clone(),
            book_ply: result.scene.book_ply.clone(),
            accepted: judged.accepted(),
            verdict: Program::verdict(result, &judged),
            times,
            rate,
            flange,
            axes,
            pads,
            events,
            vacuum_timeout: result.scene.pick_up.and_then(|pick_up| pick_up.vacuum_timeout),
            frames,
            arm,
        };
        program.check()?;
        Ok(program)
    }

    /// The verdict on a result, as it was judged again, in one line.
    pub(crate) fn verdict(result: &ResultFile, judged: &Summary) -> String {
        let verdict = table::verdict_in_a_line(result, judged);
        match result.plan.as_ref().and_then(shown::picked_up) {
            Some(picked_up) => format!("{verdict}; {picked_up}"),
            None => verdict,
        }
    }

    /// Refuses a program whose lists differ in length, whose times do not ascend from 0, or whose numbers are not finite.
    ///
    /// # Errors
    /// [`Error`] says what is wrong.
    pub fn check(&self) -> Result<(), Error> {
        // times rise from 0
        let count = self.times.len();
        if count == 0 || self.times[0] != 0.0 {
            return Err(Error::not_possible(
                "the motion has no point at 0 s",
                "let it begin there",
            ));
        }
        for (n, pair) in self.times.windows(2).enumerate() {
            if !(pair[0] < pair[1] && pair[1].is_finite()) {
                let message =
                    format!("point {} at {} s is not after the one before", n + 2, pair[1]);
                return Err(Error::not_possible(message, "leave one of them out of the motion"));
            }
        }

        // what has one finite value for each time: poses, axes, tilts of pads, joints of the arm
        let is_finite = |pose: &Pose| {
            pose.position.iter().chain(pose.axes.as_flattened()).all(|x| x.is_finite())
        };
        let poses = |poses: &Vec<Pose>| poses.len() == count && poses.iter().all(is_finite);
        let numbers = |axis: &Axis| {
            axis.values.len() == count && axis.values.iter().all(|value| value.is_finite())
        };
        let tilts =
            |pad: &Pad| pad.tilts.len() == count && pad.tilts.iter().all(|tilt| tilt.is_finite());
        let joints = |arm: &ArmJoints| {
            arm.angles.len() == count && arm.angles.as_flattened().iter().all(|x| x.is_finite())
        };

        // the first part where a value is missing or not finite
        let wrong = (self.flange.iter().find(|flange| !poses(flange)).map(|_| "flange"))
            .or_else(|| self.axes.iter().find(|axis| !numbers(axis)).map(|axis| &*axis.name))
            .or_else(|| {
                self.pads
                    .iter()
                    .find(|pad| !(poses(&pad.poses) && tilts(pad)))
                    .map(|pad| &*pad.name)
            });
        let wrong = wrong.or(self.arm.as_ref().filter(|arm| !joints(arm)).map(|_| "arm"));
        wrong.map_or(Ok(()), |what| {
            let message = format!("{what} has not one finite value for each time of the program");
            Err(Error::not_possible(message, "simulate or plan the scene again"))
        })
    }

    /// The grippers in their order, by their pads.
    pub(crate) fn grippers(&self) -> Vec<String> {
        self.pads.iter().map(|pad| pad.name.clone()).collect()
    }
}

/// The times of a motion (s), and its pads.
fn pads(result: &ResultFile) -> Result<(Vec<f64>, Vec<Pad>), Error> {
    // a pad for each gripper, which gets a pose at each time
    let ply = &result.scene.ply;
    let mut pads: Vec<Pad> = (0..ply.grippers())
        .map(|n| Pad { name: gripper_name(ply.id(n)), poses: Vec::new(), tilts: Vec::new() })
        .collect();
    let mut add = |places: Vec<[f64; 3]>, quaternions: Vec<[f64; 4]>| {
        for ((pad, place), quaternion) in pads.iter_mut().zip(places).zip(quaternions) {
            pad.poses.push(pose::of_quaternion(place, quaternion));
        }
    };

    // a planned motion is written at its rate, any other one step by step
    let times = match (&result.plan, result.motion()?) {
        (Some(plan), Some(Turned { motion, attitudes })) => {
            for found in [motion.grippers(), attitudes.grippers()] {
                if found != ply.grippers() {
                    return Err(
                        LayupError::MotionGrippers { found, expected: ply.grippers() }.into()
                    );
                }
            }
            let times = csv::written_times(result, motion, plan.rate)?;
            times.iter().for_each(|t| add(motion.at(*t), attitudes.at(*t)));
            times
        }
        _ => {
            for step in &result.steps {
                let grippers = step.grippers.iter();
                let (places, turns) = grippers.map(|g| (g.commanded, g.quaternion)).unzip();
                add(places, turns);
            }
            result.steps.iter().map(|step| step.time).collect()
        }
    };
    Ok((times, pads))
}

/// The joints of the arm that brings the pads to their places, in the configuration in which the motion was judged.
fn arm_joints(result: &ResultFile, times: &[f64], postures: &[Posture]) -> Option<ArmJoints> {
    let tool = result.judged_tool()?;
    let angles = tool.arm_along(times, postures, &[])?.angles;
    Some(ArmJoints { arm: result.scene.tool.as_ref()?.arm.clone()?, angles })
}

/// The flange and the strokes of a tool in the postures that bring the pads to their places; the pads get their tilts.
fn carried(
    tool: &Tool,
    postures: &[Posture],
    pads: &mut [Pad],
    ids: &[GripperId],
) -> (Vec<Pose>, Vec<Axis>) {
    for pad in pads.iter_mut() {
        let pad_tilt = |(pose, posture): (&Pose, &Posture)| match tool.fixed_pads {
            Some(_) => 0.0,
            None => tilt(pose, posture.frame.axes[2]),
        };
        pad.tilts = pad.poses.iter().zip(postures).map(pad_tilt).collect();
    }
    let flange = postures.iter().map(|posture| posture.frame.compose(&tool.flange)).collect();
    let strokes = |n: usize, a: usize| -> Vec<f64> {
        postures.iter().map(|posture| posture.strokes[n][a]).collect()
    };
    let axis = |n: usize, a: usize| Axis {
        name: format!("{}_{}", pads[n].name, tool.axes[a].name),
        gripper: ids[n],
        values: csv::without_rounding(strokes(n, a)),
        stroke: Some(tool.axes[a].stroke),
        speed: tool.axes[a].speed,
    };
    let each = (0..pads.len()).flat_map(|n| (0..tool.axes.len()).map(move |a| (n, a)));
    (flange, each.map(|(n, a)| axis(n, a)).collect())
}

/// The angle between the normal of a pad and a direction (unit vector, rad).
fn tilt(pad: &Pose, from: [f64; 3]) -> f64 {
    norm(cross(pad.axes[2], from)).atan2(dot(pad.axes[2], from))
}

/// Three axes a gripper, along the axes of the mold's frame.
fn gantries(pads: &[Pad], ids: &[GripperId], speed: f64) -> Vec<Axis> {
    let axis = |pad: &Pad, gripper: GripperId, n: usize| Axis {
        name: format!("{}_{}", pad.name, ["x", "y", "z"][n]),
        gripper,
        values: pad.poses.iter().map(|pose| pose.position[n]).collect(),
        stroke: None,
        speed,
    };
    let each = pads.iter().zip(ids);
    each.flat_map(|(pad, id)| [0, 1, 2].map(|n| axis(pad, *id, n))).collect()
}
