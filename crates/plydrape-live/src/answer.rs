//! The answer to a scene: the ply as it hangs, or why there is none.

use plydrape::draping::record::{CatenaryStep, Hold};
use plydrape::layup::Model;
use plydrape::outcome::Step;
use plydrape::ply::{GripperId, Kind};
use plydrape_io::page::{self, Form};
use plydrape_io::result::sheet::drape;
use plydrape_io::scene::parse_for;
use plydrape_io::store::json;
use plydrape_io::write::surface::{shape, stations};
use plydrape_io::{Error, PROGRAM, ResultFile};
use serde::Serialize;
use std::path::Path;

/// Triangles of a mold that is bent while the page looks on, at most: a quarter of those of a report.
const TRIANGLES: usize = 2000;

/// Whether the answer brings the mold along, which takes longer than the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mold {
    /// In triangles, under the grippers and a little beyond.
    Drawn,
    /// The page has it already.
    Known,
}

/// The answer for the page.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// The ply was solved: JSON with `program`, `found`, `status`, `catenaries` and, as `page`, the data of a results page with one step.
    Ply(String),
    /// The scene was refused: JSON with `refused`, what is wrong, and `help`, what would be right.
    Refused(String),
}

impl Answer {
    /// JSON text.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Answer::Ply(text) | Answer::Refused(text) => text,
        }
    }
}

/// What a results page does not say of a step.
#[derive(Debug, Serialize)]
struct Hanging {
    /// Name and version of the program.
    program: &'static str,
    /// Whether equilibrium and contact were found.
    found: bool,
    /// How the equilibrium ended, and the search for contact.
    status: [&'static str; 2],
    /// Edges along u, edges along v, then the diagonals.
    catenaries: Vec<Catenary>,
}

/// One catenary.
#[derive(Debug, Serialize)]
struct Catenary {
    kind: Kind,
    from: GripperId,
    to: GripperId,
    /// Horizontal force of each of its spans (N); null where the model gives none.
    forces: Vec<Option<f64>>,
    /// What holds each of its spans.
    holds: Vec<Hold>,
    /// Whether it is straight because its cell shears.
    shearing: bool,
    /// Whether the mold holds a part of it: its force is then that of its axial stiffness.
    touches: bool,
    /// Middle (m).
    middle: [f64; 3],
}

/// Why a scene has no ply.
#[derive(Debug, Serialize)]
struct Refused<'a> {
    /// What is wrong.
    refused: &'a str,
    /// What would be right.
    help: &'a str,
}

/// Solves a scene whose grippers are held, by the catenaries, whatever its model is.
#[must_use]
pub fn answer(scene: &str, mold: Mold) -> Answer {
    let model = Model::Catenaries;
    match parse_for(scene, Path::new(""), "the scene", None, Some(model), None) {
        Ok(file) => match drape(&file, model, Path::new(""), &|| false, |_| {}) {
            Ok(drape) => {
                let result = ResultFile::new(&file, file.input.clone(), drape);
                let triangles = (mold == Mold::Drawn).then_some(TRIANGLES);
                let form = Form { triangles, packed: false };
                hanging(&result, form).map_or_else(|e| refused(&e.to_string(), ""), Answer::Ply)
            }
            Err(error) => refused(&error.to_string(), error.help()),
        },
        Err(error) => refused(&error.message(), error.help()),
    }
}

fn refused(message: &str, help: &str) -> Answer {
    Answer::Refused(json::to_text(&Refused { refused: message, help }).unwrap_or_default())
}

fn hanging(result: &ResultFile, form: Form) -> Result<String, Error> {
    let data = page::data(result, form)?;
    let steps = result.steps.first().and_then(|step| Some((step, step.catenaries.as_ref()?)));
    let own = steps.map(|(step, hanging)| {
        let curves = result.curves(step);
        json::to_text(&Hanging {
            program: PROGRAM,
            found: hanging.solver.found(),
            status: [hanging.solver.status.name(), hanging.solver.contact.name()],
            catenaries: catenaries(result, step, hanging, &curves),
        })
    });
    let own = own.transpose()?.unwrap_or_default();
    let own = own.trim_end().trim_end_matches('}');
    Ok([own, ",\"page\":", data.trim_end(), "}"].concat())
}

fn catenaries(
    result: &ResultFile,
    step: &Step,
    hanging: &CatenaryStep,
    curves: &[Vec<Vec<[f64; 3]>>],
) -> Vec<Catenary> {
    let lines = result.scene.ply.lines();
    let catenary = |n: usize| {
        let (state, curves) = (&hanging.catenaries[n], &curves[n]);
        let ends = lines.ends(n).map(|gripper| step.grippers[gripper].position);
        let line = shape(state, curves, ends);
        Catenary {
            kind: state.kind,
            from: state.from,
            to: state.to,
            forces: state.spans.iter().map(|span| span.force).collect(),
            holds: state.spans.iter().map(|span| span.hold).collect(),
            shearing: state.shearing,
            touches: state.contact.is_some(),
            middle: stations(&line, 2)[1],
        }
    };
    (0..hanging.catenaries.len().min(curves.len())).map(catenary).collect()
}
