//! A ply as it is cut, and the cups that hold it.

use super::{Direction, Grid, GripperId, Lines, Outline, Ply};
use crate::geometry::ring;
use crate::geometry::rotation::of_tangents;
use crate::geometry::vector::{along, mean, sub, unit};

/// A ply that is cut to an outline and held where cups are.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Cut {
    /// Boundary and holes, in fabric coordinates (m).
    pub outline: Outline,
    /// The cups that hold it; none of them where the ply's grid says where they are.
    pub held: Vec<Held>,
    /// Angle from the drawing's x axis to u (rad).
    pub angle: f64,
    /// Angle from u to the rows of the array of cups (rad).
    pub turn: f64,
    /// Where the drawing has the first gripper (m).
    pub origin: [f64; 2],
}

/// A cup that holds the ply.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Held {
    /// Column and row in the array; of a list of cups its number, and 0.
    pub id: GripperId,
    /// Fabric coordinates of its middle (m).
    pub place: [f64; 2],
}

/// Two neighboring grippers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbors {
    /// Their indices.
    pub grippers: [usize; 2],
    /// The yarns that run from one to the other; `None` where their line crosses the yarns.
    pub fiber: Option<Direction>,
    /// Whether no gripper is farther out on one of its sides.
    pub border: bool,
}

impl Cut {
    /// Fabric coordinates (m) of a point of the drawing (m).
    #[must_use]
    pub fn fabric(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ((sin, cos), [a, b]) = (self.angle.sin_cos(), self.origin);
        let (x, y) = (x - a, y - b);
        [cos * x + sin * y, cos * y - sin * x]
    }

    /// A fabric point (m) as the drawing has it (m).
    #[must_use]
    pub fn drawn(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let ((sin, cos), [x, y]) = (self.angle.sin_cos(), self.origin);
        [x + cos * u - sin * v, y + sin * u + cos * v]
    }
}

impl Ply {
    /// How many grippers hold it.
    #[must_use]
    pub fn grippers(&self) -> usize {
        self.held().map_or(self.grid.grippers(), <[Held]>::len)
    }

    /// Grippers in rows: its array, or one row of all of them where they are no whole array along the yarns.
    #[must_use]
    pub fn rows(&self) -> Grid {
        self.held().map_or(self.grid, |held| Grid { nu: held.len(), nv: 1 })
    }

    /// Cups, where they are no array along the yarns.
    fn held(&self) -> Option<&[Held]> {
        self.cut.as_ref().map(|cut| cut.held.as_slice()).filter(|held| !held.is_empty())
    }

    /// The gripper at a position of all per-gripper arrays.
    #[must_use]
    pub fn id(&self, index: usize) -> GripperId {
        self.held().map_or_else(|| self.grid.id(index), |held| held[index].id)
    }

    /// Position of a gripper in all per-gripper arrays; `None` for one that does not hold the ply.
    #[must_use]
    pub fn index(&self, id: GripperId) -> Option<usize> {
        match self.held() {
            Some(held) => held.iter().position(|gripper| gripper.id == id),
            None => {
                let Grid { nu, nv } = self.grid;
                (id[0] < nu && id[1] < nv).then(|| self.grid.index(id))
            }
        }
    }

    /// Fabric coordinates of a gripper (m).
    #[must_use]
    pub fn place(&self, index: usize) -> [f64; 2] {
        match self.held() {
            Some(held) => held[index].place,
            None => {
                let id = self.grid.id(index);
                [0, 1].map(|n| id[n] as f64 * self.cell[n])
            }
        }
    }

    /// Fabric coordinates of the lowest and the highest gripper along u and along v (m).
    #[must_use]
    pub fn held_bounds(&self) -> [[f64; 2]; 2] {
        let places: Vec<[f64; 2]> = (0..self.grippers()).map(|n| self.place(n)).collect();
        ring::bounds(&places)
    }

