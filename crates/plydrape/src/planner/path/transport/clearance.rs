//! How far an array that is carried stays above the mold, and above the table that it was picked up from.

use super::turn::{Rotation, center, turned};
use crate::bodies::Obstacle;
use crate::clearance::{Poses, from_obstacles};
use crate::geometry::Point;
use crate::geometry::vector::{along, between, distance, norm, sub};
use crate::measure::Name;
use crate::mold::Mold;
use crate::planner::path::tuning::TUNING;
use crate::ply::{Grid, Ply, directions};
use crate::scene::Scene;

/// What a carried array must stay clear of.
#[derive(Debug)]
pub struct Clearance<'a> {
    mold: &'a Mold,
    /// Points of the ply at the start, from the center of the grippers (m): the grippers, and this many between them and
    /// on the overhang.
    points: Vec<Point>,
    /// How many of these points are in a line along u.
    line: usize,
    /// Center of the grippers at the start (m).
    start: Point,
    /// How far the ply hangs below these points (m).
    hang: f64,
    /// Distance to keep (m).
    margin: f64,
    /// Height of a table below the start (m); `None` where the mold is below all of it.
    table: Option<f64>,
    /// How far the start is above the mold (m).
    own: f64,
    /// Height of the highest boundary of the mold that may be below the array on its way (m).
    boundary: f64,
    /// Boxes around the obstacles: lowest and highest coordinates (m).
    obstacles: Vec<[Point; 2]>,
    /// Half of the distance between two points (m): an obstacle may be between them.
    between: f64,
    /// Bodies that must stay clear of what stands in the cell.
    bodies: Option<Carried<'a>>,
}

/// Bodies that are carried with an array.
#[derive(Debug)]
struct Carried<'a> {
    scene: &'a Scene,
    /// Where they are mounted, at the start.
    start: Poses,
    /// Distance to keep (m).
    required: f64,
    /// Their distance at the start (m), as far as it is less than that.
    own: f64,
    /// Height of the highest obstacle (m).
    highest: f64,
}

impl<'a> Carried<'a> {
    /// What the grippers of a scene carry at its start (m), with a margin (m) beside the limit; `None` without bodies or obstacles.
    fn new(scene: &'a Scene, start: &[Point], margin: f64) -> Option<Self> {
        let obstacles = scene.layup.bodies.obstacles();
        if scene.layup.bodies.is_empty() || obstacles.is_empty() {
            return None;
        }
        let poses = Poses::by_neighbors(&scene.layup, &scene.layup.ply.neighbors(), start);
        let required = scene.limits.least(Name::Clearance) + margin;
        let own = from_obstacles(&scene.layup, &poses, required).unwrap_or(required);
        let top = |obstacle: &Obstacle| obstacle.bounds()[1][2];
        let highest = obstacles.iter().map(top).fold(f64::NEG_INFINITY, f64::max);
        Some(Carried { scene, start: poses, required, own, highest })
    }

    /// By how much the array must be higher at most to keep the distance (m), with its center at a place (m) and turned; `from` is
    /// its center at the start (m), and it has `moved` so far (m).
    fn shortfall(&self, from: Point, center: Point, rotation: &Rotation, moved: f64) -> f64 {
        let required = self.required.min(self.own + moved);
        let poses = self.start.carried(from, center, rotation);
        match from_obstacles(&self.scene.layup, &poses, required) {
            // over all that stands there, and no less than the distance lacks: the way is lowered again as far as it may
            Some(distance) if distance < required => {
                let lowest = poses.stems.iter().map(|pose| pose.position[2]);
                let lowest = lowest.fold(f64::INFINITY, f64::min);
                (required - distance).max(self.highest + required - lowest)
            }
            _ => f64::NEG_INFINITY,
        }
    }
}

