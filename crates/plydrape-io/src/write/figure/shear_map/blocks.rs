//! Shear by block of cells: what has which color, and lines of equal shear.

use crate::write::figure::axes;
use crate::write::figure::canvas::Ink;
use crate::write::figure::color::viridis;
use plydrape::net::Net;

/// Most blocks that have a color of their own.
const BLOCKS: f64 = 6000.0;
/// The color scale reaches at least to here (°), so that rounding errors have no color.
const LEAST: f64 = 0.5;

/// Shear by block of cells, in degrees.
pub(super) struct Blocks<'a> {
    pub net: &'a Net,
    /// Cells of a block along each side; less at the far sides.
    pub side: usize,
    /// Blocks along u and v.
    count: [usize; 2],
    /// Mean of each block's whole cells, u running fastest.
    pub shear: Vec<Option<f64>>,
}

impl<'a> Blocks<'a> {
    pub fn new(net: &'a Net) -> Self {
        let cells = net.placement.nodes.map(|n| n - 1);
        let side = ((cells[0] * cells[1]) as f64 / BLOCKS).sqrt().ceil().max(1.0) as usize;
        let count = cells.map(|n| n.div_ceil(side));
        let mut blocks = Blocks { net, side, count, shear: Vec::new() };
        for n in 0..count[0] * count[1] {
            let inside = blocks.cells([n % count[0], n / count[0]]);
            let found: Vec<f64> = inside.filter_map(|cell| degrees(net, cell)).collect();
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            blocks.shear.push((!found.is_empty()).then_some(mean));
        }
        blocks
    }

    /// The cells of a block.
    fn cells(&self, block: [usize; 2]) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [[a, b], [c, d]] = self.corners(block);
        (b..d).flat_map(move |j| (a..c).map(move |i| [i, j]))
    }

    /// The lowest and the highest node of a block.
    fn corners(&self, block: [usize; 2]) -> [[usize; 2]; 2] {
        let nodes = self.net.placement.nodes;
        let low = block.map(|k| k * self.side);
        [low, [0, 1].map(|c| (low[c] + self.side).min(nodes[c] - 1))]
    }

    /// Upper end of the color scale (°): the largest shear of a cell.
    pub fn top(&self) -> f64 {
        self.net.report.largest_shear.map_or(LEAST, |(s, _)| s.to_degrees().max(LEAST))
    }

    /// What has a color: whole blocks, and the whole cells of the others; lowest node, highest node, ink.
    pub fn tiles(&self) -> Vec<([[usize; 2]; 2], Ink)> {
        let top = self.top();
        let mut tiles = Vec::new();
        for n in 0..self.shear.len() {
            let block = [n % self.count[0], n / self.count[0]];
            let Some(mean) = self.shear[n] else { continue };
            if self.cells(block).all(|cell| degrees(self.net, cell).is_some()) {
                tiles.push((self.corners(block), viridis(mean / top)));
                continue;
            }
            for [i, j] in self.cells(block) {
                if let Some(shear) = degrees(self.net, [i, j]) {
                    tiles.push(([[i, j], [i + 1, j + 1]], viridis(shear / top)));
                }
            }
        }
        tiles
    }

    /// Pieces of the lines on which the blocks' shear has a value (°), in fabric coordinates (m).
    pub fn isoline(&self, level: f64) -> Vec<[[f64; 2]; 2]> {
        let middle = |block: [usize; 2]| {
            let [low, high] = self.corners(block);
            let [low, high] = [low, high].map(|node| self.net.placement.fabric(node));
            [0, 1].map(|c| 0.5 * (low[c] + high[c]))
        };
        let vertex =
            |[k, m]: [usize; 2]| Some((middle([k, m]), self.shear[m * self.count[0] + k]?));
        let mut pieces = Vec::new();
        for m in 1..self.count[1] {
            for k in 1..self.count[0] {
                let ring = [[k - 1, m - 1], [k, m - 1], [k, m], [k - 1, m]].map(vertex);
                let [Some(a), Some(b), Some(c), Some(d)] = ring else { continue };
                // two triangles have no doubtful case
                for triangle in [[a, b, c], [a, c, d]] {
                    let mut ends = Vec::new();
                    for n in 0..3 {
                        let ((p, s), (q, t)) = (triangle[n], triangle[(n + 1) % 3]);
                        if (s < level) != (t < level) {
                            let share = (level - s) / (t - s);
                            ends.push([0, 1].map(|c| p[c] + share * (q[c] - p[c])));
                        }
                    }
                    if let [from, to] = ends[..] {
                        pieces.push([from, to]);
                    }
                }
            }
        }
        pieces
    }

    /// The levels of the color bar's ticks (°) that the map shows as lines.
    pub fn levels(&self) -> Vec<f64> {
        let found = || self.shear.iter().flatten();
        let low = found().copied().fold(f64::INFINITY, f64::min);
        let high = found().copied().fold(0.0, f64::max);
        // a level that the map hardly passes would only draw rounding errors
        let hair = 1e-3 * self.top();
        let passed = |level: &f64| *level > low + hair && *level < high - hair;
        axes::round_numbers(0.0, self.top(), 8.0).into_iter().filter(passed).collect()
    }
}

/// Shear magnitude of a cell (°).
fn degrees(net: &Net, cell: [usize; 2]) -> Option<f64> {
    net.cell_shear(cell).map(|shear| shear.magnitude.to_degrees())
}
