//! `plydrape net`: lays the ply of a scene on its mold as a net, and says how it lies.

use crate::failure::Done;
use crate::results::Results;
use crate::watch::whole;
use plydrape::net::Net;
use plydrape_io::write::net::{Findings, Summary, write_all};
use serde::Serialize;
use std::process::ExitCode;
use std::time::Instant;

/// Lay the ply on the mold as a net of yarns: where every point should end, and how it shears.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Of the scene it reads [ply], [mold], [target] and [limits]. Writes nodes.csv, boundary.csv, \
boundary.dxf, shear.svg, net.vtp and mold.vtp to the scene's name with `.net`, and seeds.csv and \
seeds.svg where [target] has seed = \"best\" or direction = \"best\". A file in the folder that plydrape did not write, or that \
was edited since, is never overwritten. Not accepted, with exit code 1, is a ply that runs off the \
mold, folds, or shears beyond the scene's limit or the material's locking angle.")]
pub struct Arguments {
    #[command(flatten)]
    results: Results,
}

/// What `--json` prints: the summary of the net, and how long it took.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    time_ms: f64,
}

/// Lays the net, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let results = &arguments.results;
    let ideal = plydrape_io::scene::read_ideal_drape(&results.scene)?;
    crate::outcome::warn(&ideal.warnings);
    let (mold, net) = (&ideal.mold, &ideal.net);
    // once more, to measure how long it takes apart from all else that reading a scene does
    let start = Instant::now();
    let again = Net::drape_cut(mold, net.placement, net.outline.clone());
    let time_ms = start.elapsed().as_secs_f64() * 1e3;
    debug_assert_eq!(again.as_ref(), Ok(net));

    let findings = Findings::new(net, mold, ideal.wanted.as_ref(), ideal.seeds.clone());
    let summary = Summary::new(net, &findings, Some(ideal.shear_limit));
    let (title, dir) = (&ideal.title, results.folder("net"));
    let files = whole(|| write_all(net, mold, &findings, title, &dir, &ideal.files))?;
    let text = format!("{}\n\n{}", ideal.title, summary.table());
    results.print(quiet, &Printed { summary: &summary, time_ms }, &text, &files)?;
    Ok(if summary.accepted { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
