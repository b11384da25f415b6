//! What was understood of a plybook.

use super::{drawing, mold, warnings};
use crate::failure::Done;
use crate::mesh;
use crate::numbers::degrees;
use crate::outcome;
use plydrape_io::scene::{BookPly, read_book};
use plydrape_io::store::shown;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Reads a book; prints its mold and a few lines for each ply unless `quiet`, and warnings.
pub(super) fn check(path: &Path, quiet: bool) -> Done {
    let book = read_book(path)?;
    if !quiet {
        let mut out = io::stdout().lock();
        writeln!(out, "{}", book.title)?;
        for (noun, text) in mold::of(&book.mold, book.mesh.as_ref()) {
            writeln!(out, "  {noun:<9} {text}")?;
        }
        for (n, ply) in book.plies.iter().enumerate() {
            writeln!(out, "  {:<9} {}", format!("ply {}", n + 1), ply.name)?;
            for line in lines(ply) {
                writeln!(out, "  {:<9}   {line}", "")?;
            }
        }
        out.flush()?;
    }
    outcome::warn(&mesh::warnings(Some(&book.mold), book.mesh.as_ref()));
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
        Some(thickness) => format!("{} mm thick", shown::millimetres(thickness)),
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
