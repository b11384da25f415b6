//! The catenaries in their pieces, as they are in the result file: those that hang or lie, and what the mold has
//! caught. A touch in a single point is a line from it to itself; a rest of no length has no points and is left out.
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
//! | `state` | 0 hanging, 1 overstretched, 2 straight, 3 lying with slack, 4 caught by the mold |
//! | `length_m` | its fabric length (m) |
//! | `H_N`, `has_force` | horizontal force (N), and 1 where the model gives one; else both 0 |
//! | `slack_mm`, `slack_ratio`, `wrinkle_mm`, `overstretch`, `overstretch_mm` | as in the result file; 0 for what is caught |

use super::polydata::{Array, Kind, PolyData};
use plydrape::draping::record::{
    CatenaryDirection, CatenaryKind, CatenaryState, ContactState, Hold, SpanState, Step,
};

/// A piece of a catenary.
struct Piece<'a> {
    number: usize,
    line: &'a CatenaryState,
    rest: Rest<'a>,
}

enum Rest<'a> {
    Span(&'a SpanState),
    Caught(&'a ContactState),
}

impl Piece<'_> {
    fn points(&self) -> &[[f64; 3]] {
        match self.rest {
            Rest::Span(span) => &span.points,
            Rest::Caught(contact) => &contact.points,
        }
    }

    /// A number of a span; 0 for what is caught.
    fn of(&self, number: fn(&SpanState) -> f64) -> f64 {
        match self.rest {
            Rest::Span(span) => number(span),
            Rest::Caught(_) => 0.0,
        }
    }

    fn force(&self) -> Option<f64> {
        match self.rest {
            Rest::Span(span) => span.force,
            Rest::Caught(_) => None,
        }
    }

    fn length(&self) -> f64 {
        match self.rest {
            Rest::Span(span) => span.length,
            Rest::Caught(contact) => contact.arc[1] - contact.arc[0],
        }
    }

    fn state(&self) -> u8 {
        match self.rest {
            Rest::Span(span) => match span.state {
                Hold::Hanging => 0,
                Hold::Overstretched => 1,
                Hold::Straight => 2,
                Hold::Lying => 3,
            },
            Rest::Caught(_) => 4,
        }
    }
}

/// The catenaries of a step.
pub(super) fn catenaries(step: &Step) -> PolyData {
    let mut pieces = Vec::new();
    for (number, line) in step.catenaries.iter().enumerate() {
        let spans = line.spans.iter().map(Rest::Span);
        let caught = line.contact.iter().map(Rest::Caught);
        pieces.extend(spans.chain(caught).map(|rest| Piece { number, line, rest }));
    }
    pieces.retain(|piece| !piece.points().is_empty());

    let mut first = 0;
    let mut joined = |piece: &Piece| {
        let count = piece.points().len();
        first += count;
        // a touch in one point is a line from it to itself
        if count == 1 { vec![first - 1; 2] } else { (first - count..first).collect() }
    };
    let cells = pieces.iter().map(&mut joined).collect();
    let on_mold = |piece: &Piece| vec![u8::from(piece.state() > 2); piece.points().len()];

    let numbers = |name, of: fn(&Piece) -> f64| Array::new(name, pieces.iter().map(of).collect());
    let codes = |name, of: fn(&Piece) -> u8| Array::codes(name, pieces.iter().map(of).collect());
    let whole = |name, of: fn(&Piece) -> usize| Array::whole(name, pieces.iter().map(of));
    let in_cells = vec![
        whole("catenary", |p| p.number),
        codes("kind", |p| match p.line.kind {
            CatenaryKind::Edge => 0,
            CatenaryKind::Diagonal => 1,
        }),
        codes("direction", |p| match p.line.direction {
            CatenaryDirection::U => 0,
            CatenaryDirection::V => 1,
            CatenaryDirection::Rising => 2,
            CatenaryDirection::Falling => 3,
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
        numbers("slack_mm", |p| p.of(|span| span.slack_mm)),
        numbers("slack_ratio", |p| p.of(|span| span.slack_ratio)),
        numbers("wrinkle_mm", |p| p.of(|span| span.wrinkle_mm)),
        numbers("overstretch", |p| p.of(|span| span.overstretch)),
        numbers("overstretch_mm", |p| p.of(|span| span.overstretch_mm)),
    ];
    PolyData {
        points: pieces.iter().flat_map(|piece| piece.points()).copied().collect(),
        kind: Kind::Lines,
        cells,
        at_points: vec![Array::codes("contact", pieces.iter().flat_map(on_mold).collect())],
        in_cells,
        fields: Vec::new(),
    }
}
