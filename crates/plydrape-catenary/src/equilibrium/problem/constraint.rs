//! The planes of shearing cells, which constrain the slopes at their grippers: eq. (8a) of `docs/theory/ply.md`.
//!
//! A shearing cell is a taut sheet: its plane contains the stretched bias line and the direction across it: between the
//! two other grippers of a cell whose diagonals are bias lines, of the mean of the two other sides where the sides are. Where several cells meet, their planes are averaged by their weights w, and the
//! weight of the mean is `1 − ∏(1−w)`. A diagonal that has landed gives up its weight as its free segment
//! shortens from half of it to zero.

use super::circumstances::Circumstances;
use crate::equilibrium::Number;
use crate::ply::shear;

/// What the shearing cells around a gripper prescribe there: a plane, and how much it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint<T> {
    /// Unit normal of the plane, upwards.
    pub normal: [T; 3],
    /// Weight w of the plane, from 0 at the onset of shear to 1: the slope is `(1−w) s_free + w s_plane`.
    pub weight: T,
}

impl<T: Number> Constraint<T> {
    /// Slope of the plane along a horizontal unit vector: −(n·e)/n_z.
    #[must_use]
    pub fn slope(&self, heading: [T; 2]) -> T {
        let ([nx, ny, nz], zero) = (self.normal, T::from(0.0));
        // a level plane has the slope 0, not −0
        zero - (nx * heading[0] + ny * heading[1]) / nz
    }

    /// The constrained slope along a horizontal unit vector, `free` the slope without the constraint.
    #[must_use]
    pub(crate) fn blend(&self, free: Option<T>, heading: [T; 2]) -> T {
        let plane = self.slope(heading);
        match free {
            Some(free) if self.is_partial() => free + self.weight * (plane - free),
            _ => plane,
        }
    }

    /// Whether the unconstrained slope still counts.
    #[must_use]
    pub(crate) fn is_partial(&self) -> bool {
        self.weight.re() < 1.0
    }
}

/// The stretched bias lines of a cell that shears: their taut path (m), and whether they are the falling ones.
pub type Stretched<T> = Option<(T, bool)>;

/// The constraint of each gripper, from the stretched bias lines of all cells.
pub fn constrain<T: Number>(
    around: &Circumstances<T>,
    shearing: &[Stretched<T>],
    out: &mut Vec<Option<Constraint<T>>>,
) {
    out.clear();
    out.resize(around.lines.grippers(), None);
    if !around.constrained || !(around.is_rigid(0) || around.is_rigid(1)) {
        return;
    }
    for (cell, shearing) in shearing.iter().enumerate() {
        let Some((_, falling)) = *shearing else {
            continue;
        };
        let bias = &around.lines.cells()[cell].bias;
        let (stretched, others) = (&bias[usize::from(falling)], &bias[usize::from(!falling)]);
        let mut across = [T::from(0.0); 3];
        for other in others.list() {
            let chord = around.chord(*other);
            (0..3).for_each(|n| across[n] += chord[n]);
        }
        for stretched in stretched.list().iter().copied() {
            let path = around.taut_path(stretched);
            let weight = shear::onset(around.trellis(cell), path, around.tuning.full_constraint);
            for (end, gripper) in around.lines.ends(stretched).into_iter().enumerate() {
                // the part of a bias line that is in contact does not constrain the slopes beyond its gripper
                let free = around.contacts[stretched].as_ref().map_or(1.0, |contact| {
                    let share = (2.0 * contact.free_length(end) / contact.length).clamp(0.0, 1.0);
                    share * share * (3.0 - 2.0 * share)
                });
                if free == 0.0 {
                    continue;
                }
                let (weight, along) = (weight * free, around.segment_line(stretched, end).vector());
                let Some(normal) = upward_normal(along, across, around.tuning.upright_plane) else {
                    continue;
                };
                let here = &mut out[gripper];
                let none = Constraint { normal: [T::from(0.0); 3], weight: T::from(0.0) };
                let before = here.unwrap_or(none);
                *here = Some(Constraint {
                    normal: [0, 1, 2].map(|n| before.normal[n] + weight * normal[n]),
                    weight: before.weight + weight - before.weight * weight,
                });
            }
        }
    }
    for constraint in out.iter_mut() {
        // at the very onset the weight is below rounding, and there is no plane yet
        *constraint = constraint.filter(|c| c.weight.re() > 0.0).and_then(|constraint| {
            Some(Constraint { normal: unit(constraint.normal)?, ..constraint })
        });
    }
}

/// Upward unit normal of the plane along two directions; `None` where they are parallel, or where the normal's vertical
/// part is no more than `upright`.
fn upward_normal<T: Number>(a: [T; 3], b: [T; 3], upright: f64) -> Option<[T; 3]> {
    let cross = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let normal = unit([cross(1, 2), cross(2, 0), cross(0, 1)])?;
    let up = normal[2].re();
    (up.abs() > upright).then(|| if up > 0.0 { normal } else { normal.map(|c| -c) })
}

fn unit<T: Number>(a: [T; 3]) -> Option<[T; 3]> {
    let square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    (square.re() > 0.0).then(|| a.map(|c| c / square.sqrt()))
}
