//! `plydrape replan`: the motion of a plan for a ply that does not lie where it was planned.

use crate::failure::{Done, Failure};
use crate::numbers::{degrees, millimeters, short};
use crate::outcome::{code, is_unsolved};
use crate::results;
use crate::watch::whole;
use plydrape::geometry::Pose;
use plydrape::measure::Verdict;
use plydrape::planner::replan::{Replanned, Replanner};
use plydrape::tool::Posture;
use plydrape_io::replan::PlannedResult;
use plydrape_io::result::read;
use plydrape_io::scene::{Request, SeenOffset, json_offset, read_offset};
use plydrape_io::store::json;
use plydrape_io::text::table;
use plydrape_io::{Error, Folder, write_into};
use serde::Serialize;
use std::io::{self, BufRead, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Correct the motion of a plan for a ply that does not lie where it was planned.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The ply was seen shifted and turned on its table. The corrected motion picks it up there and takes the offset out in the air, so that \
it comes to the planned landing and keeps its verdict. Speed, acceleration, jerk, tilt rate, workspace, clearance of bodies and the \
tool's rates are judged again, and the motion is made slower where it would be too fast. An offset that cannot be taken out before the ply \
meets the mold is refused with exit code 2.

With --picked, writes the files of a plan (all but plan.json) into the folder, which cannot be that of the plan itself. The file holds [offset] with x, y and yaw, and `about`, the point \
that the ply is turned about (the middle of the grippers at the start unless given), or two or more [[point]] with `planned` and `seen`. \
`far = true` beside them says that the ply does lie more than 50 mm or 10° off.

With --json and without --picked, reads objects of the same keys from standard input, one a line, and answers with one line each until the input \
ends; an `id` in an object, a text or a number, is repeated in its answer. A line that is refused is answered with `error` and `help`, and the next one is read. The exit code is that of the worst answer.")]
pub struct Arguments {
    /// The result.json of a plan, or its folder.
    result: PathBuf,

    /// Where the ply was seen.
    #[arg(long, value_name = "FILE", required_unless_present = "json")]
    picked: Option<PathBuf>,

    /// Folder of the files; beside the result, with the name replan, unless given.
    #[arg(short, long, value_name = "DIR", requires = "picked")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output for each offset.
    #[arg(long)]
    json: bool,

    /// The ply does lie more than 50 mm or 10° from where it was planned; without this, or `far = true` beside an offset, that is refused.
    #[arg(long)]
    far: bool,

    /// Samples a second of the times and positions in these objects; of the steps of the plan unless given.
    #[arg(long, value_name = "HZ", requires = "json")]
    rate: Option<f64>,
}

/// Longest line that is read from standard input (bytes).
const LONGEST_LINE: u64 = 1 << 20;

/// What `--json` prints of a corrected motion.
#[derive(Serialize)]
struct Answer<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<serde_json::Value>,
    accepted: bool,
    /// Every limit, judged by the model that decides.
    limits: &'a [Verdict],
    duration_s: f64,
    /// How many times as long as the planned motion.
    longer: f64,
    /// About the middle of the grippers at the planned start.
    offset: Offset,
    /// Share of the offset in each step of the plan.
    weights: &'a [f64],
    /// Times (s) of what follows.
    times: Vec<f64>,
    /// Positions of all grippers (m) at each time.
    positions: Vec<Vec<[f64; 3]>>,
    /// Where the robot's flange is in its world at each time, where a tool carries the grippers.
    #[serde(skip_serializing_if = "Option::is_none")]
    flange: Option<Vec<Flange>>,
}

#[derive(Serialize)]
struct Offset {
    x: f64,
    y: f64,
    yaw: f64,
    about: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
}

/// A posture of the robot and its axes.
#[derive(Serialize)]
struct Flange {
    position: [f64; 3],
    /// x, y, z, w.
    quaternion: [f64; 4],
    /// Strokes of each gripper (m).
    strokes: Vec<Vec<f64>>,
}