impl<'a> Clearance<'a> {
    /// For the array of a scene that is carried from its start to another place of its center (m).
    pub fn new(scene: &'a Scene, mold: &'a Mold, start: &[Point], end: Point) -> Self {
        let ply = &scene.layup.ply;
        let overhang = scene.layup.settings.sheet.overhang;
        // the array is carried as a rigid body about its center, with its points and those of the overhang
        let middle = center(start);
        let lines = points(ply, start, overhang);
        let line = lines.first().map_or(0, Vec::len);
        let points: Vec<Point> = lines.into_iter().flatten().map(|p| sub(p, middle)).collect();
        let reach = points.iter().map(|p| norm(*p)).fold(0.0, f64::max);
        // boundaries count where the array can come between start and end, whichever way it turns
        let way = [0, 1].map(|n| {
            let [a, b] = [middle[n], end[n]];
            [a.min(b) - reach, a.max(b) + reach]
        });
        let mut clearance = Clearance {
            mold,
            points,
            line,
            start: middle,
            hang: sag(ply, start).max(beyond(ply, overhang)),
            margin: TUNING.transport.margin * scene.layup.ply.shorter_side(),
            table: None,
            own: f64::INFINITY,
            obstacles: scene.layup.bodies.obstacles().iter().map(Obstacle::bounds).collect(),
            between: 0.5 * scene.layup.ply.shorter_side() / TUNING.transport.divisions as f64,
            bodies: None,
            boundary: highest_boundary(
                mold,
                way,
                TUNING.transport.sampling * scene.layup.ply.shorter_side(),
            ),
        };
        // at its start it has the distance from the mold that it has
        let places: Vec<Point> = clearance.points.iter().map(|p| along(middle, 1.0, *p)).collect();
        clearance.own = clearance.over_mold(&places);
        clearance.bodies = Carried::new(scene, start, clearance.margin);
        // where it starts beside the mold, it starts over a table as high as the ply hangs
        if places.iter().any(|place| clearance.above(*place).is_none()) {
            let lowest = start.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
            clearance.table = Some(lowest - clearance.hang);
        }
        clearance
    }

    /// Whether the ply is above the mold at the start, even if it hangs twice as deep as its lines.
    pub fn starts_clear(&self) -> bool {
        self.own > self.hang
    }

    /// By how much the array, with its center at a place (m) and turned, is too low over the mold and the table (m).
    pub fn shortfall(&self, center: Point, rotation: &Rotation) -> f64 {
        let lowest = self.points.iter().map(|p| along(center, 1.0, turned(rotation, *p))[2]);
        let lowest = lowest.fold(f64::INFINITY, f64::min) - self.hang;
        let over_table = self.table.map_or(f64::NEG_INFINITY, |table| {
            table + self.margin.min(self.moved(center, rotation)) - lowest
        });
        over_table.max(self.shortfall_over_mold(center, rotation))
    }

    /// By how much it is too low over the mold and the obstacles (m), the table that it was picked up from left out. It shall keep the
    /// margin; where it has hardly moved, as much as it had at the start and the distance that it has moved.
    pub fn shortfall_over_mold(&self, center: Point, rotation: &Rotation) -> f64 {
        let required = self.margin.min(self.own + self.moved(center, rotation));
        let places = self.points.iter().map(|p| along(center, 1.0, turned(rotation, *p)));
        let over_mold = required - self.over_mold(&places.collect::<Vec<Point>>());
        match &self.bodies {
            None => over_mold,
            Some(bodies) => {
                let moved = self.moved(center, rotation);
                over_mold.max(bodies.shortfall(self.start, center, rotation, moved))
            }
        }
    }

