//! The slope rules of the paper (section 2.2): what holds the ends of edges and diagonals, eq. (8) of
//! `docs/theory.md`.
//!
//! A free slope at the rim, a shared one inside, the plane through two edges for a diagonal, and a
//! shearing diagonal's own slope for all around it.

use super::Number;
use super::assembly::{Assembly, Build, End, Joint, Line, PlaneSlope, Side, SlopeSource};
use crate::ply::{Catenary, Kind, Laid};
use crate::scene::ContactEnd;

impl<T: Number> Assembly<T> {
    /// Slopes at the grippers of shearing diagonals: their outward slope, each taken in the line's own
    /// direction; where several meet, the mean.
    pub(super) fn govern(&mut self, build: &Build<T>) {
        let grid = build.grid();
        self.governed.clear();
        self.governed.resize(grid.grippers(), [None; 2]);
        let mut counts = std::mem::take(&mut self.counts);
        counts.clear();
        counts.resize(grid.grippers(), [0.0; 2]);
        for (cell, shearing) in self.shearing.iter().enumerate() {
            let Some((_, falling)) = shearing else {
                continue;
            };
            let index = grid.edges() + 2 * cell + usize::from(*falling);
            let catenary = grid.catenary(index);
            for (end, gripper) in [catenary.from, catenary.to].into_iter().enumerate() {
                // where the diagonal lies up to its gripper, all but a crumb, it governs nothing
                if build.laid[index].as_ref().is_some_and(|laid| laid.is_crumb(end)) {
                    continue;
                }
                // slope in the diagonal's direction from its first end; outward at its second end is minus it
                let slope = build.rest_line(index, end).slope();
                let outward = if end == 0 { slope } else { -slope };
                let along_u = match (catenary.kind, end) {
                    (Kind::Falling, 0) | (Kind::Rising, 1) => -outward,
                    _ => outward,
                };
                let along_v = if end == 0 { outward } else { -outward };
                let g = grid.index(gripper);
                for (d, slope) in [along_u, along_v].into_iter().enumerate() {
                    let sum = self.governed[g][d].unwrap_or(T::from(0.0));
                    self.governed[g][d] = Some(sum + slope);
                    counts[g][d] += 1.0;
                }
            }
        }
        for (governed, counts) in self.governed.iter_mut().zip(&counts) {
            for d in 0..2 {
                // a limp line has no slope to govern
                let sum = governed[d].filter(|_| build.is_rigid(d));
                governed[d] = sum.map(|sum| sum / counts[d]);
            }
        }
        self.counts = counts;
    }

    /// Joins the edges on both sides of a gripper, and holds those that a shearing diagonal governs.
    pub(super) fn join(&mut self, build: &Build<T>) {
        let grid = build.grid();
        let lines = (0..grid.nv).map(|j| (0, j)).chain((0..grid.nu).map(|i| (1, i)));
        for (direction, fixed) in lines {
            let count = if direction == 0 { grid.nu } else { grid.nv };
            for moving in 0..count {
                let id = if direction == 0 { [moving, fixed] } else { [fixed, moving] };
                let gripper = grid.index(id);
                let sides = self.sides[gripper][direction];
                if let Some(slope) = self.governed[gripper][direction] {
                    for side in sides {
                        if let Side::Hanging(element, end) = side {
                            self.elements[element].ends[end] = End::Given(slope);
                        }
                    }
                } else if let ([Side::Hanging(a, end_a), Side::Hanging(b, end_b)], true) =
                    (sides, build.is_rigid(direction))
                {
                    let joint = self.joints.len();
                    self.joints.push(Joint { gripper, direction, elements: [a, b] });
                    self.joint_at[gripper][direction] = Some(joint);
                    self.elements[a].ends[end_a] = End::Joint(joint);
                    self.elements[b].ends[end_b] = End::Joint(joint);
                }
            }
        }
    }

    /// The end of a diagonal at a gripper: the plane through the two edge slopes of its cell there.
    ///
    /// Free where those edges are parallel in plan and define no plane, and in a limp ply.
    pub(super) fn plane(
        &self,
        build: &Build<T>,
        cell: usize,
        c: Catenary,
        end: usize,
        along: &Line<T>,
    ) -> End<T> {
        let grid = build.grid();
        if build.ply.line(c.kind).flexural_rigidity == 0.0 {
            return End::Free;
        }
        let gripper = if end == 0 { c.from } else { c.to };
        let (i, j) = (cell % (grid.nu - 1), cell / (grid.nu - 1));
        let [di, dj] = [gripper[0] - i, gripper[1] - j];
        // the cell's edges at this gripper: it stands at their start (0) or at their end (1)
        let edges = [grid.edge_u([i, gripper[1]]), grid.edge_v([gripper[0], j])];
        let [u, v] = [self.directions[edges[0]][di], self.directions[edges[1]][dj]];
        let along = along.unit();
        let determinant = u[0] * v[1] - u[1] * v[0];
        if determinant.re().abs() < 1e-6 {
            return End::Free;
        }
        let share = [
            (along[0] * v[1] - along[1] * v[0]) / determinant,
            (u[0] * along[1] - u[1] * along[0]) / determinant,
        ];
        let g = grid.index(gripper);
        let source = [0, 1].map(|d| {
            if let Some(slope) = self.governed[g][d] {
                return SlopeSource::Given(slope);
            }
            if let Some(joint) = self.joint_at[g][d] {
                return SlopeSource::Joint(joint);
            }
            let at = if d == 0 { di } else { dj };
            match self.sides[g][d][1 - at] {
                Side::Hanging(element, end) => SlopeSource::Outcome(element, end),
                Side::Fixed(slope) => SlopeSource::Given(slope),
                Side::None => SlopeSource::Given(T::from(0.0)),
            }
        });
        End::Plane(PlaneSlope { share, source })
    }
}

/// What holds a rest where it leaves the mold.
pub(super) fn contact_end<T: Number>(
    build: &Build<T>,
    kind: Kind,
    laid: &Laid,
    rest: usize,
    line: &Line<T>,
) -> End<T> {
    match build.settings.contact.end {
        ContactEnd::Free => End::Free,
        ContactEnd::Tangent => {
            let ([nx, ny, nz], unit) = (laid.normal[rest], line.unit());
            if build.ply.line(kind).flexural_rigidity == 0.0 || nz <= 0.0 {
                return End::Free;
            }
            End::Given((unit[0] * -nx + unit[1] * -ny) / nz)
        }
    }
}
