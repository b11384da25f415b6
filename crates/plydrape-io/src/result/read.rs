//! A result file, read back: the whole of it, unchanged, in this version of the format, or a refusal.
//!
//! Everything that is made of a result is made of these numbers, so a file that was cut short, edited or
//! written by another version is no basis. The check sum stands for all its bytes but white space at the end.
//!
//! The file is read as a stream, three times: for its version, for its contents, for its check sum.

use super::check::fault;
use super::document::{AlsoDocument, Document, shown};
use super::refusal;
use super::step::StepColumns;
use super::{Also, ResultFile};
use crate::Error;
use crate::result::sheet::{self, SheetKept};
use crate::store::file_kind::FileKind;
use crate::store::format::{FILE, FORMAT, VERSION};
use crate::store::shown::excerpt;
use crate::store::{folder, input, size};
use plydrape::layup::Model;
use plydrape::outcome::Step;
use plydrape::ply::{Grid, Ply};
use serde::Deserialize;
use serde_json::error::Category;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The result file that a path means: the one in it, if it is a folder.
#[must_use]
pub fn file_of(path: &Path) -> Cow<'_, Path> {
    let inside = path.join(FILE);
    if path.is_dir() && inside.is_file() { inside.into() } else { path.into() }
}

/// What tells a result file before all of it is understood.
#[derive(Deserialize)]
struct Head {
    format: Option<serde_json::Value>,
    version: Option<u64>,
    program: Option<String>,
}

/// A file that was read.
type ReadDocument = Document<'static, Vec<StepColumns>, String>;

/// Reads a result file, or that in a folder.
///
/// # Errors
/// [`Error`] if it cannot be read, or is not, to the last byte, what this version writes.
pub fn read(path: &Path) -> Result<ResultFile, Error> {
    let path = &*file_of(path);
    let fault = |source| refusal::unreadable(path, source);
    let size = input::size(path).map_err(fault)?;
    size::result(size).map_err(|error| error.of_file(format_args!("`{}`", path.display())))?;
    let folder = path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    if !folder::is_sealed(folder) {
        return Err(refusal::mixed(folder));
    }
    let file = File::open(path).map_err(fault)?;
    // what is added to it meanwhile is not read
    let mut result = read_from(&mut Bounded { reader: BufReader::new(file), size }, path)?;
    result.files = vec![path.into(), folder.join(sheet::NAME)];
    Ok(result)
}

/// Reads the bytes of a result file; its path appears in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: &[u8], path: &Path) -> Result<ResultFile, Error> {
    read_from(&mut Bounded { reader: Cursor::new(bytes), size: bytes.len() as u64 }, path)
}

/// A file of a known size.
struct Bounded<R> {
    reader: R,
    size: u64,
}

impl<R: BufRead + Seek> Bounded<R> {
    /// All of it, from its beginning.
    fn all(&mut self) -> io::Result<impl BufRead> {
        self.reader.rewind()?;
        Ok((&mut self.reader).take(self.size))
    }
}

fn read_from<R: BufRead + Seek>(file: &mut Bounded<R>, path: &Path) -> Result<ResultFile, Error> {
    let unreadable = |source| refusal::unreadable(path, source);
    let changed = |what: String| refusal::changed(path, &what);
    let foreign = |reason: String| refusal::foreign(path, &reason);

    let size = file.size;
    // Whose it is, and of which version: keys that are unknown here say nothing yet.
    let head = serde_json::from_reader(file.all().map_err(unreadable)?);
    let head: Head = match head {
        Ok(head) => head,
        Err(error) => {
            let ours = begins_as_ours(file.all().map_err(unreadable)?).map_err(unreadable)?;
            return Err(match error.classify() {
                Category::Io => unreadable(error.into()),
                Category::Eof if ours => refusal::truncated(path, error.line(), error.column()),
                _ if ours => changed(reason(&error)),
                Category::Data => {
                    foreign(format!("not a result of plydrape: it has no `format` \"{FORMAT}\""))
                }
                _ => {
                    let all = file.all().map_err(unreadable)?;
                    foreign(other_file(all, size, &error).map_err(unreadable)?)
                }
            });
        }
    };
    let (found, program) = match head {
        Head { format: Some(format), version: Some(version), program } if format == FORMAT => {
            (version, program.unwrap_or_else(|| "an unknown program".into()))
        }
        _ => {
            return Err(foreign(format!(
                "not a result of plydrape: it has no `format` \"{FORMAT}\" with a `version`"
            )));
        }
    };
    if found != u64::from(VERSION) {
        return Err(refusal::other_version(path, found, &program));
    }

    // What it says, and whether that can be.
    let read: ReadDocument = serde_json::from_reader(file.all().map_err(unreadable)?)
        .map_err(|error| changed(reason(&error)))?;
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let (result, sum) = from_columns(read, folder).map_err(changed)?;
    if let Some(what) = fault(&result) {
        return Err(changed(what));
    }
    match checksum(file.all().map_err(unreadable)?).map_err(unreadable)? {
        Some(found) if found == sum => Ok(result),
        _ => Err(changed("its check sum does not match its contents".into())),
    }
}

