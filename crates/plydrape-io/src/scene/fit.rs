//! Tables of tests of a material: the CSV files of `plydrape fit`.
//!
//! Lines `# key = value` above a table may state a measure of its specimen, as in `# width = 100 mm`, and so may the lines that a machine
//! writes there, as in `Width: 100 mm`.

use super::read;
use super::source::Document;
use super::table::{Column, Plain, Table as Csv, Title, title};
use super::units::{self, Dimension};
use crate::Error;
use crate::store::file_kind::edits;
use std::ops::Range;
use std::path::Path;

/// What a table is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Displacement and force of a machine: `displacement`, `force`.
    Pull,
    /// Displacement and force of a machine in time: `displacement`, `force`, `time`.
    Timed,
    /// Overhangs, one specimen a row: `overhang`.
    Overhang,
    /// Points of a hanging strip: `x`, `z`.
    Points,
    /// A bending test: `curvature`, `moment`.
    Moment,
}

/// A table that was read.
#[derive(Debug, Clone)]
pub struct Table {
    /// Rows (SI); the second number is 0 where there is one column.
    pub rows: Vec<[f64; 2]>,
    /// Times of the rows (s), of a table that is read with them.
    pub times: Vec<f64>,
    document: Document,
    /// The numbers of each row.
    places: Vec<[Range<usize>; 2]>,
    header: Range<usize>,
    stated: Vec<Stated>,
}

/// A measure that a table states of its specimen.
#[derive(Debug, Clone)]
struct Stated {
    key: &'static str,
    /// The value (SI).
    value: f64,
    place: Range<usize>,
}

/// Difference of two values of one measure, as a share, that is rounding.
const SAME: f64 = 1e-9;

impl Table {
    /// A measure of the specimen (SI): what the file states, else what an option gives.
    ///
    /// # Errors
    /// If file and option say different values, or neither says one.
    pub fn measure(&self, key: &'static str, given: Option<f64>) -> Result<f64, Error> {
        self.stated(key, given)?.ok_or_else(|| {
            let value = example(key);
            self.document.error(
                self.header.clone(),
                format!("the {key} of the specimens is given nowhere"),
                format!("give --{key} \"{value}\", or a line `# {key} = {value}` at the top of this file"),
            )
        })
    }

    /// A measure of the specimen (SI), where the file or an option says it.
    ///
    /// # Errors
    /// If file and option say different values.
    pub fn stated(&self, key: &'static str, given: Option<f64>) -> Result<Option<f64>, Error> {
        let Some(stated) = self.stated.iter().find(|stated| stated.key == key) else {
            return Ok(given);
        };
        match given {
            Some(given) if differ(given, stated.value) => Err(self.document.error(
                stated.place.clone(),
                format!("the file states another {key} than --{key}"),
                format!("leave out --{key}, or correct this line"),
            )),
            _ => Ok(Some(stated.value)),
        }
    }

    /// An error at a number of a row: in the first or in the last column of the test (0 or 1), which is that of the time where it has one.
    #[must_use]
    pub fn error(
        &self,
        [row, column]: [usize; 2],
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        let place = self.places.get(row).and_then(|places| places.get(column));
        let place = place.unwrap_or(&self.header).clone();
        self.document.error(place, message, help)
    }

    /// An error of the table as a whole, at its header.
    #[must_use]
    pub fn error_anywhere(&self, message: impl Into<String>, help: impl Into<String>) -> Error {
        self.document.error(self.header.clone(), message, help)
    }

    /// The line of a row in its file, counted from 1.
    #[must_use]
    pub fn line(&self, row: usize) -> usize {
        let start = self.places.get(row).map_or(0, |places| places[0].start);
        self.document.text[..start].matches('\n').count() + 1
    }
}

fn differ(a: f64, b: f64) -> bool {
    (a - b).abs() > SAME * a.abs().max(b.abs())
}

