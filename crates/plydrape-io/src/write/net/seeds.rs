//! What each seed and each heading costs: the table `seeds.csv`.

use crate::Error;
use crate::write::csv::{number, text};
use ::csv::Writer;
use plydrape::net::{Choice, Seeds};

/// One row a choice, in the order in which they were tried: fabric coordinates of the seed (m), the heading of u that was asked
/// of the middle and that of u at the seed (°), the largest shear with the net that all choices are compared with and with the
/// net of the scene (°), nodes of the ply without a place, how far the middle is from its place (m) and turned there (°), and
/// whether it was taken. What is not known is empty.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn table(seeds: &Seeds) -> Result<String, Error> {
    // titles with their units
    let mut table = Writer::from_writer(Vec::new());
    table.write_record([
        "u (m)",
        "v (m)",
        "heading (deg)",
        "seed heading (deg)",
        "max shear (deg)",
        "max shear, scene's net (deg)",
        "missing nodes",
        "off (m)",
        "turn (deg)",
        "taken",
    ])?;

    // a row for each choice; two values are not known where the held point has no place on the mold
    for (n, choice) in seeds.choices.iter().enumerate() {
        let Choice { at, heading, held_heading, missing, off, .. } = choice;
        let degrees = |angle: f64| number(angle.to_degrees());
        let known = off.is_some();
        table.write_record([
            number(at.fabric[0]),
            number(at.fabric[1]),
            degrees(*held_heading),
            if known { degrees(*heading) } else { String::new() },
            choice.largest_shear.map(degrees).unwrap_or_default(),
            choice.largest_shear_fine.map(degrees).unwrap_or_default(),
            if known { missing.to_string() } else { String::new() },
            off.map(|(off, _)| number(off)).unwrap_or_default(),
            off.map(|(_, turn)| degrees(turn)).unwrap_or_default(),
            u8::from(n == seeds.chosen).to_string(),
        ])?;
    }
    text(table)
}
