//! The net on its mold in 3D.

use super::blocks::Blocks;
use super::marks::{arrow, dot, mark, marked, seed_ways};
use crate::figure::FigureError;
use crate::figure::axes::Frame;
use crate::figure::canvas::{Canvas, Ink, Px};
use crate::figure::colour::{DARK, MOLD, RED, WEAVE};
use crate::figure::layout::{bounds, mold_picture};
use crate::figure::panel::MoldPicture;
use crate::figure::piece::{self, Form, Piece, grown, thread};
use crate::figure::projection::{Point, View};
use crate::figure::relief::BACK;
use plydrape::mold::Mold;
use plydrape::net::{Boundary, Net};

/// Most fabric lines drawn each way.
const LINES: usize = 24;
/// How far the mold is drawn beyond the net, as a share of the width.
const MARGIN: f64 = 0.06;

/// The box around the net in 3D, and the mold in it.
pub(super) struct Draped {
    pub low: Point,
    pub high: Point,
    pub mold_picture: Option<MoldPicture>,
    boundary: Option<Boundary>,
}

impl Draped {
    pub fn of(nodes: &[Point], mold: &Mold, boundary: Option<Boundary>) -> Self {
        let [mut low, mut high] = bounds(nodes);
        let reach = MARGIN * (high[0] - low[0]).hypot(high[1] - low[1]).max(1e-3);
        for c in 0..2 {
            low[c] -= reach;
            high[c] += reach;
        }
        let across = (high[0] - low[0]).hypot(high[1] - low[1]);
        let mold_picture = mold_picture(mold, low, high, across);
        if let Some([floor, roof]) = mold_picture.as_ref().map(MoldPicture::heights) {
            low[2] = low[2].min(floor);
            high[2] = high[2].max(roof);
        }
        let least = 0.05 * across;
        if high[2] - low[2] < least {
            high[2] = low[2] + least;
        }
        Draped { low, high, mold_picture, boundary }
    }

    pub fn draw(
        &self,
        canvas: &mut Canvas,
        view: &View,
        blocks: &Blocks,
    ) -> Result<(), FigureError> {
        let frame = Frame { low: self.low, high: self.high, stretch: 1.0 };
        frame.back(canvas, view)?;
        let net = blocks.net;
        let mut pieces = Vec::new();
        let node = |id| net.node(id);
        for ([[a, b], [c, d]], ink) in blocks.tiles() {
            let ring = [node([a, b]), node([c, b]), node([c, d]), node([a, d])];
            let [Some(p), Some(q), Some(r), Some(s)] = ring else { continue };
            let ring = [p, q, r, s];
            let place = [0, 1, 2].map(|c| ring.iter().map(|p| p[c]).sum::<f64>() / 4.0);
            let flat = ring.map(|p| view.at(p));
            // the back of the ply lets through what it hides
            let (points, ink) = match turned(&flat) {
                false => (grown(&flat), ink),
                true => (flat.to_vec(), Ink(ink.0, BACK)),
            };
            pieces.push(Piece { depth: view.depth(place), place, points, ink, form: Form::Area });
        }
        // A net without cells is a line.
        let line = net.placement.nodes.contains(&1);
        let (ink, width) = if line { (RED, 1.7) } else { (WEAVE, 0.7) };
        let lift = 1.5 * blocks.side as f64 * net.placement.mesh[0].max(net.placement.mesh[1]);
        let coverage = net.coverage();
        let of_ply = |pair: &&[[usize; 2]]| pair.iter().all(|id| coverage.node(*id));
        for way in fabric_lines(net) {
            for pair in way.windows(2).filter(of_ply) {
                if let [Some(a), Some(b)] = [node(pair[0]), node(pair[1])] {
                    thread(&mut pieces, view, &[a, b], lift, ink, width);
                }
            }
        }
        // of a ply that is cut
        for line in self.boundary.iter().filter(|_| net.outline.is_some()).flat_map(|b| &b.lines) {
            let again = line.points.first().filter(|_| line.closed);
            let places: Vec<Point> =
                line.points.iter().chain(again).map(|point| point.place).collect();
            thread(&mut pieces, view, &places, lift, DARK, 1.0);
        }
        match &self.mold_picture {
            Some(MoldPicture::Relief(relief)) => relief.paint_among(canvas, view, pieces)?,
            Some(MoldPicture::Flat(patch)) => {
                canvas.polygon(&patch.map(|p| view.at(p)), MOLD)?;
                piece::paint(canvas, pieces)?;
            }
            None => piece::paint(canvas, pieces)?,
        }

        for (name, way) in seed_ways(net) {
            let path: Vec<Px> = way.iter().map_while(|id| node(*id)).map(|p| view.at(p)).collect();
            arrow(canvas, &path, name)?;
        }
        if let Some(seed) = node(net.placement.seed) {
            dot(canvas, view.at(seed))?;
        }
        if let Some((largest, cell)) = marked(net) {
            let [i, j] = cell;
            let ring = [node([i, j]), node([i + 1, j + 1])];
            if let [Some(p), Some(q)] = ring {
                let at = view.at([0, 1, 2].map(|c| 0.5 * (p[c] + q[c])));
                mark(canvas, at, &format!("{largest:.1}°"))?;
            }
        }
        frame.front(canvas, view)
    }
}

/// True if the back of a cell is seen: its corners run clockwise on the sheet.
fn turned([a, b, c, d]: &[Px; 4]) -> bool {
    let ([px, py], [qx, qy]) = ([c[0] - a[0], c[1] - a[1]], [d[0] - b[0], d[1] - b[1]]);
    // the sheet's second axis points down
    px * qy - py * qx > 0.0
}

/// Some of the fabric lines along u and along v, the rims among them, by their nodes.
fn fabric_lines(net: &Net) -> Vec<Vec<[usize; 2]>> {
    let nodes = net.placement.nodes;
    let mut lines = Vec::new();
    for way in 0..2 {
        let (along, across) = (nodes[way], nodes[1 - way]);
        let apart = (across - 1).div_ceil(LINES).max(1);
        let step = (along - 1).div_ceil(200).max(1);
        let last = across - 1;
        for k in (0..last).step_by(apart).chain([last]) {
            let at = |n: usize| if way == 0 { [n, k] } else { [k, n] };
            lines.push((0..along - 1).step_by(step).chain([along - 1]).map(at).collect());
        }
    }
    lines
}
