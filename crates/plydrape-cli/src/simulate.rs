//! `plydrape simulate`: drapes the ply of a scene along its motion, and says how it went.

use crate::errors;
use crate::failure::Done;
use crate::mesh;
use crate::model::{self, ModelName};
use crate::outcome::{Printed, exit_code, warn};
use crate::results::{self, Results};
use crate::watch::Interrupt;
use plydrape::outcome::Robustness;
use plydrape_io::rerun::is_better;
use plydrape_io::text::table;
use plydrape_io::{Folder, ResultFile, names, scene, write_into};

/// Drape the ply along the trajectories of a scene; steps, limits, verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
One model drapes and decides, that of the scene: its steps, its limits and its verdict are printed, written and returned as the exit \
code. With --also the other model is draped too and shown beside it; it never judges.

Writes result.json, steps.csv, trajectory.csv and report.html, and sheet.npz where the sheet was draped, to the scene's \
name with `.results`; report.html is a page for any browser. A file in the folder that plydrape did not write, or that was edited \
since, is never overwritten. Ctrl-C ends after the step under way and writes the steps done.

With [errors] in the scene, a sample of complete drapes of cells that are off by them is judged too, at most 64 unless set there, and the \
verdict says which errors the motion tolerates.")]
pub struct Arguments {
    #[command(flatten)]
    results: Results,

    /// The model that drapes and decides, instead of the scene's.
    #[arg(long)]
    model: Option<ModelName>,

    /// Drape by the other model too, and show it beside; it never judges.
    #[arg(long, value_name = "MODEL")]
    also: Option<ModelName>,

    /// Judge the drape without the errors of the scene.
    #[arg(long)]
    without_errors: bool,
}

/// Simulates, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let asked = &arguments.results;
    // first of all, so that even a long read ends in files of what was done
    let interrupt = Interrupt::listen();
    let [model, also] = [arguments.model, arguments.also].map(|name| name.map(Into::into));
    let scene = scene::read_for(&asked.scene, model, also)?;
    warn(&scene.notices);
    warn(&mesh::warnings(scene.layup.mold.as_ref(), scene.mesh.as_ref()));
    let folder = Folder::claim(&asked.folder("results"), "simulate", &scene.files)?;
    folder.refuse_taken(&names(&scene, false))?;

    // the model that decides, then the other one if it is asked for
    let (decides, dir) = (scene.layup.settings.model, folder.stage());
    let drape = model::drape(&scene, decides, dir, &interrupt, quiet)?;
    let took = drape.solving;
    let mut result = ResultFile::new(&scene, scene.input.clone(), drape);
    let mut interrupted = model::show_also(&mut result, &scene, dir, &interrupt, quiet)?;

    // cells with errors, and the files
    if !arguments.without_errors {
        let robustness = Robustness::of_simulated(&scene);
        interrupted |= !errors::judge(&mut result, &robustness, took, &interrupt, quiet);
    }
    interrupted |= result.summary.interrupted();
    let (folder, _kept) = results::place(folder, interrupted, |dir| is_better(&result, dir))?;
    let files = write_into(folder, &result, &[])?;

    let mut text = asked.text(&result, &table::draped(&result, took));
    text += errors::left_out(&result, interrupted, &interrupt);
    asked.print(quiet, &Printed::new(&result, took), &text, &files)?;
    Ok(exit_code(&result, interrupted))
}
