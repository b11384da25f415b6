//! A result for ROS 2: what its axes, its flange and its vacuum do, as messages in YAML, and a bag of it with the ply's shape.
//!
//! - `trajectory.yaml`: one `trajectory_msgs/msg/JointTrajectory` of the axes, in the block style that `ros2 topic echo`
//!   prints and `ros2 topic pub` reads;
//! - `flange.yaml`, if one arm holds the array: one `nav_msgs/msg/Path` of its flange;
//! - `vacuum.yaml`: what the vacuum does, one `control_msgs/msg/DynamicInterfaceGroupValues` behind the other;
//! - `loads.yaml`: the expected loads on the grippers at the same times, and the preload of their
//!   mounts, as one `trajectory_msgs/msg/JointTrajectory`;
//! - `array.urdf`, `controllers.yaml` and `array.launch.py`: the array for `ros2_control`;
//! - `trajectory.mcap`: a bag that `ros2 bag play` and viewers open, with the topics
//!
//! | topic | message | when |
//! |---|---|---|
//! | [`TRAJECTORY`] | the same trajectory | once, at the start |
//! | [`PATH`] | the same path | once, at the start, if there is a flange |
//! | [`POSE`] | `geometry_msgs/msg/PoseStamped`, the flange | at every sample, if there is one |
//! | [`VACUUM`] | the same commands | each at its time |
//! | `/tf_static` | `tf2_msgs/msg/TFMessage`: the mold in the world; with `/tf` the tool at the flange | once, at the start |
//! | `/tf` | `tf2_msgs/msg/TFMessage`: the flange and every pad, by its gripper's name, at the mold | at every sample, on request alone |
//! | [`LOADS`] | the same loads | once, at the start |
//! | [`MOLD`] | `visualization_msgs/msg/MarkerArray`, the mold | once, at the start, if there is a mold |
//! | [`PLY`] | `visualization_msgs/msg/MarkerArray`: surface, catenaries, contact, grippers | every step, at its time; of a sheet in the steps that were kept |
//!
//! Meters, seconds, radians; z up; the frame [`FRAME`] is that of the scene. `message` holds the messages as
//! Rust types, `cdr` and `bag` their bytes, `schema` their definitions; `trajectory`, `poses` and `vacuum` fill them from a
//! program, `loads` and `markers` from a result.

mod bag;
mod cdr;
mod description;
mod loads;
mod markers;
mod message;
mod poses;
mod schema;
mod time;
mod trajectory;
mod vacuum;

use crate::Error;
use crate::result::ResultFile;
use crate::result::sheet::{SheetKept, SheetStates};
use crate::robot::program::{Program, wide};
use crate::store::folder::Files;
use crate::store::json::finite;
use crate::write::loads::Loads;
use bag::Bag;
use plydrape::layup::Model;

/// How the names of all frames but [`WORLD`] begin, because robots have frames of the names `flange` and `tool` (REP 199).
pub const PREFIX: &str = "ply_";
/// The frame of all positions: the scene's own.
pub const FRAME: &str = "ply_mold";
/// The frame in which the mold stands.
pub const WORLD: &str = "world";
/// The frame of the flange.
pub const FLANGE: &str = "ply_flange";
/// The frame of the tool's center.
pub const TOOL: &str = "ply_tool";
/// What is said above the trajectory of axes that an arm carries.
const ALONE: &str = "# Nothing here holds these axes together with the arm: never run them while it moves at reduced speed\n";
/// Topic of the trajectory of the axes.
pub const TRAJECTORY: &str = "/plydrape/trajectory";
/// Topic of the path of the flange.
pub const PATH: &str = "/plydrape/flange";
/// Topic of the flange over time.
pub const POSE: &str = "/plydrape/flange_pose";
/// Topic of what the vacuum does.
pub const VACUUM: &str = "/plydrape/vacuum";
/// Topic of the expected loads.
pub const LOADS: &str = "/plydrape/loads";
/// Name of the bag's record of the verdict.
pub const PROGRAM: &str = "plydrape_program";
/// Name of the bag's record of the mounts' stiffness.
pub const MOUNTS: &str = "plydrape_mounts";
/// Topic of the mold's marker.
pub const MOLD: &str = "/plydrape/mold";
/// Topic of the ply's markers.
pub const PLY: &str = "/plydrape/ply";

