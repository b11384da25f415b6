//! The shear on the flat fabric, u to the right and v upwards.

use super::blocks::Blocks;
use super::marks::{arrow, dot, mark, marked, seed_arrows};
use crate::write::figure::axes::{self, LABEL, TICK};
use crate::write::figure::canvas::{Canvas, Ink, Px, plain};
use crate::write::figure::color::{DARK, FRAME};

/// Where the flat fabric is on the sheet.
pub(super) struct Flat {
    pub left: f64,
    pub bottom: f64,
    /// Picture points per meter.
    pub scale: f64,
    /// Lowest and highest fabric coordinates (m).
    pub bounds: [[f64; 2]; 2],
}

impl Flat {
    /// A fabric point (m) on the sheet.
    fn pixel(&self, [u, v]: [f64; 2]) -> Px {
        let [low, _] = self.bounds;
        [self.left + (u - low[0]) * self.scale, self.bottom - (v - low[1]) * self.scale]
    }

    pub fn draw(&self, canvas: &mut Canvas, blocks: &Blocks) {
        let net = blocks.net;
        let place = |id: [usize; 2]| net.placement.fabric(id);
        for ([low, high], ink) in blocks.tiles() {
            let ([x0, y0], [x1, y1]) = (self.pixel(place(low)), self.pixel(place(high)));
            // each reaches over those to its right and above, which cover it, so that no seam shows
            let [right, top] = self.pixel(self.bounds[1]);
            let (x1, y1) = ((x1 + 0.8).min(right), (y1 - 0.8).max(top));
            canvas.polygon(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], ink);
        }
        for level in blocks.levels() {
            for piece in blocks.isoline(level) {
                canvas.line(&piece.map(|p| self.pixel(p)), Ink([255; 3], 0.8), 0.8);
            }
        }

        // The ply's boundary, ticks and labels.
        let [low, high] = self.bounds;
        let [u, v] = [0, 1].map(|c| high[c] - low[c]);
        if let Some(outline) = net.ply_outline() {
            for ring in outline.rings() {
                let closed: Vec<Px> =
                    ring.iter().chain(ring.first()).map(|p| self.pixel(*p)).collect();
                canvas.line(&closed, if net.outline.is_some() { DARK } else { FRAME }, 1.0);
            }
        }
        let most = |length: f64, room: f64| (length * self.scale / room).clamp(2.0, 10.0);
        for tick in axes::ticks(low[0], high[0], most(u, 56.0)) {
            let [x, y] = self.pixel([tick * 1e-3, low[1]]);
            canvas.line(&[[x, y], [x, y + 4.0]], FRAME, 1.0);
            canvas.text(&axes::label(tick), [x, y + 13.0], plain(TICK, 0));
        }
        for tick in axes::ticks(low[1], high[1], most(v, 34.0)) {
            let [x, y] = self.pixel([low[0], tick * 1e-3]);
            canvas.line(&[[x - 4.0, y], [x, y]], FRAME, 1.0);
            canvas.text(&axes::label(tick), [x - 8.0, y], plain(TICK, 1));
        }
        let [x, y] = self.pixel([0.5 * (low[0] + high[0]), low[1]]);
        canvas.text("u (mm)", [x, y + 34.0], plain(LABEL, 0));
        let [x, y] = self.pixel([low[0], high[1]]);
        canvas.text("v (mm)", [x, y - 16.0], plain(LABEL, 1));

        for (name, nodes) in seed_arrows(net) {
            let ends = [nodes[0], nodes[nodes.len() - 1]];
            arrow(canvas, &ends.map(|id| self.pixel(place(id))), name);
        }
        dot(canvas, self.pixel(place(net.placement.seed)));
        if let Some((largest, cell)) = marked(net) {
            let corner = place(cell);
            let middle = [0, 1].map(|c| corner[c] + 0.5 * net.placement.mesh[c]);
            mark(canvas, self.pixel(middle), &format!("{largest:.1}°"), self.pixel(high)[0]);
        }
    }
}
