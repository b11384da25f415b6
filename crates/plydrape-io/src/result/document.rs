//! Content of a result file: one JSON object, whose lists are columns, so that no name is repeated.
//!
//! The keys are `format`, `version`, `program`, `scene`, `plan`, `summary`, `sheet_states` if a sheet was draped, `catenaries` if these were,
//! `steps`, `also` if the other model was draped too, `checksum`, in this order. `summary` and `steps` are of the model that decides; `also`
//! has those of the other one. `catenaries` names each catenary once; steps refer to it by its number, from 0. What a step holds is described
//! in `docs/guide/result_file.md`. The check sum (CRC-32) is that of all bytes before its own value.
//!
//! A file is written step by step while its check sum is formed, and read without its text being kept.

use super::contact::Known;
use super::step::StepColumns;
use super::{ResultFile, SceneEcho};
use crate::Error;
use crate::result::sheet::SheetSeal;
use crate::store::folder::Content;
use crate::store::format::{FORMAT, VERSION};
use crate::store::json::finite;
use plydrape::layup::Model;
use plydrape::outcome::{Step, Summary, Unjudged};
use plydrape::planner::PlanRecord;
use plydrape::ply::{GripperId, Kind, Lines};
use serde::ser::SerializeSeq;
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{self, Write};

/// The file's own shape, with its steps and its check sum in any form.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document<'a, S, C> {
    pub format: Cow<'a, str>,
    pub version: u32,
    pub program: Cow<'a, str>,
    pub scene: Cow<'a, SceneEcho>,
    pub plan: Cow<'a, Option<PlanRecord>>,
    pub summary: Cow<'a, Summary>,
    /// The file with the states of the sheet, if one was draped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sheet_states: Option<Cow<'a, SheetSeal>>,
    /// The catenaries of the ply, if they were draped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub catenaries: Option<Catenaries>,
    pub steps: S,
    /// The drape by the other model, if it was asked for.
    #[serde(default = "nothing", skip_serializing_if = "Option::is_none")]
    pub also: Option<AlsoDocument<'a, S>>,
    pub checksum: C,
}

/// The drape by the model that does not decide.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AlsoDocument<'a, S> {
    pub summary: Unjudged<'a>,
    pub steps: S,
}

/// The other model was not draped.
fn nothing<T>() -> Option<T> {
    None
}

/// The catenaries of the ply: fiber lines along u, along v, then bias lines.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Catenaries {
    kind: Vec<Kind>,
    from: Vec<GripperId>,
    to: Vec<GripperId>,
}

impl Catenaries {
    /// The catenaries of the first step.
    fn named(steps: &[Step]) -> Self {
        let lines = || {
            let first = steps.iter().take(1).filter_map(|step| step.catenaries.as_ref());
            first.flat_map(|step| &step.catenaries)
        };
        Catenaries {
            kind: lines().map(|line| line.kind).collect(),
            from: lines().map(|line| line.from).collect(),
            to: lines().map(|line| line.to).collect(),
        }
    }

    /// Whether they are the catenaries of a ply.
    pub(super) fn are_of(&self, lines: &Lines) -> bool {
        let count = lines.catenaries();
        [self.kind.len(), self.from.len(), self.to.len()] == [count; 3]
            && (0..count).map(|n| lines.catenary(n)).enumerate().all(|(n, line)| {
                (line.kind, line.from, line.to) == (self.kind[n], self.from[n], self.to[n])
            })
    }
}

/// Steps that turn into columns one after the other as they are written.
pub(super) struct Steps<'a>(&'a [Step]);

impl Serialize for Steps<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut known = Known::default();
        let mut list = to.serialize_seq(Some(self.0.len()))?;
        for step in self.0 {
            list.serialize_element(&StepColumns::new(step, &mut known))?;
        }
        list.end()
    }
}

/// The check sum of what has been written up to here.
struct Sum<'a>(&'a RefCell<crc32fast::Hasher>);

impl Serialize for Sum<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let sum = self.0.borrow().clone();
        to.serialize_str(&shown(sum))
    }
}

/// A check sum as it is written.
pub(super) fn shown(sum: crc32fast::Hasher) -> String {
    format!("crc32:{:08x}", sum.finalize())
}

/// Passes on what is written and sums it up.
struct Summing<'a, W> {
    sum: &'a RefCell<crc32fast::Hasher>,
    to: W,
}

impl<W: Write> Write for Summing<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.to.write(bytes)?;
        self.sum.borrow_mut().update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

