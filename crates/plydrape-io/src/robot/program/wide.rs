//! The program as one table, `motion_wide.csv`, or `NAME_wide.csv` beside a program `NAME` of a robot: a row a time, a column a number.
//!
//! | columns | |
//! |---|---|
//! | `t (s)` | time |
//! | `flange x (m)`, `y`, `z`, `qx`, `qy`, `qz`, `qw` | the flange in the frame of the mold, if one arm holds the array |
//! | `g2_0_z (m)` | an axis |
//! | `g2_0 vacuum` | 1 while the vacuum of a gripper is on, else 0 |
//! | `g2_0 tilt (deg)` | the angle of a passive joint; no axis moves it |
//!
//! Numbers are in the shortest form that reads back to the same double; what is rounding beside the other components of its vector, or
//! beside the largest stroke of its axis, is zero.

use super::context::rejected;
use super::sampling::nearest;
use super::{Event, EventKind, Program};
use crate::Error;
use crate::write::csv::{cell, comment, number, text as text_of, without_rounding};
use ::csv::Writer;
use plydrape::geometry::Pose;
use plydrape::ply::gripper_name;

/// Name of the file.
pub const FILE: &str = "motion_wide.csv";

/// Name of the file beside the program of a robot, by the name of that.
pub(super) fn beside(program: &str) -> String {
    format!("{program}_{}", FILE.trim_start_matches("motion_"))
}

/// The table. Of a motion that is not accepted, a comment above the header says so.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn text(program: &Program) -> Result<String, Error> {
    let mut header = vec!["t (s)".to_owned()];
    if program.flange.is_some() {
        header.extend(
            ["x (m)", "y (m)", "z (m)", "qx", "qy", "qz", "qw"].map(|c| format!("flange {c}")),
        );
    }
    header.extend(program.axes.iter().map(|axis| cell(&format!("{} (m)", axis.name))));
    header.extend(program.grippers().iter().map(|name| format!("{name} vacuum")));
    header.extend(program.grippers().iter().map(|name| format!("{name} tilt (deg)")));
    let mut table = Writer::from_writer(Vec::new());
    table.write_record(&header)?;
    let vacuum = vacuum(program);
    let turns = Pose::quaternions(program.flange.iter().flatten());
    for (k, time) in program.times.iter().enumerate() {
        let mut row = vec![number(*time)];
        if let Some(flange) = &program.flange {
            row.extend(without_rounding(flange[k].position).map(number));
            row.extend(without_rounding(turns[k]).map(number));
        }
        row.extend(program.axes.iter().map(|axis| number(axis.values[k])));
        row.extend(vacuum[k].iter().map(|on| u8::from(*on).to_string()));
        row.extend(program.pads.iter().map(|pad| number(pad.tilts[k].to_degrees())));
        table.write_record(&row)?;
    }
    Ok(head(program) + &text_of(table)?)
}

/// A comment that says that the motion is not accepted, if it is not: readers of tables expect the header first.
pub(crate) fn head(program: &Program) -> String {
    if program.accepted { String::new() } else { comment(&rejected(program)) }
}

/// The verdict as a comment.
pub(crate) fn verdict(program: &Program) -> String {
    match program.accepted {
        true => comment(&format!("Verdict: {}", program.verdict)),
        false => head(program),
    }
}

/// Whether the vacuum of each gripper is on at each time, from the sample nearest to each event on.
fn vacuum(program: &Program) -> Vec<Vec<bool>> {
    let names = program.grippers();
    let mut on = vec![vec![false; names.len()]; program.times.len()];
    for Event { time, kind, grippers } in &program.events {
        let from = nearest(&program.times, *time);
        for id in grippers {
            let Some(n) = names.iter().position(|name| *name == gripper_name(*id)) else {
                continue;
            };
            for row in &mut on[from..] {
                row[n] = *kind != EventKind::Release;
            }
        }
    }
    on
}