/// Measures that a file may state.
const STATED: [(&str, Dimension); 5] = [
    ("width", Dimension::LENGTH),
    ("length", Dimension::LENGTH),
    ("side", Dimension::LENGTH),
    ("fabric", Dimension::LENGTH),
    ("mass", Dimension::AREAL_MASS),
];

/// Titles of columns that tell specimens or cycles apart.
const SPECIMENS: [&str; 9] = [
    "specimen",
    "sample",
    "cycle",
    "strip",
    "probe",
    "probekorper",
    "zyklus",
    "eprouvette",
    "test",
];
/// Titles of columns that tell warp and weft apart.
const DIRECTIONS: [&str; 4] = ["direction", "richtung", "orientation", "yarn"];

const DISPLACEMENT: Column = Column {
    names: &["displacement", "crosshead", "stroke"],
    last_words: &[
        "displacement",
        "extension",
        "elongation",
        "travel",
        "stroke",
        "deplacement",
        "allongement",
        "spostamento",
        "desplazamiento",
    ],
    endings: &["weg", "verschiebung"],
    dimension: Dimension::LENGTH,
    unit: "mm",
    option: Some("--displacement"),
    plain: Some(&Plain {
        believed: [5e-4, 0.5],
        words: "displacements of shear tests are 0.5 mm to 500 mm",
    }),
};
const FORCE: Column = Column {
    names: &["force", "load"],
    last_words: &["force", "load", "charge", "forza", "fuerza", "carga"],
    endings: &["kraft"],
    dimension: Dimension::FORCE,
    unit: "N",
    option: Some("--force"),
    plain: Some(&Plain {
        believed: [0.05, 5e3],
        words: "forces of shear tests reach 0.05 N to 5000 N",
    }),
};
const TIME: Column = Column {
    last_words: &["time", "temps", "tempo", "tiempo"],
    endings: &["zeit"],
    ..Column::named(&["time", "t"], Dimension::TIME)
};
const OVERHANG: Column = Column {
    names: &["overhang", "overhang length", "overhanging length"],
    last_words: &["overhang"],
    endings: &["uberhang", "uberhanglange"],
    dimension: Dimension::LENGTH,
    unit: "mm",
    option: Some("--overhang"),
    plain: Some(&Plain { believed: [0.01, 0.6], words: "overhangs are 10 mm to 600 mm" }),
};
const PLACES: Plain = Plain { believed: [0.0, 2.0], words: "strips hang over up to 2 m" };
const CURVATURE: Column = Column {
    names: &["curvature", "k"],
    last_words: &["curvature", "courbure"],
    endings: &["krummung"],
    dimension: Dimension::CURVATURE,
    unit: "1/cm",
    option: Some("--curvature"),
    plain: Some(&Plain {
        believed: [5.0, 1e3],
        words: "bending tests reach 5 1/m to 1000 1/m, a radius of 200 mm to 1 mm",
    }),
};
const MOMENT: Column = Column {
    names: &["moment", "m", "moment per width"],
    last_words: &["moment"],
    endings: &["biegemoment"],
    dimension: Dimension::FORCE,
    unit: "gf cm/cm",
    option: Some("--moment"),
    plain: Some(&Plain {
        believed: [1e-4, 10.0],
        words: "moments per width reach 0.0001 N to 10 N",
    }),
};

impl Reading {
    fn columns(self) -> &'static [Column] {
        const X: Column = Column {
            option: Some("--x"),
            plain: Some(&PLACES),
            ..Column::named(&["x"], Dimension::LENGTH)
        };
        const Z: Column = Column {
            option: Some("--z"),
            plain: Some(&PLACES),
            ..Column::named(&["z"], Dimension::LENGTH)
        };
        match self {
            Reading::Pull => &[DISPLACEMENT, FORCE],
            Reading::Timed => &[DISPLACEMENT, FORCE, TIME],
            Reading::Overhang => &[OVERHANG],
            Reading::Points => &[X, Z],
            Reading::Moment => &[CURVATURE, MOMENT],
        }
    }
}