/// The files of a result: names and contents; with `tf`, the bag has the frames over time. Same result, same bytes.
///
/// # Errors
/// [`Error`] if a number is not finite, a time is none that ROS 2 can say, or the states of the sheet cannot be read.
pub fn files(result: &ResultFile, tf: bool) -> Result<Files, Error> {
    // the motion, and the description of the array that makes it
    let program = Program::new(result)?;
    let (mut bag, mut files) = motion(&program, tf)?;
    files.extend(description::files(result, &program));

    // the loads that the grippers are expected to carry
    if let Some(known) = &Loads::new(result) {
        let loads = loads::loads(&program, known)?;
        finite::check(&loads)?;
        bag.latched(LOADS, schema::JOINTS, &loads)?;
        let mut text = wide::verdict(&program);
        if let Some(mounts) = known.mounts {
            text += &loads::head(mounts);
            bag.note(MOUNTS, loads::stiffness(mounts))?;
        }
        files.push(("loads.yaml".into(), (text + &yaml(&loads)?).into_bytes()));
    }

    // the mold, which is the same all the time
    if let Some(mold) = markers::mold(result) {
        bag.latched(MOLD, schema::MARKERS, &mold)?;
    }

    // the ply in each step, with the state of the sheet if the sheet decides and the state was kept
    bag.channel(PLY, schema::MARKERS, bag::VOLATILE)?;
    let paint = markers::Paint::new(result);
    let decides = result.sheet_states.as_ref().filter(|_| result.model() == Model::Sheet);
    let mut sheet = decides.map(SheetKept::open).transpose()?;
    let kept = sheet.as_mut().map(SheetStates::steps).transpose()?.unwrap_or_default();
    for step in &result.steps {
        let number = kept.iter().find(|(kept, _)| *kept == step.step).map(|(_, number)| *number);
        let state = match (&mut sheet, number) {
            (Some(sheet), Some(number)) => sheet.state(number)?,
            _ => None,
        };
        let shown = sheet.as_ref().zip(state.as_ref()).map(|(sheet, state)| (sheet.mesh(), state));
        let ply = markers::ply(result, step, shown, &paint);
        finite::check(&ply)?;
        bag.write(PLY, time::nanoseconds(step.step, step.time)?, &ply)?;
    }
    files.push(("trajectory.mcap".into(), bag.finish()?));
    Ok(files)
}

/// The files of a program alone, without loads and without the shape of the ply.
///
/// # Errors
/// As [`files`].
pub fn program_files(program: &Program, tf: bool) -> Result<Files, Error> {
    let (bag, mut files) = motion(program, tf)?;
    files.push(("trajectory.mcap".into(), bag.finish()?));
    Ok(files)
}