    /// How far the ply with its points at places (m) is above the mold (m), also at the mold's boundary between two of
    /// them; infinite where there is no mold.
    fn over_mold(&self, places: &[Point]) -> f64 {
        let heights: Vec<Option<f64>> = places.iter().map(|place| self.above(*place)).collect();
        let mut least = heights.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        // the lowest pairs first: where others are too high to be lower over the boundary, they are left out
        let mut pairs = Vec::new();
        for k in 0..places.len() {
            let right = (k + 1) % self.line > 0;
            let next = [right.then_some(k + 1), Some(k + self.line)];
            for n in next.into_iter().flatten().filter(|n| *n < places.len()) {
                let ends = match [heights[k], heights[n]] {
                    [Some(_), None] => [places[k], places[n]],
                    [None, Some(_)] => [places[n], places[k]],
                    _ => continue,
                };
                pairs.push((ends[0][2].min(ends[1][2]) - self.hang - self.boundary, ends));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (lowest, ends) in pairs {
            if lowest >= least {
                break;
            }
            let above = boundary(self.mold, ends).and_then(|place| self.above(place));
            least = least.min(above.unwrap_or(f64::INFINITY));
        }
        least
    }

    /// The farthest that a point of the array has moved in plan (m).
    fn moved(&self, center: Point, rotation: &Rotation) -> f64 {
        let by = sub(center, self.start);
        let moves = self.points.iter().map(|p| along(sub(turned(rotation, *p), *p), 1.0, by));
        moves.map(|d| d[0].hypot(d[1])).fold(0.0, f64::max)
    }

    /// Height of the ply that hangs from a place over what is below it (m), the mold or the box around an obstacle; `None` where there
    /// is neither.
    fn above(&self, place: Point) -> Option<f64> {
        let mold = self.mold.highest_point([place[0], place[1]]).map(|top| top[2]);
        let over = |[low, high]: &&[Point; 2]| {
            (0..2).all(|c| (low[c] - self.between..=high[c] + self.between).contains(&place[c]))
        };
        let obstacles = self.obstacles.iter().filter(over).map(|[_, high]| high[2]);
        let top = obstacles.chain(mold).reduce(f64::max)?;
        Some(place[2] - self.hang - top)
    }
}

/// The place between one over the mold and one beside it, just over the mold's boundary (m).
fn boundary(mold: &Mold, [mut on, mut off]: [Point; 2]) -> Option<Point> {
    let mut found = None;
    for _ in 0..TUNING.transport.boundary_halvings {
        let middle = between(on, off, 0.5);
        if mold.highest_point([middle[0], middle[1]]).is_some() {
            on = middle;
            found = Some(middle);
        } else {
            off = middle;
        }
    }
    found
}

/// Height of the highest boundary of a mold within ranges of x and y, as lines `pitch` apart meet it (m); minus infinity where they
/// meet none.
fn highest_boundary(mold: &Mold, ranges: [[f64; 2]; 2], pitch: f64) -> f64 {
    // a very long way has no more of these lines than samples
    let most = TUNING.transport.most_samples;
    let [nx, ny] =
        ranges.map(|[low, high]| (((high - low) / pitch).ceil().max(1.0) as usize).min(most));
    let node = |i: usize, j: usize| {
        let [x, y] = [(0, i, nx), (1, j, ny)].map(|(n, k, count)| {
            let [low, high] = ranges[n];
            low + (high - low) * k as f64 / count as f64
        });
        [x, y, 0.0]
    };
    // which nodes of a grid see the mold from above
    let line = |j: usize| -> Vec<bool> {
        (0..=nx).map(|i| mold.highest_point([node(i, j)[0], node(i, j)[1]]).is_some()).collect()
    };
    let lines: Vec<Vec<bool>> = (0..=ny).map(line).collect();
    // a boundary passes between neighbors of which only one sees it: bisect there
    let mut highest = f64::NEG_INFINITY;
    for j in 0..=ny {
        for i in 0..=nx {
            for (k, l) in [(i + 1, j), (i, j + 1)].into_iter().filter(|(k, l)| *k <= nx && *l <= ny)
            {
                let ends = match [lines[j][i], lines[l][k]] {
                    [true, false] => [node(i, j), node(k, l)],
                    [false, true] => [node(k, l), node(i, j)],
                    _ => continue,
                };
                let place = boundary(mold, ends).and_then(|p| mold.highest_point([p[0], p[1]]));
                highest = highest.max(place.map_or(f64::NEG_INFINITY, |place| place[2]));
            }
        }
    }
    highest
}

/// Points of the ply as its array is at the start, as lines along u: a few each cell between its lowest and highest fabric
/// coordinates (m). Between grippers that are an array along the yarns they are bilinear, elsewhere where the array as a whole
/// puts them.
fn points(ply: &Ply, places: &[Point], overhang: f64) -> Vec<Vec<Point>> {
    let [low, high] = ply.bounds(overhang);
    let [inner_low, inner_high] = ply.held_bounds();
    // coordinates divide cells evenly, and the overhang adds one at each end
    let axis = |n: usize| -> Vec<f64> {
        let size = inner_high[n] - inner_low[n];
        let parts = (size / ply.cell[n] * TUNING.transport.divisions as f64).round();
        let inner = (0..=parts as usize).map(|k| inner_low[n] + k as f64 / parts.max(1.0) * size);
        let mut axis: Vec<f64> = inner.collect();
        if low[n] < inner_low[n] {
            axis.insert(0, low[n]);
        }
        if high[n] > inner_high[n] {
            axis.push(high[n]);
        }
        axis
    };
    let (u, v) = (axis(0), axis(1));
    // cups without a grid only say where the array as a whole is and how it is turned
    let at: Box<dyn Fn(f64, f64) -> Point> = match ply.grid {
        Grid::NONE => {
            let (middle, [along_u, along_v]) = (center(places), directions(ply, places));
            let count = places.len() as f64;
            let own =
                [0, 1].map(|n| (0..places.len()).map(|k| ply.place(k)[n]).sum::<f64>() / count);
            Box::new(move |u, v| {
                let p = along(middle, u - own[0], along_u);
                along(p, v - own[1], along_v)
            })
        }
        grid => Box::new(move |u, v| bilinear(grid, places, [u / ply.cell[0], v / ply.cell[1]])),
    };
    v.iter().map(|v| u.iter().map(|u| at(*u, *v)).collect()).collect()
}

/// The place (m) at a share of cells between the grippers of an array; beyond them its outermost cells go on.
pub fn bilinear(grid: Grid, places: &[Point], [u, v]: [f64; 2]) -> Point {
    let cell = |x: f64, count: usize| (x.max(0.0) as usize).min(count.saturating_sub(2));
    let (i, j) = (cell(u, grid.nu), cell(v, grid.nv));
    let place = |i: usize, j: usize| places[grid.index([i.min(grid.nu - 1), j.min(grid.nv - 1)])];
    let line = |j: usize| {
        let (a, b) = (place(i, j), place(i + 1, j));
        along(a, u - i as f64, sub(b, a))
    };
    let (a, b) = (line(j), line(j + 1));
    along(a, if v.is_finite() { v - j as f64 } else { 0.0 }, sub(b, a))
}

/// How far a cell hangs below its grippers (m) if it does not shear: its middle hangs below the middles of two of its edges as an edge
/// along the other direction does, each as a parabola, `f² = 3/8 ℓ (L − ℓ)`. A heavy ply that shears hangs up to 1.3 times as deep.
fn sag(ply: &Ply, places: &[Point]) -> f64 {
    let mut largest = [0.0_f64; 2];
    for pair in ply.neighbors() {
        let [a, b] = pair.grippers.map(|n| places[n]);
        let [p, q] = pair.grippers.map(|n| ply.place(n));
        let way = [q[0] - p[0], q[1] - p[1]];
        let (chord, length) = (distance(a, b), ply.length_factor * way[0].hypot(way[1]));
        let sag = (0.375 * chord * (length - chord).max(0.0)).sqrt();
        let most = &mut largest[usize::from(way[1].abs() > way[0].abs())];
        *most = most.max(sag);
    }
    largest[0] + largest[1]
}

/// How far fabric reaches beyond the outermost grippers at most (m): so far may it hang.
fn beyond(ply: &Ply, overhang: f64) -> f64 {
    let ([low, high], [from, to]) = (ply.bounds(overhang), ply.held_bounds());
    [0, 1].map(|n| (from[n] - low[n]).max(high[n] - to[n])).into_iter().fold(0.0, f64::max)
}