/// Reads a table; `chosen` are the titles of its columns where they have other names than usual.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn read_fit(path: &Path, reading: Reading, chosen: &[Option<&str>]) -> Result<Table, Error> {
    let document = read::table(path, &path.to_string_lossy())?;
    table(document, reading, chosen)
}

fn table(document: Document, reading: Reading, chosen: &[Option<&str>]) -> Result<Table, Error> {
    // each row is a point of the test; of an overhang it has one number
    let csv = Csv::new(&document, reading.columns(), chosen)?;
    let mut stated = stated(&document, &csv.header())?;
    let (mut rows, mut times, mut places) = (Vec::new(), Vec::new(), Vec::new());
    for row in csv.rows() {
        let first = row.number(0)?;
        if reading == Reading::Overhang && first <= 0.0 {
            return Err(row.fault(
                0,
                "an overhang is not above zero",
                "give the length of the strip beyond the edge, as in 62 in a column `overhang (mm)`",
            ));
        }
        rows.push([first, if reading == Reading::Overhang { 0.0 } else { row.number(1)? }]);
        if reading == Reading::Timed {
            times.push(row.number(2)?);
        }
        places.push([row.place(0), row.place(reading.columns().len() - 1)]);
    }

    // there are points, plain numbers are plausible, and specimens or directions that the test keeps apart are not mixed
    let header = csv.header();
    if rows.is_empty() {
        return Err(document.error(
            header,
            format!("`{}` has no rows below its header", document.file),
            "give one row a point",
        ));
    }
    csv.check_plain()?;
    if reading != Reading::Overhang {
        of_one_value(&csv, &SPECIMENS, "give each specimen, and each cycle, a file of its own")?;
    }
    if matches!(reading, Reading::Overhang | Reading::Points) {
        of_one_value(&csv, &DIRECTIONS, "give strips along warp and weft files of their own")?;
    }

    // measures of the specimen may be in columns of their own
    in_columns(&document, &csv, reading, &mut stated)?;
    Ok(Table { rows, times, places, header, stated, document })
}

/// Refuses a table with a column of one of these names that has several values.
fn of_one_value(csv: &Csv, names: &[&str], help: &str) -> Result<(), Error> {
    let titles = csv.titles();
    let named = |title: &Title| names.contains(&title.name.as_str());
    let Some(index) = titles.iter().position(named) else { return Ok(()) };
    let name = &titles[index].name;
    let mut first = None;
    for row in csv.rows() {
        let value = row.field(index).to_owned();
        if *first.get_or_insert_with(|| value.clone()) != value {
            return Err(row.fault(
                0,
                format!("the column `{name}` has more than one value, and another one begins here"),
                help,
            ));
        }
    }
    Ok(())
}

/// Measures of the specimen in columns of their own, which have one value.
fn in_columns(
    document: &Document,
    csv: &Csv,
    reading: Reading,
    stated: &mut Vec<Stated>,
) -> Result<(), Error> {
    let pulls = matches!(reading, Reading::Pull | Reading::Timed);
    for (index, Title { name, unit, place }) in csv.titles().into_iter().enumerate() {
        // of a strip the length may be that along its points
        let known = STATED.iter().find(|(key, _)| *key == name && (*key != "length" || pulls));
        let Some((key, dimension)) = known else { continue };
        let size = unit.as_deref().and_then(|unit| units::unit(unit).ok());
        let mut values = csv.rows().map(|row| row.value(index));
        let first = values.next().flatten();
        let value = match (first, size) {
            (Some(first), Some((size, of)))
                if of == *dimension && values.all(|value| value == Some(first)) =>
            {
                first * size
            }
            _ => {
                return Err(document.error(
                    place,
                    format!("the column `{key}` is no measure of one specimen: it has several values, or no unit"),
                    format!("remove the column, and write a line `# {key} = {}` at the top of the file of each specimen", example(key)),
                ));
            }
        };
        match stated.iter().find(|stated| stated.key == *key) {
            Some(before) if differ(before.value, value) => {
                return Err(document.error(
                    place,
                    format!("the file states another `{key}` before"),
                    "remove the column, or correct the line above",
                ));
            }
            Some(_) => {}
            None => stated.push(Stated { key, value, place }),
        }
    }
    Ok(())
}