    /// Fabric coordinates of its middle (m): that of the box around the drawing of a ply that is cut, whatever way its yarns
    /// run and wherever it is held; else halfway between the outermost grippers.
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        let halfway = |[low, high]: [[f64; 2]; 2]| [0, 1].map(|n| 0.5 * (low[n] + high[n]));
        match &self.cut {
            Some(cut) => cut.fabric(halfway(cut.outline.moved(|point| cut.drawn(point)).bounds())),
            None => halfway(self.held_bounds()),
        }
    }

    /// Fabric coordinates of its lowest and highest points along u and along v (m); `overhang` (m) is what a rectangle has
    /// beyond its outermost grippers.
    #[must_use]
    pub fn bounds(&self, overhang: f64) -> [[f64; 2]; 2] {
        match &self.cut {
            Some(cut) => cut.outline.bounds(),
            None => {
                let [low, high] = self.held_bounds();
                // a strip has its width from its cell
                let beyond =
                    [self.grid.nu, self.grid.nv].map(|n| if n > 1 { overhang } else { 0.0 });
                [[0, 1].map(|n| low[n] - beyond[n]), [0, 1].map(|n| high[n] + beyond[n])]
            }
        }
    }

    /// The grippers next to each other: along the columns and rows of an array to the next cup that holds, in a list those
    /// with no third one between them (Gabriel and Sokal 1969).
    #[must_use]
    pub fn neighbors(&self) -> Vec<Neighbors> {
        let pairs: Vec<[usize; 2]> = match self.held() {
            None => {
                let lines = Lines::array(self.grid, self.cell);
                (0..lines.edges()).map(|edge| lines.ends(edge)).collect()
            }
            Some(held) if held.iter().any(|gripper| gripper.id[1] > 0) => next_in_lines(held),
            Some(held) => next_in_list(held),
        };
        let neighbors_of = |[a, b]: [usize; 2]| {
            let [p, q] = [a, b].map(|n| self.place(n));
            let way = [q[0] - p[0], q[1] - p[1]];
            let length = way[0].hypot(way[1]);
            let along = |n: usize| way[1 - n].abs() <= 1e-9 * length;
            let fiber = match [along(0), along(1)] {
                [true, _] => Some(Direction::U),
                [_, true] => Some(Direction::V),
                _ => None,
            };
            Neighbors { grippers: [a, b], fiber, border: self.is_border([p, q]) }
        };
        pairs.into_iter().map(neighbors_of).collect()
    }

    /// Whether the strip across the line between two grippers has grippers on one of its sides at most.
    fn is_border(&self, [p, q]: [[f64; 2]; 2]) -> bool {
        let way = [q[0] - p[0], q[1] - p[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let mut sides = [false; 2];
        for place in (0..self.grippers()).map(|n| self.place(n)) {
            let off = [place[0] - p[0], place[1] - p[1]];
            let along = (off[0] * way[0] + off[1] * way[1]) / square;
            let across = (way[0] * off[1] - way[1] * off[0]) / square;
            if (-1e-9..=1.0 + 1e-9).contains(&along) && across.abs() > 1e-9 {
                sides[usize::from(across > 0.0)] = true;
            }
        }
        sides != [true; 2]
    }
}

/// Unit tangents of u and v at a gripper, from the ways to its neighbors at positions (m), by least squares; across a
/// single line of grippers the ply is level.
#[must_use]
pub fn tangents(
    ply: &Ply,
    neighbors: &[Neighbors],
    positions: &[[f64; 3]],
    gripper: usize,
) -> [[f64; 3]; 2] {
    let shares = tangent_shares(ply, neighbors, gripper);
    shares.tangents(|other| sub(positions[other], positions[gripper]))
}

/// Orientation (x, y, z, w) of each gripper by the lines to its neighbors at positions (m), whatever the ply between them does.
#[must_use]
pub fn orientations(ply: &Ply, neighbors: &[Neighbors], positions: &[[f64; 3]]) -> Vec<[f64; 4]> {
    let orientation = |n: usize| {
        let [u, v] = tangents(ply, neighbors, positions, n);
        of_tangents(u, v)
    };
    (0..positions.len()).map(orientation).collect()
}

/// How the tangents of u and v at a gripper follow from the ways to its neighbors: [`tangents`] are along the sums.
#[must_use]
pub fn tangent_shares(ply: &Ply, neighbors: &[Neighbors], gripper: usize) -> Shares {
    let beside = neighbors.iter().filter(|pair| pair.grippers.contains(&gripper));
    let others = beside.map(|pair| pair.grippers[usize::from(pair.grippers[0] == gripper)]);
    Shares::new(ply, others, ply.place(gripper))
}

/// Unit vectors along u and v of all grippers at positions (m), by least squares; across a single line of grippers the ply is level.
#[must_use]
pub fn directions(ply: &Ply, positions: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let (middle, all) = (mean(positions), 0..positions.len());
    let count = positions.len() as f64;
    let origin = [0, 1].map(|c| all.clone().map(|n| ply.place(n)[c]).sum::<f64>() / count);
    Shares::new(ply, all, origin).tangents(|n| sub(positions[n], middle))
}

/// How tangents of the ply follow from ways to grippers, by least squares.
#[derive(Debug, Clone, PartialEq)]
pub struct Shares {
    /// Grippers, each with the shares (1/m) of the way to it in the tangents of u and v.
    pub grippers: Vec<(usize, [f64; 2])>,
    /// The unit vector (u, v) of the line on which all of them are in the fabric; `None` if they are on no line.
    pub line: Option<[f64; 2]>,
}

impl Shares {
    /// The shares of grippers that are seen from a place in the fabric (m).
    fn new(ply: &Ply, grippers: impl Iterator<Item = usize>, [u, v]: [f64; 2]) -> Self {
        let offset = |n: usize| (n, [ply.place(n)[0] - u, ply.place(n)[1] - v]);
        let ways: Vec<(usize, [f64; 2])> = grippers.map(offset).collect();
        let moment = |a: usize, b: usize| ways.iter().map(|(_, way)| way[a] * way[b]).sum::<f64>();
        let (uu, uv, vv) = (moment(0, 0), moment(0, 1), moment(1, 1));
        let (square, determinant) = (uu + vv, uu * vv - uv * uv);
        let (inverse, line) = if determinant > 1e-9 * square * square {
            ([[vv, -uv], [-uv, uu]].map(|row| row.map(|c| c / determinant)), None)
        } else {
            let [a, b] = if uu >= vv { [uu, uv] } else { [uv, vv] };
            let size = a.hypot(b);
            let line = if size > 0.0 { [a / size, b / size] } else { [1.0, 0.0] };
            (line.map(|a| line.map(|b| a * b / square)), Some(line))
        };
        let share = |(n, [u, v]): (usize, [f64; 2])| (n, inverse.map(|[a, b]| a * u + b * v));
        Shares { grippers: ways.into_iter().map(share).collect(), line }
    }

    /// Unit tangents of u and v, from the way in space to each gripper (m).
    fn tangents(&self, way: impl Fn(usize) -> [f64; 3]) -> [[f64; 3]; 2] {
        let [u, v] = [0, 1].map(|d| {
            let add = |sum, (n, shares): &(usize, [f64; 2])| along(sum, shares[d], way(*n));
            self.grippers.iter().fold([0.0; 3], add)
        });
        let left = |way: [f64; 3]| unit([-way[1], way[0], 0.0]).unwrap_or([0.0, 1.0, 0.0]);
        let direction = |sum| unit(sum).unwrap_or([1.0, 0.0, 0.0]);
        let Some([cos, sin]) = self.line else {
            return [direction(u), unit(v).unwrap_or(left(direction(u)))];
        };
        let line = direction(along(u.map(|c| cos * c), sin, v));
        [[cos, -sin], [sin, cos]].map(|[a, b]| along(line.map(|c| a * c), b, left(line)))
    }
}

/// For each cup the next one that holds along its row and along its column: all rows first.
fn next_in_lines(held: &[Held]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for axis in 0..2 {
        for (n, gripper) in held.iter().enumerate() {
            let ahead = held.iter().enumerate().filter(|(_, other)| {
                other.id[1 - axis] == gripper.id[1 - axis] && other.id[axis] > gripper.id[axis]
            });
            pairs.extend(ahead.min_by_key(|(_, other)| other.id[axis]).map(|(m, _)| [n, m]));
        }
    }
    pairs
}

/// Pairs of cups with no third one in the circle that has both at its ends.
fn next_in_list(held: &[Held]) -> Vec<[usize; 2]> {
    let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    let mut pairs = Vec::new();
    for (n, a) in held.iter().enumerate() {
        for (m, b) in held.iter().enumerate().skip(n + 1) {
            let whole = square(a.place, b.place) * (1.0 + 1e-9);
            let between = |c: &Held| square(a.place, c.place) + square(b.place, c.place) <= whole;
            let free = held.iter().enumerate().all(|(k, c)| k == n || k == m || !between(c));
            if free {
                pairs.push([n, m]);
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ply::cloth;

    fn ply(held: Vec<Held>) -> Ply {
        let outline = Outline::rectangle([-1.0; 2], [1.0; 2]).unwrap();
        let cut = Cut { outline, held, angle: 0.0, turn: 0.0, origin: [0.0; 2] };
        Ply { cut: Some(cut), ..cloth(Grid::NONE) }
    }

    fn pairs(ply: &Ply) -> Vec<[GripperId; 2]> {
        ply.neighbors().iter().map(|pair| pair.grippers.map(|n| ply.id(n))).collect()
    }

    fn array(nu: usize, nv: usize, holds: impl Fn(GripperId) -> bool) -> Vec<Held> {
        let ids = (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j]));
        let held = |id: GripperId| Held { id, place: id.map(|k| 0.1 * k as f64) };
        ids.filter(|id| holds(*id)).map(held).collect()
    }

    /// Where the cup in the middle is off, its row and its column go on to the next one; where all hold, neighbors are
    /// those of the grid, in its order.
    #[test]
    fn neighbors_are_the_next_cups_that_hold() {
        let whole = ply(array(3, 3, |_| true));
        let grid = Grid { nu: 3, nv: 3 };
        let lines = Lines::array(grid, [0.1; 2]);
        let edges: Vec<_> = (0..lines.edges()).map(|n| lines.catenary(n)).collect();
        let expected: Vec<_> = edges.iter().map(|edge| [edge.from, edge.to]).collect();
        assert_eq!(pairs(&whole), expected);

        let holed = ply(array(3, 3, |id| id != [1, 1]));
        assert!(pairs(&holed).contains(&[[0, 1], [2, 1]]));
        assert!(pairs(&holed).contains(&[[1, 0], [1, 2]]));
        assert_eq!(pairs(&holed).len(), 10);
    }

    /// A list of places in rows and columns has the same neighbors as the array, whatever their order.
    #[test]
    fn a_list_in_rows_and_columns_has_the_neighbors_of_the_array() {
        let mut list = array(4, 3, |_| true);
        list.reverse();
        for (n, held) in list.iter_mut().enumerate() {
            held.id = [n, 0];
        }
        let by_place = |ply: &Ply| {
            let place = |n: usize| ply.place(n).map(|c| (c * 1e3).round() as i64);
            let mut all: Vec<_> = ply.neighbors().iter().map(|p| p.grippers.map(place)).collect();
            all.iter_mut().for_each(|pair| pair.sort());
            all.sort();
            all
        };
        assert_eq!(by_place(&ply(list)), by_place(&ply(array(4, 3, |_| true))));
    }

    /// Cups on one line of the fabric, in any direction and however close: a level ply has the axes of its pose.
    #[test]
    fn a_single_line_of_cups_knows_its_angle_to_the_yarns() {
        let pose = crate::geometry::Pose::new([0.3, -0.2, 0.4], [0.0, 0.0, 0.4]);
        for way in [[0.1, 0.0], [0.0, 0.1], [0.1, 0.05], [-0.1, 0.2], [1e-5, 2e-5]] {
            let held = |n: usize| Held { id: [n, 0], place: way.map(|c| n as f64 * c) };
            let ply = ply((0..3).map(held).collect());
            let place = |n: usize| pose.place([ply.place(n)[0], ply.place(n)[1], 0.0]);
            let positions: Vec<[f64; 3]> = (0..3).map(place).collect();
            let neighbors = ply.neighbors();
            for found in [directions(&ply, &positions), tangents(&ply, &neighbors, &positions, 1)] {
                for (found, axis) in found.iter().zip(pose.axes) {
                    assert!(crate::geometry::distance(*found, axis) < 1e-9, "{way:?}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn border_lines_have_grippers_on_one_side_only() {
        let ply = ply(array(4, 3, |_| true));
        for pair in ply.neighbors() {
            let [a, b] = pair.grippers.map(|n| ply.id(n));
            let is_outer =
                |axis: usize, last: usize| a[axis] == b[axis] && [0, last].contains(&a[axis]);
            assert_eq!(pair.border, is_outer(0, 3) || is_outer(1, 2), "{a:?} {b:?}");
        }
    }
}
