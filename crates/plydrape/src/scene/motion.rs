//! Gripper positions over the steps: straight, held, or from a file.

use super::csv::{Column, Csv, Row};
use super::error::{Document, SceneError};
use super::file::{MotionKind, MotionTable};
use super::places::{Places, X, Y, Z, csv_file, in_grid, point};
use super::quantity::{Count, Located};
use super::units::Dimension;
use super::{Motion, Target};
use crate::ply::{Grid, GripperId, Ply};
use std::ops::Range;
use std::path::Path;

/// Steps of a straight motion unless given, as in Krogh et al. 2018.
const STEPS: usize = 30;
/// Most steps of a motion.
const MOST_STEPS: usize = 1_000_000;
/// Most gripper positions of a motion: a gigabyte of them.
pub(super) const MOST_POSITIONS: usize = 50_000_000;
/// Shortest and longest duration (s).
const DURATIONS: [f64; 2] = [1e-6, 1e7];

/// A motion from the start, straight to a target or held.
pub(super) fn motion(
    table: Option<&Located<MotionTable>>,
    start: &Places,
    target: Option<&Target>,
    ply: &Ply,
    document: &Document,
) -> Result<Motion, SceneError> {
    let keys = table.map(|t| &t.value);
    let kind = match keys {
        Some(keys) => keys.kind,
        None if target.is_some() => MotionKind::Straight,
        None => MotionKind::Hold,
    };
    if let Some(file) = keys.and_then(|k| k.file.as_ref()) {
        return Err(document.error(
            file.span.clone(),
            "`file` belongs to a motion of kind \"file\"",
            "write kind = \"file\", or remove `file`",
        ));
    }
    if kind == MotionKind::Hold {
        return hold(keys, start, document);
    }
    let Some(target) = target else {
        let place = table.map_or(0..0, |t| t.span.clone());
        return Err(document.error(
            place,
            "a straight motion needs a target, and the scene has none",
            "add [target], or write kind = \"hold\"",
        ));
    };

    // Step 1 is the start, the last step the target.
    let steps = match keys.and_then(|k| k.steps.as_ref()) {
        Some(steps) => step_count(steps, ply.grid, document)?,
        None => STEPS,
    };
    let last = (steps - 1) as f64;
    let duration = match keys.and_then(|k| k.duration.as_ref()) {
        Some(duration) => duration.within(document, DURATIONS)?,
        None => last,
    };
    let motion = Motion {
        times: (0..steps).map(|k| duration * (k as f64 / last)).collect(),
        positions: (0..steps)
            .map(|k| between(&start.points, &target.grippers, k as f64 / last))
            .collect(),
    };
    check_runs(&motion, start, ply)?;
    Ok(motion)
}

fn hold(
    keys: Option<&MotionTable>,
    start: &Places,
    document: &Document,
) -> Result<Motion, SceneError> {
    let stray = keys.and_then(|keys| {
        let steps = keys.steps.as_ref().map(|steps| &steps.span);
        steps.or(keys.duration.as_ref().map(|duration| &duration.span))
    });
    if let Some(span) = stray {
        return Err(document.error(
            span.clone(),
            "a ply that is held has one step and no duration",
            "remove `steps` and `duration`, or write kind = \"straight\"",
        ));
    }
    Ok(Motion {
        times: vec![0.0],
        positions: vec![start.points.clone()],
    })
}

fn step_count(
    steps: &Located<Count>,
    grid: Grid,
    document: &Document,
) -> Result<usize, SceneError> {
    let Count(written) = steps.value;
    let most = MOST_STEPS.min(MOST_POSITIONS / grid.grippers());
    match usize::try_from(written) {
        Ok(count) if (2..=most).contains(&count) => Ok(count),
        Ok(count) if count > most => Err(document.error(
            steps.span.clone(),
            format!("{count} steps are too many"),
            format!(
                "{most} steps or fewer are possible with {} grippers",
                grid.grippers()
            ),
        )),
        _ => Err(document.error(
            steps.span.clone(),
            format!("a straight motion cannot have {written} steps"),
            "give 2 or more: step 1 is the start, the last step the target",
        )),
    }
}

