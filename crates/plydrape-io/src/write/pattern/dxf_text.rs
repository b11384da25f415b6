//! A DXF text of AutoCAD 2010 (AC1024) with layers, in millimeters.
//!
//! What every program expects is there: the tables, the two blocks of model space and paper space, the root dictionary, and a
//! handle and an owner for everything. Text is UTF-8; layers and entities keep their order.

use std::fmt::Write as _;

/// Handles that occur in several places (hexadecimal).
const MODEL: &str = "20";
const PAPER: &str = "21";
const ROOT: &str = "30";
/// The first handle that is free.
const FIRST: usize = 0x100;

/// A DXF text under way.
pub struct Text {
    layers: Vec<(&'static str, u8)>,
    entities: String,
    handles: usize,
    bounds: [[f64; 3]; 2],
}

impl Text {
    /// A text with layers, each with its color of the AutoCAD color index.
    pub fn new(layers: &[(&'static str, u8)]) -> Self {
        let bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        Text { layers: layers.to_vec(), entities: String::new(), handles: FIRST, bounds }
    }

    /// A flat polyline (m).
    pub fn polyline(&mut self, layer: &str, points: &[[f64; 2]], closed: bool) {
        self.entity("LWPOLYLINE", layer, "AcDbPolyline");
        self.pairs(&[(90, &points.len()), (70, &u8::from(closed)), (43, &0)]);
        for point in points {
            let [x, y, _] = self.shown([point[0], point[1], 0.0]);
            self.pairs(&[(10, &x), (20, &y)]);
        }
    }

    /// A polyline in space (m).
    pub fn polyline_3d(&mut self, layer: &str, points: &[[f64; 3]], closed: bool) {
        let line = self.entity("POLYLINE", layer, "AcDb3dPolyline");
        let flags = 8 + u8::from(closed);
        self.pairs(&[(66, &1), (10, &"0.0"), (20, &"0.0"), (30, &"0.0"), (70, &flags)]);
        for point in points {
            self.part("VERTEX", &line, layer);
            self.pairs(&[(100, &"AcDbVertex"), (100, &"AcDb3dPolylineVertex")]);
            let [x, y, z] = self.shown(*point);
            self.pairs(&[(10, &x), (20, &y), (30, &z), (70, &32)]);
        }
        self.part("SEQEND", &line, layer);
    }

    /// A circle (m).
    pub fn circle(&mut self, layer: &str, center: [f64; 2], radius: f64) {
        self.entity("CIRCLE", layer, "AcDbCircle");
        for side in [-radius, radius] {
            self.shown([center[0] + side, center[1] + side, 0.0]);
        }
        let [x, y, z] = self.shown([center[0], center[1], 0.0]);
        self.pairs(&[(10, &x), (20, &y), (30, &z), (40, &mm(radius))]);
    }

    /// A line of text, its middle at a place, of a height of its capital letters (m).
    pub fn text(&mut self, layer: &str, middle: [f64; 2], height: f64, text: &str) {
        self.entity("TEXT", layer, "AcDbText");
        let [x, y, z] = self.shown([middle[0], middle[1], 0.0]);
        self.pairs(&[(10, &x), (20, &y), (30, &z), (40, &mm(height)), (1, &without_codes(text))]);
        self.pairs(&[(72, &1), (11, &x), (21, &y), (31, &z), (100, &"AcDbText"), (73, &2)]);
    }

    /// All of it.
    pub fn finish(self) -> String {
        // the header has the bounds of the entities and the next free handle
        let mut all = Text { entities: String::new(), ..Text::new(&self.layers) };
        all.bounds = self.bounds;
        all.handles = self.handles;
        all.header();
        all.section("CLASSES");
        all.pair(0, &"ENDSEC");
        all.tables();

        // model space and paper space, which every drawing has
        all.section("BLOCKS");
        for (owner, name, begin, end) in
            [(MODEL, "*Model_Space", "22", "23"), (PAPER, "*Paper_Space", "24", "25")]
        {
            let entity = [(330, owner), (100, "AcDbEntity")];
            let paper: &[(i32, &str)] = if owner == PAPER { &[(67, "1")] } else { &[] };
            all.strings(&[(0, "BLOCK"), (5, begin)]);
            all.strings(&entity);
            all.strings(paper);
            all.strings(&[(8, "0"), (100, "AcDbBlockBegin"), (2, name), (70, "0")]);
            all.strings(&[(10, "0.0"), (20, "0.0"), (30, "0.0"), (3, name), (1, "")]);
            all.strings(&[(0, "ENDBLK"), (5, end)]);
            all.strings(&entity);
            all.strings(paper);
            all.strings(&[(8, "0"), (100, "AcDbBlockEnd")]);
        }
        all.pair(0, &"ENDSEC");

        // what was drawn
        all.section("ENTITIES");
        all.entities += &self.entities;
        all.pair(0, &"ENDSEC");

        // the root dictionary
        all.section("OBJECTS");
        all.strings(&[(0, "DICTIONARY"), (5, ROOT), (330, "0"), (100, "AcDbDictionary")]);
        all.strings(&[(281, "1"), (3, "ACAD_GROUP"), (350, "31")]);
        all.strings(&[(0, "DICTIONARY"), (5, "31"), (330, ROOT), (100, "AcDbDictionary")]);
        all.strings(&[(281, "1"), (0, "ENDSEC"), (0, "EOF")]);
        all.entities
    }

    fn header(&mut self) {
        self.section("HEADER");
        let [low, high] = self.bounds.map(|bound| bound.map(finite));
        self.strings(&[(9, "$ACADVER"), (1, "AC1024"), (9, "$DWGCODEPAGE"), (3, "ANSI_1252")]);
        // millimeters, metric
        self.strings(&[(9, "$INSUNITS"), (70, "4"), (9, "$MEASUREMENT"), (70, "1")]);
        for (name, [x, y, z]) in [("$EXTMIN", low), ("$EXTMAX", high)] {
            self.pairs(&[(9, &name), (10, &mm(x)), (20, &mm(y)), (30, &mm(z))]);
        }
        let seed = format!("{:X}", self.handles);
        self.pairs(&[(9, &"$HANDSEED"), (5, &seed), (0, &"ENDSEC")]);
    }

    fn tables(&mut self) {
        // programs expect all tables, also those without entries
        self.section("TABLES");
        self.table("VPORT", "1", 0);
        self.pair(0, &"ENDTAB");

        // line types
        self.table("LTYPE", "2", 3);
        for (name, handle, note) in
            [("ByBlock", "10", ""), ("ByLayer", "11", ""), ("Continuous", "12", "Solid line")]
        {
            self.record("LTYPE", handle, "2", "AcDbLinetypeTableRecord");
            self.strings(&[(2, name), (70, "0"), (3, note), (72, "65"), (73, "0"), (40, "0.0")]);
        }
        self.pair(0, &"ENDTAB");

        // layer 0, which every drawing has, and the layers of this one
        let layers = std::mem::take(&mut self.layers);
        self.table("LAYER", "3", layers.len() + 1);
        for (n, (name, color)) in [("0", 7)].iter().chain(&layers).enumerate() {
            self.record("LAYER", &format!("{:X}", 0x40 + n), "3", "AcDbLayerTableRecord");
            self.pairs(&[(2, name), (70, &0), (62, color), (6, &"Continuous"), (370, &-3)]);
        }
        self.pair(0, &"ENDTAB");

        // one style of text
        self.table("STYLE", "4", 1);
        self.record("STYLE", "13", "4", "AcDbTextStyleTableRecord");
        self.strings(&[(2, "Standard"), (70, "0"), (40, "0.0"), (41, "1.0"), (50, "0.0")]);
        self.strings(&[(71, "0"), (42, "2.5"), (3, "txt"), (4, "")]);
        self.pair(0, &"ENDTAB");

        // no views and no coordinate systems
        for (name, handle) in [("VIEW", "5"), ("UCS", "6")] {
            self.table(name, handle, 0);
            self.pair(0, &"ENDTAB");
        }

        // the application, and one style of dimensions
        self.table("APPID", "7", 1);
        self.record("APPID", "14", "7", "AcDbRegAppTableRecord");
        self.strings(&[(2, "ACAD"), (70, "0"), (0, "ENDTAB")]);
        self.table("DIMSTYLE", "8", 1);
        self.strings(&[(100, "AcDbDimStyleTable"), (71, "0")]);
        self.strings(&[(0, "DIMSTYLE"), (105, "15"), (330, "8"), (100, "AcDbSymbolTableRecord")]);
        self.strings(&[(100, "AcDbDimStyleTableRecord"), (2, "Standard"), (70, "0")]);
        self.pair(0, &"ENDTAB");

        // the blocks of model space and paper space
        self.table("BLOCK_RECORD", "9", 2);
        for (name, handle) in [("*Model_Space", MODEL), ("*Paper_Space", PAPER)] {
            self.record("BLOCK_RECORD", handle, "9", "AcDbBlockTableRecord");
            self.strings(&[(2, name), (340, "0"), (70, "4"), (280, "1"), (281, "0")]);
        }
        self.pair(0, &"ENDTAB");
        self.pair(0, &"ENDSEC");
    }

    fn section(&mut self, name: &str) {
        self.strings(&[(0, "SECTION"), (2, name)]);
    }

    fn table(&mut self, name: &str, handle: &str, records: usize) {
        self.strings(&[(0, "TABLE"), (2, name), (5, handle), (330, "0")]);
        self.pairs(&[(100, &"AcDbSymbolTable"), (70, &records)]);
    }

    fn record(&mut self, kind: &str, handle: &str, table: &str, class: &str) {
        self.strings(&[(0, kind), (5, handle), (330, table)]);
        self.strings(&[(100, "AcDbSymbolTableRecord"), (100, class)]);
    }

    /// The beginning of an entity in model space; its handle.
    fn entity(&mut self, kind: &str, layer: &str, class: &str) -> String {
        let handle = self.part(kind, MODEL, layer);
        self.pair(100, &class);
        handle
    }

    fn part(&mut self, kind: &str, owner: &str, layer: &str) -> String {
        let handle = format!("{:X}", self.handles);
        self.handles += 1;
        self.strings(&[(0, kind), (5, &handle), (330, owner), (100, "AcDbEntity"), (8, layer)]);
        handle
    }

    /// A place as it is written, which the drawing must show.
    fn shown(&mut self, point: [f64; 3]) -> [String; 3] {
        for n in 0..3 {
            self.bounds[0][n] = self.bounds[0][n].min(point[n]);
            self.bounds[1][n] = self.bounds[1][n].max(point[n]);
        }
        point.map(mm)
    }

    fn strings(&mut self, pairs: &[(i32, &str)]) {
        for (code, value) in pairs {
            self.pair(*code, value);
        }
    }

    fn pairs(&mut self, pairs: &[(i32, &dyn std::fmt::Display)]) {
        for (code, value) in pairs {
            self.pair(*code, *value);
        }
    }

    fn pair(&mut self, code: i32, value: &(impl std::fmt::Display + ?Sized)) {
        // into a String, which refuses nothing
        let _ = write!(self.entities, "{code}\n{value}\n");
    }
}

/// A length in millimeters, to a picometer, which leaves out the rounding of the unit.
fn mm(length: f64) -> String {
    let shown = format!("{:?}", round(length * 1e3));
    // DXF knows no sign of zero
    if shown == "-0.0" { "0.0".into() } else { shown }
}

/// To nine digits behind the point.
fn round(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    if rounded.is_finite() { rounded } else { value }
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// A text without control characters; a caret begins a code in DXF.
fn without_codes(text: &str) -> String {
    super::one_line(text).replace('^', "^ ")
}
