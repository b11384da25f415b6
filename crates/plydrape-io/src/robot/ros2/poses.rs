//! The flange and the pads over time, as poses and as frames.
//!
//! `tf2` and viewers go from one pose to the next on straight lines and shortest turns, so of the samples only those are
//! written between which that is near enough, see [`crate::robot::program::sampling`].

use super::message::{Header, Path, Pose, PoseStamped, TfMessage, Transform, TransformStamped};
use super::{FLANGE, FRAME, TOOL, WORLD, time};
use crate::Error;
use crate::robot::program::pose::{angle, interpolated, quaternion};
use crate::robot::program::sampling::{Deviation, Sampling, thin};
use crate::robot::program::{Program, Tolerance};
use plydrape::geometry::vector::distance;
use plydrape::mold;

/// The samples of the poses that are written.
pub(super) fn sampling(program: &Program, tolerance: &Tolerance) -> Sampling {
    let bodies: Vec<&Vec<mold::Pose>> =
        program.flange.iter().chain(program.pads.iter().map(|pad| &pad.poses)).collect();
    let times = &program.times;
    let off = |a: usize, b: usize, k: usize| {
        let share = (times[k] - times[a]) / (times[b] - times[a]);
        let of_body = |poses: &&Vec<mold::Pose>| {
            let pose = interpolated(&poses[a], &poses[b], share);
            Deviation {
                position: distance(pose.position, poses[k].position),
                angle: angle(&pose, &poses[k]),
            }
        };
        bodies.iter().map(of_body).fold(Deviation::default(), Deviation::or)
    };
    thin(times.len(), &[], tolerance, off)
}

/// The flange at some samples, each with its time.
///
/// # Errors
/// [`Error`] if a time is none that ROS 2 can say.
pub(super) fn flange(program: &Program, kept: &[usize]) -> Result<Option<Path>, Error> {
    let Some(flange) = &program.flange else { return Ok(None) };
    let turns = mold::Pose::quaternions(kept.iter().map(|k| &flange[*k]));
    let pose = |(k, turn): (&usize, [f64; 4])| {
        let pose = Pose { position: flange[*k].position.into(), orientation: turn.into() };
        Ok(PoseStamped { header: header(*k, program.times[*k], FRAME)?, pose })
    };
    let poses = kept.iter().zip(turns).map(pose).collect::<Result<_, Error>>()?;
    Ok(Some(Path { header: header(0, 0.0, FRAME)?, poses }))
}

/// The frames that stand still: the mold in the world, and the tool at the flange.
pub(super) fn fixed(program: &Program) -> Result<TfMessage, Error> {
    let mut transforms = vec![transform(0, 0.0, [WORLD, FRAME], &program.frames.mold)?];
    if program.flange.is_some() {
        transforms.push(transform(0, 0.0, [FLANGE, TOOL], &program.frames.tool)?);
    }
    Ok(TfMessage { transforms })
}

/// The frames that move, at a sample: the flange and the pads in the frame of the mold.
pub(super) fn moving(program: &Program, k: usize) -> Result<TfMessage, Error> {
    let flange = program.flange.iter().map(|flange| (FLANGE, &flange[k]));
    let pads = program.pads.iter().map(|pad| (&*pad.name, &pad.poses[k]));
    let frames = flange.chain(pads);
    let transforms = frames.map(|(name, pose)| transform(k, program.times[k], [FRAME, name], pose));
    Ok(TfMessage { transforms: transforms.collect::<Result<_, _>>()? })
}

fn transform(
    k: usize,
    seconds: f64,
    [parent, child]: [&str; 2],
    pose: &mold::Pose,
) -> Result<TransformStamped, Error> {
    Ok(TransformStamped {
        header: header(k, seconds, parent)?,
        child_frame_id: child.into(),
        transform: Transform {
            translation: pose.position.into(),
            rotation: quaternion(pose).into(),
        },
    })
}

fn header(k: usize, seconds: f64, frame: &str) -> Result<Header, Error> {
    Ok(Header { stamp: time::stamp(time::nanoseconds(k + 1, seconds)?), frame_id: frame.into() })
}