/// What `--json` prints of a line that is refused.
#[derive(Serialize)]
struct Refusal {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<serde_json::Value>,
    error: String,
    help: String,
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Refusal { id: None, error: error.message().into(), help: error.help().into() }
    }
}

/// Reads the plan, answers, writes the files.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    if let Some(rate) = arguments.rate.filter(|rate| !(*rate > 0.0 && rate.is_finite())) {
        let help = "give samples a second above 0, as in --rate 100";
        return Err(crate::argument::refused("--rate", &rate.to_string(), "is no rate", help));
    }
    let planned = PlannedResult::new(read::read(&arguments.result)?)?;
    let replanner = planned.replanner()?;
    match &arguments.picked {
        Some(file) => once(arguments, &planned, &replanner, file, quiet),
        None => stream(arguments, &planned, &replanner),
    }
}

/// One offset from a file, with the files of its result.
fn once(
    arguments: &Arguments,
    planned: &PlannedResult,
    replanner: &Replanner,
    file: &Path,
    quiet: bool,
) -> Done {
    // where the ply was seen, and where the files go
    let seen = read_offset(file, planned.tolerance())?.also_far(arguments.far);
    let result_file = read::file_of(&arguments.result);
    let beside = || result_file.parent().unwrap_or(Path::new("")).join("replan");
    let output = arguments.output.clone().unwrap_or_else(beside);

    // the corrected motion
    let replanned = planned.replan(replanner, &seen)?;
    let answer = match arguments.json {
        true => json::to_text(&Answer::new(planned, replanner, &replanned, arguments.rate)?)?,
        false => String::new(),
    };
    let said = said(&seen, &replanned);

    // the files of the result; no file that was read is replaced
    let read = [&planned.result().files[..], &[file.into()]].concat();
    let (result, files) = whole(|| {
        let folder = Folder::claim(&output, "replan", &read)?;
        let result = planned.corrected(replanned, folder.stage())?;
        let files = write_into(folder, &result, &[])?;
        Ok::<_, Error>((result, files))
    })?;

    // what is printed
    let text = match arguments.json {
        true => answer,
        false if quiet => String::new(),
        false => {
            let screen = table::screen(&result, &said, results::ink());
            format!("{}\n{}", screen.trim_end(), results::list(&files))
        }
    };
    results::print(&text, &files)?;
    Ok(code(false, is_unsolved(&result), result.summary.accepted()))
}

/// Offsets from standard input, one a line.
fn stream(arguments: &Arguments, planned: &PlannedResult, replanner: &Replanner) -> Done {
    let mut input = io::stdin().lock();
    let unsolved = is_unsolved(planned.result());
    let (mut refused, mut accepted) = (false, true);
    loop {
        let mut line = Vec::new();
        let read = (&mut input).take(LONGEST_LINE).read_until(b'\n', &mut line);
        let read = read.map_err(|fault| unread(&fault))?;
        if read == 0 {
            break;
        }
        let whole = line.ends_with(b"\n") || (read as u64) < LONGEST_LINE;
        if !whole {
            skip_line(&mut input)?;
        }
        if whole && line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let answer = match whole {
            true => answer(arguments, planned, replanner, &line),
            false => Err(Refusal {
                id: None,
                error: "the line is longer than 1 MiB".into(),
                help: "give one offset a line".into(),
            }),
        };
        let text = match answer {
            Ok((text, keeps)) => {
                accepted &= keeps;
                text
            }
            Err(refusal) => {
                refused = true;
                json::to_text(&refusal)?
            }
        };
        // nobody asks for what nobody reads
        if !results::print_to_reader(&text, &[])? {
            break;
        }
    }
    Ok(if refused { ExitCode::from(2) } else { code(false, unsolved, accepted) })
}

/// Standard input that cannot be read.
fn unread(fault: &io::Error) -> Failure {
    Failure::Refused {
        message: format!("standard input cannot be read: {fault}"),
        help: "give offsets, one JSON object a line".into(),
    }
}

