//! The slope rules of the paper (section 2.2): what holds the ends of edges and diagonals, eq. (8) of
//! `docs/theory/ply.md`.
//!
//! A free slope on the boundary, a shared one inside, the plane through two edges for a diagonal, and the plane
//! of a shearing cell for all that meet its stretched diagonal's grippers.

use super::Number;
use super::assembly::{
    Assembly, Build, Constraint, End, Joint, Line, PlaneSlope, Side, SlopeSource,
};
use crate::ply::{Catenary, Kind, Laid, shear};
use crate::scene::ContactEnd;

impl<T: Number> Assembly<T> {
    /// The planes of shearing cells at the grippers of their stretched diagonals, eq. (8a) of `docs/theory/ply.md`.
    ///
    /// A shearing cell is a taut sheet: its plane contains the stretched diagonal and the direction between the
    /// two other grippers. Where several cells meet, their planes are averaged by their weights w, and the
    /// weight of the mean is `1 − ∏(1−w)`. A diagonal that has landed gives up its weight as its free segment
    /// shortens from half of it to nothing.
    pub(super) fn constrain(&mut self, build: &Build<T>) {
        let grid = build.grid();
        self.constraints.clear();
        self.constraints.resize(grid.grippers(), None);
        if !build.constrained || !self.is_rigid.contains(&true) {
            return;
        }
        for (cell, shearing) in self.shearing.iter().enumerate() {
            let Some((path, falling)) = *shearing else {
                continue;
            };
            let first = grid.edges() + 2 * cell;
            let (stretched, other) = (first + usize::from(falling), first + usize::from(!falling));
            let [along_u, along_v, _] = build.factors.length;
            let [a, b] = build.ply.sides(cell, build.laid);
            let weight = shear::onset([along_u * a, along_v * b], path, build.full_constraint);
            let across = build.chord(other);
            let catenary = grid.catenary(stretched);
            for (end, gripper) in [catenary.from, catenary.to].into_iter().enumerate() {
                // what of the diagonal is in contact says nothing about what hangs beyond its gripper
                let free = build.laid[stretched].as_ref().map_or(1.0, |laid| {
                    let share = (2.0 * laid.rest(end) / laid.length).clamp(0.0, 1.0);
                    share * share * (3.0 - 2.0 * share)
                });
                if free == 0.0 {
                    continue;
                }
                let weight = weight * free;
                let Some(normal) = upward_normal(build.rest_line(stretched, end).vector(), across)
                else {
                    continue;
                };
                let here = &mut self.constraints[grid.index(gripper)];
                let none = Constraint { normal: [T::from(0.0); 3], weight: T::from(0.0) };
                let before = here.unwrap_or(none);
                *here = Some(Constraint {
                    normal: [0, 1, 2].map(|n| before.normal[n] + weight * normal[n]),
                    weight: before.weight + weight - before.weight * weight,
                });
            }
        }
        for constraint in self.constraints.iter_mut() {
            // at the very onset the weight is below rounding, and there is no plane yet
            *constraint = constraint.filter(|c| c.weight.re() > 0.0).and_then(|constraint| {
                Some(Constraint { normal: unit(constraint.normal)?, ..constraint })
            });
        }
    }

    /// Joins the edges on both sides of a gripper, and holds those that a shearing cell constrains.
    pub(super) fn join(&mut self, build: &Build<T>) {
        let grid = build.grid();
        let lines = (0..grid.nv).map(|j| (0, j)).chain((0..grid.nu).map(|i| (1, i)));
        for (direction, fixed) in lines {
            let count = if direction == 0 { grid.nu } else { grid.nv };
            for moving in 0..count {
                let id = if direction == 0 { [moving, fixed] } else { [fixed, moving] };
                let gripper = grid.index(id);
                let sides = self.sides[gripper][direction];
                let constraint = self.constraints[gripper].filter(|_| build.is_rigid(direction));
                if let Some(constraint) = constraint {
                    for side in sides {
                        if let Side::Hanging(element, end) = side {
                            let heading = self.directions[self.elements[element].catenary][end];
                            let free = build.free.get(element).map(|slopes| slopes[end]);
                            let slope = constraint.blend(free, heading);
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

    /// The end of a diagonal at a gripper: the plane through the two edge slopes of its cell there, or the plane
    /// of the shearing cells.
    ///
    /// Free where those edges are parallel in plan and define no plane, and in a limp ply.
    pub(super) fn plane(
        &self,
        build: &Build<T>,
        cell: usize,
        c: Catenary,
        [end, element]: [usize; 2],
        along: &Line<T>,
    ) -> End<T> {
        let grid = build.grid();
        if build.ply.line(c.kind).flexural_rigidity == 0.0 {
            return End::Free;
        }
        let gripper = if end == 0 { c.from } else { c.to };
        let g = grid.index(gripper);
        if let Some(constraint) = self.constraints[g] {
            let free = build.free.get(element).map(|slopes| slopes[end]);
            return End::Given(constraint.blend(free, along.unit()));
        }
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
        let source = [0, 1].map(|d| {
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

/// Upward unit normal of the plane along two directions; none where they are parallel or the plane is vertical.
fn upward_normal<T: Number>(a: [T; 3], b: [T; 3]) -> Option<[T; 3]> {
    let cross = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let normal = unit([cross(1, 2), cross(2, 0), cross(0, 1)])?;
    let up = normal[2].re();
    (up.abs() > VERTICAL).then(|| if up > 0.0 { normal } else { normal.map(|c| -c) })
}

/// Vertical part of a unit normal below which its plane stands upright and prescribes no slope.
const VERTICAL: f64 = 1e-6;

fn unit<T: Number>(a: [T; 3]) -> Option<[T; 3]> {
    let square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    (square.re() > 0.0).then(|| a.map(|c| c / square.sqrt()))
}
