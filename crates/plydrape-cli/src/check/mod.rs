//! `plydrape check`: reads a scene, says what was understood, and warns of what cannot be meant.

mod bodies;
mod book;
mod cell;
mod cups;
mod drawing;
mod limits;
mod mold;
mod motion;
mod rules;
mod shear;
mod sheet;
mod warnings;

use crate::failure::{Done, Failure};
use crate::model;
use crate::numbers::{degrees, millimeters, short};
use crate::outcome::warn;
use crate::results;
use crate::watch::{Interrupt, whole};
use plydrape::material::{Material, Scatter, Section, ShearCurve, Spread, TensionLaw};
use plydrape::ply::Ply;
use plydrape_io::scene::SceneFile;
use plydrape_io::store::{json, shown};
use plydrape_io::{Content, Folder, ResultFile, page};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// A noun of the scene and what it is; without a noun it goes on with the one before.
type SummaryLine = (&'static str, String);

/// The page of a scene.
const PAGE: &str = "check.html";
/// Mass of one ply of prepreg (kg/m²), that of `prepreg_cold`.
const PREPREG: f64 = 0.3143;

/// Read a scene or a plybook, and say what was understood or what is wrong.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
What is possible but hardly meant, such as a start kilometers off, is warned of on standard error, \
with exit code 0.

With --html, check.html goes to the scene's name with `.check`: a page for any browser that shows the ply hung at its start, the cups \
that hold it and those that do not, what they carry, what stands in the cell, the mold, where the ply must end on it, which way its warp \
runs, and where the cups shall end. Nothing is planned for it, and nothing is judged.")]
pub struct Arguments {
    /// The scene file, or the file of a plybook.
    scene: PathBuf,

    /// Write a page that shows the scene too.
    #[arg(long)]
    html: bool,

    /// Folder of the page; the scene's name with `.check` unless given.
    #[arg(short, long, value_name = "DIR", requires = "html")]
    output: Option<PathBuf>,

    /// Drape the motion of the scene twice, the second time with FACTOR times the shear force of the material, and say what changes.
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    shear_scale: Option<String>,

    /// Print one JSON object on standard output instead of the lines, with the warnings in it.
    #[arg(long)]
    json: bool,
}

/// What `--json` prints of a scene.
#[derive(Serialize)]
struct Printed<'a> {
    title: &'a str,
    summary: Vec<Noun<'a>>,
    warnings: &'a [String],
    files: &'a [PathBuf],
}

/// A noun of the scene, and the lines on what it is.
#[derive(Serialize)]
struct Noun<'a> {
    noun: &'a str,
    lines: Vec<&'a str>,
}

/// The lines of each noun, those without one with the noun before.
fn nouns(lines: &[SummaryLine]) -> Vec<Noun<'_>> {
    let mut nouns: Vec<Noun> = Vec::new();
    for (noun, text) in lines {
        match nouns.last_mut().filter(|last| noun.is_empty() || last.noun == *noun) {
            Some(last) => last.lines.push(text),
            None => nouns.push(Noun { noun, lines: vec![text] }),
        }
    }
    nouns
}

/// Reads the scene; prints a summary unless `quiet`, and warnings.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let factor = arguments.shear_scale.as_deref().map(shear::factor).transpose()?;
    // a plybook has its own summary; a page and another shear force are for one scene
    if plydrape_io::scene::is_book(&arguments.scene) {
        for (option, given) in [("--html", arguments.html), ("--shear-scale", factor.is_some())] {
            if given {
                return Err(Failure::Refused {
                    message: format!("{option} is for one scene, and this file is a plybook"),
                    help: format!("give the scene of one ply, or leave {option} out"),
                });
            }
        }
        return book::check(&arguments.scene, arguments.json, quiet);
    }

    // the summary, with what another shear force changes, and the warnings
    let scene = plydrape_io::scene::read(&arguments.scene)?;
    let (mut lines, warnings) = (summary(&scene), warnings::warnings(&scene));
    if let Some(factor) = factor {
        lines.extend(shear::shear(&scene, factor)?);
    }
    // the page, if one is asked for
    let files = match arguments.html {
        true => page(&scene, arguments, &lines, &warnings)?,
        false => Vec::new(),
    };

    // one object with all of it, or text with the warnings on standard error
    if arguments.json {
        let title = &scene.title;
        let printed = Printed { title, summary: nouns(&lines), warnings: &warnings, files: &files };
        results::print(&json::to_text(&printed)?, &files)?;
        return Ok(ExitCode::SUCCESS);
    }
    if !quiet {
        let lines = lines.iter().map(|(noun, text)| format!("  {noun:<9} {text}\n"));
        let text =
            format!("{}\n{}{}", scene.title, lines.collect::<String>(), results::list(&files));
        results::print(&text, &files)?;
    }
    warn(&warnings);
    Ok(ExitCode::SUCCESS)
}

/// Writes the page that shows a scene, with the ply hung at its start.
fn page(
    scene: &SceneFile,
    arguments: &Arguments,
    lines: &[SummaryLine],
    warnings: &[String],
) -> Result<Vec<PathBuf>, Failure> {
    let beside = || arguments.scene.with_extension("check");
    let dir = arguments.output.clone().unwrap_or_else(beside);
    let folder = Folder::claim(&dir, "check", &scene.files)?;
    folder.refuse_taken(&[PAGE])?;
    let mut held = scene.clone();
    held.scene.layup = held.scene.layup.held_at_start();
    held.scene.layup.release = None;
    let model = held.layup.settings.model;
    let drape = model::drape(&held, model, folder.stage(), &Interrupt::never(), true)?;
    let result = ResultFile::new(&held, held.input.clone(), drape);
    let html = page::look_html(scene, result, lines, warnings)?;
    Ok(whole(|| folder.write(&[(PAGE, &html.as_bytes() as &dyn Content)]))?)
}

