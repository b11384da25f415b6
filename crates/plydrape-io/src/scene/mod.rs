//! A scene: everything one drape needs, read from a TOML file and checked.
//!
//! A file becomes a scene in three stages, each refusing what it cannot pass on with the place in
//! the file, what is wrong there and what would be right ([`Diagnostic`]):
//!
//! 1. `read`, `tree`, `diagnostic`: bytes become a text, a text the keys of `file`;
//! 2. `quantity`, `units`: values with a unit become SI numbers of the expected dimension;
//! 3. `check` with `bodies`, `cell`, `cut`, `dxf`, `material`, `curve`, `mold`, `settings`, `placement`, `target`, `start`, `motion`, `trajectory`, `limits`, `bound`, `model`,
//!    `sheet`, `plan`, `errors`, `tool`, `release`, `pick_up`: numbers become a [`Scene`], with what else the file says a [`SceneFile`].
//!
//! `table` reads every CSV file, `fit` those of tests. `offset` reads where a camera saw the ply. `book` reads the plies of one part, each as a scene; `argument` lends the reader of stage 2 to values on the command line.

mod argument;
mod bodies;
mod book;
mod bound;
mod cell;
mod check;
mod choice;
mod curve;
mod cut;
mod diagnostic;
mod dxf;
mod errors;
mod file;
mod fit;

mod ideal;
mod limits;
mod located;
mod material;
mod model;
mod mold;
mod motion;
mod offset;
mod pick_up;
mod placement;
mod places;
mod plan;
mod pose;
mod quantity;
mod rate;
mod read;
mod rectangle;
mod release;
mod robot;
mod schema;
mod settings;
mod sheet;
mod source;
mod start;
mod table;
mod target;
mod tool;
mod trajectory;
mod tree;
mod units;
pub mod usual;

pub use argument::{Measured, quantity};
pub use book::{Book, BookPly, is_book, parse_book, read_book};
pub use cut::{CupArray, IdleCup, LeftOff};
pub use fit::{Reading, Table as FitTable, read_fit};
pub use ideal::IdealDrape;
pub use material::{read_material, shipped_material, shipped_materials};
pub use offset::{Request, SeenOffset, json_offset, parse_offset, read_offset};
pub use schema::schema;
pub use trajectory::slow_in_seconds;

use crate::Error;
use crate::error::Diagnostic;
use crate::read::outline::Drawn;
use crate::store::file_kind::FileKind;
use crate::store::{input, shown};
use located::Located;
use plydrape::layup::Model;
use plydrape::mold::{MeshReport, Mold};
use plydrape::ply::Ply;
use plydrape::scene::Scene;
use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// A commented scene to start from.
pub const TEMPLATE: &str = include_str!("template.toml");

/// Reads and checks a scene file; files it names are relative to its folder.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn read(path: &Path) -> Result<SceneFile, Error> {
    read_for(path, None, None)
}

/// As [`read`], for another model than the scene's, if one is given, and with another one beside it (`also`).
///
/// # Errors
/// As [`read`].
pub fn read_for(
    path: &Path,
    model: Option<Model>,
    also: Option<Model>,
) -> Result<SceneFile, Error> {
    let document = open(path)?;
    let mut file = keys(&document)?;
    choose_models(&mut file, model, also);
    let mut scene = check::scene(&file, None, &document)?;
    scene.files.push(path.into());
    Ok(scene)
}

/// Puts a model in place of the scene's, if one is given, and another one beside it (`also`).
fn choose_models(file: &mut file::SceneKeys, model: Option<Model>, also: Option<Model>) {
    let key = |model: Model| Located { value: file::ModelKey::from(model), span: 0..0 };
    if let Some(kind) = model.map(key) {
        // what the scene has beside its own model may be the one that decides now
        file.model.also.take_if(|also| also.value == kind.value);
        file.model.kind = Some(kind);
    }
    if let Some(also) = also.map(key) {
        file.model.also = Some(also);
    }
}

/// Reads of a scene file what its ideal drape needs, `[ply]`, `[mold]`, `[target]` and `[limits]`, and
/// lays the ply; files it names are relative to its folder.
///
/// # Errors
/// The first fault found, with its place and a remedy. A ply that runs off the mold or folds is none.
pub fn read_ideal_drape(path: &Path) -> Result<IdealDrape, Error> {
    let document = open(path)?;
    let mut ideal = ideal::ideal_drape(&keys(&document)?, &document)?;
    ideal.files.push(path.into());
    Ok(ideal)
}

/// The text of a scene file.
fn open(path: &Path) -> Result<source::Document, Error> {
    let mut document = read::text(path, &path.to_string_lossy(), read::LARGEST_TOML);
    if let Err(Error::Scene(error)) = &mut document {
        if path.is_dir() {
            error.help = in_folder(path);
        } else if !path.exists() {
            let new = "`plydrape new NAME` writes a scene to start from";
            error.help = match error.help.is_empty() {
                true => new.into(),
                // what ends with a question mark ends a sentence
                false if error.help.ends_with('?') => format!("{} {new}", error.help),
                false => format!("{}; {new}", error.help),
            };
        } else if let Ok(bytes) = input::bytes(path, read::LARGEST_TOML)
            && let Some(other) = taken_for_a_scene(&bytes, &error.file)
        {
            return Err(other);
        }
    }
    document
}