/// What a file is that is no JSON.
fn other_file(file: impl BufRead, size: u64, error: &serde_json::Error) -> io::Result<String> {
    let mut start = Vec::new();
    file.take(1 << 16).read_to_end(&mut start)?;
    Ok(match FileKind::of_start(&start, size).filter(|kind| *kind != FileKind::Json) {
        _ if start.trim_ascii().is_empty() => "empty, not a result of plydrape".into(),
        Some(kind) => format!("{}, not a result of plydrape", kind.name()),
        None => format!("not a result of plydrape: it is not JSON, {}", reason(error)),
    })
}

/// Longest reason that is shown whole (characters): it may quote a key of the file.
const REASON: usize = 300;

/// Why a file is not what it should be, with the place.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    if text.chars().count() <= REASON {
        return text;
    }
    let start = excerpt(&text, REASON);
    format!("{start} at line {} column {}", error.line(), error.column())
}

/// The grippers of a ply, as an array or by their number.
fn named(ply: &Ply) -> String {
    match ply.grid {
        Grid::NONE => format!("{} grippers", ply.grippers()),
        Grid { nu, nv } => format!("{nu} × {nv} grippers"),
    }
}

/// The result that a file in a folder describes, and the check sum that it names.
fn from_columns(read: ReadDocument, folder: PathBuf) -> Result<(ResultFile, String), String> {
    // the ply must be possible, and the catenaries those between its grippers
    let ply = read.scene.ply.clone();
    if let Some(what) = super::check::ply_fault(&read.scene) {
        return Err(what);
    }
    if read.catenaries.as_ref().is_some_and(|named| !named.are_of(&ply.lines())) {
        return Err(format!("its catenaries are not those of {}", named(&ply)));
    }

    // the steps of the model that decides, and of the one beside it
    let (summary, catenaries) = (read.summary.into_owned(), read.catenaries.is_some());
    let steps = steps_of_model(&ply, summary.model, read.steps)?;
    let also = read.also.map(|AlsoDocument { summary, steps: columns }| {
        let summary = summary.0.into_owned();
        let steps = steps_of_model(&ply, summary.model, columns)?;
        Ok::<_, String>(Also { summary, steps })
    });
    let result = ResultFile {
        program: read.program.into_owned(),
        scene: read.scene.into_owned(),
        plan: read.plan.into_owned(),
        summary,
        sheet_states: read.sheet_states.map(|seal| SheetKept::read(seal.into_owned(), folder)),
        steps,
        also: also.transpose()?,
        files: Vec::new(),
        motion: OnceLock::new(),
    };

    // catenaries are named exactly where some were draped
    if catenaries != result.steps_of(Model::Catenaries).is_some() {
        return Err(
            "its catenaries are named where none were draped, or not where they were".into()
        );
    }
    Ok((result, read.checksum))
}

/// The steps that columns describe, those of a model: catenaries are there where these draped.
fn steps_of_model(ply: &Ply, model: Model, columns: Vec<StepColumns>) -> Result<Vec<Step>, String> {
    let mut known = Vec::new();
    let step = |(columns, number): (StepColumns, usize)| {
        let in_step = |what| format!("in step {number}, {what}");
        let step = columns.step(ply, &mut known).map_err(in_step)?;
        match (model, &step.catenaries) {
            (Model::Sheet, Some(_)) => Err(in_step("the sheet has catenaries".into())),
            (Model::Catenaries, None) => Err(in_step("the catenaries are missing".into())),
            _ => Ok(step),
        }
    };
    columns.into_iter().zip(1..).map(step).collect()
}

/// Check sum of a file up to the value of its last key; `None` where that is not the check sum.
fn checksum(mut file: impl BufRead) -> io::Result<Option<String>> {
    let mut sum = crc32fast::Hasher::new();
    let mut end: Vec<u8> = Vec::new();
    loop {
        let chunk = file.fill_buf()?;
        if chunk.is_empty() {
            break;
        }
        let count = chunk.len();
        end.extend(chunk);
        file.consume(count);
        let spent = end.len().saturating_sub(END);
        sum.update(&end[..spent]);
        end.drain(..spent);
    }
    let place = end.windows(CHECKSUM.len()).rposition(|text| text == CHECKSUM);
    let Some(place) = place.map(|place| place + CHECKSUM.len()) else { return Ok(None) };
    sum.update(&end[..place]);
    let sum = shown(sum);
    let rest = String::from_utf8_lossy(&end[place..]);
    Ok((rest.trim_end() == format!("\"{sum}\"}}")).then_some(sum))
}

/// The key of the check sum, as it is written.
const CHECKSUM: &[u8] = b"\"checksum\":";

/// Bytes at the end of a file among which the check sum is looked for.
const END: usize = 1024;

/// Whether what is no JSON begins as a result file does.
fn begins_as_ours(file: impl BufRead) -> io::Result<bool> {
    let mut start = Vec::new();
    file.take(64).read_to_end(&mut start)?;
    start.retain(|byte| !byte.is_ascii_whitespace());
    Ok(start.starts_with(format!("{{\"format\":\"{FORMAT}\"").as_bytes()))
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