/// Positions a share `t` of the way from start to target.
fn between(start: &[[f64; 3]], target: &[[f64; 3]], t: f64) -> Vec<[f64; 3]> {
    let at = |(a, b): (&[f64; 3], &[f64; 3])| [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
    // The ends are met to the last bit.
    if t >= 1.0 {
        return target.to_vec();
    }
    start.iter().zip(target).map(at).collect()
}

/// Refuses grippers that pass straight above each other on their way.
fn check_runs(motion: &Motion, start: &Places, ply: &Ply) -> Result<(), SceneError> {
    for (step, positions) in motion.positions.iter().enumerate().skip(1) {
        let places = Places {
            points: positions.clone(),
            document: start.document.clone(),
            spans: start.spans.clone(),
            height: None,
        };
        places.check_run(ply, &format!("in step {}", step + 1))?;
    }
    Ok(())
}

/// The columns of a motion file; others, such as the attitude `qx` … `qw`, are ignored.
const COLUMNS: [Column; 5] = [
    Column {
        name: "t",
        dimension: Dimension::TIME,
    },
    Column {
        name: "gripper",
        dimension: Dimension::NONE,
    },
    X,
    Y,
    Z,
];

/// A motion from a CSV file, and the start with its places in that file.
pub(super) fn motion_file(
    table: &Located<MotionTable>,
    ply: &Ply,
    scene: &Document,
    base: &Path,
) -> Result<(Motion, Places), SceneError> {
    let Some(name) = &table.value.file else {
        return Err(scene.error(
            table.span.clone(),
            "a motion of kind \"file\" needs a file",
            "add file = \"trajectory.csv\" with the columns t, gripper, x, y, z",
        ));
    };
    let stray = table.value.steps.as_ref().map(|steps| &steps.span);
    let stray = stray.or(table.value.duration.as_ref().map(|duration| &duration.span));
    if let Some(span) = stray {
        return Err(scene.error(
            span.clone(),
            "the motion comes from a file, which has its own steps and times",
            "remove `steps` and `duration`, or write kind = \"straight\"",
        ));
    }
    let document = csv_file(&name.value, &name.span, scene, base)?;
    let mut steps = Steps::new(&document, ply);
    let csv = Csv::new(&document, &COLUMNS)?;
    for row in csv.rows() {
        steps.add(&row)?;
    }
    steps.finish(csv.header.clone())?;
    let (motion, spans) = (steps.motion, steps.first_spans);
    let start = Places {
        points: motion.positions.first().cloned().unwrap_or_default(),
        document,
        spans,
        height: None,
    };
    Ok((motion, start))
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
        let grippers = ply.grid.grippers();
        Steps {
            document,
            ply,
            motion: Motion {
                times: Vec::new(),
                positions: Vec::new(),
            },
            first_time: 0.0,
            seen: vec![false; grippers],
            spans: vec![0..0; grippers],
            first_spans: Vec::new(),
            last_row: 0..0,
        }
    }

    fn add(&mut self, row: &Row) -> Result<(), SceneError> {
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
            _ => self.begin(time, row)?,
        }

        // One gripper of the step.
        let gripper = gripper_id(row)?;
        let index = in_grid(gripper, self.ply.grid).map_err(|(m, h)| row.fault(1, m, h))?;
        if std::mem::replace(&mut self.seen[index], true) {
            return Err(row.fault(
                1,
                format!("gripper {gripper:?} stands here for the second time at t = {written} s"),
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

    fn begin(&mut self, time: f64, row: &Row) -> Result<(), SceneError> {
        self.complete()?;
        let most = MOST_STEPS.min(MOST_POSITIONS / self.ply.grid.grippers());
        if self.motion.times.len() == most || time > DURATIONS[1] {
            return Err(row.fault(
                0,
                "the motion is too long",
                format!("{most} steps and {:e} s are the most", DURATIONS[1]),
            ));
        }
        self.seen.fill(false);
        self.motion.times.push(time);
        self.motion
            .positions
            .push(vec![[0.0; 3]; self.ply.grid.grippers()]);
        Ok(())
    }

    /// Refuses a step in which a gripper is missing or stands straight above another.
    fn complete(&mut self) -> Result<(), SceneError> {
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
                "gripper {:?} has no row at t = {} s",
                self.ply.grid.id(missing),
                time + self.first_time
            ),
            format!(
                "give every one of the {} grippers one row at every time",
                self.ply.grid.grippers()
            ),
        ))
    }

    fn finish(&mut self, header: Range<usize>) -> Result<(), SceneError> {
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

/// A gripper written as "i-j".
fn gripper_id(row: &Row) -> Result<GripperId, SceneError> {
    let text = row.text(1)?;
    let indices = text
        .split_once('-')
        .and_then(|(i, j)| Some([i.trim().parse().ok()?, j.trim().parse().ok()?]));
    indices.ok_or_else(|| {
        row.fault(
            1,
            format!("`{text}` is no gripper"),
            "write grippers as \"i-j\", from 0-0",
        )
    })
}
