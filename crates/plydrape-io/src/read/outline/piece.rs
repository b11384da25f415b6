//! The pieces of a drawing: closed lines with their holes, blocks and labels, of which one is the ply.
//!
//! A closed line within another one is a hole of that, and one within a hole is a piece again. Blocks that a drawing places are
//! pieces of their own, also where one of them lies within another: cutters write a nest so.

use super::chain::Closed;
use super::entity::Text;
use super::place::{listed, toml};
use super::{area, bounds, inside, lines};
use crate::error::Fault;
use crate::store::shown::millimeters;
use plydrape::ply::Ring;
use std::collections::BTreeSet;

/// Most pieces, layers and labels that a message lists.
const MOST: usize = 20;

/// Which piece of a drawing is the ply.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// The one that is this block, by its name in small or capital letters.
    Block(String),
    /// The one with this text inside it or in its block, in small or capital letters.
    Label(String),
    /// The smallest one around this point (m).
    Point([f64; 2]),
}

/// The closed lines of a drawing, each within others or not.
pub struct Nest {
    /// The largest first; of two that are as large, the first of the file.
    lines: Vec<Closed>,
    /// The smallest line around each.
    around: Vec<Option<usize>>,
    /// How many lines are around each.
    depth: Vec<usize>,
    /// The lines that may be the boundary of the ply.
    pieces: Vec<usize>,
}

/// A line of the ply and those that are its holes, by their numbers.
pub struct Chosen {
    /// The boundary.
    pub boundary: usize,
    /// The holes.
    pub holes: Vec<usize>,
    /// Lines of other blocks within the boundary that are no holes of this piece.
    pub others: usize,
}

impl Nest {
    /// Finds what is within what.
    pub fn new(mut lines: Vec<Closed>) -> Self {
        lines.sort_by(|a, b| area(&b.ring).total_cmp(&area(&a.ring)));
        let boxes: Vec<[[f64; 2]; 2]> = lines.iter().map(|line| bounds(&line.ring)).collect();
        let within = |[low, high]: [[f64; 2]; 2], [x, y]: [f64; 2]| {
            (low[0]..=high[0]).contains(&x) && (low[1]..=high[1]).contains(&y)
        };
        let mut nest = Nest { around: Vec::new(), depth: Vec::new(), pieces: Vec::new(), lines };
        for n in 0..nest.lines.len() {
            let point = nest.lines[n].ring[0];
            // the smallest of the larger ones is the last
            let is_around = |outer: &usize| {
                within(boxes[*outer], point) && inside(&nest.lines[*outer].ring, point)
            };
            let outer = (0..n).rev().find(is_around);
            let depth = outer.map_or(0, |outer| nest.depth[outer] + 1);
            let own_block = outer.is_some_and(|outer| nest.are_of_two_blocks(n, outer));
            if depth % 2 == 0 || own_block {
                nest.pieces.push(n);
            }
            nest.around.push(outer);
            nest.depth.push(depth);
        }
        nest
    }

    /// The closed lines.
    pub fn lines(&self) -> &[Closed] {
        &self.lines
    }

    fn are_of_two_blocks(&self, a: usize, b: usize) -> bool {
        let [a, b] = [a, b].map(|n| self.lines[n].placed.number);
        a != b && a != 0 && b != 0
    }

    /// The lines within a line that are in no other one of these.
    fn holes(&self, piece: usize) -> impl Iterator<Item = usize> {
        (0..self.lines.len()).filter(move |n| self.around[*n] == Some(piece))
    }

    /// The smallest piece around a point.
    fn around(&self, point: [f64; 2]) -> Option<usize> {
        self.pieces.iter().rev().copied().find(|n| inside(&self.lines[*n].ring, point))
    }

    /// The piece that a text names: the one of its block if that has one alone, else the smallest one around it.
    fn named(&self, text: &Text) -> Option<usize> {
        let number = text.placed.number;
        let of_block = |n: &&usize| number != 0 && self.lines[**n].placed.number == number;
        let mut same = self.pieces.iter().filter(of_block);
        match (same.next(), same.next()) {
            (Some(piece), None) => Some(*piece),
            _ => self.around(text.at),
        }
    }

    /// The texts of each piece.
    fn labels(&self, texts: &[Text]) -> Vec<Vec<String>> {
        let mut labels = vec![Vec::new(); self.pieces.len()];
        for text in texts {
            let piece = self.named(text);
            if let Some(n) = self.pieces.iter().position(|other| Some(*other) == piece) {
                labels[n].extend(text.lines.iter().cloned());
            }
        }
        labels
    }

