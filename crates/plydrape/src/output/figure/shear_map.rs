//! The shear map of a net: on the mold in 3D, and on the flat fabric with lines of equal shear.
//!
//! A cell has the colour of its shear magnitude. Of large nets, blocks of cells share a colour, their
//! mean. Where the net has no nodes nothing is drawn.

use super::FigureError;
use super::axes::{self, Frame, LABEL, ROOM, TICK, plain};
use super::bar::bar;
use super::canvas::{self, Canvas, Ink, Px, Type};
use super::colour::{BLACK, DARK, FRAME, RED, WEAVE, viridis};
use super::layout::{bounds, ground, heading, title};
use super::panel::Ground;
use super::piece::{self, Form, Piece, grown, thread};
use super::projection::{Point, View};
use super::relief::BACK;
use crate::mold::Mold;
use crate::net::Net;

/// Width of the sheet, and where the panels end and the colour bar begins (picture points).
const WIDTH: f64 = 900.0;
const PANELS: f64 = 800.0;
/// Most height of the box in 3D and of the flat fabric, most width of the latter (picture points).
const BOX: f64 = 400.0;
const FLAT: Px = [600.0, 320.0];
/// Height of the head and of a further line in it, of a panel's title and of the legend (picture points).
const HEAD: f64 = 72.0;
const LINE: f64 = 16.0;
const TITLE: f64 = 20.0;
const LEGEND: f64 = 42.0;
/// Most blocks that have a colour of their own, and most fabric lines drawn each way.
const BLOCKS: f64 = 6000.0;
const LINES: usize = 24;
/// The colour scale reaches at least to here (°), so that rounding errors have no colour.
const LEAST: f64 = 0.5;
/// Cells whose shear differs by no more than this (°) shear alike.
const ALIKE: f64 = 0.05;
/// How far the mold is drawn beyond the net, as a share of the width.
const MARGIN: f64 = 0.06;
const WHITE: Ink = Ink([255; 3], 1.0);

/// Shear by block of cells, in degrees.
struct Blocks<'a> {
    net: &'a Net,
    /// Cells of a block along each side; less at the far rims.
    side: usize,
    /// Blocks along u and v.
    count: [usize; 2],
    /// Mean of each block's whole cells, u running fastest.
    shear: Vec<Option<f64>>,
}

/// The shear map of a net on its mold, as an SVG 900 points wide.
///
/// # Errors
/// [`FigureError`] if the net has no node with a place, or the writer fails.
pub fn svg(net: &Net, mold: &Mold, name: &str) -> Result<String, FigureError> {
    let nodes: Vec<Point> = net.nodes.iter().flatten().copied().collect();
    if nodes.is_empty() {
        return Err(FigureError::NoNode);
    }
    let frame = Box3::of(&nodes, mold);
    let unit = View::of(frame.low, frame.high, 1.0);
    let [from, to] = unit.extent(frame.low, frame.high);
    let room = [PANELS - ROOM[0] - ROOM[2], BOX];
    let scale = (room[0] / (to[0] - from[0])).min(room[1] / (to[1] - from[1]));
    let first = TITLE + ROOM[1] + (to[1] - from[1]) * scale + ROOM[3];

    let blocks = Blocks::of(net);
    let whole = blocks.shear.iter().any(Option::is_some);
    let fabric = [0, 1].map(|c| (net.layup.nodes[c] - 1) as f64 * net.layup.mesh[c]);
    let flat = if whole { (FLAT[0] / fabric[0]).min(FLAT[1] / fabric[1]) } else { 0.0 };
    let second = if whole { TITLE + ROOM[1] + fabric[1] * flat + ROOM[3] } else { 0.0 };
    let absent = absent(net);
    let head = if absent.is_empty() { HEAD } else { HEAD + LINE };
    let size = [WIDTH, (head + first + second + LEGEND).ceil()];

    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, size)?;
    canvas.text(&title(name), [28.0, 26.0], heading(17.0))?;
    canvas.text(&figures(net), [28.0, 49.0], plain(12.5, -1))?;
    canvas.text(&absent, [28.0, 49.0 + LINE], plain(12.5, -1))?;
    let top = blocks.top();

    // On the mold.
    canvas.text("on the mold", [28.0, head + 12.0], heading(14.0))?;
    let free = room[0] - (to[0] - from[0]) * scale;
    let corner = [ROOM[0] + free / 2.0, head + TITLE + ROOM[1]];
    let origin = [corner[0] - scale * from[0], corner[1] - scale * from[1]];
    frame.draw(&mut canvas, &unit.placed(scale, origin), &blocks)?;

    // On the flat fabric.
    if whole {
        let y = head + first;
        canvas.text("on the flat fabric", [28.0, y + 12.0], heading(14.0))?;
        let left = (PANELS - fabric[0] * flat) / 2.0;
        let map = Map { left, bottom: y + TITLE + ROOM[1] + fabric[1] * flat, scale: flat, fabric };
        map.draw(&mut canvas, &blocks)?;
        let between = [head + 40.0, size[1] - LEGEND - 24.0];
        bar(&mut canvas, "shear (deg)", [0.0, top], PANELS + 24.0, between)?;
    }
    legend(&mut canvas, net, size[1] - LEGEND / 2.0 - 4.0)?;
    canvas.finish()?;
    Ok(canvas::at_size(&text, size))
}

