//! A plybook: the plies of one part on one mold, in the order in which they are laid.
//!
//! A book has the tables of a scene, which all of its plies share, and one `[[plies]]` for each ply with its name and the tables that
//! are its own: their keys replace the shared ones, key by key. So every ply becomes the keys of a whole scene, each
//! with its place in the book's text, and is read as any scene is. A ply may also be a scene file beside the book, without a mold.
//!
//! A ply lies on every earlier one that it overlaps. The mold of its scene is then [`Mold::Layered`]: the book's mold and those
//! plies where their ideal drape puts them.

use super::check;
use super::diagnostic;
use super::file::{MoldTable, SceneKeys};
use super::located::Located;
use super::source::{Document, excerpt};
use super::tree::{Fault, read_table};
use super::{SceneFile, mold, named, open, read, settings};
use crate::Error;
use plydrape::mold::{Layer, Layers, MeshReport, Mold, Raised, overlap};
use plydrape::scene;
use serde::Deserialize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The key of the plies of a book, by which it is known.
const PLIES: &str = "plies";
/// Most plies of a book.
const MOST: usize = 1000;

/// The plies of one part.
#[derive(Debug, Clone)]
pub struct Book {
    /// Name for reports.
    pub title: String,
    /// What the first ply is laid on.
    pub mold: Mold,
    /// What was found and repaired while the mold was read, if it is a mesh.
    pub mesh: Option<MeshReport>,
    /// The plies in the order in which they are laid.
    pub plies: Vec<BookPly>,
    /// The book itself and the files that it and its plies name.
    pub files: Vec<PathBuf>,
}

/// One ply of a book.
#[derive(Debug, Clone)]
pub struct BookPly {
    /// Name.
    pub name: String,
    /// Scene, on the mold with the plies that it lies on.
    pub scene: SceneFile,
    /// The plies that it lies on, counted from 0, the lowest first.
    pub lies_on: Vec<usize>,
    /// The rings in plan within which it lies, by its ideal drape (m).
    pub region: Vec<Vec<[f64; 2]>>,
}

impl BookPly {
    /// A name for its folder: its place in the book from 1, and its name without what is no letter or digit.
    #[must_use]
    pub fn folder(&self, index: usize) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        let name: String = self.name.chars().map(plain).take(40).collect();
        format!("{:02}_{name}", index + 1)
    }
}

/// What a book says beside its plies.
#[derive(Deserialize)]
struct Head {
    title: Option<Located<String>>,
    mold: Located<MoldTable>,
}

/// What one of `[[plies]]` says of itself, beside the tables of its scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
struct Entry {
    name: Option<Located<String>>,
    scene: Option<Located<String>>,
}

/// One of `[[plies]]` under reading.
struct Reading<'a> {
    name: String,
    keys: SceneKeys,
    /// The text that its keys are from: the book's or that of its own scene file.
    document: Document,
    /// Header in the book.
    header: Range<usize>,
    book: &'a Document,
}

/// Whether a file is a book: whether it has `[[plies]]`. One that cannot be read is none.
#[must_use]
pub fn is_book(path: &Path) -> bool {
    open(path).is_ok_and(|document| has_plies(&document))
}

/// Whether a text has `[[plies]]`.
pub(super) fn has_plies(document: &Document) -> bool {
    // most scenes need not be parsed twice
    document.text.contains(PLIES)
        && DeTable::parse(&document.text).is_ok_and(|table| table.get_ref().contains_key(PLIES))
}

/// Reads and checks a book; files that it names are relative to its folder.
///
/// # Errors
/// The first fault found, with its place, a remedy and the ply that it is of.
pub fn read_book(path: &Path) -> Result<Book, Error> {
    let document = open(path)?;
    let mut book = book(&document)?;
    book.files.insert(0, path.into());
    Ok(book)
}

/// Reads and checks the text of a book; files it names are relative to `base`, and `name` stands for the book in messages.
///
/// # Errors
/// As [`read_book`].
pub fn parse_book(text: &str, base: &Path, name: &str) -> Result<Book, Error> {
    book(&Document::new(name, text).within(base))
}