/// The bag of a program under way, and its other files.
fn motion(program: &Program, tf: bool) -> Result<(Bag, Files), Error> {
    // what every file says first: whether the plan is accepted
    program.check()?;
    let mut bag = Bag::new()?;
    let mut files: Files = Vec::new();
    let head = wide::verdict(program);

    // the trajectory of the axes of the array, and of the joints of the arm
    if !program.axes.is_empty() || program.arm.is_some() {
        let trajectory = trajectory::trajectory(program)?;
        finite::check(&trajectory)?;
        bag.latched(TRAJECTORY, schema::JOINTS, &trajectory)?;
        let alone = if program.flange.is_some() && program.arm.is_none() { ALONE } else { "" };
        let text = head.clone() + alone + &yaml(&trajectory)?;
        files.push(("trajectory.yaml".into(), text.into_bytes()));
    }

    // the path of the flange as a whole, and its poses in time
    if let Some(path) = poses::flange(program)? {
        finite::check(&path)?;
        bag.latched(PATH, schema::PATH, &path)?;
        bag.channel(POSE, schema::POSE, bag::VOLATILE)?;
        for (k, pose) in path.poses.iter().enumerate() {
            bag.write(POSE, time::nanoseconds(k + 1, program.times[k])?, pose)?;
        }
        files.push(("flange.yaml".into(), (head.clone() + &yaml(&path)?).into_bytes()));
    }

    // frames that do not move, and on request those that do
    bag.latched("/tf_static", schema::FRAMES, &poses::fixed(program, tf)?)?;
    if tf {
        bag.channel("/tf", schema::FRAMES, bag::VOLATILE)?;
        for (k, time) in program.times.iter().enumerate() {
            let frames = poses::moving(program, k)?;
            finite::check(&frames)?;
            bag.write("/tf", time::nanoseconds(k + 1, *time)?, &frames)?;
        }
    }

    // when the vacuum switches
    let commands = vacuum::commands(program)?;
    if !commands.is_empty() {
        bag.channel(VACUUM, schema::OUTPUTS, bag::VOLATILE)?;
        let mut texts = Vec::new();
        for (at, command) in &commands {
            bag.write(VACUUM, *at, command)?;
            texts.push(yaml(command)?);
        }
        files.push(("vacuum.yaml".into(), (head + &texts.join("---\n")).into_bytes()));
    }

    // the verdict is in the recording itself, which may be copied without the other files
    bag.note(
        PROGRAM,
        [("accepted", program.accepted.to_string()), ("verdict", program.verdict.clone())],
    )?;

    Ok((bag, files))
}

/// A message as `ros2 topic echo` prints it.
///
/// Readers of YAML 1.1, as Python's, take a number with an exponent for text unless it has a point and a sign:
/// `1.0e-07`. Python knows `y` as a name, which others of that version do not, so it stands unquoted.
fn yaml<T: serde::Serialize>(message: &T) -> Result<String, Error> {
    let options = serde_saphyr::ser_options! {
        yaml_12: true,
        no_lang_directive: true,
        compact_list_indent: true,
    };
    serde_saphyr::to_string_with_options(message, options)
        .map_err(|fault| Error::Internal(format!("cannot write a ROS 2 message as YAML: {fault}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// A result gives the same bytes each time.
    #[test]
    fn the_same_result_gives_the_same_bytes() {
        let result = sample::draped(3, 2, 4);
        let first = files(&result, false).unwrap();
        let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            names,
            [
                "trajectory.yaml",
                "vacuum.yaml",
                "array.urdf",
                "controllers.yaml",
                "array.launch.py",
                "loads.yaml",
                "trajectory.mcap"
            ]
        );
        assert!(first == files(&result, false).unwrap());
    }

    /// A step that is not later than the one before has no place in a trajectory.
    #[test]
    fn times_that_do_not_grow_are_refused() {
        let mut result = sample::draped(2, 2, 3);
        result.steps[2].time = result.steps[1].time + 1e-10;
        let fault = files(&result, false).unwrap_err().to_string();
        assert!(fault.contains("nanosecond"), "{fault}");
        result.steps[0].time = -1.0;
        let fault = files(&result, false).unwrap_err().to_string();
        assert!(fault.contains("no point at 0 s"), "{fault}");
    }

    /// Every number has a point, and a sign before its exponent: Python reads it as a number.
    #[test]
    fn numbers_are_numbers_for_readers_of_either_version() {
        let mut result = sample::draped(2, 2, 2);
        result.steps[0].grippers[0].commanded = [1e-7, -1e22, 3.0];
        let files = files(&result, false).unwrap();
        let text = String::from_utf8(files[0].1.clone()).unwrap();
        for wanted in ["- 1.0e-7\n", "- -1.0e+22\n", "- 3.0\n"] {
            assert!(text.contains(wanted), "{wanted} is not in\n{text}");
        }
    }
}