    /// The ply: the only piece, or the one that is chosen.
    pub fn chosen(&self, piece: Option<&Piece>, texts: &[Text]) -> Result<Chosen, Fault> {
        let found: Vec<usize> = match piece {
            None => self.pieces.clone(),
            Some(Piece::Point(point)) => self.around(*point).into_iter().collect(),
            Some(Piece::Block(block)) => {
                let is_of = |n: &usize| self.lines[*n].placed.is_of(block);
                self.pieces.iter().copied().filter(is_of).collect()
            }
            Some(Piece::Label(label)) => {
                let same = |text: &String| plain(text) == plain(label);
                let labels = self.labels(texts);
                let has = self.pieces.iter().zip(&labels).filter(|(_, l)| l.iter().any(same));
                has.map(|(n, _)| *n).collect()
            }
        };
        let [boundary] = found[..] else {
            return Err(self.not_one(piece, &found, texts));
        };
        // a point chooses what is drawn around it, whatever blocks that is of
        let is_own = |hole: &usize| match piece {
            Some(Piece::Block(_) | Piece::Label(_)) => !self.are_of_two_blocks(*hole, boundary),
            _ => true,
        };
        let (holes, others): (Vec<usize>, Vec<usize>) = self.holes(boundary).partition(is_own);
        Ok(Chosen { boundary, holes, others: others.len() })
    }

    /// Why a choice chooses no piece, or several.
    fn not_one(&self, piece: Option<&Piece>, found: &[usize], texts: &[Text]) -> Fault {
        let (count, all) = (found.len(), self.pieces.len());
        let point = |[x, y]: [f64; 2]| format!("({}, {}) mm", millimeters(x), millimeters(y));

        // why this is no choice: nobody chose, nothing fits, or several pieces do
        let message = match (piece, count) {
            (None, _) => {
                // the two largest pieces show why the drawing has more than one
                let [outer, inner] = [0, 1].map(|n| self.pieces[n]);
                let why = match self.are_of_two_blocks(outer, inner) {
                    true => "is of another block than",
                    false => "is not inside",
                };
                let [outer, inner] = [outer, inner].map(|n| &self.lines[n].place);
                format!(
                    "it has {} outlines, and none is chosen: {inner} {why} the largest closed line, {outer}",
                    if all == 2 { "two".into() } else { all.to_string() },
                )
            }
            (Some(Piece::Point(at)), _) => {
                format!("there is no closed line around the point {}", point(*at))
            }
            (Some(Piece::Block(name)), 0) => format!("no piece is of a block {}", toml(name)),
            (Some(Piece::Block(name)), _) => {
                format!("{count} pieces are of the block {}", toml(name))
            }
            (Some(Piece::Label(text)), 0) => format!("no piece has the label {}", toml(text)),
            (Some(Piece::Label(text)), _) => {
                format!("{count} pieces have the label {}", toml(text))
            }
        };

        // list those that fit if there are several, else all pieces
        let shown = if count > 1 { found } else { &self.pieces[..] };
        Fault::new(message, format!("choose one in [ply]:\n{}", self.list(shown, texts)))
    }

