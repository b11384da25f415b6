//! `plydrape simulate`: drapes the ply of a scene along its motion, and says how it went.

use crate::errors::{self, BrokenOff};
use crate::failure::Done;
use crate::outcome::{Printed, exit_code};
use crate::results::Results;
use crate::sheet::drape_sheet;
use crate::watch::{Interrupt, bar};
use clap::ValueEnum;
use plydrape::errors::Robustness;
use plydrape_io::{Folder, NAMES, ResultFile, table, write_into};

/// Drape the ply along the trajectories of a scene; table of steps, verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Writes result.json, steps.csv, trajectory.csv, figure.svg and report.html, and sheet.npz where the model \
is the sheet, to the scene's name with `.results`; report.html is a page for any browser. A file in the \
folder that plydrape did not write, or that was edited since, is never overwritten. \
Ctrl-C ends after the step under way and writes the steps done.

With [errors] in the scene, a sample of complete drapes of cells that are off by them is judged too, 64 unless set there, and the \
verdict says which errors the motion stands.")]
pub struct Arguments {
    #[command(flatten)]
    results: Results,

    /// The model that decides, instead of the scene's; the catenaries are always draped.
    #[arg(long)]
    model: Option<Model>,

    /// Judge the drape without the errors of the scene.
    #[arg(long)]
    without_errors: bool,
}

/// The model of the ply that decides.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Model {
    /// The whole ply as cloth, between and beyond the grippers.
    Sheet,
    /// Lines of ply between the grippers, as in Krogh et al. 2018.
    Catenaries,
}

impl From<Model> for plydrape::scene::Model {
    fn from(model: Model) -> Self {
        match model {
            Model::Sheet => plydrape::scene::Model::Sheet,
            Model::Catenaries => plydrape::scene::Model::Catenaries,
        }
    }
}

/// Simulates, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let results = &arguments.results;
    // first of all, so that even a long read ends in files of what was done
    let interrupt = Interrupt::listen();
    let scene = plydrape_io::scene::read_for(&results.scene, arguments.model.map(Into::into))?;
    let sheet = crate::sheet::check(&scene)?;

    let folder = Folder::claim(&results.folder("results"), "simulate")?;
    folder.refuse_inputs(&NAMES[..6], &scene.files)?;

    let steps = scene.motion.positions.len();
    let bar = bar(steps, "draping {bar:40} step {pos} of {len}, {eta} left", quiet);
    let drape = plydrape::draping::simulate(&scene, |done| {
        bar.set_position(done as u64);
        interrupt.asked()
    });
    bar.finish_and_clear();

    let solving = drape.solving;
    let mut result = ResultFile::new(&scene, scene.input.clone(), drape);
    let took = drape_sheet(&mut result, &scene, sheet, folder.stage(), &interrupt, quiet)?;
    let broken_off = if arguments.without_errors {
        None
    } else {
        errors::judge(&mut result, &Robustness::of_simulated(&scene), &interrupt, quiet)
    };
    let files = write_into(folder, &result, &[], &scene.files)?;
    let title = &result.scene.title;
    let mut text = format!("{title}\n\n{}", table::steps_and_verdict(&result));
    text += broken_off.map_or("", BrokenOff::text);
    results.print(quiet, &Printed::of(&result, solving, took), &text, &files)?;
    Ok(exit_code(&result, broken_off.is_some() || result.summary.interrupted()))
}
