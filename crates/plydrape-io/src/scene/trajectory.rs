//! Gripper positions over the steps from a CSV file.

use super::file::MotionTable;
use super::located::Located;
use super::motion::DURATIONS;
use super::places::{Places, X, Y, Z, csv_file, index, point};
use super::quantity::rounded;
use super::source::Document;
use super::table::{Column, Row, Table};
use super::units::Dimension;
use crate::Error;
use plydrape::measure::Practice;
use plydrape::motion::{MOST_POSITIONS, MOST_STEPS, Motion, SHORTEST_STEP, is_too_short};
use plydrape::ply::{GripperId, Ply, gripper_name, read_gripper_name};
use std::ops::Range;

/// The columns of a motion file; others, such as the attitude `qx` … `qw`, are ignored.
const COLUMNS: [Column; 5] = [
    Column::named(&["t", "time", "zeit", "temps"], Dimension::TIME),
    Column::named(&["gripper"], Dimension::NONE),
    X,
    Y,
    Z,
];

/// A motion from a CSV file, and the start with its places in that file.
pub(super) fn trajectory(
    table: &Located<MotionTable>,
    ply: &Ply,
    scene: &Document,
) -> Result<(Motion, Places), Error> {
    // the scene names a file, which has the steps and the times of the motion
    let Some(name) = &table.value.file else {
        return Err(scene.error(
            table.span.clone(),
            "a motion of kind \"file\" needs a file",
            "add file = \"trajectory.csv\" with the columns t, gripper, x, y, z",
        ));
    };
    let misplaced = table.value.steps.as_ref().map(|steps| &steps.span);
    let misplaced = misplaced.or(table.value.duration.as_ref().map(|duration| &duration.span));
    if let Some(span) = misplaced {
        return Err(scene.error(
            span.clone(),
            "the motion comes from a file, which has its own steps and times",
            "remove `steps` and `duration`, or write kind = \"straight\"",
        ));
    }

    // each row says where one gripper is at one time
    let document = csv_file(&name.value, &name.span, scene)?;
    let mut steps = Steps::new(&document, ply);
    let csv = Table::new(&document, &COLUMNS, &[])?;
    for row in csv.rows() {
        steps.add(&row)?;
    }
    steps.finish(csv.header())?;

    // numbers without a unit must be plausible
    csv.check_plain()?;
    if !csv.has_unit(0) {
        believed(&steps.motion, csv.header(), &document)?;
    }

    // the grippers start where the first step has them
    let (motion, spans) = (steps.motion, steps.first_spans);
    let start = Places {
        points: motion.positions.first().cloned().unwrap_or_default(),
        document,
        spans,
        height: None,
    };
    Ok((motion, start))
}

/// The largest speed (m/s) of a motion at whose times all grippers are slower than grippers are, and not if its times are milliseconds.
#[must_use]
pub fn slow_in_seconds(motion: &Motion) -> Option<f64> {
    let speed = motion.least_peaks(0.0).speed.value;
    let [slowest, fastest] = Practice::SPEED.found;
    (speed < slowest && (slowest..=fastest).contains(&(1e3 * speed))).then_some(speed)
}

/// Refuses times without a unit that look like milliseconds.
fn believed(motion: &Motion, header: Range<usize>, document: &Document) -> Result<(), Error> {
    let Some(speed) = slow_in_seconds(motion) else { return Ok(()) };
    Err(document.error(
        header,
        format!(
            "the column `t` has no unit, and in seconds no gripper would be faster than {} mm/s",
            rounded(1e3 * speed)
        ),
        format!(
            "did you mean ms? {}; name the unit in the header, `t (ms)` or `t (s)`",
            Practice::SPEED.words
        ),
    ))
}

/// The steps of a motion file, as its rows come.
struct Steps<'a> {
    document: &'a Document,
    ply: &'a Ply,
    motion: Motion,
    /// Time written in the file at the first step (s).
    first_time: f64,
    /// Which grippers the last step has so far.
    seen: Vec<bool>,
    /// The row of each gripper in the last step, and in the first.
    spans: Vec<Range<usize>>,
    first_spans: Vec<Range<usize>>,
    last_row: Range<usize>,
}