impl ResultFile {
    fn document<C>(&self, checksum: C) -> Document<'_, Steps<'_>, C> {
        Document {
            format: FORMAT.into(),
            version: VERSION,
            program: self.program.as_str().into(),
            scene: Cow::Borrowed(&self.scene),
            plan: Cow::Borrowed(&self.plan),
            summary: Cow::Borrowed(&self.summary),
            sheet_states: self.sheet_states.as_ref().map(|states| Cow::Borrowed(states.seal())),
            catenaries: self.steps_of(Model::Catenaries).map(Catenaries::named),
            steps: Steps(&self.steps),
            also: self.also.as_ref().map(|also| AlsoDocument {
                summary: Unjudged(Cow::Borrowed(&also.summary)),
                steps: Steps(&also.steps),
            }),
            checksum,
        }
    }

    /// The whole file as text.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if any number is NaN or infinite.
    pub fn text(&self) -> Result<String, Error> {
        self.check_finite()?;
        let mut text = Vec::new();
        self.write_sound(&mut text).map_err(Error::json)?;
        Ok(String::from_utf8(text).unwrap_or_default())
    }

    /// Writes the whole file, whose numbers are all finite.
    fn write_sound(&self, to: impl Write) -> serde_json::Result<()> {
        let sum = RefCell::new(crc32fast::Hasher::new());
        let mut to = Summing { sum: &sum, to };
        serde_json::to_writer(&mut to, &self.document(Sum(&sum)))?;
        to.write_all(b"\n").map_err(serde_json::Error::io)
    }

    /// Refuses a result that holds a NaN or an infinity.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the key of the first.
    pub(crate) fn check_finite(&self) -> Result<(), Error> {
        finite::check(&self.document(""))
    }

    /// Refuses a result with a number beyond `most` in size.
    pub(super) fn check_within(&self, most: f64) -> Result<(), Error> {
        finite::within(&self.document(""), most)
    }
}

/// One line of JSON with a line feed; numbers in their shortest exact form.
impl Content for ResultFile {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        self.check_finite().map_err(io::Error::other)?;
        Ok(self.write_sound(to)?)
    }
}

/// The keys and values of the file, without its check sum.
impl Serialize for ResultFile {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.document("").serialize(to)
    }
}

#[cfg(test)]
mod tests {
    use crate::sample::lines;
    use crate::{Error, ResultFile, sample};

    fn refused_key(result: &ResultFile) -> Option<String> {
        match result.text() {
            Err(Error::NotFinite { key, .. }) => Some(key),
            _ => None,
        }
    }

    /// The key in the error is the path that a reader of the JSON would follow.
    #[test]
    fn a_number_that_is_not_finite_is_refused_by_its_key() {
        let mut result = sample::draped(4, 2, 3);
        lines(&mut result, 1)[1].spans[0].slopes[1] = f64::NAN;
        assert_eq!(refused_key(&result).as_deref(), Some("steps[1].spans.slopes[1][1]"));
        let mut result = sample::draped(4, 2, 3);
        lines(&mut result, 1)[0].spans[0].force = Some(f64::INFINITY);
        assert_eq!(refused_key(&result).as_deref(), Some("steps[1].spans.H_N[0]"));
        let mut result = sample::draped(4, 2, 3);
        result.scene.settings.axial_stiffness = f64::NAN;
        assert_eq!(refused_key(&result).as_deref(), Some("scene.settings.axial_stiffness"));
    }

    /// An inextensible ply has EA = ∞, which the file says as null.
    #[test]
    fn infinite_axial_stiffness_is_null() {
        let mut result = sample::draped(4, 2, 2);
        result.scene.settings.axial_stiffness = f64::INFINITY;
        let read: serde_json::Value = serde_json::from_str(&result.text().unwrap()).unwrap();
        assert!(read["scene"]["settings"]["axial_stiffness"].is_null());
        assert_eq!(read["format"], "plydrape-result");
    }

    /// Shortest exact form: what is read back is the number that was written, to the last bit.
    #[test]
    fn numbers_survive_to_the_last_bit() {
        let mut result = sample::draped(2, 1, 1);
        result.steps[0].time = 0.1 + 0.2;
        let read: serde_json::Value = serde_json::from_str(&result.text().unwrap()).unwrap();
        assert_eq!(read["steps"][0]["time"].as_f64(), Some(0.1 + 0.2));
    }
}