    /// Pieces, each in a line with the key that chooses it and what it is.
    fn list(&self, shown: &[usize], texts: &[Text]) -> String {
        // labels and blocks of a piece, and those that no other piece has
        let labels = self.labels(texts);
        let labels_of = |n: usize| {
            let place = self.pieces.iter().position(|piece| *piece == n);
            place.map_or(&[][..], |place| &labels[place])
        };
        let has =
            |n: usize, text: &str| labels_of(n).iter().any(|label| plain(label) == plain(text));
        let only_label = |n: usize| {
            let only =
                |text: &&String| self.pieces.iter().filter(|other| has(**other, text)).count() == 1;
            labels_of(n).iter().find(only)
        };
        let only_block = |n: usize| {
            let pieces_in = |block: &str| {
                self.pieces.iter().filter(|p| self.lines[**p].placed.is_of(block)).count()
            };
            self.lines[n].placed.blocks.iter().find(|block| pieces_in(block) == 1)
        };
        let mut out: Vec<String> = Vec::new();
        for &n in shown.iter().take(MOST) {
            // what can choose the piece: a point in it, its label and its block
            let line = &self.lines[n];
            let point = self.point_in(n).map(|point| {
                let [x, y] = point.map(millimeters);
                format!("point = [\"{x} mm\", \"{y} mm\"]")
            });
            let label = labels_of(n).first().map(|label| format!("label = {}", toml(label)));
            let block = line.placed.blocks.first();
            let block = block.map(|block| format!("block = {}", toml(block)));
            // the key is a label or a block that is its own, else the point; the other facts are only shown
            let key = (only_label(n).map(|label| format!("label = {}", toml(label))))
                .or_else(|| only_block(n).map(|block| format!("block = {}", toml(block))))
                .or_else(|| point.clone());
            let facts = [label, block, point].into_iter().flatten();
            let facts: Vec<String> = facts.filter(|fact| Some(fact) != key.as_ref()).collect();
            let size = size(&line.ring);
            let facts =
                if facts.is_empty() { String::new() } else { format!("; {}", facts.join("; ")) };
            let key = key.map_or_else(|| "a piece".into(), |key| format!("piece = {{ {key} }}"));
            out.push(format!("{key} ({size}{facts})"));
        }

        // a long list is cut short
        if shown.len() > MOST {
            out.push(format!("and {} more", shown.len() - MOST));
        }
        out.join("\n")
    }

    /// A point of a piece that a point in millimeters with three digits can choose, as far from its lines as a few cuts show.
    fn point_in(&self, n: usize) -> Option<[f64; 2]> {
        let rings = || self.holes(n).chain([n]).map(|n| &self.lines[n].ring);
        let [low, high] = bounds(&self.lines[n].ring);
        let mut best: Option<(f64, [f64; 2])> = None;
        for share in [4, 3, 5, 2, 6, 1, 7].map(|k| f64::from(k) / 8.0) {
            let y = low[1] + share * (high[1] - low[1]);
            let cuts = |[a, b]: [[f64; 2]; 2]| {
                let crosses = (a[1] > y) != (b[1] > y);
                crosses.then(|| a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
            };
            let mut cuts: Vec<f64> =
                rings().flat_map(|ring| lines(ring).filter_map(cuts)).collect();
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.chunks_exact(2) {
                let point = [0.5 * (pair[0] + pair[1]), y].map(|x| (x * 1e6).round() * 1e-6);
                let width = pair[1] - pair[0];
                if best.is_none_or(|(most, _)| width > most * (1.0 + 1e-9))
                    && self.around(point) == Some(n)
                {
                    best = Some((width, point));
                }
            }
        }
        best.map(|(_, point)| point)
    }
}

/// A text as it is compared.
fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase()
}

/// How large a closed line is along x and y, in words.
pub(super) fn size(ring: &Ring) -> String {
    let [low, high] = bounds(ring);
    let [width, height] = [0, 1].map(|n| millimeters(high[n] - low[n]));
    format!("{width} × {height} mm")
}

/// Refuses closed lines that are on several layers if none is named: which of them are of the ply, nobody has said.
pub(super) fn check_layers(all: &[&Closed], file: &str) -> Result<(), Fault> {
    let mut layers: Vec<(&BTreeSet<String>, Vec<&Closed>)> = Vec::new();
    for line in all {
        match layers.iter_mut().find(|(known, _)| **known == line.layers) {
            Some((_, lines)) => lines.push(line),
            None => layers.push((&line.layers, vec![line])),
        }
    }
    let [(first, _), _, ..] = &layers[..] else { return Ok(()) };
    let names = |layers: &BTreeSet<String>| {
        let names: Vec<String> = layers.iter().map(|layer| toml(layer)).collect();
        names.join(", ")
    };
    let holds = layers.iter().take(MOST).map(|(layers, lines)| {
        let name = listed(&layers.iter().collect::<Vec<_>>());
        // the largest first
        match lines[..] {
            [one] => format!("{name} has one of {}", size(&one.ring)),
            _ => format!(
                "{name} has {} of {} to {}",
                lines.len(),
                size(&lines[lines.len() - 1].ring),
                size(&lines[0].ring)
            ),
        }
    });
    let holds: Vec<String> = holds.collect();
    let more = if layers.len() > MOST { ", …" } else { "" };
    Err(Fault::new(
        format!(
            "its closed lines are on several layers, and none is named: {}{more}",
            holds.join(", ")
        ),
        format!(
            "name those that have the boundary and the holes of the ply, as in outline = {{ file = {}, layers = [{}] }}",
            toml(file),
            names(first)
        ),
    ))
}
