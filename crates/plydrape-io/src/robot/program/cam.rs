//! The axes of the array as a cam of the motion's progress: `array_cam.csv`, or `NAME_cam.csv` beside a program `NAME` of a robot.
//!
//! The controller of the arm interpolates the progress as one more axis, and that of the array follows it by this table, on straight lines between
//! its rows. So the array is where it belongs to the place of the arm at any speed, and stands where the arm stands.
//!
//! | column | |
//! |---|---|
//! | `progress (mm)` | from 0 to 1000 over the motion, each row after the one before; times at which everything rests have none |
//! | `g2_0_z (m)` | an axis |

use super::Program;
use super::sampling::Track;
use super::wide::head;
use crate::Error;
use crate::write::csv::{cell, number, text as text_of};
use ::csv::Writer;

/// Name of the file.
pub const FILE: &str = "array_cam.csv";

/// Progress at the end (m), which is a length because controllers have linear axes.
pub(super) const LENGTH: f64 = 1.0;

/// Name of the file beside the program of a robot, by the name of that.
pub(super) fn beside(program: &str) -> String {
    format!("{program}_cam.csv")
}

/// The table; `None` where no arm holds the array, or it has no axes.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn text(program: &Program) -> Result<Option<String>, Error> {
    if program.flange.is_none() || program.axes.is_empty() {
        return Ok(None);
    }
    let progress = Track::new(program, false).progress;
    let mut table = Writer::from_writer(Vec::new());
    let names = program.axes.iter().map(|axis| cell(&format!("{} (m)", axis.name)));
    table.write_record(std::iter::once("progress (mm)".to_owned()).chain(names))?;
    for (k, share) in progress.iter().enumerate() {
        if k > 0 && *share <= progress[k - 1] {
            continue;
        }
        let values = program.axes.iter().map(|axis| number(axis.values[k]));
        table.write_record(std::iter::once(number(1e3 * LENGTH * share)).chain(values))?;
    }
    Ok(Some(head(program) + &text_of(table)?))
}
