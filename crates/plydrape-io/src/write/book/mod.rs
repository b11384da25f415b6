//! The results of a planned book: `book.json` and one report over all of its plies, beside a folder of results for each ply.
//!
//! `book.json` is one JSON object with `format` ("plydrape-book"), `version`, `program`, `title`, `accepted`, `interrupted` and `plies`, which has a
//! [`PlyRecord`] for each ply.

mod drawing;
mod report;
mod table;

pub use report::html;
pub use table::table;

use crate::scene::{Book, BookPly};
use crate::store::json;
use crate::text::table::{closest, limiting, measure_text};
use crate::{Content, Error, Folder, PROGRAM, ResultFile, Staged};
use plydrape::measure::Verdict;
use plydrape::scene::World;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The names of the files of a book beside the folders of its plies.
pub const NAMES: [&str; 2] = ["book.json", "report.html"];

/// Version of `book.json`; it grows when a key changes its meaning.
const VERSION: u32 = 1;

/// How one ply of a book was planned.
#[derive(Debug, Clone, Serialize)]
pub struct PlyRecord {
    /// Name.
    pub name: String,
    /// Folder of its results, beside `book.json`.
    pub folder: String,
    /// Numbers of the plies that it lies on, counted from 1.
    pub lies_on: Vec<usize>,
    /// Thickness (m), if the book says it.
    pub thickness: Option<f64>,
    /// Whether its plan keeps all limits.
    pub accepted: bool,
    /// In which world that was judged.
    pub world: World,
    /// The limit that is exceeded most; of an accepted plan the one that is nearest to not holding.
    pub worst: Option<Verdict>,
    /// How long its motion takes (s).
    pub motion_s: f64,
    /// Drapes of its search.
    pub evaluations: usize,
    /// The rings in plan within which it lies, by its ideal drape: x and y (m).
    pub region: Vec<Vec<[f64; 2]>>,
    /// Direction of the warp in the middle of the ply, in plan from x towards y (rad).
    pub warp_heading: Option<f64>,
}

impl PlyRecord {
    /// The record of a ply of a book, whose index counts from 0, from its planned result.
    #[must_use]
    pub fn new(book: &Book, index: usize, result: &ResultFile) -> Self {
        let ply: &BookPly = &book.plies[index];
        let limits = &result.summary.limits;
        let worst = limiting(limits).or_else(|| closest(limits)).cloned();
        PlyRecord {
            name: ply.name.clone(),
            folder: ply.folder(index),
            lies_on: ply.lies_on.iter().map(|n| n + 1).collect(),
            thickness: ply.scene.thickness,
            accepted: result.summary.accepted(),
            world: result.summary.world,
            worst,
            motion_s: result.steps.last().map_or(0.0, |step| step.time),
            evaluations: result.plan.as_ref().map_or(0, |plan| plan.evaluations),
            region: ply.region.clone(),
            warp_heading: drawing::warp_heading(ply),
        }
    }

    /// Worst limit as text.
    #[must_use]
    pub fn worst_text(&self) -> String {
        self.worst.as_ref().map_or_else(|| "–".into(), measure_text)
    }

    /// What it lies on, as text: the numbers of plies, or the mold.
    #[must_use]
    pub fn lies_on_text(&self) -> String {
        if self.lies_on.is_empty() {
            return "the mold".into();
        }
        let numbers: Vec<String> = self.lies_on.iter().map(usize::to_string).collect();
        numbers.join(", ")
    }
}

#[derive(Serialize)]
struct Written<'a> {
    format: &'static str,
    version: u32,
    program: &'static str,
    title: &'a str,
    accepted: bool,
    interrupted: bool,
    plies: &'a [PlyRecord],
}

/// `book.json` as text.
///
/// # Errors
/// [`Error`] if a number is not finite.
pub fn text(book: &Book, plies: &[PlyRecord], interrupted: bool) -> Result<String, Error> {
    json::to_text(&Written {
        format: "plydrape-book",
        version: VERSION,
        program: PROGRAM,
        title: &book.title,
        accepted: plies.iter().all(|ply| ply.accepted),
        interrupted,
        plies,
    })
}

/// Whether more plies of a planned book are accepted than of that in a folder, which may have none.
#[must_use]
pub fn is_better(plies: &[PlyRecord], dir: &Path) -> bool {
    #[derive(Deserialize)]
    struct Ply {
        accepted: bool,
    }
    #[derive(Deserialize)]
    struct Earlier {
        plies: Vec<Ply>,
    }
    let path = dir.join(NAMES[0]);
    let earlier = || serde_json::from_slice::<Earlier>(&std::fs::read(&path).ok()?).ok();
    let accepted = plies.iter().filter(|ply| ply.accepted).count();
    let fewer = |book: Earlier| book.plies.iter().filter(|ply| ply.accepted).count() < accepted;
    !path.exists() || earlier().is_some_and(fewer)
}

/// Stages the files of a book; they come in together with those of its plies, see [`crate::store::folder::write_together`].
///
/// # Errors
/// [`Error`] as for [`Folder::write`].
pub fn stage_into(
    folder: Folder,
    book: &Book,
    plies: &[PlyRecord],
    interrupted: bool,
) -> Result<Staged, Error> {
    let (text, html) = (text(book, plies, interrupted)?, html(book, plies, interrupted));
    let [text, html] = [text.as_bytes(), html.as_bytes()];
    let files: [(&str, &dyn Content); 2] = [(NAMES[0], &text), (NAMES[1], &html)];
    folder.stage_files(&files)
}