/// What a file states of its specimen, in comments and in the lines above its header.
fn stated(document: &Document, header: &Range<usize>) -> Result<Vec<Stated>, Error> {
    let mut found: Vec<Stated> = Vec::new();
    let mut start = 0;
    for line in document.text.split_inclusive('\n') {
        let from = start;
        start += line.len();
        // as a spreadsheet saves a comment again
        let said = line.trim().trim_end_matches([';', ',', '\t', '"', ' ']).trim_start_matches('"');
        let place = from..from + line.trim_end().len();
        let next = match said.strip_prefix('#') {
            Some(comment) => in_comment(document, comment, &place)?,
            None if from < header.start => in_text(said),
            None => None,
        };
        let Some((key, value)) = next else { continue };
        if let Some(before) = found.iter().find(|stated| stated.key == key) {
            if differ(before.value, value) {
                return Err(document.error(
                    place,
                    format!("the file states another `{key}` before"),
                    "give each specimen a file of its own, with its own measures",
                ));
            }
            continue;
        }
        found.push(Stated { key, value, place });
    }
    Ok(found)
}

/// A measure in a comment `# key = value`.
fn in_comment(
    document: &Document,
    comment: &str,
    place: &Range<usize>,
) -> Result<Option<(&'static str, f64)>, Error> {
    let Some((key, value)) = comment.split_once(['=', ':']) else { return Ok(None) };
    let written = title::words(key);
    let Some((key, dimension)) = STATED.iter().find(|(known, _)| *known == written) else {
        // a site is no side unless it has a length
        let found = units::quantity(value.trim()).ok().and_then(|(_, found)| found);
        let near =
            STATED.iter().find(|(known, unit)| edits(known, &written) == 1 && found == Some(*unit));
        return match near {
            Some((known, _)) => Err(document.error(
                place.clone(),
                format!("`{written}` is no measure known here"),
                format!("did you mean `{known}`?"),
            )),
            None => Ok(None),
        };
    };
    let help = format!("expected {dimension}, as in `# {key} = {}`", example(key));
    let fault = |message: String| Err(document.error(place.clone(), message, help.clone()));
    match units::quantity(value.trim().trim_matches('"')) {
        Ok((value, Some(unit))) if unit == *dimension && value.is_finite() => {
            Ok(Some((*key, value)))
        }
        Ok((_, Some(unit))) => fault(format!("`{key}` is {unit} here")),
        Ok((_, None)) => fault(format!("`{key}` has no unit here")),
        Err(wrong) => fault(format!("`{key}` cannot be read: {}", wrong.message)),
    }
}

/// A measure in a line that a machine writes above its table, as in `Width: 100 mm` and `"Width";"100,0";"mm"`.
fn in_text(line: &str) -> Option<(&'static str, f64)> {
    let (name, value) = line.split_once([':', '=', ';', '\t', ','])?;
    let (name, unit) = title::title(name.trim_matches('"'));
    let (key, dimension) = STATED.iter().find(|(known, _)| *known == name)?;
    let words: Vec<&str> =
        value.split([';', '\t', '"', ' ']).filter(|word| !word.is_empty()).collect();
    let value = [words.join(" ").as_str(), unit.unwrap_or_default()].join(" ").replace(',', ".");
    match units::quantity(&value) {
        Ok((value, Some(unit))) if unit == *dimension && value.is_finite() => Some((*key, value)),
        _ => None,
    }
}

fn example(key: &str) -> &'static str {
    if key == "mass" { "314 g/m^2" } else { "100 mm" }
}

#[cfg(test)]
mod tests;
