//! What `plydrape plan` is asked for.

use crate::failure::Failure;
use crate::model::ModelName;
use crate::numbers::{degrees, millimeters};
use crate::outcome::warn;
use crate::results::Results;
use clap::{ValueEnum, value_parser};
use plydrape::geometry::Pose;
use plydrape::measure::Name;
use plydrape::scene::PlanMethod;
use plydrape_io::Diagnostic;
use plydrape_io::scene::SceneFile;
use std::path::PathBuf;

/// Find trajectories that lay the ply on its mold, and drape along them; verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The scene needs [mold] and [target]; [plan] and [limits] say how to look and what to keep. Grippers \
start where they start in `simulate`: of a motion from a file only the first step is used, and a \
`duration` in [motion] is refused: limits.duration is what a plan keeps. Limits that no plan can keep are said, and \
nothing is planned then, with exit code 1, unless --anyway asks for it. The search ends with the first plan that keeps all limits with a margin. The best \
plan found is written even if it is not accepted, whatever ends the search. Ctrl-C or SIGTERM ends it, finishes the best \
plan so far and writes it; a second one ends that too. The exit code is 0 if that plan is accepted, else 130; where a better plan is in the folder already, the files \
go beside it. Without a terminal, the progress of the search is written to standard error once a minute.

While it searches, search.json in the folder holds all that was judged so far, at most half a minute old. After a crash or a power cut, --continue goes on \
from there, to the same plan.

One model drapes and decides, that of the scene: its steps, its limits and its verdict are printed, written and returned as the exit \
code. With --also the other model is draped along the plan too and shown beside it; it never judges.

The plan is then judged with errors. With [errors] in the scene, a sample of complete drapes of cells that are off by them decides \
too, at most 64 unless set there. The verdict says which errors the plan tolerates, of each gripper's position where the scene has none. \
Ctrl-C ends these drapes, as does twice the time of --time; the plan is then written without what they would say, and is not accepted if the sample is missing.

Writes result.json, steps.csv, trajectory.csv, motion.csv, report.html and plan.json, and sheet.npz \
where the sheet was draped, to the scene's name with `.plan`. A file in the folder that plydrape did not write, or that was edited \
since, is never overwritten.

A plybook, a file with [[plies]], is planned ply by ply, each on those that it lies on, several at once; see `docs/guide/plybook.md`. Each ply has a \
folder of its own in the book's, beside book.json and a report.html over all plies. --time, --seed and the other options are for each \
ply; the exit code is 0 if all plies are accepted.

With --compare nothing is searched: the ply is draped by each of five strategies, straight (every gripper to its \
target), all at once (formed over its place and let down flat), rolled (a line lands first), from a point (the middle lands \
first) and stepwise. A table says which limits each one breaks, the worst first. comparison.csv (all limits) goes \
to the scene's name with `.compare`. The exit code is 0 if one of them is accepted, 1 if none is.")]
pub struct Arguments {
    #[command(flatten)]
    pub(super) results: Results,

    /// The planner, instead of the scene's.
    #[arg(long)]
    method: Option<Method>,

    /// Seed of the search, instead of the scene's: the same seed, the same plan.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Go on improving a plan that keeps all limits with a margin, until all drapes of [plan] evaluations are used up or
    /// the time is over.
    #[arg(long)]
    improve: bool,

    /// End the search after this time, e.g. 5min or 90s, with the best plan so far; what follows ends after as much again.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) time: Option<String>,

    /// Drape the plan by the other model too, and show it beside; it never judges.
    #[arg(long, value_name = "MODEL")]
    pub(super) also: Option<ModelName>,

    /// Plan and judge without errors, for a quick look: no cell is draped, and nothing is said of the errors that the plan tolerates.
    #[arg(long)]
    pub(super) without_errors: bool,

    /// Drape by every named strategy instead of a search, and say side by side why the others fail.
    #[arg(long, conflicts_with_all = ["method", "seed", "improve", "time", "earlier", "also", "without_errors"])]
    pub(super) compare: bool,

