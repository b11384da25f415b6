//! A result for ROS 2: the grippers' trajectory as a message in YAML, and a bag of it with the ply's shape.
//!
//! - `trajectory.yaml`: one `trajectory_msgs/msg/MultiDOFJointTrajectory`, in the block style that
//!   `ros2 topic echo` prints and `ros2 topic pub` reads;
//! - `loads.yaml`, where they are known: the expected loads on the grippers at the same times, and the preload of their
//!   mounts, as one `trajectory_msgs/msg/JointTrajectory`;
//! - `trajectory.mcap`: a bag that `ros2 bag play` and viewers open, with the topics
//!
//! | topic | message | when |
//! |---|---|---|
//! | [`TRAJECTORY`] | the same trajectory | once, at the start |
//! | [`LOADS`] | the same loads | once, at the start, if they are known |
//! | [`MOLD`] | `visualization_msgs/msg/MarkerArray`, the mold | once, at the start, if there is a mold |
//! | [`PLY`] | `visualization_msgs/msg/MarkerArray`: surface, catenaries, contact, grippers | every step, at its time |
//!
//! Metres, seconds, radians; z up; the frame [`FRAME`] is that of the scene. `message` holds the messages as
//! Rust types, `cdr` and `bag` their bytes, `schema` their definitions; `trajectory` and `markers` fill them from a
//! result.

mod bag;
mod cdr;
mod error;
mod loads;
mod markers;
mod message;
mod schema;
mod time;
mod trajectory;
mod turning;

pub use error::Ros2Error;

use super::loads::Loads;
use super::{OutputError, finite};
use crate::result::ResultFile;
use bag::Bag;

/// The frame of all positions: the scene's own.
pub const FRAME: &str = "mold";
/// Topic of the grippers' trajectory.
pub const TRAJECTORY: &str = "/plydrape/trajectory";
/// Topic of the expected loads.
pub const LOADS: &str = "/plydrape/loads";
/// Name of the bag's record of the mounts' stiffness.
pub const MOUNTS: &str = "plydrape_mounts";
/// Topic of the mold's marker.
pub const MOLD: &str = "/plydrape/mold";
/// Topic of the ply's markers.
pub const PLY: &str = "/plydrape/ply";

/// `trajectory.yaml`, `trajectory.mcap`, and where loads are known `loads.yaml`: names and contents. Same result, same bytes.
///
/// # Errors
/// [`OutputError`] if a number is not finite, a time is none that ROS 2 can say, or the states of the sheet cannot be read.
pub fn files(result: &ResultFile) -> Result<Vec<(String, Vec<u8>)>, OutputError> {
    let trajectory = trajectory::trajectory(result)?;
    finite::check(&trajectory)?;
    let yaml = yaml(&trajectory)?;

    let mut bag = Bag::new()?;
    bag.latched(TRAJECTORY, schema::TRAJECTORY, &trajectory)?;
    let known = Loads::of(result)?;
    let mut more = Vec::new();
    if let Some(known) = &known {
        let loads = loads::loads(result, known, &trajectory)?;
        finite::check(&loads)?;
        bag.latched(LOADS, schema::LOADS, &loads)?;
        let mut text = String::new();
        if let Some(mounts) = known.mounts {
            text = loads::head(mounts);
            bag.note(MOUNTS, loads::stiffness(mounts))?;
        }
        more.push(("loads.yaml".into(), (text + &self::yaml(&loads)?).into_bytes()));
    }
    if let Some(mold) = markers::mold(result) {
        bag.latched(MOLD, schema::MARKERS, &mold)?;
    }
    bag.channel(PLY, schema::MARKERS, bag::VOLATILE)?;
    let paint = markers::Paint::of(result);
    for step in &result.steps {
        let ply = markers::ply(result, step, &paint);
        finite::check(&ply)?;
        bag.write(PLY, time::nanoseconds(step.step, step.time)?, &ply)?;
    }
    let mut files = vec![
        ("trajectory.yaml".into(), yaml.into_bytes()),
        ("trajectory.mcap".into(), bag.finish()?),
    ];
    files.extend(more);
    Ok(files)
}

/// A message as `ros2 topic echo` prints it.
///
/// Readers of YAML 1.1, as Python's, take a number with an exponent for text unless it has a point and a sign:
/// `1.0e-07`. Python knows `y` as a name, which others of that version do not, so it stands unquoted.
fn yaml<T: serde::Serialize>(message: &T) -> Result<String, Ros2Error> {
    let options = serde_saphyr::ser_options! {
        yaml_12: true,
        no_lang_directive: true,
        compact_list_indent: true,
    };
    Ok(serde_saphyr::to_string_with_options(message, options)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// Two files, and the same bytes again from the same result.
    #[test]
    fn the_same_result_gives_the_same_bytes() {
        let result = sample::draped(3, 2, 4);
        let first = files(&result).unwrap();
        let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["trajectory.yaml", "trajectory.mcap"]);
        assert!(first == files(&result).unwrap());
    }

    /// A step that is not later than the one before has no place in a trajectory.
    #[test]
    fn times_that_do_not_grow_are_refused() {
        let mut result = sample::draped(2, 2, 3);
        result.steps[2].time = result.steps[1].time + 1e-10;
        let fault = files(&result).unwrap_err().to_string();
        assert!(fault.contains("nanosecond"), "{fault}");
        result.steps[0].time = -1.0;
        let fault = files(&result).unwrap_err().to_string();
        assert!(fault.contains("-1"), "{fault}");
    }

    /// Every number has a point, and a sign before its exponent: Python reads it as a number.
    #[test]
    fn numbers_are_numbers_for_readers_of_either_version() {
        let mut result = sample::draped(2, 2, 2);
        result.steps[0].grippers[0].position = [1e-7, -1e22, 3.0];
        let text = String::from_utf8(files(&result).unwrap().remove(0).1).unwrap();
        for wanted in ["x: 1.0e-7\n", "y: -1.0e+22\n", "z: 3.0\n"] {
            assert!(text.contains(wanted), "{wanted} is not in\n{text}");
        }
    }
}