/// Refuses a book in place of a scene.
pub(super) fn refused_as_scene(document: &Document) -> Error {
    let place = document.text.find("[[plies").unwrap_or(0);
    let length = document.text.get(place..).and_then(|text| text.find('\n')).unwrap_or(0);
    document.error(
        place..place + length,
        "this is a plybook: expected a scene of one ply",
        "`plydrape plan` plans a book and `plydrape check` reads it; other commands take a single ply: a scene file, or the result.json in the ply's folder of a planned book",
    )
}

fn book(document: &Document) -> Result<Book, Error> {
    // the book as a table, without the plies
    let fault = |fault: Fault| diagnostic::scene_error(document, fault);
    let root = DeTable::parse(&document.text).map_err(|error| fault(error.into()))?;
    let whole = root.span();
    let mut shared = root.into_inner();
    let entries = entries(&mut shared, document)?;

    // title and mold are of the book alone, and all plies share the mold
    let head: Head = {
        let keys = ["title", "mold"];
        let kept = |(key, _): &(&Spanned<_>, &Spanned<_>)| {
            let key: &std::borrow::Cow<str> = key.get_ref();
            keys.contains(&&**key)
        };
        let table: DeTable =
            shared.iter().filter(kept).map(|(k, v)| (k.clone(), v.clone())).collect();
        if !table.contains_key("mold") {
            return Err(document.error_anywhere(
                "the book has no [mold] to lay its plies on",
                "add [mold] with kind = \"plane\", or another one; all plies share it",
            ));
        }
        read_table(table, 0..0).map_err(fault)?
    };
    let title = check::title(head.title.as_ref(), document)?;
    shared.remove("title");
    shared.remove("mold");

    // the keys of every ply; messages name a ply without a name by its number
    let mut readings: Vec<Reading> = Vec::with_capacity(entries.len());
    for (n, (entry, span)) in entries.into_iter().enumerate() {
        let label = entry.get("name").and_then(|name| name.get_ref().as_str());
        let label = label.filter(|name| !name.trim().is_empty());
        let label = label.map_or_else(|| (n + 1).to_string(), str::to_owned);
        let named = |fault| in_ply(fault, &label);
        let reading = reading(entry, span, &shared, &whole, document).map_err(named)?;
        if let Some(twin) = readings.iter().position(|other| other.name == reading.name) {
            return Err(document.error(
                reading.header,
                format!(
                    "plies {} and {} have the same name, \"{}\"",
                    twin + 1,
                    n + 1,
                    excerpt(&reading.name)
                ),
                "give every ply a `name` of its own",
            ));
        }
        readings.push(reading);
    }

    // what all plies would share has no effect if each has a scene file of its own
    if let (Some((key, _)), true) = (
        shared.iter().next(),
        readings.iter().all(|reading| reading.document.file != document.file),
    ) {
        return Err(document.error(
            key.span(),
            format!("no ply uses `{}`: each has a scene file of its own", excerpt(key.get_ref())),
            "move it into the scene files; the book has `title`, [mold] and [[plies]] then",
        ));
    }

    // the mold, by the cells and the contact tolerance of the first ply
    let first = &readings[0];
    let (mold, mesh) = {
        let grippers = first.keys.grippers.as_ref().map(|table| &table.value);
        let (ply, _) = check::ply(&first.keys.ply, grippers, &first.document)
            .map_err(|fault| in_ply(fault, &first.name))?;
        let contact = settings::contact(&first.keys, &ply, &first.document)
            .map_err(|fault| in_ply(fault, &first.name))?;
        mold::mold(&head.mold.value, &ply, contact.tolerance, document)?
    };

    // from below upwards, because a ply lies on those before it
    let mut plies: Vec<BookPly> = Vec::with_capacity(readings.len());
    for reading in &readings {
        let ply = ply_on_others(reading, &title, &mold, &plies, &readings);
        plies.push(ply.map_err(|fault| in_ply(fault, &reading.name))?);
    }

    // all files that were read, each once
    let mut files = named(document);
    files.extend(plies.iter().flat_map(|ply| ply.scene.files.iter().cloned()));
    files.sort();
    files.dedup();
    Ok(Book { title, mold, mesh, plies, files })
}

/// A fault with the ply that it is of.
fn in_ply(mut error: Error, name: &str) -> Error {
    if let Error::Scene(fault) = &mut error {
        fault.message = format!("ply {}: {}", excerpt(name), fault.message);
    }
    error
}