/// Reads on to the end of a line.
fn skip_line(input: &mut impl BufRead) -> Result<(), Failure> {
    loop {
        let bytes = input.fill_buf().map_err(|fault| unread(&fault))?;
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let length = end.map_or(bytes.len(), |end| end + 1);
        let done = end.is_some() || bytes.is_empty();
        input.consume(length);
        if done {
            return Ok(());
        }
    }
}

/// The answer to one line, and whether it is accepted.
fn answer(
    arguments: &Arguments,
    planned: &PlannedResult,
    replanner: &Replanner,
    line: &[u8],
) -> Result<(String, bool), Refusal> {
    let text = std::str::from_utf8(line).map_err(|_| Refusal {
        id: None,
        error: "the line is no UTF-8 text".into(),
        help: "give one JSON object a line".into(),
    })?;
    let Request { id, seen } = json_offset(text, planned.tolerance());
    let answer = || {
        let found = planned.replan(replanner, &seen?.also_far(arguments.far))?;
        let answer = Answer::new(planned, replanner, &found, arguments.rate)?;
        let answer = Answer { id: id.clone(), ..answer };
        Ok((json::to_text(&answer)?, answer.accepted))
    };
    answer().map_err(|error: Error| Refusal { id: id.clone(), ..error.into() })
}

impl<'a> Answer<'a> {
    fn new(
        planned: &PlannedResult,
        replanner: &'a Replanner,
        replanned: &'a Replanned,
        rate: Option<f64>,
    ) -> Result<Self, Error> {
        let Replanned { motion, summary, .. } = replanned;
        // the corrected motion, at the steps of the plan or at the rate asked for
        let (times, positions) = match rate {
            None => (motion.times().to_vec(), motion.positions().to_vec()),
            Some(rate) => {
                let sampled = motion.sampled(rate).map_err(plydrape::Error::ReplanMotion)?;
                (sampled.times, sampled.positions)
            }
        };

        // the flange of the robot along it, where a tool carries the grippers
        let flange = planned.scene().layup.tool.as_ref().map(|tool| {
            let postures: Vec<_> = positions.iter().map(|places| tool.posture(places)).collect();
            let pose = |posture: &Posture| tool.world.compose(&posture.frame.compose(&tool.flange));
            let poses: Vec<Pose> = postures.iter().map(pose).collect();
            let turns = Pose::quaternions(&poses);
            let flange = |((posture, pose), quaternion): ((Posture, &Pose), [f64; 4])| Flange {
                position: pose.position,
                quaternion,
                strokes: posture.strokes,
            };
            postures.into_iter().zip(&poses).zip(turns).map(flange).collect()
        });

        // the offset that the motion takes out
        let picked_up = replanned.record.picked_up.as_ref();
        let (offset, residual) =
            picked_up.map(|picked| (picked.offset, picked.residual)).unwrap_or_default();
        let [x, y] = offset.shift;
        Ok(Answer {
            id: None,
            accepted: summary.accepted(),
            limits: &summary.limits,
            duration_s: motion.duration(),
            longer: replanned.longer,
            offset: Offset { x, y, yaw: offset.yaw, about: offset.about, residual },
            weights: replanner.weights(),
            times,
            positions,
            flange,
        })
    }
}

/// What is said of the correction.
fn said(seen: &SeenOffset, replanned: &Replanned) -> String {
    let offset = replanned.record.picked_up.as_ref().map_or(seen.offset, |picked| picked.offset);
    let [x, y] = offset.shift.map(millimeters);
    let mut text = format!("the ply lies off by x {x} mm, y {y} mm, yaw {}°", degrees(offset.yaw));
    if let Some(residual) = seen.residual {
        text += &format!("; points fit to {} mm", millimeters(residual));
    }
    let duration = replanned.motion.duration();
    text += &match replanned.longer > 1.0 {
        true => format!(
            "\nmotion of {duration:.1} s, {} times as long as planned",
            short((1e4 * replanned.longer).ceil() / 1e4)
        ),
        false => format!("\nmotion of {duration:.1} s, as planned"),
    };
    text
}
