//! What was understood of a plybook.

use super::{Noun, drawing, mold, nouns, warnings};
use crate::failure::Done;
use crate::mesh;
use crate::numbers::degrees;
use crate::outcome;
use crate::results;
use plydrape_io::scene::{BookPly, read_book};
use plydrape_io::store::{json, shown};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// What `--json` prints of a book.
#[derive(Serialize)]
struct Printed<'a> {
    title: &'a str,
    summary: Vec<Noun<'a>>,
    plies: Vec<PrintedPly<'a>>,
    warnings: &'a [String],
}

/// A ply of a book as `--json` prints it.
#[derive(Serialize)]
struct PrintedPly<'a> {
    name: &'a str,
    lines: Vec<String>,
    warnings: Vec<String>,
}

/// Reads a book; prints its mold and a few lines for each ply unless `quiet`, and warnings; or one JSON object.
pub(super) fn check(path: &Path, as_json: bool, quiet: bool) -> Done {
    let book = read_book(path)?;
    let mesh = mesh::warnings(Some(&book.mold), book.mesh.as_ref());
    let mold = mold::shape(&book.mold, book.mesh.as_ref());
    if as_json {
        let plies = book.plies.iter().map(|ply| PrintedPly {
            name: &ply.name,
            lines: lines(ply),
            warnings: warnings::warnings(&ply.scene),
        });
        let plies = plies.collect();
        let printed = Printed { title: &book.title, summary: nouns(&mold), plies, warnings: &mesh };
        results::print(&json::to_text(&printed)?, &[])?;
        return Ok(ExitCode::SUCCESS);
    }
    if !quiet {
        let mut text = format!("{}\n", book.title);
        for (noun, line) in mold {
            text += &format!("  {noun:<9} {line}\n");
        }
        for (n, ply) in book.plies.iter().enumerate() {
            text += &format!("  {:<9} {}\n", format!("ply {}", n + 1), ply.name);
            for line in lines(ply) {
                text += &format!("  {:<9}   {line}\n", "");
            }
        }
        results::print(&text, &[])?;
    }
    outcome::warn(&mesh);
    for ply in &book.plies {
        for warning in warnings::warnings(&ply.scene) {
            // standard error that cannot be written is no fault of the book
            let text = shown::escaped(&warning.to_string());
            let _ = writeln!(io::stderr(), "warning: ply {}: {text}", ply.name);
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn lines(ply: &BookPly) -> Vec<String> {
    let scene = &ply.scene;
    let thickness = match scene.thickness {
        Some(thickness) => format!("{} mm thick", shown::millimeters(thickness)),
        None => "of a thickness that nothing needs".into(),
    };
    let below = match &ply.lies_on[..] {
        [] => "the mold".into(),
        [one] => format!("ply {}", one + 1),
        more => {
            let numbers: Vec<String> = more.iter().map(|n| (n + 1).to_string()).collect();
            format!("plies {}", numbers.join(", "))
        }
    };
    let heading = scene.layup.target.as_ref().and_then(|target| target.drape.as_ref());
    let heading = heading.map(|net| {
        format!(
            "u towards {} deg in plan, ideal drape sheared by {} deg at most",
            degrees(net.placement.heading),
            degrees(net.report.largest_shear.map_or(0.0, |(shear, _)| shear.abs())),
        )
    });
    let mut lines =
        vec![format!("{}, {}", shown::ply(&scene.layup.ply), scene.layup.ply.material.name)];
    lines.extend(scene.drawn.iter().flat_map(drawing::drawing));
    lines.push(format!("{thickness}, lies on {below}"));
    lines.extend(heading);
    lines
}
