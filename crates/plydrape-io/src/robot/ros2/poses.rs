//! The flange and the pads over time, as poses and as frames.
//!
//! Every sample of the motion has its pose: a Cartesian controller goes on from one to the next without steps.

use super::message::{Header, Path, Pose, PoseStamped, TfMessage, Transform, TransformStamped};
use super::{FLANGE, FRAME, PREFIX, TOOL, WORLD, time};
use crate::Error;
use crate::robot::program::Program;
use crate::robot::program::pose::quaternion;
use plydrape::mold;

/// The flange at every sample, each with its time.
///
/// # Errors
/// [`Error`] if a time is none that ROS 2 can say.
pub(super) fn flange(program: &Program) -> Result<Option<Path>, Error> {
    let Some(flange) = &program.flange else { return Ok(None) };
    let turns = mold::Pose::quaternions(flange);
    let pose = |(k, turn): (usize, [f64; 4])| {
        let pose = Pose { position: flange[k].position.into(), orientation: turn.into() };
        Ok(PoseStamped { header: header(k, program.times[k], FRAME)?, pose })
    };
    let poses = turns.into_iter().enumerate().map(pose).collect::<Result<_, Error>>()?;
    Ok(Some(Path { header: header(0, 0.0, FRAME)?, poses }))
}

/// The frames that stand still: the mold in the world, and the tool at the flange where the flange is a frame too.
pub(super) fn fixed(program: &Program, tf: bool) -> Result<TfMessage, Error> {
    let mut transforms = vec![transform(0, 0.0, [WORLD, FRAME], &program.frames.mold)?];
    if tf && program.flange.is_some() {
        transforms.push(transform(0, 0.0, [FLANGE, TOOL], &program.frames.tool)?);
    }
    Ok(TfMessage { transforms })
}

/// The frames that move, at a sample: the flange and the pads in the frame of the mold.
pub(super) fn moving(program: &Program, k: usize) -> Result<TfMessage, Error> {
    let flange = program.flange.iter().map(|flange| (FLANGE.to_owned(), &flange[k]));
    let pads = program.pads.iter().map(|pad| (format!("{PREFIX}{}", pad.name), &pad.poses[k]));
    let frames = flange.chain(pads);
    let transforms =
        frames.map(|(name, pose)| transform(k, program.times[k], [FRAME, &name], pose));
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