impl<'a> Steps<'a> {
    fn new(document: &'a Document, ply: &'a Ply) -> Self {
        let grippers = ply.grippers();
        Steps {
            document,
            ply,
            motion: Motion { times: Vec::new(), positions: Vec::new() },
            first_time: 0.0,
            seen: vec![false; grippers],
            spans: vec![0..0; grippers],
            first_spans: Vec::new(),
            last_row: 0..0,
        }
    }

    fn add(&mut self, row: &Row) -> Result<(), Error> {
        // A new time begins a new step.
        let written = row.number(0)?;
        if self.motion.times.is_empty() {
            self.first_time = written;
        }
        let time = written - self.first_time;
        match self.motion.times.last() {
            Some(last) if time == *last => {}
            Some(last) if time < *last => {
                return Err(row.fault(
                    0,
                    format!("the time falls from {} s to {written} s", last + self.first_time),
                    "sort the rows by time: every gripper at one time, then every gripper at the next",
                ));
            }
            Some(last) if is_too_short(time - last) => {
                return Err(row.fault(
                    0,
                    format!("the time rises by {:.1e} s from the step before", time - last),
                    format!(
                        "give each step {SHORTEST_STEP:e} s at least, or leave one of both steps out"
                    ),
                ));
            }
            _ => self.begin(time, row)?,
        }

        // One gripper of the step.
        let gripper = gripper_id(row)?;
        let index = index(gripper, self.ply).map_err(|(m, h)| row.fault(1, m, h))?;
        if std::mem::replace(&mut self.seen[index], true) {
            return Err(row.fault(
                1,
                format!(
                    "gripper {} is listed for the second time at t = {written} s",
                    gripper_name(gripper)
                ),
                "give every gripper one row at every time",
            ));
        }
        if let Some(positions) = self.motion.positions.last_mut() {
            positions[index] = point(row, [2, 3, 4])?;
        }
        self.spans[index] = row.span.clone();
        self.last_row = row.span.clone();
        Ok(())
    }

    fn begin(&mut self, time: f64, row: &Row) -> Result<(), Error> {
        self.complete()?;
        let most = MOST_STEPS.min(MOST_POSITIONS / self.ply.grippers());
        if self.motion.times.len() == most || time > DURATIONS[1] {
            return Err(row.fault(
                0,
                "the motion is too long",
                format!("{most} steps and {:e} s are the most", DURATIONS[1]),
            ));
        }
        self.seen.fill(false);
        self.motion.times.push(time);
        self.motion.positions.push(vec![[0.0; 3]; self.ply.grippers()]);
        Ok(())
    }

    /// Refuses a step in which a gripper is missing or straight above another.
    fn complete(&mut self) -> Result<(), Error> {
        let (Some(time), Some(points)) = (self.motion.times.last(), self.motion.positions.last())
        else {
            return Ok(());
        };
        let Some(missing) = self.seen.iter().position(|seen| !seen) else {
            if self.first_spans.is_empty() {
                self.first_spans.clone_from(&self.spans);
            }
            let places = Places {
                points: points.clone(),
                document: self.document.clone(),
                spans: self.spans.clone(),
                height: None,
            };
            let time = time + self.first_time;
            return places.check_run(self.ply, &format!("at t = {time} s"));
        };
        Err(self.document.error(
            self.last_row.clone(),
            format!(
                "gripper {} has no row at t = {} s",
                gripper_name(self.ply.id(missing)),
                time + self.first_time
            ),
            format!("give every one of the {} grippers one row at every time", self.ply.grippers()),
        ))
    }

    fn finish(&mut self, header: Range<usize>) -> Result<(), Error> {
        if self.motion.times.is_empty() {
            return Err(self.document.error(
                header,
                "there is no row below the header",
                "give one row for every gripper at every time",
            ));
        }
        self.complete()
    }
}

/// A gripper by its name, see [`read_gripper_name`].
fn gripper_id(row: &Row) -> Result<GripperId, Error> {
    let text = row.text(1)?;
    read_gripper_name(text).ok_or_else(|| {
        let help = "write grippers as g2_0, from g0_0; 2-0 and gripper_2_0 are read too";
        row.fault(1, format!("`{text}` is no gripper"), help)
    })
}
