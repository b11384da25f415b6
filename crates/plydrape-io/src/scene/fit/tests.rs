use super::*;

fn read_table(text: &str, reading: Reading) -> Result<Table, Error> {
    table(Document::new("test.csv", text), reading, &[])
}

#[test]
fn columns_have_units_and_comments_state_measures() {
    let text = "# width = 100 mm\n# by hand\ndisplacement (mm),force (N)\n0,0\n2,0.5\n";
    let table = read_table(text, Reading::Pull).unwrap();
    assert_eq!(table.rows, [[0.0, 0.0], [0.002, 0.5]]);
    assert_eq!(table.measure("width", None).unwrap(), 0.1);
    assert_eq!(table.stated("length", None).unwrap(), None);
    let text = "curvature (1/mm),moment (N mm/mm)\n0.02,0.1\n";
    assert_eq!(read_table(text, Reading::Moment).unwrap().rows, [[20.0, 0.1]]);
    for header in [
        "K (1/cm),M (gf cm/cm)",
        "K 1/cm,M gf cm/cm",
        "Curvature / 1/cm;Bending moment / gf cm/cm",
        "K,M\n1/cm,gf.cm/cm",
        "Krümmung [cm^-1]\tBiegemoment [gf·cm/cm]",
    ] {
        let separator = header.chars().find(|c| ",;\t".contains(*c)).unwrap_or(',');
        let text = format!("{header}\n0.5{separator}0.1\n");
        let [curvature, moment] = read_table(&text, Reading::Moment).unwrap().rows[0];
        assert!((curvature - 50.0).abs() < 1e-12 && (moment - 9.80665e-4).abs() < 1e-15);
    }
}

/// A comment as people write it, as a spreadsheet saves it again, and a line of a machine.
#[test]
fn a_file_states_its_measures_in_comments_and_lines_of_machines() {
    for line in [
        "# Width: 50 mm",
        "\"# width = 50 mm\";;",
        "#width=0.05 m\n# site: Hamburg\n# mask = 3",
        "Width: 50 mm",
        "\"Width\";\"50,0\";\"mm\"",
        "Width (mm);50",
        "Width (mm);Weg (mm);Kraft (N)\n50;2;1",
    ] {
        let text = match line.contains("Weg") {
            true => line.to_owned(),
            false => format!("{line}\nWeg (mm);Kraft (N)\n2;1\n"),
        };
        let table = read_table(&text, Reading::Pull).unwrap();
        assert_eq!(table.measure("width", None).unwrap(), 0.05, "{line}");
        let other = table.measure("width", Some(0.1)).unwrap_err();
        assert_eq!(other.message(), "the file states another width than --width");
        assert_eq!(other.diagnostic().unwrap().line_column(), Some((1, 1)));
    }
}

#[test]
fn faults_have_a_place_and_a_remedy() {
    for (text, reading, message) in [
        ("displacement (mm),force (mm)\n", Reading::Pull, "`mm` is the unit of a length"),
        ("displacement (mm)\n1\n", Reading::Pull, "the column `force` is missing"),
        ("x,z\n", Reading::Points, "`test.csv` has no rows below its header"),
        ("x,z\n0.1,oops\n", Reading::Points, "`oops` is no finite number"),
        ("overhang (mm)\n62\n-3\n", Reading::Overhang, "an overhang is not above zero"),
        ("# width = 100 N\nx,z\n0,0\n", Reading::Points, "`width` is a force here"),
        ("# width = 100\nx,z\n0,0\n", Reading::Points, "`width` has no unit here"),
        ("# widht = 1 m\nx,z\n0,0\n", Reading::Points, "`widht` is no measure known here"),
        (
            "# width = 50 mm\nx,z\n0,0\n# width = 60 mm\n1,0\n",
            Reading::Points,
            "the file states another `width` before",
        ),
        (
            "Specimen,Weg (mm),Kraft (N)\n1,2,1\n1,3,2\n2,2,1\n",
            Reading::Pull,
            "the column `specimen` has more than one value, and another one begins here",
        ),
        (
            "overhang (mm),mass (g/m^2)\n62,300\n63,400\n",
            Reading::Overhang,
            "the column `mass` is no measure of one specimen: it has several values, or no unit",
        ),
        (
            "Direction,Overhang (mm)\nwarp,62\nweft,57\n",
            Reading::Overhang,
            "the column `direction` has more than one value, and another one begins here",
        ),
    ] {
        let error = read_table(text, reading).unwrap_err();
        assert_eq!(error.message(), message);
        assert!(error.diagnostic().unwrap().span.is_some() && !error.help().is_empty());
    }
}

/// KES-FB2 writes K in 1/cm and M in gf cm/cm: as SI numbers they would be two thousand times too stiff.
#[test]
fn plain_numbers_that_are_not_usual_are_asked_about() {
    for (text, reading, message) in [
        (
            "displacement;force\n4;1\n",
            Reading::Pull,
            "the column `displacement` has no unit, and `4` would be 4 m",
        ),
        (
            "displacement (mm);force\n4;6466\n",
            Reading::Pull,
            "the column `force` has no unit, and `6466` would be 6466 N",
        ),
        (
            "displacement (mm);force\n4;0.00696\n",
            Reading::Pull,
            "the column `force` has no unit, and `0.00696` would be 0.00696 N",
        ),
        (
            "K,M\n0.1,0.002\n2.5,0.05\n",
            Reading::Moment,
            "the column `curvature` has no unit, and `2.5` would be 2.5 1/m",
        ),
        (
            "K (1/cm),M\n0.1,20\n2.5,500\n",
            Reading::Moment,
            "the column `moment` has no unit, and `500` would be 500 N",
        ),
        (
            "overhang\n62\n",
            Reading::Overhang,
            "the column `overhang` has no unit, and `62` would be 62 m",
        ),
    ] {
        let error = read_table(text, reading).unwrap_err();
        assert_eq!(error.message(), message);
        assert!(error.help().starts_with("name the unit in the header"), "{}", error.help());
    }
    assert!(read_table("overhang\n0.062\n", Reading::Overhang).is_ok());
}

/// A title that ends in a name is one field, whatever precedes it.
#[test]
fn a_column_beside_others_is_read_alone() {
    for text in [
        "strip,overhang (mm)\n1,62\n2,63\n",
        "strip;side, face;overhang (mm)\n1;a;62,0\n2;b;63,0\n",
        "strip\tStrip overhang, mm\n1\t62.0\n2\t63.0\n",
        "overhang (mm)\n62,0\n63,0\n",
    ] {
        let rows = read_table(text, Reading::Overhang).unwrap().rows;
        assert_eq!(rows, [[0.062, 0.0], [0.063, 0.0]], "{text}");
    }
}