/// The nouns of a scene, each in a line.
fn summary(scene: &SceneFile) -> Vec<SummaryLine> {
    let ply = &scene.layup.ply;
    let mut lines = vec![("ply", shown::ply(ply))];
    lines.extend(scene.drawn.iter().flat_map(drawing::drawing).map(|text| ("", text)));
    lines.extend(cups::cups(scene));
    lines.push(("material", material(&ply.material)));
    lines.push(("", ply.material.source.clone()));
    lines.extend(weight(ply).map(|text| ("", text)));
    lines.extend(scatter(&ply.material).map(|text| ("", format!("scatter: {text}"))));
    lines.extend(mold::mold(scene));
    lines.extend(motion::motion(scene));
    lines.extend(rules::tool(scene));
    lines.extend(bodies::bodies(scene));
    lines.extend(rules::pick_up(scene));
    lines.extend(rules::release(scene));
    lines.extend(rules::rules(scene));
    lines.extend(sheet::sheet(scene));
    lines.extend(cell::cell(scene));
    lines.extend(limits::limits(scene));
    lines.extend(rules::plan(scene));
    lines
}

/// What a mass per line makes per area, in this scene's cells, beside that of one ply.
fn weight(ply: &Ply) -> Option<String> {
    let Section::Line { mass, .. } = ply.material.section else { return None };
    let [a, b] = ply.cell.map(millimeters);
    let areal_mass = ply.areal_mass();
    let plies = areal_mass / PREPREG;
    let plies = if plies >= 1.5 {
        format!(", the weight of {plies:.0} plies of prepreg of {PREPREG} kg/m²")
    } else {
        String::new()
    };
    let areal_mass = format!("{areal_mass:.2}");
    Some(format!("{} kg/m over cells of {a} × {b} mm are {areal_mass} kg/m²{plies}", short(mass)))
}

/// How far the properties of a material scatter; `None` where nobody says.
fn scatter(material: &Material) -> Option<String> {
    let Scatter { mass, warp_rigidity, weft_rigidity, tension, shear_curve } = material.scatter;
    let share = |share: f64| format!("{} %", short(100.0 * share));
    let mut parts = vec![("mass", mass.map(share))];
    if warp_rigidity == weft_rigidity || matches!(material.section, Section::Line { .. }) {
        parts.push(("bending", warp_rigidity.map(share)));
    } else {
        parts.push(("bending in warp", warp_rigidity.map(share)));
        parts.push(("bending in weft", weft_rigidity.map(share)));
    }
    parts.push(("tension", tension.map(share)));
    let shear = |spread| match spread {
        Spread::Share(value) => share(value),
        Spread::Factor { factor } => format!("a factor of {}", short(factor)),
    };
    parts.push(("shear", shear_curve.map(shear)));
    let known: Vec<String> =
        parts.into_iter().filter_map(|(name, value)| Some(format!("{name} {}", value?))).collect();
    (!known.is_empty()).then(|| known.join(", "))
}

fn material(material: &Material) -> String {
    // mass and bending rigidity, and the moment over the curvature where the material has it
    let section = match material.section {
        Section::Line { mass, flexural_rigidity } => {
            format!("{} kg/m, EI {} N·m²", short(mass), short(flexural_rigidity))
        }
        Section::Areal { mass, warp_rigidity, weft_rigidity } => format!(
            "{} kg/m², bending rigidity {} N·m in warp, {} N·m in weft",
            short(mass),
            short(warp_rigidity),
            short(weft_rigidity)
        ),
    };
    let moments = match &material.moment {
        [None, None] => String::new(),
        curves => {
            let along = curves.iter().zip(["warp", "weft"]).filter_map(|(curve, along)| {
                Some(format!("{} points along the {along}", curve.as_ref()?.curvature.len()))
            });
            let along: Vec<String> = along.collect();
            format!(
                " at rest, moment over curvature of {} (catenaries take the rigidity at rest)",
                along.join(", ")
            )
        }
    };

    // shear force over the shear angle, where the fabric locks, and what resin adds
    let shear = match &material.shear_curve {
        Some(ShearCurve::Table { angle, .. }) => format!("shear curve of {} points", angle.len()),
        Some(ShearCurve::Polynomial { coefficients }) if coefficients.len() == 1 => {
            format!("shear slope {} N/m per rad", short(coefficients[0]))
        }
        Some(ShearCurve::Polynomial { .. }) => "shear curve as a polynomial".into(),
        None => "no shear curve: shear forces stay unknown".into(),
    };
    let locking = match material.locking_angle {
        Some(angle) => format!(", locks at {} deg", degrees(angle)),
        None => String::new(),
    };
    let rate = match &material.shear_rate {
        Some(rate) => format!(
            ", with resin of {} N/m per rad that relaxes in {} s",
            short(rate.stiffness),
            short(rate.time())
        ),
        None => String::new(),
    };

    // tension of the fabric over its strain
    let tension = match &material.tension {
        Some(TensionLaw::Linear { stiffness }) => format!(", EA' {} N/m", short(*stiffness)),
        Some(TensionLaw::Table { strain, .. }) => format!(", tension of {} points", strain.len()),
        None => String::new(),
    };
    format!("{}: {section}{moments}; {shear}{rate}{tension}{locking}", material.name)
}