/// The tables of `[[plies]]`, taken out of the book's.
fn entries<'i>(
    shared: &mut DeTable<'i>,
    document: &Document,
) -> Result<Vec<(DeTable<'i>, Range<usize>)>, Error> {
    let help = "write [[plies]] before each ply's keys, as in name = \"first\" and target = { direction = \"45 deg\" }";
    let Some(found) = shared.remove(PLIES) else {
        return Err(document.error_anywhere("the book has no [[plies]]", help));
    };
    let span = found.span();
    let refused = |span: Range<usize>, message: String| Err(document.error(span, message, help));
    let DeValue::Array(found) = found.into_inner() else {
        return refused(span, "`plies` is no list of tables".into());
    };
    let count = found.len();
    if !(1..=MOST).contains(&count) {
        return refused(span, format!("there cannot be {count} plies: 1 to {MOST} are possible"));
    }
    let mut tables = Vec::with_capacity(count);
    for entry in found {
        let span = entry.span();
        let DeValue::Table(table) = entry.into_inner() else {
            return refused(span, "this is no table of a ply's keys".into());
        };
        tables.push((table, span));
    }
    Ok(tables)
}

/// One of `[[plies]]` as the keys of a scene.
fn reading<'a>(
    mut entry: DeTable<'_>,
    span: Range<usize>,
    shared: &DeTable<'_>,
    whole: &Range<usize>,
    document: &'a Document,
) -> Result<Reading<'a>, Error> {
    // faults show the header of the ply in the book
    let fault = |fault: Fault| diagnostic::scene_error(document, fault);
    let text = document.text.get(span.clone()).unwrap_or_default();
    let header = span.start..span.start + text.find('\n').unwrap_or(text.len());
    let refused =
        |span: Range<usize>, message: &str, help: &str| Err(document.error(span, message, help));

    // mold and title are those of the book
    for (key, help) in [
        ("mold", "remove it: all plies of a book lie on the book's [mold]"),
        ("title", "remove it: a ply has a `name`, and the book has the `title`"),
    ] {
        if let Some(value) = entry.get(key) {
            return refused(
                value.span(),
                &format!("a ply of a book has no `{key}` of its own"),
                help,
            );
        }
    }

    // name and scene file are keys of the book, not of the scene
    let own: DeTable = ["name", "scene"]
        .into_iter()
        .filter_map(|key| {
            let (k, _) = entry.get_key_value(key)?;
            let k = k.clone();
            Some((k, entry.remove(key)?))
        })
        .collect();
    let own: Entry = read_table(own, span.clone()).map_err(fault)?;

    // the name of a ply is that of its scene file if it has none of its own
    let name = match (&own.name, &own.scene) {
        (Some(name), _) if name.value.trim().is_empty() => {
            return refused(
                name.span.clone(),
                "the name is empty",
                "give the ply a name, as in name = \"first\"",
            );
        }
        (Some(name), _) => check::line(name, document)?,
        (None, Some(file)) => {
            let stem = Path::new(&file.value).file_stem().unwrap_or_default();
            crate::store::shown::name(&stem.to_string_lossy())
        }
        (None, None) => {
            return refused(header, "the ply has no name", "add name = \"first\" or the like");
        }
    };

    // a scene file is read alone: nothing of the book is mixed into it
    if let Some(file) = &own.scene {
        if let Some((key, _)) = entry.iter().next() {
            return refused(
                key.span(),
                "a ply with a `scene` file has no other keys in the book",
                "move them into the scene file, or remove `scene`",
            );
        }
        return reading_of_file(name, file, header, document);
    }

    // what the ply says itself goes over what all plies share
    let mut keys = shared.clone();
    for (key, value) in entry {
        let over = match (keys.remove(&**key.get_ref()), value) {
            (Some(below), value) => stacked(below, value),
            (None, value) => value,
        };
        keys.insert(key, over);
    }
    if !keys.contains_key("ply") {
        return refused(
            header,
            "neither the ply nor the book has a table `ply`",
            "add [ply] to the book for what all plies share, and ply = { size = [\"300 mm\", \"200 mm\"] } or the like here",
        );
    }

    let keys: SceneKeys = read_table(keys, whole.clone()).map_err(fault)?;
    Ok(Reading { name, keys, document: document.clone(), header, book: document })
}

