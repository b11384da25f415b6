use super::*;
use proptest::prelude::*;

const PULL: [Column; 2] = [
    Column {
        last_words: &["displacement", "extension", "travel"],
        endings: &["weg"],
        option: Some("--displacement"),
        ..Column::named(&["displacement"], Dimension::LENGTH)
    },
    Column {
        last_words: &["force", "load"],
        endings: &["kraft"],
        unit: "N",
        option: Some("--force"),
        ..Column::named(&["force"], Dimension::FORCE)
    },
];
const COLUMNS: [Column; 2] =
    [Column::named(&["t"], Dimension::TIME), Column::named(&["x"], Dimension::LENGTH)];

fn chosen(text: &str, titles: &[Option<&str>]) -> Result<Vec<Vec<f64>>, Error> {
    let document = Document::new("test.csv", text);
    let table = Table::new(&document, &PULL, titles)?;
    table.rows().map(|row| Ok(vec![row.number(0)?, row.number(1)?])).collect()
}

fn read_numbers(text: &str) -> Result<Vec<Vec<f64>>, Error> {
    chosen(text, &[])
}

fn assert_two_points(text: &str, found: Result<Vec<Vec<f64>>, Error>) {
    let rows = found.unwrap_or_else(|error| panic!("{text}: {error}"));
    let expected = [[0.004, 0.088], [0.008, 0.191]];
    assert_eq!(rows.len(), 2, "{text}");
    for (row, expected) in rows.iter().zip(expected) {
        for (value, expected) in row.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-15, "{text}: {rows:?}");
        }
    }
}

/// Two points, written by hand, by spreadsheets of two countries, and by testing machines.
#[test]
fn a_table_reads_the_same_whoever_wrote_it() {
    for text in [
        "displacement (mm),force (N)\n4,0.088\n8,0.191\n",
        "displacement (mm);force (N)\r\n4,0;0,088\r\n8,0;0,191\r\n",
        "Displacement [mm]\tForce [mN]\n4.0\t88\n8.0\t191\n",
        "sep=;\nWeg;Kraft\nmm;N\n4,0;0,088\n8,0;0,191\n;;\n",
        "Operator: J. Smith, 3 pm\nTime,Displacement,Force\n(s),(mm),(N)\n0,4,0.088\n1,8,0.191\n",
        "\"Time\",\"Weg\",\"Kraft\"\n\"s\",\"mm\",\"N\"\n\"0\",\"4,0\",\"0,088\"\n\"1\",\"8,0\",\"0,191\"\n",
        "displacement / mm,force / N,\n4,0.088,\n8,0.191,\n",
        "force_N;displacement_mm;note\n0.088;4;\n0.191;8;slip\n",
        "Kraft in N;Weg in mm\n0,088;4\n0,191;8\n",
        "Time,Tensile extension,Load\n(s),(mm),(N)\n0,4,0.088\n1,8,0.191\n",
        "Axial Displacement(mm)\tAxial Force(N)\n4\t0.088\n8\t0.191\n",
        "\"Standard travel\";\"Standard force\"\n\"mm\";\"N\"\n4;0,088\n8;0,191\n",
        "Displacement_(mm),Force_(kN)\n4,0.000088\n8,0.000191\n",
        "Crosshead travel, mm;Prüfkraft, N\n4;0,088\n8;0,191\n",
        "\"Extension 1\",\"AxialForce\"\n\"mm\",\"N\"\n4,0.088\n8,0.191\n",
        "Extension (mm),Extension (%),Load (N)\n4,1,0.088\n8,2,0.191\n",
    ] {
        assert_two_points(text, read_numbers(text));
    }
}

/// A title that is no usual name, alone or with its unit.
#[test]
fn an_option_names_a_column() {
    for (text, titles) in [
        ("Kanal A (mm),Kanal B (N)\n4,0.088\n8,0.191\n", [Some("Kanal A"), Some("kanal b")]),
        ("Kanal A,Kanal B\n4,88\n8,191\n", [Some("Kanal A (mm)"), Some("Kanal B [mN]")]),
        ("Weg (mm),Travel (m),Kraft (N)\n4,7,0.088\n8,7,0.191\n", [Some("Weg (mm)"), None]),
    ] {
        assert_two_points(text, chosen(text, &titles));
    }
    let error = chosen("a (mm),force (N)\n4,1\n", &[Some("b"), None]).unwrap_err();
    assert_eq!(error.message(), "no column is called `b`");
    assert!(error.help().ends_with("`a (mm)`, `force (N)`"), "{}", error.help());
}

