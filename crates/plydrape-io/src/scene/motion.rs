//! Gripper positions over the steps of a straight motion, or of a ply that is held.

use super::file::{MotionKind, MotionTable};
use super::located::{Count, Located, Whole};
use super::places::Places;
use super::quantity::Read;
use super::source::Document;
use crate::Error;
use plydrape::geometry::vector;
use plydrape::layup::Target;
use plydrape::motion::{MOST_POSITIONS, MOST_STEPS, Motion, SHORTEST_STEP, is_too_short};
use plydrape::ply::Ply;

/// Steps of a straight motion unless given, as in Krogh et al. 2018.
pub(super) const STEPS: usize = 30;
/// Shortest and longest duration (s).
pub(super) const DURATIONS: [f64; 2] = [1e-6, 1e7];

/// A motion from the start, straight to a target or held.
pub(super) fn motion(
    table: Option<&Located<MotionTable>>,
    start: &Places,
    target: Option<&Target>,
    ply: &Ply,
    document: &Document,
) -> Result<Motion, Error> {
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
        Some(steps) => step_count(steps, ply.grippers(), document)?,
        None => STEPS,
    };
    let last = (steps - 1) as f64;
    let written = keys.and_then(|k| k.duration.as_ref());
    let duration = written.map_or(Ok(last), |duration| duration.read(document))?;
    if let Some(written) = written
        && is_too_short(duration / last)
    {
        return Err(document.error(
            written.span.clone(),
            format!(
                "{} leaves {:.1e} s for a step",
                document.quoted(&written.span),
                duration / last
            ),
            format!("give each of the {steps} steps {SHORTEST_STEP:e} s at least"),
        ));
    }
    let motion = Motion {
        times: (0..steps).map(|k| duration * (k as f64 / last)).collect(),
        positions: (0..steps)
            .map(|k| between(&start.points, &target.grippers, k as f64 / last))
            .collect(),
    };
    check_runs(&motion, start, ply)?;
    Ok(motion)
}

/// Why a plan of a scene with this motion is refused: it has a time law of its own and would ignore the duration.
pub(super) fn unplanned(keys: &MotionTable, document: &Document) -> Option<Error> {
    let span = &keys.duration.as_ref()?.span;
    let written = document.excerpt(span);
    Some(document.error(
        span.clone(),
        format!(
            "a plan does not keep the duration {} of [motion]: how long it takes follows from the limits of its grippers",
            document.quoted(span)
        ),
        format!(
            "remove it, or comment it out; if a plan shall take no longer, write duration = {written} in [limits]"
        ),
    ))
}

fn hold(keys: Option<&MotionTable>, start: &Places, document: &Document) -> Result<Motion, Error> {
    let misplaced = keys.and_then(|keys| {
        let steps = keys.steps.as_ref().map(|steps| &steps.span);
        steps.or(keys.duration.as_ref().map(|duration| &duration.span))
    });
    if let Some(span) = misplaced {
        return Err(document.error(
            span.clone(),
            "a ply that is held has one step and no duration",
            "remove `steps` and `duration`, or write kind = \"straight\"",
        ));
    }
    Ok(Motion { times: vec![0.0], positions: vec![start.points.clone()] })
}

fn step_count(
    steps: &Located<Count>,
    grippers: usize,
    document: &Document,
) -> Result<usize, Error> {
    let Whole(written) = steps.value;
    let most = MOST_STEPS.min(MOST_POSITIONS / grippers);
    match usize::try_from(written) {
        Ok(count) if (2..=most).contains(&count) => Ok(count),
        Ok(count) if count > most => Err(document.error(
            steps.span.clone(),
            format!("{count} steps are too many"),
            format!("{most} steps or fewer are possible with {} grippers", grippers),
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
    start.iter().zip(target).map(|(a, b)| vector::between(*a, *b, t)).collect()
}

/// Refuses grippers that pass straight above each other on their way.
fn check_runs(motion: &Motion, start: &Places, ply: &Ply) -> Result<(), Error> {
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