/// The table of a ply merged over the shared one, key by key; a value that is no table is the ply's own.
fn stacked<'i>(below: Spanned<DeValue<'i>>, over: Spanned<DeValue<'i>>) -> Spanned<DeValue<'i>> {
    let span = over.span();
    match (below.into_inner(), over.into_inner()) {
        (DeValue::Table(mut below), DeValue::Table(over)) => {
            for (key, value) in over {
                below.remove(&**key.get_ref());
                below.insert(key, value);
            }
            Spanned::new(span, DeValue::Table(below))
        }
        (_, over) => Spanned::new(span, over),
    }
}

/// A ply whose scene is a file of its own.
fn reading_of_file<'a>(
    name: String,
    file: &Located<String>,
    header: Range<usize>,
    book: &'a Document,
) -> Result<Reading<'a>, Error> {
    let document = read::text(&book.path(&file.value), &file.value, read::LARGEST_TOML)
        .map_err(|error| book.error_of_named(&file.span, error, "book"))?;
    let keys = super::keys(&document)?;
    if let Some(mold) = &keys.mold {
        return Err(document.error(
            mold.span.clone(),
            "a scene file of a book has no mold of its own",
            "remove [mold]: all plies of a book lie on the book's",
        ));
    }
    Ok(Reading { name, keys, document, header, book })
}

/// Reads the scene of a ply on the mold with the plies below it, and where the ply itself lies.
fn ply_on_others(
    reading: &Reading,
    title: &str,
    mold: &Mold,
    below: &[BookPly],
    readings: &[Reading],
) -> Result<BookPly, Error> {
    // without a target it is not known which plies lie below
    let Reading { name, keys, document, header, .. } = reading;
    if keys.target.as_ref().is_none_or(|target| target.value.positions.is_some()) {
        let place = keys.target.as_ref().map_or(header, |target| &target.span);
        let document = if keys.target.is_some() { document } else { reading.book };
        return Err(document.error(
            place.clone(),
            "the book does not say how the ply lies on the mold",
            "add target = { origin = [0, 0], direction = \"45 deg\" } or the like to the ply, or [target] to the book; `positions` of grippers do not say it",
        ));
    }

    // where the ply lies, as if the mold were bare
    let bare = check::scene(keys, Some(mold.clone()), document)?;
    let region = region(&bare, mold).ok_or_else(|| {
        let message = "the ply has no place on the mold that another ply could lie on";
        reading.book.error(
            header.clone(),
            message,
            "a book holds plies with a width that lie on the mold",
        )
    })?;

    // every ply below that it overlaps raises the mold by its thickness
    let mut lies_on = Vec::new();
    let mut layers = Vec::new();
    for (n, lower) in below.iter().enumerate() {
        let thickness = lower.scene.thickness;
        if !overlap(&region, &lower.region, thickness.unwrap_or(0.0)) {
            continue;
        }
        let Some(thickness) = thickness else {
            return Err(reading.book.error(
                readings[n].header.clone(),
                format!("it lies on ply {}, whose thickness is not known", excerpt(&lower.name)),
                "add thickness = \"0.3 mm\" to the [ply] of the book or of that ply: how thick it is once it lies",
            ));
        };
        let layer = Layer::new(thickness, lower.region.clone()).map_err(|fault| {
            reading.book.error(
                readings[n].header.clone(),
                fault.to_string(),
                "give another outline",
            )
        })?;
        lies_on.push(n);
        layers.push(layer);
    }

    // the scene once more on the raised mold
    let (mut scene, region) = if layers.is_empty() {
        (bare, region)
    } else {
        let layered = Raised { mold: mold.clone(), relief: Layers(layers) };
        let layered = Mold::Layered(Arc::new(layered));
        let scene = check::scene(keys, Some(layered), document)?;
        let region = self::region(&scene, mold).unwrap_or(region);
        (scene, region)
    };

    // the scene says which ply of which book it is
    scene.scene.title = format!("{title}: {name}");
    scene.scene.book_ply = Some(scene::BookPly { number: below.len() + 1, name: name.clone() });
    Ok(BookPly { name: name.clone(), scene, lies_on, region })
}

/// Where a ply lies, in plan.
fn region(scene: &SceneFile, bare: &Mold) -> Option<Vec<Vec<[f64; 2]>>> {
    let net = scene.layup.target.as_ref()?.drape.as_ref()?;
    net.region(scene.layup.mold.as_ref()?, bare)
}
