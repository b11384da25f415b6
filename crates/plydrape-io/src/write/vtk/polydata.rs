//! VTK's XML PolyData: a short text that names the arrays, and behind it their bytes.
//!
//! The arrays are at the end in their own binary form, little endian, each behind its length in bytes as an
//! unsigned number of 64 bits, so that doubles come back to the last bit; version 1.0 of the format.

use plydrape::mold::patch::Triangles;
use std::fmt::Write;

/// Points and what joins them. All cells are of one kind.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PolyData {
    pub points: Vec<[f64; 3]>,
    pub kind: Kind,
    pub cells: Vec<Vec<usize>>,
    pub at_points: Vec<Array>,
    pub in_cells: Vec<Array>,
    /// What is of the whole and of no point or cell.
    pub fields: Vec<Array>,
}

/// What the cells are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Verts,
    Lines,
    Polys,
}

/// Numbers with a name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Array {
    name: &'static str,
    /// Numbers of one entry.
    width: usize,
    values: Values,
}

#[derive(Debug, Clone, PartialEq)]
enum Values {
    Doubles(Vec<f64>),
    Whole(Vec<i64>),
    Bytes(Vec<u8>),
    /// Each behind the other, each with a zero at its end.
    Texts(String),
}

impl Array {
    /// One number an entry.
    pub fn new(name: &'static str, values: Vec<f64>) -> Self {
        Array { name, width: 1, values: Values::Doubles(values) }
    }

    /// A vector an entry.
    pub fn vectors<const N: usize>(name: &'static str, values: &[[f64; N]]) -> Self {
        Array { name, width: N, values: Values::Doubles(values.as_flattened().to_vec()) }
    }

    /// Whole numbers.
    pub fn whole(name: &'static str, values: impl IntoIterator<Item = usize>) -> Self {
        // indices of what is in memory
        Array {
            name,
            width: 1,
            values: Values::Whole(values.into_iter().map(|k| k as i64).collect()),
        }
    }

    /// Codes and flags.
    pub fn codes(name: &'static str, values: Vec<u8>) -> Self {
        Array { name, width: 1, values: Values::Bytes(values) }
    }

    /// Texts.
    pub fn texts(name: &'static str, values: impl IntoIterator<Item = String>) -> Self {
        let joined = values.into_iter().map(|text| text + "\0").collect();
        Array { name, width: 1, values: Values::Texts(joined) }
    }

    fn kind(&self) -> &'static str {
        match self.values {
            Values::Doubles(_) => "Float64",
            Values::Whole(_) => "Int64",
            Values::Bytes(_) => "UInt8",
            Values::Texts(_) => "String",
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match &self.values {
            Values::Doubles(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Values::Whole(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Values::Bytes(values) => values.clone(),
            Values::Texts(text) => text.clone().into_bytes(),
        }
    }
}

impl PolyData {
    /// A surface of triangles.
    pub fn surface(surface: Triangles, at_points: Vec<Array>) -> Self {
        let cells = surface.triangles.iter().map(|t| t.map(|n| n as usize).to_vec()).collect();
        PolyData {
            points: surface.vertices,
            kind: Kind::Polys,
            cells,
            at_points,
            in_cells: Vec::new(),
            fields: Vec::new(),
        }
    }

    /// This data with its time (s), where VTK looks for it.
    pub fn with_time(mut self, time: f64) -> Self {
        self.fields.push(Array::new("TimeValue", vec![time]));
        self
    }

    /// The whole file.
    pub fn bytes(&self) -> Vec<u8> {
        // what is of the whole, and how many points and cells there are
        let mut file = File::default();
        file.text.push_str(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" \
             byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n",
        );
        file.fields(&self.fields);
        let (points, cells) = (self.points.len(), self.cells.len());
        let mut piece = format!("<Piece NumberOfPoints=\"{points}\"");
        for kind in [Kind::Verts, Kind::Lines, Kind::Polys] {
            let count = if kind == self.kind { cells } else { 0 };
            let _ = write!(piece, " NumberOf{kind:?}=\"{count}\"");
        }
        let _ = writeln!(file.text, "{piece} NumberOfStrips=\"0\">");

        // points, and cells one behind the other with the place where each ends
        file.section("Points", &[Array::vectors("Points", &self.points)]);
        let mut end = 0;
        let ends = self.cells.iter().map(|cell| {
            end += cell.len();
            end
        });
        let joined = [
            Array::whole("offsets", ends),
            Array::whole("connectivity", self.cells.iter().flatten().copied()),
        ];
        file.section(&format!("{:?}", self.kind), &joined);

        // values at points and in cells
        file.section("PointData", &self.at_points);
        file.section("CellData", &self.in_cells);

        // the bytes of all arrays, behind the text that names them
        file.text.push_str("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
        let mut bytes = file.text.into_bytes();
        bytes.extend(file.appended);
        bytes.extend(b"\n</AppendedData>\n</VTKFile>\n");
        bytes
    }
}

/// A file under way: its text, and the bytes behind it.
#[derive(Default)]
struct File {
    text: String,
    appended: Vec<u8>,
}

impl File {
    fn section(&mut self, name: &str, arrays: &[Array]) {
        let _ = writeln!(self.text, "<{name}>");
        for array in arrays {
            let components = match array.width {
                1 => String::new(),
                more => format!(" NumberOfComponents=\"{more}\""),
            };
            self.array(array, &components);
        }
        let _ = writeln!(self.text, "</{name}>");
    }

    fn fields(&mut self, arrays: &[Array]) {
        if arrays.is_empty() {
            return;
        }
        self.text.push_str("<FieldData>\n");
        for array in arrays {
            self.array(array, " NumberOfTuples=\"1\"");
        }
        self.text.push_str("</FieldData>\n");
    }

    fn array(&mut self, array: &Array, size: &str) {
        let (kind, name, offset) = (array.kind(), array.name, self.appended.len());
        let _ = writeln!(
            self.text,
            "<DataArray type=\"{kind}\" Name=\"{name}\"{size} format=\"appended\" offset=\"{offset}\"/>"
        );
        let bytes = array.bytes();
        self.appended.extend((bytes.len() as u64).to_le_bytes());
        self.appended.extend(bytes);
    }
}