/// The part of the mold around a net that its map shows, in polygons (m).
pub(in crate::output) fn patch(net: &Net, mold: &Mold) -> Vec<Vec<Point>> {
    let nodes: Vec<Point> = net.nodes.iter().flatten().copied().collect();
    if nodes.is_empty() {
        return Vec::new();
    }
    match Box3::of(&nodes, mold).ground {
        Some(Ground::Flat(corners)) => vec![corners.to_vec()],
        Some(Ground::Relief(relief)) => relief.outlines(),
        None => Vec::new(),
    }
}

/// The key figures in one line.
fn figures(net: &Net) -> String {
    let ([nu, nv], [du, dv]) = (net.layup.nodes, net.layup.mesh.map(|d| d * 1e3));
    let width = |d: f64| axes::label((d * 1e3).round() / 1e3);
    let mesh = if (du - dv).abs() < 1e-9 * du {
        width(du)
    } else {
        format!("{} × {}", width(du), width(dv))
    };
    let mut parts = vec![format!("{nu} × {nv} nodes, mesh {mesh} mm")];
    if let Some((largest, cell)) = net.report.largest_shear {
        let [u, v] = [0, 1].map(|c| (cell[c] as f64 + 0.5) * net.layup.mesh[c] * 1e3);
        let [largest, mean] = [largest, net.report.mean_shear].map(f64::to_degrees);
        if marked(net).is_some() {
            parts.push(format!("largest shear {largest:.1}° at u = {u:.0} mm, v = {v:.0} mm"));
            parts.push(format!("mean {mean:.1}°"));
        } else {
            parts.push(format!("shear {mean:.1}° everywhere"));
        }
    }
    parts.join("  ·  ")
}

/// How many nodes have no place on the mold, and why.
fn absent(net: &Net) -> String {
    let report = &net.report;
    let missing = [
        (report.off_mold, "off the mold"),
        (report.folded, "folded"),
        (report.unreached, "behind a fold"),
    ];
    let some = missing.iter().filter(|m| m.0 > 0);
    let parts: Vec<String> = some.map(|(count, what)| format!("{count} nodes {what}")).collect();
    parts.join("  ·  ")
}

impl<'a> Blocks<'a> {
    fn of(net: &'a Net) -> Self {
        let cells = net.layup.nodes.map(|n| n - 1);
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
        let nodes = self.net.layup.nodes;
        let low = block.map(|k| k * self.side);
        [low, [0, 1].map(|c| (low[c] + self.side).min(nodes[c] - 1))]
    }

    /// Upper end of the colour scale (°): the largest shear of a cell.
    fn top(&self) -> f64 {
        self.net.report.largest_shear.map_or(LEAST, |(s, _)| s.to_degrees().max(LEAST))
    }

