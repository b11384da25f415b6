//! A solved span as text: what holds it, a table of places along it, and its shape.

use super::{Solved, SpanShape, picture};
use crate::numbers::{millimeters, short};
use plydrape::catenary::EndCondition;
use std::fmt::Write;

/// Points of the drawn curve.
const POINTS: usize = 400;

/// Everything a person wants to know of a span.
pub fn text(solved: &Solved) -> String {
    let span = &solved.span;
    let rise = match span.rise {
        0.0 => "level".to_string(),
        rise if rise > 0.0 => format!("{} mm up", millimeters(rise)),
        rise => format!("{} mm down", millimeters(-rise)),
    };
    let mut text = format!(
        "{} mm of ply over a run of {} mm, {rise}: {}\n\n",
        millimeters(span.length),
        millimeters(span.run),
        solved.state()
    );
    for (noun, value) in summary(solved) {
        let _ = writeln!(text, "  {noun:<17} {value}");
    }
    let _ = write!(text, "\n{}\n", table(solved));
    let station = |n: usize| solved.station(n as f64 / POINTS as f64);
    let points: Vec<[f64; 2]> = (0..=POINTS).map(station).map(|s| [s.x, s.z]).collect();
    text + &picture::curve(&points)
}

/// Force, sag, end slopes and moments, and what a straight or stretched span calls for.
fn summary(solved: &Solved) -> Vec<(&'static str, String)> {
    let span = &solved.span;
    let force = match solved.root.force {
        Some(force) if force < 0.0 => format!("{} N, compression", short(force)),
        Some(force) => format!("{} N, tension", short(force)),
        None => "none: a straight ply that does not stretch carries no known force".into(),
    };
    let (depth, place) = solved.sag();
    let sag = if depth > 0.0 {
        format!(
            "{} mm below the chord, {} mm from the start",
            millimeters(depth),
            millimeters(place)
        )
    } else {
        "none: nowhere below the chord".into()
    };
    let slopes = solved.slopes();
    let held = |end: usize| match span.ends[end] {
        _ if solved.is_straight() => "the chord's",
        EndCondition::Free => "free",
        EndCondition::Slope(_) => "held",
    };
    // zero by definition at a free end, up to rounding by the closed form
    let moment = |end: usize| match span.ends[end] {
        EndCondition::Free => 0.0,
        EndCondition::Slope(_) => solved.station(end as f64).moment,
    };
    let ends = [0, 1].map(|end| short(moment(end) * 1e3));
    let mut lines = vec![
        ("horizontal force", force),
        ("sag", sag),
        (
            "slopes",
            format!(
                "{} at the start ({}), {} at the end ({})",
                short(slopes[0]),
                held(0),
                short(slopes[1]),
                held(1)
            ),
        ),
        ("moments", format!("{} N·mm at the start, {} N·mm at the end", ends[0], ends[1])),
    ];
    if solved.at_rest {
        let text =
            "small-sag theory takes the first slope of the moment; --theory exact takes all of it";
        lines.push(("moment table", text.into()));
    }
    let beyond = span.chord() - span.length;
    if solved.state() == "overstretched" {
        lines.push((
            "overstretch",
            format!(
                "the chord of {} mm is {} mm ({} %) longer than the ply",
                millimeters(span.chord()),
                millimeters(beyond),
                short(beyond / span.length * 100.0)
            ),
        ));
    }
    if solved.is_straight() {
        if span.ends != [EndCondition::Free; 2] {
            lines.push(("", "a straight span cannot take the slopes asked for".into()));
        }
        lines.push(("", "a finite --axial-stiffness would give its force".into()));
    }
    lines
}

/// Places along the span; six digits of the largest number in each column, to the right.
fn table(solved: &Solved) -> String {
    let head = ["x mm", "z mm", "slope", "moment N·mm", "vertical force N"];
    // columns in the units of the heads
    let values: Vec<[f64; 5]> = solved
        .stations()
        .map(|s| [s.x * 1e3, s.z * 1e3, s.slope, s.moment * 1e3, s.vertical_force])
        .collect();

    // as many decimals as give the largest number of a column six digits
    let decimals = [0, 1, 2, 3, 4].map(|column| {
        let largest = values.iter().fold(0.0, |m, row| f64::max(m, row[column].abs()));
        if largest > 0.0 { (5.0 - largest.log10().floor()).clamp(0.0, 12.0) as usize } else { 0 }
    });
    let mut rows = vec![head.map(str::to_string)];
    rows.extend(values.iter().map(|row| {
        [0, 1, 2, 3, 4].map(|column| match solved.shape {
            // a straight span that does not stretch carries no known force
            SpanShape::Straight if column == 4 => "–".to_string(),
            _ => without_sign_of_zero(format!("{:.*}", decimals[column], row[column])),
        })
    }));

    // a column is as wide as its longest text
    let mut widths = [0; 5];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = cell.chars().count().max(*width);
        }
    }
    let mut text = String::new();
    for row in &rows {
        for (width, cell) in widths.iter().zip(row) {
            let _ = write!(text, "  {cell:>width$}");
        }
        text.push('\n');
    }
    text
}

/// `-0.000` as `0.000`.
fn without_sign_of_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(size) if size.chars().all(|c| c == '0' || c == '.') => size.to_string(),
        _ => text,
    }
}
