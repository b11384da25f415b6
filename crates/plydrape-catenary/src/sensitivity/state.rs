//! The derivatives of a state: sparse rows, filled group by group.

use super::tuning::TUNING;
use super::{Quantity, ROWS, Row};
use crate::equilibrium::{Coloring, Direction, Solver, StateTangent};
use crate::geometry::Point;
use crate::ply::{ContactSegment, GripperId, Ply};

/// The derivatives of a state to all gripper positions.
pub(super) struct StateDerivatives {
    /// Derivatives of each element's force (N), end slopes, run, rise and length (m).
    pub rows: Vec<[Row; ROWS]>,
    /// Taut path of each cell's stretched diagonal (m), if any.
    pub paths: Vec<Option<Quantity>>,
    /// Slope of the ply at each gripper along u and v, where there is one.
    pub slopes: Vec<[Option<Quantity>; 2]>,
}

impl StateDerivatives {
    /// Differentiates the last state of a solver. Numbers smaller than a share `negligible` of the largest in a row are
    /// left out; with 0 there are all.
    pub fn new(
        ply: &Ply,
        solver: &Solver,
        positions: &[Point],
        contacts: &[Option<ContactSegment>],
        negligible: f64,
    ) -> Self {
        let mut linearized = solver.linearize(positions, contacts);
        let rows = ply.rows();
        let whole = rows.nu.max(rows.nv);
        let mut reach = if negligible > 0.0 { TUNING.reach } else { whole };
        loop {
            let coloring = Coloring::from_ply(ply, reach);
            let mut gathered = Gathered::new(ply, solver, positions.len(), negligible);
            let mut direction = Direction::none(positions.len());
            for group in 0..coloring.groups() {
                for axis in 0..3 {
                    let members = || coloring.members(group);
                    members().for_each(|gripper| direction.grippers[gripper][axis] = 1.0);
                    gathered.put(&coloring, group, axis, &linearized.along(&direction));
                    members().for_each(|gripper| direction.grippers[gripper][axis] = 0.0);
                }
            }
            if coloring.is_whole() || !linearized.is_sound() || gathered.decays() {
                return gathered.finish(solver, positions);
            }
            reach *= 2;
        }
    }
}

/// Rows as they are filled, kind by kind: those of elements, paths, slopes along u and v.
struct Gathered {
    negligible: f64,
    corners: Vec<GripperId>,
    /// Names of the cells and of the grippers.
    cells: Vec<GripperId>,
    ids: Vec<GripperId>,
    kinds: Vec<Vec<Gathering>>,
}

/// Kinds of rows: six of elements, then paths, then slopes along u and v.
const KINDS: usize = ROWS + 3;

/// A row under way: its numbers in any order, and the largest of those that are as far as groups allow.
#[derive(Debug, Clone, Default)]
struct Gathering {
    entries: Vec<(usize, f64)>,
    far: f64,
}

impl Gathering {
    fn put(&mut self, negligible: f64, place: usize, is_far: bool, x: f64) {
        if x == 0.0 {
            return;
        }
        // before it grows, what is known to be negligible goes
        if self.entries.len() == self.entries.capacity() && self.entries.len() > 8 {
            let least = negligible * self.largest();
            self.entries.retain(|(_, x)| x.abs() >= least || x.is_nan());
        }
        self.entries.push((place, x));
        if is_far {
            self.far = self.far.max(x.abs());
        }
    }

    fn largest(&self) -> f64 {
        self.entries.iter().fold(0.0, |most, (_, x)| x.abs().max(most))
    }

    fn finish(mut self, negligible: f64) -> Row {
        self.entries.sort_unstable_by_key(|(place, _)| *place);
        let mut row: Row = self.entries.into_iter().collect();
        row.trim(negligible);
        row
    }
}

impl Gathered {
    fn new(ply: &Ply, solver: &Solver, grippers: usize, negligible: f64) -> Self {
        let (elements, lines) = (&solver.problem().elements, solver.lines());
        let corner = |catenary: usize| {
            let c = lines.catenary(catenary);
            [0, 1].map(|d| c.from[d].min(c.to[d]))
        };
        let count = |kind: usize| match kind {
            ROWS => lines.cells().len(),
            kind if kind > ROWS => grippers,
            _ => elements.len(),
        };
        Gathered {
            negligible,
            cells: lines.cells().iter().map(|cell| cell.id).collect(),
            ids: (0..grippers).map(|n| ply.id(n)).collect(),
            corners: elements.iter().map(|element| corner(element.catenary)).collect(),
            kinds: (0..KINDS).map(|kind| vec![Gathering::default(); count(kind)]).collect(),
        }
    }

    /// What the ply does when a group moves along an axis.
    fn put(&mut self, coloring: &Coloring, group: usize, axis: usize, tangent: &StateTangent) {
        let Gathered { negligible, corners, cells, ids, kinds } = self;
        let mut put = |kind: usize, n: usize, near: Option<(usize, bool)>, x: f64| {
            if let Some((gripper, is_far)) = near {
                kinds[kind][n].put(*negligible, 3 * gripper + axis, is_far, x);
            }
        };
        for (n, corner) in corners.iter().enumerate() {
            let near = coloring.near(group, *corner);
            let ([first, second], [run, rise, length]) = (tangent.end_slopes[n], tangent.spans[n]);
            let changes = [tangent.force[n], first, second, run, rise, length];
            changes.into_iter().enumerate().for_each(|(row, x)| put(row, n, near, x));
        }
        for (cell, change) in tangent.paths.iter().enumerate() {
            put(ROWS, cell, coloring.near(group, cells[cell]), *change);
        }
        for (gripper, changes) in tangent.grippers.iter().enumerate() {
            let near = coloring.near(group, ids[gripper]);
            (0..2).for_each(|d| put(ROWS + 1 + d, gripper, near, changes[d]));
        }
    }

    /// Whether what is farthest away is negligible, so that what is farther still is too.
    fn decays(&self) -> bool {
        self.kinds.iter().all(|rows| {
            let largest: Vec<f64> = rows.iter().map(Gathering::largest).collect();
            let noise = TUNING.noise * largest.iter().fold(0.0, |most: f64, x| most.max(*x));
            let small = |(row, largest): (&Gathering, &f64)| {
                row.far <= self.negligible * largest.max(noise)
            };
            rows.iter().zip(&largest).all(small)
        })
    }

    fn finish(self, solver: &Solver, positions: &[Point]) -> StateDerivatives {
        let problem = solver.problem();
        let mut kinds = self.kinds.into_iter().map(|rows| {
            let finish = |row: Gathering| row.finish(self.negligible);
            rows.into_iter().map(finish).collect::<Vec<Row>>().into_iter()
        });
        let mut next = || kinds.next().unwrap_or_default();
        let mut elements: [_; ROWS] = std::array::from_fn(|_| next());
        let rows = (0..problem.elements.len())
            .map(|_| elements.each_mut().map(|rows| rows.next().unwrap_or_default()))
            .collect();
        let paths = problem.shearing.iter().zip(next());
        let paths = paths
            .map(|(shearing, gradient)| shearing.map(|(value, _)| Quantity { value, gradient }));
        let paths = paths.collect();
        let [along_u, along_v] = [next(), next()];
        let slope = |n: usize, d: usize, gradient: Row| {
            solver.gripper_slope(positions, n, d).map(|value| Quantity { value, gradient })
        };
        let slopes = along_u.zip(along_v).enumerate();
        let slopes = slopes.map(|(n, (u, v))| [slope(n, 0, u), slope(n, 1, v)]).collect();
        StateDerivatives { rows, paths, slopes }
    }
}