/// What could be read in two ways, or not at all, has its place and a remedy.
#[test]
fn what_may_be_another_table_is_refused() {
    for (text, message) in [
        ("displacement (mm),force (N)\n4,0,0,088\n", "this row has 4 fields and the header 2"),
        ("displacement (mm),force (N)\n4,\"1,088.5\"\n", "`1,088.5` has a separator of thousands"),
        (
            "displacement (mm);force (N)\n4,5;1.088\n",
            "`1.088` has a decimal point where other numbers have a comma",
        ),
        ("Weg;Kraft\nmm;mm\n4;1\n", "`mm` is the unit of a length"),
        (
            "Weg (furlong);Kraft (N)\n4;1\n",
            "the unit in `Weg (furlong)` cannot be read: `furlong` is no unit known here",
        ),
        ("a;b\nWeg;b\n4;1\n", "the column `force` is missing"),
        ("Weg (mm);Kraft (N)\n4;\n", "this row has no value for the column `force`"),
        ("Weg (mm);Kraft (N);Weg (mm);Kraft (N)\n4;1;5;2\n", "two columns are called `Weg (mm)`"),
        (
            "Crosshead travel (mm);Extension (mm);Kraft (N)\n4;5;1\n",
            "the columns `Crosshead travel (mm)` and `Extension (mm)` may both be the column `displacement`",
        ),
        (
            "Time;Load\n1;2\n2;3\n3;4\nWeg (mm);Kraft (N)\n4;1\n",
            "there are numbers above the header, and it is not known what they are",
        ),
    ] {
        let error = read_numbers(text).unwrap_err();
        assert_eq!(error.message(), message, "{text}");
        assert!(error.diagnostic().unwrap().span.is_some() && !error.help().is_empty(), "{text}");
    }
    let error = read_numbers("a;b\nWeg;b\n4;1\n").unwrap_err();
    assert_eq!(error.diagnostic().unwrap().line_column(), Some((2, 1)));
    assert!(error.help().contains("--force \"title of the column\""), "{}", error.help());
}

/// One rule for every separator, and the remedy is read.
#[test]
fn a_number_that_may_be_another_one_is_refused() {
    for (text, number, remedies) in [
        ("Weg (mm),Kraft (N)\n4,\"1,088\"\n", "1,088", ["1088", "\"1,0880\""]),
        ("Weg (mm)\tKraft (mN)\n5\t998\n9\t1,012\n", "1,012", ["1012", "1,0120"]),
        ("Weg (mm)\tKraft (mN)\n5\t998\n9\t1.012\n", "1.012", ["1012", "1.0120"]),
        ("Weg (mm);Kraft (mN)\n5;998\n9;1.012\n", "1.012", ["1012", "1.0120"]),
        ("Weg (mm);Kraft (mN)\n5;998\n9;1,012\n", "1,012", ["1012", "1,0120"]),
        ("Weg (mm),Kraft (mN)\n5,998\n9,1.012\n", "1.012", ["1012", "1.0120"]),
        ("Weg (um);Kraft (N)\n61.500;1\n", "61.500", ["61500", "61.5000"]),
    ] {
        let error = read_numbers(text).unwrap_err();
        let mark = if number.contains(',') { "comma" } else { "point" };
        let message = format!("`{number}` may have a decimal {mark} or a separator of thousands");
        assert_eq!(error.message(), message, "{text}");
        for remedy in remedies {
            assert!(error.help().contains(remedy.trim_matches('"')), "{}", error.help());
            let written = text.replace(&format!("\"{number}\""), number);
            let mended = written.replace(number, remedy);
            assert!(read_numbers(&mended).is_ok(), "{mended}: {:?}", read_numbers(&mended));
        }
    }
    for text in [
        "Weg (mm);Kraft (N)\n-200;9,708\n-150;11,500\n",
        "Weg (mm)\tKraft (N)\n-200\t9.708\n-150\t11.500\n",
        "Weg (mm),Kraft (N)\n4,1.088\n8,2.191\n",
        "Weg (mm);Kraft (N)\n4;1.088\n8.5;2\n",
    ] {
        assert!(read_numbers(text).is_ok(), "{text}: {:?}", read_numbers(text));
    }
}

#[test]
fn columns_are_found_by_name_and_scaled_by_their_unit() {
    for text in [
        "# note\nx (mm), q, \"t (ms)\"\r\n98, 0, 500\r\n\n",
        "X [mm];q;T (ms)\n98,0;0;500,0\n",
        "x/mm\tq\tt/ms\n98\t0\t500\n",
        "x,q,t\nmm,,ms\n98,0,500\n",
    ] {
        let document = Document::new("a.csv", text);
        let table = Table::new(&document, &COLUMNS, &[]).unwrap();
        let rows: Vec<_> = table.rows().collect();
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].number(0).unwrap(), 0.5);
        assert!((rows[0].number(1).unwrap() - 0.098).abs() < 1e-15);
    }
}

#[test]
fn a_fault_points_at_its_field() {
    let document = Document::new("a.csv", "t,x (mm)\n0, 12mm\n");
    let table = Table::new(&document, &COLUMNS, &[]).unwrap();
    let row = table.rows().next().unwrap();
    let error = row.number(1).unwrap_err();
    assert_eq!(error.diagnostic().unwrap().line_column(), Some((2, 4)));
    assert_eq!(&document.text[error.diagnostic().unwrap().span.clone().unwrap()], "12mm");
}

proptest! {
    /// No text makes the reader panic, be it random or nearly a table.
    #[test]
    fn any_text_is_read_or_refused(
        text in "\\PC*",
        near in "weg[;,\t]kraft\\n([0-9.,;\"e #°\\-]{0,9}\\r?\\n?){0,4}",
        timed in "t ?\\(?[ms]{0,2}\\)?,x\\n([0-9.,e\" #°\\-]{0,9}\\r?\\n?){0,4}",
    ) {
        let _ = read_numbers(&text);
        let _ = read_numbers(&near);
        let document = Document::new("a.csv", &timed);
        if let Ok(table) = Table::new(&document, &COLUMNS, &[]) {
            for row in table.rows() {
                prop_assert!(row.number(0).is_ok_and(f64::is_finite) || row.number(0).is_err());
                prop_assert!(row.whole(1).is_ok() || row.whole(1).is_err());
            }
        }
    }
}