/// What to give in place of a folder: a scene in it, or what else is there.
fn in_folder(path: &Path) -> String {
    let inside =
        |name: &str| Some(shown::path(&path.join(name))).filter(|_| path.join(name).is_file());
    match (inside("scene.toml"), inside("result.json")) {
        (Some(scene), _) => format!("did you mean `{scene}`?"),
        (None, Some(result)) => format!(
            "it holds a result, {result}, which `plydrape report` and `plydrape export` take; a scene is a .toml file"
        ),
        (None, None) => {
            "give the .toml file of a scene; `plydrape new NAME` writes one to start from".into()
        }
    }
}

/// The refusal of a file that is something else than a scene, if its bytes tell.
fn taken_for_a_scene(bytes: &[u8], name: &str) -> Option<Error> {
    let kind = FileKind::detect(bytes).filter(|kind| *kind != FileKind::Scene)?;
    let file = shown::name(name);
    let message = format!("`{file}` is {}, not a scene", kind.name());
    Some(source::Document::new(name, "").error_anywhere(message, kind.in_place_of_a_scene(&file)))
}

/// Reads and checks the text of a scene; files it names are relative to `base`, and `name` stands
/// for the scene in messages.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn parse(text: &str, base: &Path, name: &str) -> Result<SceneFile, Error> {
    parse_for(text, base, name, None, None, None)
}

/// Reads and checks the table `[ply]` of a scene's text alone; a material file is relative to `base`.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn parse_ply(text: &str, base: &Path, name: &str) -> Result<Ply, Error> {
    let document = source::Document::new(name, text).within(base);
    let keys = keys(&document)?;
    let grippers = keys.grippers.as_ref().map(|table| &table.value);
    check::ply(&keys.ply, grippers, &document).map(|(ply, _)| ply)
}

/// As [`parse`], on a mold that a program has made if one is given, the text having no `[mold]` then, and for models as [`read_for`].
///
/// # Errors
/// As [`parse`], and if the text has a mold of its own beside a given one.
pub fn parse_for(
    text: &str,
    base: &Path,
    name: &str,
    made: Option<Mold>,
    model: Option<Model>,
    also: Option<Model>,
) -> Result<SceneFile, Error> {
    let document = source::Document::new(name, text).within(base);
    let mut file = keys(&document)?;
    choose_models(&mut file, model, also);
    match (&file.mold, made) {
        (Some(table), Some(_)) => Err(document.error(
            table.span.clone(),
            "the scene has two molds",
            "leave out [mold], or give no other mold",
        )),
        (_, Some(made)) => check::scene_on(&file, made, &document),
        (_, None) => check::scene(&file, None, &document),
    }
}

/// Files that a text may name: every value that is the path of one, and those that such a file names if it is TOML, as
/// that of a material or of a cell.
fn named(document: &source::Document) -> Vec<PathBuf> {
    let mut out = named_in(&document.text, &document.folder);
    for path in out.clone().iter().filter(|path| path.extension() == Some("toml".as_ref())) {
        let text = input::text(path, read::LARGEST_TOML).unwrap_or_default();
        out.extend(named_in(&text, path.parent().unwrap_or(&document.folder)));
    }
    out
}

/// Files that are values of a text alone.
fn named_in(text: &str, base: &Path) -> Vec<PathBuf> {
    fn search(value: &DeValue, base: &Path, out: &mut Vec<PathBuf>) {
        match value {
            DeValue::String(name) => {
                out.extend(Some(base.join(&**name)).filter(|path| path.is_file()));
            }
            DeValue::Array(values) => {
                values.iter().for_each(|value| search(value.get_ref(), base, out));
            }
            DeValue::Table(table) => {
                table.values().for_each(|value| search(value.get_ref(), base, out));
            }
            _ => {}
        }
    }
    let mut out = Vec::new();
    if let Ok(table) = DeTable::parse(text) {
        search(&DeValue::Table(table.into_inner()), base, &mut out);
    }
    out
}

fn keys(document: &source::Document) -> Result<file::SceneKeys, Error> {
    if document.text.trim().is_empty() {
        return Err(document.error_anywhere(
            format!("`{}` is empty", document.file),
            "`plydrape new NAME` writes a commented scene to start from",
        ));
    }
    if book::has_plies(document) {
        return Err(book::refused_as_scene(document));
    }
    read::keys(document).map_err(|error| {
        taken_for_a_scene(document.text.as_bytes(), &document.file).unwrap_or(error)
    })
}

/// A scene with what its file says beside it.
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// The text of the file; `None` for a scene that was made in a program.
    pub input: Option<Arc<str>>,
    /// The file itself and those that it names, as far as they are there.
    pub files: Vec<PathBuf>,
    /// What was found and repaired while the mold was read, if it is a mesh.
    pub mesh: Option<MeshReport>,
    /// The array of cups over a ply that is cut.
    pub cups: Option<CupArray>,
    /// What was read of the drawing of the ply, if it has one.
    pub drawn: Option<Drawn>,
    /// The name of its cell, or that cell's file, if it has one.
    pub cell: Option<String>,
    /// Thickness of the ply once it lies (m), if the scene says it: what is laid on it lies that much higher.
    pub thickness: Option<f64>,
    /// Keys of the scene that have a new name, and limits that the model which decides does not measure, each in a sentence with what to change.
    pub notices: Vec<String>,
    /// Why no plan is looked for: what the scene says of its own motion and a planned one would not keep.
    pub plan_refusal: Option<Box<Diagnostic>>,
}

impl Deref for SceneFile {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

impl DerefMut for SceneFile {
    fn deref_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }
}