    /// Threads of the search, one per core unless given; the plan does not depend on it.
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,

    /// Plan although no plan can keep the limits of the scene, to see how near one comes.
    #[arg(long, conflicts_with = "compare")]
    pub(super) anyway: bool,

    /// Look first for the place of the scene in the robot's world where its arm follows best, and plan there; `world` of [tool] does not count.
    #[arg(long)]
    pub(super) place: bool,

    /// Go on from the folder of an earlier run: of one that was cut off, to the plan that it would have found.
    #[arg(long = "continue", value_name = "DIR")]
    pub(super) earlier: Option<PathBuf>,
}

/// The planner of a motion.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Method {
    /// Whole trajectories, judged by complete drapes.
    Path,
    /// Step by step, as Krogh et al. 2018 sketch it.
    Stepwise,
}

impl From<Method> for PlanMethod {
    fn from(method: Method) -> Self {
        match method {
            Method::Path => PlanMethod::Path,
            Method::Stepwise => PlanMethod::Stepwise,
        }
    }
}

impl Arguments {
    /// Where a scene should stand for its robot, which is said; or why there is no such place, and what to do.
    fn placed(&self, scene: &SceneFile) -> Result<Pose, (&'static str, &'static str)> {
        if scene.layup.tool.as_ref().is_none_or(|tool| tool.arm.is_none()) {
            return Err((
                "has no [robot]: --place asks where its arm follows the motion",
                "say in [robot] which arm carries the tool, as in arm = \"ur20\"",
            ));
        }
        let clearance = scene.limits.least(Name::Clearance);
        let found = scene.layup.placement(clearance).ok_or((
            "has no place where its arm follows from the start to the target within its limits",
            "choose an arm with a longer reach, let the ply be picked up nearer to its mold, or ask less of the arm in [robot]",
        ))?;
        let [x, y, z] = found.world.position.map(millimeters);
        warn(&[format!(
            "placed where the arm follows from {} configurations; for the scene: world = {{ position = [\"{x} mm\", \"{y} mm\", \"{z} mm\"], \
             rotation = [0, 0, \"{} deg\"] }}",
            found.keeping,
            degrees(found.yaw)
        )]);
        Ok(found.world)
    }

    /// The option that is given and that only a scene of one ply has; `None` if there is none.
    pub(super) fn option_of_one_ply(&self) -> Option<&'static str> {
        match (self.compare, self.also, self.place) {
            (true, ..) => Some("--compare"),
            (_, Some(_), _) => Some("--also"),
            (_, _, true) => Some("--place"),
            _ => None,
        }
    }

    /// Puts what the options say in place of the scene's own; refuses a scene that cannot be planned.
    pub(super) fn apply(&self, scene: &mut SceneFile) -> Result<(), Failure> {
        // a plan needs a mold, a target, and a scene that may be planned
        let file = &self.results.scene;
        let refused = |message: &str, help: &str| {
            let message = format!("`{}` {message}", file.display());
            Failure::from(Diagnostic::new(file.display().to_string(), message, help))
        };
        if scene.layup.mold.is_none() {
            return Err(refused(
                "has no [mold] to lay the ply on",
                "add [mold] with kind = \"plane\", or another one; a ply that just hangs needs no plan",
            ));
        }
        if scene.layup.target.is_none() {
            return Err(refused(
                "has no [target]: a plan needs to know where the ply shall end",
                "add [target] with `origin`, `direction`, `shear` and `seed`, or empty, or with `positions`",
            ));
        }
        if let Some(refusal) = scene.plan_refusal.take() {
            return Err(Failure::from(*refusal));
        }
        // the place of the scene where the arm follows best
        if self.place {
            let world = self.placed(scene).map_err(|(message, help)| refused(message, help))?;
            if let Some(tool) = &mut scene.layup.tool {
                tool.world = world;
            }
        }
        // how to search
        if let Some(method) = self.method {
            scene.plan.method = method.into();
        }
        if let Some(seed) = self.seed {
            scene.plan.seed = seed;
        }
        scene.plan.improve |= self.improve;
        Ok(())
    }
}
