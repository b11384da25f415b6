//! The slope rules of the paper (section 2.2): what holds the ends of edges and diagonals, eq. (8) of
//! `docs/theory/ply.md`.
//!
//! A free slope on the boundary, a shared one inside, the plane through two edges for a diagonal, and the plane
//! of a shearing cell for all that meet its stretched diagonal's grippers.

use super::circumstances::Circumstances;
use super::constraint::Constraint;
use super::element::{Element, End, PlaneSlope, SlopeSource};
use super::line::StraightLine;
use crate::equilibrium::Number;

/// An unknown slope: that of a line of edges at a gripper, which two hanging edges share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SharedSlope {
    /// Index of the gripper.
    pub gripper: usize,
    /// 0 along u, 1 along v.
    pub direction: usize,
    /// The elements that end and begin here.
    pub elements: [usize; 2],
}

/// An edge of the ply on one side of a gripper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side<T> {
    /// The ply ends here.
    None,
    /// It hangs: this element, by this end.
    Hanging(usize, usize),
    /// It is straight or lies on the mold, at this slope.
    Fixed(T),
}

/// How the edges meet at the grippers.
#[derive(Debug, Clone)]
pub struct Slopes<T> {
    /// Unknown slopes, line by line: u-lines first, each in ascending order.
    shared: Vec<SharedSlope>,
    /// The unknown slope of each gripper along u and v.
    shared_at: Vec<[Option<usize>; 2]>,
    /// The edges around each gripper: `[direction][before, after]`.
    sides: Vec<[[Side<T>; 2]; 2]>,
    /// Heading of each edge at its two ends.
    headings: Vec<[[T; 2]; 2]>,
}

impl<T> Default for Slopes<T> {
    fn default() -> Self {
        let (shared, shared_at) = (Vec::new(), Vec::new());
        Slopes { shared, shared_at, sides: Vec::new(), headings: Vec::new() }
    }
}

impl<T: Number> Slopes<T> {
    /// Forgets all edges, for this many grippers.
    pub fn reset(&mut self, grippers: usize) {
        self.shared.clear();
        self.headings.clear();
        self.shared_at.clear();
        self.shared_at.resize(grippers, [None; 2]);
        self.sides.clear();
        self.sides.resize(grippers, [[Side::None; 2]; 2]);
    }

    /// Notes what the grippers of the next edge see of it, and its headings there.
    pub fn see(&mut self, grippers: [usize; 2], along: usize, seen: [(Side<T>, [T; 2]); 2]) {
        for (end, gripper) in grippers.into_iter().enumerate() {
            self.sides[gripper][along][1 - end] = seen[end].0;
        }
        self.headings.push(seen.map(|(_, heading)| heading));
    }

    /// Unknown slopes, line by line.
    pub fn shared(&self) -> &[SharedSlope] {
        &self.shared
    }

    /// The edges around each gripper: `[direction][before, after]`.
    pub fn sides(&self) -> &[[[Side<T>; 2]; 2]] {
        &self.sides
    }

    /// Holds the ends of all edges: by a slope that both sides of a gripper share, or by a shearing cell's plane.
    pub fn hold_edges(
        &mut self,
        around: &Circumstances<T>,
        constraints: &[Option<Constraint<T>>],
        elements: &mut [Element<T>],
    ) {
        for (direction, grippers) in around.lines.chains() {
            // a line without bending stiffness takes no slope from its grippers
            if !around.is_rigid(direction) {
                continue;
            }
            for &gripper in grippers {
                let sides = self.sides[gripper][direction];
                // cells that shear prescribe the slopes of the edges that hang at their grippers
                if let Some(constraint) = constraints[gripper] {
                    for side in sides {
                        if let Side::Hanging(element, end) = side {
                            let heading = self.headings[elements[element].catenary][end];
                            let free = around.free.get(element).map(|slopes| slopes[end]);
                            let slope = constraint.blend(free, heading);
                            elements[element].ends[end] = End::Prescribed(slope);
                        }
                    }
                } else if let [Side::Hanging(a, end_a), Side::Hanging(b, end_b)] = sides {
                    // edges that hang on both sides of a gripper share one unknown slope
                    let slope = self.shared.len();
                    self.shared.push(SharedSlope { gripper, direction, elements: [a, b] });
                    self.shared_at[gripper][direction] = Some(slope);
                    elements[a].ends[end_a] = End::Shared(slope);
                    elements[b].ends[end_b] = End::Shared(slope);
                }
            }
        }
    }

    /// The end of a diagonal, which is to be element number `element`, along a line: the plane through the two edge
    /// slopes of its cell at the gripper, or the plane of the shearing cells.
    ///
    /// Free where those edges are parallel in plan and define no plane, and in a limp ply.
    pub fn diagonal_end(
        &self,
        around: &Circumstances<T>,
        constraints: &[Option<Constraint<T>>],
        catenary: usize,
        [element, end]: [usize; 2],
        line: &StraightLine<T>,
    ) -> End<T> {
        let along = line.heading();
        if around.ply.line(around.kind(catenary)).flexural_rigidity == 0.0 {
            return End::Free;
        }
        let gripper = around.lines.ends(catenary)[end];
        if let Some(constraint) = constraints[gripper] {
            let free = around.free.get(element).map(|slopes| slopes[end]);
            return End::Prescribed(constraint.blend(free, along));
        }
        // the fiber lines between which it leaves, before the gripper (0) or behind it (1); at a boundary those that go on
        let away = around.lines.offset(catenary);
        let fibers = [0, 1].map(|d| {
            let side = usize::from((away[d] > 0.0) == (end == 0));
            let beside = around.lines.beside(gripper, d);
            [side, 1 - side].into_iter().find_map(|side| Some((side, beside[side]?)))
        });
        let [Some((side_u, edge_u)), Some((side_v, edge_v))] = fibers else { return End::Free };
        let sides = [side_u, side_v];
        let [u, v] = [self.headings[edge_u][1 - side_u], self.headings[edge_v][1 - side_v]];
        let determinant = u[0] * v[1] - u[1] * v[0];
        if determinant.re().abs() < around.tuning.parallel_edges {
            return End::Free;
        }
        let share = [
            (along[0] * v[1] - along[1] * v[0]) / determinant,
            (u[0] * along[1] - u[1] * along[0]) / determinant,
        ];
        let source =
            [0, 1].map(|d| match (self.shared_at[gripper][d], self.sides[gripper][d][sides[d]]) {
                (Some(slope), _) => SlopeSource::Shared(slope),
                (None, Side::Hanging(element, end)) => SlopeSource::Outcome(element, end),
                (None, Side::Fixed(slope)) => SlopeSource::Prescribed(slope),
                (None, Side::None) => SlopeSource::Prescribed(T::from(0.0)),
            });
        End::Plane(PlaneSlope { share, source })
    }
}