    /// What has a colour: whole blocks, and the whole cells of the others; lowest node, highest node, ink.
    fn tiles(&self) -> Vec<([[usize; 2]; 2], Ink)> {
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
    fn isoline(&self, level: f64) -> Vec<[[f64; 2]; 2]> {
        let middle = |block: [usize; 2]| {
            let [low, high] = self.corners(block);
            [0, 1].map(|c| 0.5 * (low[c] + high[c]) as f64 * self.net.layup.mesh[c])
        };
        let at = |[k, m]: [usize; 2]| Some((middle([k, m]), self.shear[m * self.count[0] + k]?));
        let mut pieces = Vec::new();
        for m in 1..self.count[1] {
            for k in 1..self.count[0] {
                let ring = [[k - 1, m - 1], [k, m - 1], [k, m], [k - 1, m]].map(at);
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

    /// The levels of the colour bar's ticks (°) that the map shows as lines.
    fn levels(&self) -> Vec<f64> {
        let found = || self.shear.iter().flatten();
        let low = found().copied().fold(f64::INFINITY, f64::min);
        let high = found().copied().fold(0.0, f64::max);
        // a level that the map hardly passes would only draw rounding errors
        let hair = 1e-3 * self.top();
        let passed = |level: &f64| *level > low + hair && *level < high - hair;
        axes::round(0.0, self.top(), 8.0).into_iter().filter(passed).collect()
    }
}

/// Shear magnitude of a cell (°).
fn degrees(net: &Net, cell: [usize; 2]) -> Option<f64> {
    net.cell_shear(cell).map(|shear| shear.magnitude.to_degrees())
}

/// The box around the net in 3D, and the mold in it.
struct Box3 {
    low: Point,
    high: Point,
    ground: Option<Ground>,
}

impl Box3 {
    fn of(nodes: &[Point], mold: &Mold) -> Self {
        let [mut low, mut high] = bounds(nodes);
        let reach = MARGIN * (high[0] - low[0]).hypot(high[1] - low[1]).max(1e-3);
        for c in 0..2 {
            low[c] -= reach;
            high[c] += reach;
        }
        let across = (high[0] - low[0]).hypot(high[1] - low[1]);
        let ground = ground(mold, low, high, across);
        if let Some([floor, roof]) = ground.as_ref().map(Ground::heights) {
            low[2] = low[2].min(floor);
            high[2] = high[2].max(roof);
        }
        let least = 0.05 * across;
        if high[2] - low[2] < least {
            high[2] = low[2] + least;
        }
        Box3 { low, high, ground }
    }

    fn draw(&self, canvas: &mut Canvas, view: &View, blocks: &Blocks) -> Result<(), FigureError> {
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
        let line = net.layup.nodes.contains(&1);
        let (ink, width) = if line { (RED, 1.7) } else { (WEAVE, 0.7) };
        let lift = 1.5 * blocks.side as f64 * net.layup.mesh[0].max(net.layup.mesh[1]);
        for way in fabric_lines(net) {
            for pair in way.windows(2) {
                if let [Some(a), Some(b)] = [node(pair[0]), node(pair[1])] {
                    thread(&mut pieces, view, &[a, b], lift, ink, width);
                }
            }
        }
        match &self.ground {
            Some(Ground::Relief(relief)) => relief.paint_among(canvas, view, pieces)?,
            Some(Ground::Flat(patch)) => {
                canvas.polygon(&patch.map(|p| view.at(p)), super::colour::MOLD)?;
                piece::paint(canvas, pieces)?;
            }
            None => piece::paint(canvas, pieces)?,
        }

        for (name, way) in seed_ways(net) {
            let path: Vec<Px> = way.iter().map_while(|id| node(*id)).map(|p| view.at(p)).collect();
            arrow(canvas, &path, name)?;
        }
        if let Some(seed) = node(net.layup.seed) {
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
    let nodes = net.layup.nodes;
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

/// The fabric from the seed on, a sixth of the net along u and along v, or against it where u or v ends.
fn seed_ways(net: &Net) -> Vec<(&'static str, Vec<[usize; 2]>)> {
    let (nodes, seed) = (net.layup.nodes, net.layup.seed);
    let way = |(c, name): (usize, &'static str)| {
        let wanted = (nodes[c] / 6).max(1);
        // beside the far rim the arrow leads to the seed
        let from = seed[c].min((nodes[c] - 1).saturating_sub(wanted));
        let to = (from + wanted).min(nodes[c] - 1);
        let at = |n: usize| if c == 0 { [n, seed[1]] } else { [seed[0], n] };
        (name, (from..=to).map(at).collect())
    };
    [(0, "u"), (1, "v")].into_iter().map(way).collect()
}

/// The largest shear (°) and its cell, unless all cells shear alike.
fn marked(net: &Net) -> Option<(f64, [usize; 2])> {
    let alike = net.report.mean_shear.to_degrees() + ALIKE;
    net.report.largest_shear.map(|(s, cell)| (s.to_degrees(), cell)).filter(|(s, _)| *s > alike)
}

/// Where the flat fabric is on the sheet.
struct Map {
    left: f64,
    bottom: f64,
    /// Picture points per metre.
    scale: f64,
    /// Lengths along u and v (m).
    fabric: [f64; 2],
}

impl Map {
    fn at(&self, [u, v]: [f64; 2]) -> Px {
        [self.left + u * self.scale, self.bottom - v * self.scale]
    }

    fn draw(&self, canvas: &mut Canvas, blocks: &Blocks) -> Result<(), FigureError> {
        let net = blocks.net;
        let place = |id: [usize; 2]| [0, 1].map(|c| id[c] as f64 * net.layup.mesh[c]);
        for ([low, high], ink) in blocks.tiles() {
            let ([x0, y0], [x1, y1]) = (self.at(place(low)), self.at(place(high)));
            // each reaches a hair over its neighbours, so that no seam shows
            let (x1, y1) = (x1 + 0.3, y1 - 0.3);
            canvas.polygon(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], ink)?;
        }
        for level in blocks.levels() {
            for piece in blocks.isoline(level) {
                canvas.line(&piece.map(|p| self.at(p)), Ink([255; 3], 0.8), 0.8)?;
            }
        }

        // The fabric's rim, ticks and labels.
        let [u, v] = self.fabric;
        let ring = [[0.0, 0.0], [u, 0.0], [u, v], [0.0, v], [0.0, 0.0]].map(|p| self.at(p));
        canvas.line(&ring, FRAME, 1.0)?;
        let most = |length: f64, room: f64| (length * self.scale / room).clamp(2.0, 10.0);
        for tick in axes::ticks(0.0, u, most(u, 56.0)) {
            let [x, y] = self.at([tick * 1e-3, 0.0]);
            canvas.line(&[[x, y], [x, y + 4.0]], FRAME, 1.0)?;
            canvas.text(&axes::label(tick), [x, y + 13.0], plain(TICK, 0))?;
        }
        for tick in axes::ticks(0.0, v, most(v, 34.0)) {
            let [x, y] = self.at([0.0, tick * 1e-3]);
            canvas.line(&[[x - 4.0, y], [x, y]], FRAME, 1.0)?;
            canvas.text(&axes::label(tick), [x - 8.0, y], plain(TICK, 1))?;
        }
        let [x, y] = self.at([u / 2.0, 0.0]);
        canvas.text("u (mm)", [x, y + 34.0], plain(LABEL, 0))?;
        let [x, y] = self.at([0.0, v]);
        canvas.text("v (mm)", [x, y - 16.0], plain(LABEL, 1))?;

        for (name, way) in seed_ways(net) {
            let ends = [way[0], way[way.len() - 1]];
            arrow(canvas, &ends.map(|id| self.at(place(id))), name)?;
        }
        dot(canvas, self.at(place(net.layup.seed)))?;
        if let Some((largest, cell)) = marked(net) {
            let middle = [0, 1].map(|c| (cell[c] as f64 + 0.5) * net.layup.mesh[c]);
            mark(canvas, self.at(middle), &format!("{largest:.1}°"))?;
        }
        Ok(())
    }
}

/// A line with a head at its end and its name beyond it, readable on every colour.
fn arrow(canvas: &mut Canvas, path: &[Px], name: &str) -> Result<(), FigureError> {
    let [.., before, tip] = path else { return Ok(()) };
    let size = (tip[0] - before[0]).hypot(tip[1] - before[1]).max(1e-9);
    let along = [0, 1].map(|c| (tip[c] - before[c]) / size);
    let place = |ahead: f64, aside: f64| {
        [tip[0] + ahead * along[0] - aside * along[1], tip[1] + ahead * along[1] + aside * along[0]]
    };
    let head = |grow: f64| {
        [place(1.0 + grow, 0.0), place(-8.0 - grow, 4.0 + grow), place(-8.0 - grow, -4.0 - grow)]
    };
    canvas.line(path, WHITE, 3.4)?;
    canvas.polygon(&head(1.4), WHITE)?;
    canvas.line(path, BLACK, 1.6)?;
    canvas.polygon(&head(0.0), BLACK)?;
    badge(canvas, place(13.0, 0.0), name)
}

/// The seed.
fn dot(canvas: &mut Canvas, at: Px) -> Result<(), FigureError> {
    disc(canvas, at, 5.2, WHITE)?;
    disc(canvas, at, 4.0, BLACK)
}

/// The place of the largest shear, and how large it is.
fn mark(canvas: &mut Canvas, at: Px, value: &str) -> Result<(), FigureError> {
    canvas.circle(at, 5.0, WHITE, 3.6)?;
    canvas.circle(at, 5.0, RED, 1.8)?;
    let half = 3.4 * value.chars().count() as f64;
    // beside the mark, on the side with room
    let side = if at[0] + 2.0 * half + 20.0 < PANELS { 1.0 } else { -1.0 };
    badge(canvas, [at[0] + side * (10.0 + half), at[1]], value)
}

/// A short text on a light ground.
fn badge(canvas: &mut Canvas, at: Px, text: &str) -> Result<(), FigureError> {
    let half = [3.4 * text.chars().count() as f64 + 2.5, 7.5];
    let corner = |x: f64, y: f64| [at[0] + x * half[0], at[1] + y * half[1]];
    let ring = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    canvas.polygon(&ring, Ink([255; 3], 0.82))?;
    canvas.text(text, at, Type { size: 12.0, bold: true, ink: DARK, side: 0 })
}

fn disc(canvas: &mut Canvas, [x, y]: Px, radius: f64, ink: Ink) -> Result<(), FigureError> {
    let ring: Vec<Px> = (0..24)
        .map(|k| (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos())
        .map(|(s, c)| [x + radius * c, y + radius * s])
        .collect();
    canvas.polygon(&ring, ink)
}

/// What the marks mean, in one line.
fn legend(canvas: &mut Canvas, net: &Net, y: f64) -> Result<(), FigureError> {
    let word = |canvas: &mut Canvas, text: &str, x: f64| canvas.text(text, [x, y], plain(12.5, -1));
    let mut x = 28.0;
    dot(canvas, [x + 5.0, y])?;
    word(canvas, "seed; arrows lead along u and v", x + 17.0)?;
    x += 232.0;
    if marked(net).is_some() {
        canvas.circle([x + 5.0, y], 5.0, RED, 1.8)?;
        word(canvas, "largest shear", x + 17.0)?;
        x += 126.0;
    }
    if !net.missing.is_empty() {
        let ring = [[0.0, -5.0], [10.0, -5.0], [10.0, 5.0], [0.0, 5.0], [0.0, -5.0]];
        canvas.line(&ring.map(|[dx, dy]| [x + dx, y + dy]), FRAME, 1.0)?;
        word(canvas, "no place on the mold", x + 17.0)?;
    }
    Ok(())
}
