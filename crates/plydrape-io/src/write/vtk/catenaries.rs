//! The catenaries in their pieces: spans that hang or lie, and what is in contact with the mold. A touch in a single point is
//! a line from it to itself; a segment of no length has no points and is left out.
//!
//! Point data: `contact`, 1 on pieces that lie on the mold. Cell data, of the catenary:
//!
//! | array | |
//! |---|---|
//! | `catenary` | its number in the result file, from 0 |
//! | `kind` | 0 edge, 1 diagonal |
//! | `direction` | 0 u, 1 v, 2 rising, 3 falling |
//! | `from_i`, `from_j`, `to_i`, `to_j` | the grippers at its ends |
//! | `set_length_m` | its set length (m) |
//! | `shearing` | 1 for a diagonal that the shear of its cell stretches |
//!
//! and of the piece:
//!
//! | array | |
//! |---|---|
//! | `state` | 0 hanging, 1 overstretched, 2 straight, 3 lying with slack, 4 in contact |
//! | `length_m` | its fabric length (m) |
//! | `H_N`, `has_force` | horizontal force (N), and 1 where the model gives one; else both 0 |
//! | `slack_mm`, `slack_ratio`, `wrinkle_mm`, `overstretch`, `overstretch_mm` | as in `steps.csv`, of this piece; 0 for what is in contact |

use super::polydata::{Array, Kind, PolyData};
use crate::result::{ResultFile, catenaries as lines_of};
use plydrape::draping::record::{CatenaryState, Hold, SpanState};
use plydrape::outcome::Step;
use plydrape::ply::Kind as Family;

/// A piece of a catenary.
struct Piece<'a> {
    number: usize,
    line: &'a CatenaryState,
    /// None for what is in contact.
    span: Option<&'a SpanState>,
    points: &'a [[f64; 3]],
    /// Height of the ruck that its slack makes (mm).
    wrinkle: f64,
}

impl Piece<'_> {
    /// A number of a span from the length of its catenary; 0 for what is in contact.
    fn span_number(&self, number: fn(&SpanState, f64) -> f64) -> f64 {
        self.span.map_or(0.0, |span| number(span, self.line.length))
    }

    fn force(&self) -> Option<f64> {
        self.span.and_then(|span| span.force)
    }

    fn length(&self) -> f64 {
        let contact = || self.line.contact.as_ref().map_or(0.0, |contact| contact.length());
        self.span.map_or_else(contact, |span| span.length)
    }

    fn state(&self) -> u8 {
        match self.span.map(|span| span.hold) {
            Some(Hold::Hanging) => 0,
            Some(Hold::Overstretched) => 1,
            Some(Hold::Straight) => 2,
            Some(Hold::Lying) => 3,
            None => 4,
        }
    }
}

/// The catenaries of a step.
pub(super) fn catenaries(result: &ResultFile, step: &Step) -> PolyData {
    let curves = result.curves(step);
    let (ply, gravity) = (&result.scene.ply, result.scene.settings.gravity);
    let mut pieces = Vec::new();
    for (number, (line, curves)) in lines_of(step).iter().zip(&curves).enumerate() {
        for (span, points) in line.spans.iter().zip(curves) {
            let wrinkle = span.ruck(ply, gravity, line).map_or(0.0, |ruck| 1e3 * ruck.height());
            pieces.push(Piece { number, line, span: Some(span), points, wrinkle });
        }
        let contact = line.contact.iter().map(|contact| contact.points.as_slice());
        pieces.extend(contact.map(|points| Piece {
            number,
            line,
            span: None,
            points,
            wrinkle: 0.0,
        }));
    }
    pieces.retain(|piece| !piece.points.is_empty());

    let mut first = 0;
    let mut joined = |piece: &Piece| {
        let count = piece.points.len();
        first += count;
        // a touch in one point is a line from it to itself
        if count == 1 { vec![first - 1; 2] } else { (first - count..first).collect() }
    };
    let cells = pieces.iter().map(&mut joined).collect();
    let on_mold = |piece: &Piece| vec![u8::from(piece.state() > 2); piece.points.len()];

    let numbers =
        |name, value: fn(&Piece) -> f64| Array::new(name, pieces.iter().map(value).collect());
    let codes =
        |name, value: fn(&Piece) -> u8| Array::codes(name, pieces.iter().map(value).collect());
    let whole = |name, value: fn(&Piece) -> usize| Array::whole(name, pieces.iter().map(value));
    let in_cells = vec![
        whole("catenary", |p| p.number),
        codes("kind", |p| u8::from(!p.line.kind.is_edge())),
        codes("direction", |p| match p.line.kind {
            Family::EdgeU => 0,
            Family::EdgeV => 1,
            Family::Rising => 2,
            Family::Falling => 3,
        }),
        whole("from_i", |p| p.line.from[0]),
        whole("from_j", |p| p.line.from[1]),
        whole("to_i", |p| p.line.to[0]),
        whole("to_j", |p| p.line.to[1]),
        numbers("set_length_m", |p| p.line.length),
        codes("shearing", |p| p.line.shearing.into()),
        codes("state", |p| p.state()),
        numbers("length_m", |p| p.length()),
        numbers("H_N", |p| p.force().unwrap_or(0.0)),
        codes("has_force", |p| p.force().is_some().into()),
        numbers("slack_mm", |p| p.span_number(SpanState::slack_mm)),
        numbers("slack_ratio", |p| p.span_number(SpanState::slack_ratio)),
        numbers("wrinkle_mm", |p| p.wrinkle),
        numbers("overstretch", |p| p.span.map_or(0.0, |span| p.line.overstretch(span))),
        numbers("overstretch_mm", |p| p.span_number(SpanState::overstretch_mm)),
    ];
    PolyData {
        points: pieces.iter().flat_map(|piece| piece.points).copied().collect(),
        kind: Kind::Lines,
        cells,
        at_points: vec![Array::codes("contact", pieces.iter().flat_map(on_mold).collect())],
        in_cells,
        fields: Vec::new(),
    }
}
