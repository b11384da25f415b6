//! Plies that lie on a mold: what the next ply is laid on.
//!
//! They are a height along the normal of the mold, see [`super::Raised`]: the sum of the thicknesses of the plies that lie at a
//! place. A ply's region is where it is seen from above, in plan, because plies are laid from above. Beyond its boundary its
//! thickness t runs out in a ramp, since the next ply bridges the step at its edge: over a width w the height falls as
//! t (1 − 3 x² + 2 x³), x the distance from the boundary over w. Its steepest slope 3 t / 2 w is [`STEEPEST`], so that the ramp is
//! as wide as the ply is thick, times a number. Height and normal are continuous; on a mold that is inclined the ramp is less
//! steep along the mold than in plan.

use super::raised::{Raise, Relief};
use crate::Error;
use crate::geometry::ring::{self, lines};

/// Steepest slope of the ramp at the edge of a ply, 1 in 20: our assumption, the taper that is usual for dropped plies. A single dry
/// ply bridges farther by its own stiffness, which the sheet computes.
pub const STEEPEST: f64 = 0.05;

/// Cells along the longer side of the grid by which a place in the region is found.
const CELLS: usize = 64;

/// A ply that lies on a mold.
#[derive(Debug, Clone)]
pub struct Layer {
    thickness: f64,
    rings: Vec<Vec<[f64; 2]>>,
    /// Where the ramp ends: lowest and highest coordinates (m).
    bounds: [[f64; 2]; 2],
    grid: Grid,
}

/// Equal thickness and region.
impl PartialEq for Layer {
    fn eq(&self, other: &Self) -> bool {
        self.thickness == other.thickness && self.rings == other.rings
    }
}

/// The plies that lie on a mold, the first at the bottom.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layers(pub Vec<Layer>);

/// What is known of a part of the plan.
#[derive(Debug, Clone)]
enum GridCell {
    /// All of it has the full thickness.
    Inside,
    /// Nothing of it.
    Outside,
    /// Lines of the boundary that may be the nearest or be crossed.
    Near(Vec<[[f64; 2]; 2]>),
}

/// The plan in cells, so that most places are answered without the boundary.
#[derive(Debug, Clone)]
struct Grid {
    side: f64,
    count: [usize; 2],
    cells: Vec<GridCell>,
}

/// The boundary of a layer as seen from a place.
struct Nearest {
    /// Distance (m).
    distance: f64,
    /// Unit vector from the nearest point of the boundary to the place.
    away: [f64; 2],
    /// The nearest point is a corner.
    is_corner: bool,
}

impl Layer {
    /// A ply of a `thickness` (m) whose region in plan is bounded by rings (m), holes among them.
    ///
    /// # Errors
    /// [`Error::LayerThickness`] without a thickness, [`Error::LayerRegion`] without a region.
    pub fn new(thickness: f64, rings: Vec<Vec<[f64; 2]>>) -> Result<Self, Error> {
        if !(thickness > 0.0 && thickness.is_finite()) {
            return Err(Error::LayerThickness { thickness_mm: thickness * 1e3 });
        }
        let is_ring =
            |ring: &Vec<[f64; 2]>| ring.len() >= 3 && ring.iter().flatten().all(|c| c.is_finite());
        if rings.is_empty() || !rings.iter().all(is_ring) {
            return Err(Error::LayerRegion { rings: rings.len() });
        }
        let width = ramp(thickness);
        let [low, high] = bounds(&rings);
        let bounds = [low.map(|c| c - width), high.map(|c| c + width)];
        let grid = Grid::new(&rings, bounds, width);
        Ok(Layer { thickness, rings, bounds, grid })
    }

    /// Thickness (m).
    #[must_use]
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The rings that bound its region in plan (m): a place within an odd number of them is covered.
    #[must_use]
    pub fn rings(&self) -> &[Vec<[f64; 2]>] {
        &self.rings
    }

    /// Height (m), slope, and second derivatives (1/m) at a place in plan.
    fn at(&self, place: [f64; 2]) -> (f64, [f64; 2], [f64; 3]) {
        let none = (0.0, [0.0; 2], [0.0; 3]);
        let full = (self.thickness, [0.0; 2], [0.0; 3]);
        if !(0..2).all(|n| (self.bounds[0][n]..=self.bounds[1][n]).contains(&place[n])) {
            return none;
        }
        let lines = match self.grid.cell(self.bounds[0], place) {
            GridCell::Inside => return full,
            GridCell::Outside => return none,
            GridCell::Near(lines) => lines,
        };
        if is_inside(&self.rings, place) {
            return full;
        }
        let width = ramp(self.thickness);
        let Some(nearest) = nearest(lines, place).filter(|found| found.distance < width) else {
            return none;
        };
        let (t, x) = (self.thickness, nearest.distance / width);
        let height = t * (1.0 - x * x * (3.0 - 2.0 * x));
        let slope = t / width * 6.0 * x * (x - 1.0);
        let bend = t / (width * width) * (12.0 * x - 6.0);
        // around a corner the ramp is a cone
        let round = if nearest.is_corner { slope / nearest.distance } else { 0.0 };
        let [a, b] = nearest.away;
        let hessian =
            [bend * a * a + round * b * b, (bend - round) * a * b, bend * b * b + round * a * a];
        (height, [slope * a, slope * b], hessian)
    }
}

impl Relief for Layers {
    fn at(&self, [x, y, _]: [f64; 3]) -> Raise {
        let mut sum = Raise { height: 0.0, gradient: [0.0; 3], hessian: [0.0; 3] };
        for layer in &self.0 {
            let (height, [a, b], hessian) = layer.at([x, y]);
            sum.height += height;
            sum.gradient[0] += a;
            sum.gradient[1] += b;
            (0..3).for_each(|n| sum.hessian[n] += hessian[n]);
        }
        sum
    }

    fn most(&self) -> f64 {
        self.0.iter().map(Layer::thickness).sum()
    }

    fn steepest(&self) -> f64 {
        STEEPEST * self.0.len() as f64
    }
}

impl Grid {
    fn new(rings: &[Vec<[f64; 2]>], [low, high]: [[f64; 2]; 2], width: f64) -> Self {
        let size = [0, 1].map(|n| high[n] - low[n]);
        let side = size[0].max(size[1]) / CELLS as f64;
        let count = size.map(|s| ((s / side).ceil() as usize).max(1));
        let lines: Vec<[[f64; 2]; 2]> = rings.iter().flat_map(|ring| lines(ring)).collect();
        let reach = 0.5 * side * std::f64::consts::SQRT_2;
        let cell = |index: usize| {
            let [i, j] = [index % count[0], index / count[0]];
            let middle = [(0, i), (1, j)].map(|(n, k)| low[n] + (k as f64 + 0.5) * side);
            let away = |line: &[[f64; 2]; 2]| from_line(*line, middle).0;
            let nearest = lines.iter().map(away).fold(f64::INFINITY, f64::min);
            // a millionth more than half a cell's diagonal, for rounding
            let reach = reach * (1.0 + 1e-6);
            if is_inside(rings, middle) && nearest > reach {
                return GridCell::Inside;
            }
            if nearest > reach + width {
                return GridCell::Outside;
            }
            let near = lines.iter().filter(|line| away(line) <= nearest + 2.0 * reach);
            GridCell::Near(near.copied().collect())
        };
        let cells = (0..count[0] * count[1]).map(cell).collect();
        Grid { side, count, cells }
    }

    fn cell(&self, low: [f64; 2], place: [f64; 2]) -> &GridCell {
        let [i, j] = [0, 1]
            .map(|n| (((place[n] - low[n]) / self.side).max(0.0) as usize).min(self.count[n] - 1));
        &self.cells[j * self.count[0] + i]
    }
}

/// How far the ramp of a ply of some thickness (m) reaches beyond its boundary (m).
#[must_use]
pub fn ramp(thickness: f64) -> f64 {
    1.5 * thickness / STEEPEST
}

/// Places along each side of what two regions have in common, and along the longer side of a region, at which they are compared.
const COMPARED: usize = 64;

/// Whether two regions in plan overlap by more than a `margin` (m): plies whose edges meet do not.
#[must_use]
pub fn overlap(a: &[Vec<[f64; 2]>], b: &[Vec<[f64; 2]>], margin: f64) -> bool {
    let ([low, high], [other_low, other_high]) = (bounds(a), bounds(b));
    let low = [0, 1].map(|n| low[n].max(other_low[n]));
    let high = [0, 1].map(|n| high[n].min(other_high[n]));
    if !(0..2).all(|n| low[n] < high[n]) {
        return false;
    }
    // a narrow overlap is found along the boundary of one of them
    let step = (high[0] - low[0]).max(high[1] - low[1]) / COMPARED as f64;
    let along = |rings: &[Vec<[f64; 2]>], other: &[Vec<[f64; 2]>]| {
        rings.iter().flat_map(|ring| lines(ring)).any(|[p, q]| {
            let parts = ((q[0] - p[0]).hypot(q[1] - p[1]) / step).ceil().max(1.0) as usize;
            (0..parts).any(|k| {
                let t = k as f64 / parts as f64;
                is_deep(other, [0, 1].map(|n| p[n] + t * (q[n] - p[n])), margin)
            })
        })
    };
    let within = || {
        (0..COMPARED * COMPARED).any(|index| {
            let share =
                [index % COMPARED, index / COMPARED].map(|k| (k as f64 + 0.5) / COMPARED as f64);
            let place = [0, 1].map(|n| low[n] + share[n] * (high[n] - low[n]));
            is_deep(a, place, 0.5 * margin) && is_deep(b, place, 0.5 * margin)
        })
    };
    along(a, b) || along(b, a) || within()
}

/// Whether a place is within a region, farther than `depth` (m) from its boundary.
fn is_deep(rings: &[Vec<[f64; 2]>], place: [f64; 2], depth: f64) -> bool {
    let lines = || rings.iter().flat_map(|ring| lines(ring));
    is_inside(rings, place) && lines().all(|line| from_line(line, place).0 > depth)
}

/// Lowest and highest coordinates of rings (m).
fn bounds(rings: &[Vec<[f64; 2]>]) -> [[f64; 2]; 2] {
    ring::bounds(rings.iter().flatten())
}

/// Whether a place is within an odd number of rings.
fn is_inside(rings: &[Vec<[f64; 2]>], place: [f64; 2]) -> bool {
    rings.iter().filter(|ring| ring::is_inside(ring, place)).count() % 2 == 1
}

/// Distance of a place from a line (m), the vector from its nearest point of the line (m), and whether that is an end.
fn from_line([a, b]: [[f64; 2]; 2], place: [f64; 2]) -> (f64, [f64; 2], bool) {
    let way = [b[0] - a[0], b[1] - a[1]];
    let to = [place[0] - a[0], place[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let share = (to[0] * way[0] + to[1] * way[1]) / square;
    // a line without length is a point
    let t = if square > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
    let off = [to[0] - t * way[0], to[1] - t * way[1]];
    (off[0].hypot(off[1]), off, !(t > 0.0 && t < 1.0))
}

fn nearest(lines: &[[[f64; 2]; 2]], place: [f64; 2]) -> Option<Nearest> {
    let found = lines.iter().map(|line| from_line(*line, place));
    let (distance, off, is_corner) = found.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let away = if distance > 0.0 { off.map(|c| c / distance) } else { [0.0; 2] };
    Some(Nearest { distance, away, is_corner: is_corner && distance > 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vector::{along, dot};
    use crate::mold::{
        Face, Graph, Mesh, Mold, Plane, Pose, Raised, Saddle, Sphere, Surface, distance,
    };
    use std::sync::Arc;

    const THICK: f64 = 3e-4;

    fn layer(thickness: f64, rings: &[&[[f64; 2]]]) -> Layer {
        Layer::new(thickness, rings.iter().map(|ring| ring.to_vec()).collect()).expect("a layer")
    }

    /// A pentagon with a hole, none of its sides along an axis.
    fn cut() -> Layer {
        let boundary = [[-0.11, -0.09], [0.1, -0.12], [0.13, 0.02], [0.07, 0.11], [-0.12, 0.08]];
        let hole = [[-0.03, -0.02], [0.02, -0.04], [0.01, 0.03]];
        layer(THICK, &[&boundary, &hole])
    }

    fn large(thickness: f64) -> Layer {
        layer(thickness, &[&[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]])
    }

    fn on(mold: &Mold, layers: Vec<Layer>) -> Mold {
        Mold::Layered(Arc::new(Raised { mold: mold.clone(), relief: Layers(layers) }))
    }

    fn plane() -> Mold {
        Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] })
    }

    fn sphere(radius: f64) -> Mold {
        let pose = Pose::new([0.0, 0.0, -0.4], [0.0; 3]);
        Mold::Sphere(Sphere { pose, radius, face: Face::Outside })
    }

    fn saddle() -> Mold {
        let surface = Surface::Saddle(Saddle { radii: [0.6, 0.9] });
        Mold::Graph(Graph { pose: Pose::new([0.0; 3], [0.1, -0.1, 0.5]), surface, domain: None })
    }

    /// The saddle in triangles.
    fn mesh() -> Mold {
        let count = 40;
        let corner = |n: usize| {
            let [i, j] = [n % count, n / count];
            let [x, y] = [i, j].map(|k| -0.3 + 0.6 * k as f64 / (count - 1) as f64);
            [x, y, x * x / 1.2 - y * y / 1.8]
        };
        let vertices: Vec<[f64; 3]> = (0..count * count).map(corner).collect();
        let mut triangles = Vec::new();
        for j in 0..count as u32 - 1 {
            for i in 0..count as u32 - 1 {
                let a = j * count as u32 + i;
                let (b, c, d) = (a + 1, a + 1 + count as u32, a + count as u32);
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        Mold::Mesh(Arc::new(Mesh::of_triangles(vertices, &triangles).expect("a mesh").0))
    }

    /// Places on, in the ramps of, and off the cut layer, none of them special.
    fn places() -> Vec<[f64; 2]> {
        let grid = |n: usize| [n % 37, n / 37].map(|k| -0.151 + 0.0083 * k as f64);
        (0..37 * 37).map(grid).collect()
    }

    #[test]
    fn a_covered_plane_is_a_plane_one_thickness_higher() {
        let mold = on(&plane(), vec![large(THICK)]);
        for p in [[0.1, 0.2, 0.05], [-0.3, 0.0, 1e-5], [0.0, 0.4, -1e-3]] {
            let closest = mold.closest_point(p);
            assert_eq!(closest.point, [p[0], p[1], THICK]);
            assert_eq!((closest.distance, closest.normal), (p[2] - THICK, [0.0, 0.0, 1.0]));
            assert_eq!(mold.separation(p, f64::INFINITY).distance, closest.distance);
        }
        assert_eq!(mold.highest_point([0.1, 0.1]), Some([0.1, 0.1, THICK]));
    }

    #[test]
    fn a_covered_sphere_is_a_sphere_one_thickness_larger() {
        let [thin, thick] = [on(&sphere(0.4), vec![large(THICK)]), sphere(0.4 + THICK)];
        for p in [[0.1, 0.05, 0.06], [-0.2, 0.1, -0.01], [0.02, 0.03, 1e-5]] {
            let [a, b] = [&thin, &thick].map(|mold| mold.closest_point(p));
            assert!(distance(a.point, b.point) < 1e-15 && distance(a.normal, b.normal) < 1e-15);
            assert!((a.distance - b.distance).abs() < 1e-15);
            let [a, b] = [&thin, &thick].map(|mold| mold.curvatures(p).principal);
            assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
            let [a, b] = [&thin, &thick].map(|mold| mold.highest_point([p[0], p[1]]));
            assert!(distance(a.expect("a point"), b.expect("a point")) < 1e-12);
        }
    }

    #[test]
    fn off_the_plies_the_mold_is_as_it_was() {
        for mold in [plane(), sphere(0.4), saddle(), mesh()] {
            let layered = on(&mold, vec![cut()]);
            for [x, y] in [[0.2, 0.1], [-0.16, -0.2], [0.0, 0.19]] {
                let top = mold.highest_point([x, y]).expect("a point");
                for height in [0.02, 0.0, -1e-4] {
                    let p = [x, y, top[2] + height];
                    assert_eq!(layered.closest_point(p), mold.closest_point(p));
                }
                let same = layered.highest_point([x, y]).expect("a point");
                assert!(distance(same, top) < 1e-14, "Newton's last step is rounding");
            }
        }
    }

    #[test]
    fn two_plies_add_up() {
        let second = layer(2e-4, &[&[[-0.05, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.05, 0.2]]]);
        for [x, y] in places() {
            let p = [x, y, 0.0];
            let [a, b] = [cut(), second.clone()].map(|layer| Layers(vec![layer]).at(p));
            let both = Layers(vec![cut(), second.clone()]).at(p);
            assert!((both.height - a.height - b.height).abs() < 1e-18);
            for n in 0..3 {
                assert!((both.gradient[n] - a.gradient[n] - b.gradient[n]).abs() < 1e-15);
            }
        }
        let both = Layers(vec![cut(), second]);
        assert!((both.at([0.05, 0.05, 0.0]).height - 5e-4).abs() < 1e-18);
        assert!((both.most() - 5e-4).abs() < 1e-18);
    }

    /// The height over the plan as it is defined, without the grid of cells; slope and second derivatives by central differences,
    /// where no kink is near.
    #[test]
    fn height_and_slope_are_those_of_the_distance_from_the_boundary() {
        let (layer, width) = (cut(), ramp(THICK));
        let lines: Vec<_> = layer.rings.iter().flat_map(|ring| lines(ring)).collect();
        let height = |place: [f64; 2]| {
            let away = lines.iter().map(|l| from_line(*l, place).0).fold(f64::INFINITY, f64::min);
            let x = if is_inside(&layer.rings, place) { 0.0 } else { (away / width).min(1.0) };
            THICK * (1.0 - 3.0 * x * x + 2.0 * x * x * x)
        };
        let (mut on_ramps, h) = (0, 1e-7);
        for place in places() {
            let (found, slope, hessian) = layer.at(place);
            assert!((found - height(place)).abs() < 1e-18, "{place:?}");
            let moved = |dx: f64, dy: f64| [place[0] + dx, place[1] + dy];
            let central = [
                (height(moved(h, 0.0)) - height(moved(-h, 0.0))) / (2.0 * h),
                (height(moved(0.0, h)) - height(moved(0.0, -h))) / (2.0 * h),
            ];
            // heights of 3e-4 m have 5e-20 m of rounding, over 2e-7 m
            let off = (0..2).map(|n| (slope[n] - central[n]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-5, "{place:?}: {slope:?} {central:?}");
            assert!(slope[0].hypot(slope[1]) <= STEEPEST * (1.0 + 1e-12));
            if found > 0.0 && found < THICK {
                on_ramps += 1;
                let [px, mx] = [h, -h].map(|h| layer.at(moved(h, 0.0)).1);
                let [py, my] = [h, -h].map(|h| layer.at(moved(0.0, h)).1);
                let bends = [px[0] - mx[0], py[0] - my[0], py[1] - my[1]].map(|d| d / (2.0 * h));
                let most = 6.0 * THICK / (width * width);
                for (found, bend) in hessian.into_iter().zip(bends) {
                    assert!((found - bend).abs() < 1e-4 * most, "{place:?} {found} {bend}");
                }
            }
        }
        assert!(on_ramps > 50, "{on_ramps}");
    }

    /// On the ramps closest points lie on the surface, and the normal is the gradient of the signed distance, to the order of
    /// slope times the mold's curvature (2.5/m) times the height.
    #[test]
    fn normals_on_ramps_are_the_gradient_of_the_distance() {
        let mut checked = 0;
        for mold in [plane(), sphere(0.4), saddle()] {
            let layered = on(&mold, vec![cut()]);
            for [x, y] in places().into_iter().step_by(5) {
                let top = layered.highest_point([x, y]).expect("a point");
                assert!(layered.signed_distance(top).abs() < 1e-13, "{x} {y}");
                let closest = layered.closest_point(top);
                assert!(distance(closest.point, top) < 1e-12);
                let slope = dot(closest.normal, mold.normal(top)).clamp(-1.0, 1.0).acos();
                if slope < 1e-3 {
                    continue;
                }
                checked += 1;
                let h = 1e-7;
                let central = [0, 1, 2].map(|axis| {
                    let distance_at = |by: f64| {
                        let mut q = top;
                        q[axis] += by;
                        layered.signed_distance(q)
                    };
                    (distance_at(h) - distance_at(-h)) / (2.0 * h)
                });
                assert!(distance(central, closest.normal) < 2.0 * STEEPEST * 2.5 * THICK + 1e-6);
            }
        }
        assert!(checked > 30, "{checked}");
    }

    /// Along the normal from any point of the covered mesh the distance grows as the way does.
    #[test]
    fn a_mesh_with_a_ply_on_it_is_offset_along_its_normal() {
        let (mold, layered) = (mesh(), on(&mesh(), vec![large(THICK)]));
        for [x, y] in [[0.013, 0.027], [-0.15, 0.04], [0.09, -0.16]] {
            let top = mold.highest_point([x, y]).expect("a point");
            let closest = layered.closest_point(top);
            assert!((closest.distance + THICK).abs() < 1e-12);
            let above = layered.closest_point(along(closest.point, 1e-3, closest.normal));
            assert!((above.distance - 1e-3).abs() < 1e-6, "{}", above.distance);
            assert!(
                (distance(above.point, mold.closest_point(above.point).point) - THICK).abs() < 1e-9
            );
        }
    }

    #[test]
    fn plies_overlap_where_both_lie_and_not_where_their_edges_meet() {
        let box_of = |[a, b, c, d]: [f64; 4]| vec![vec![[a, b], [c, b], [c, d], [a, d]]];
        let [left, right] = [[0.0, 0.0, 0.2, 0.1], [0.2, 0.0, 0.4, 0.1]].map(box_of);
        assert!(!overlap(&left, &right, THICK) && !overlap(&right, &left, THICK));
        assert!(overlap(&left, &left, THICK), "the same region");
        let across = box_of([0.1, -0.3, 0.101, 0.3]);
        assert!(overlap(&left, &across, THICK) && overlap(&across, &left, THICK), "a cross");
        let small = box_of([0.05, 0.05, 0.052, 0.052]);
        assert!(overlap(&left, &small, THICK), "one within the other");
        let mut frame = left.clone();
        frame.extend(box_of([0.04, 0.04, 0.06, 0.06]));
        assert!(!overlap(&frame, &small, THICK), "one in a hole of the other");
        assert!(!overlap(&left, &box_of([0.1998, 0.0, 0.4, 0.1]), THICK), "within the thickness");
        assert!(overlap(&left, &box_of([0.199, 0.0, 0.4, 0.1]), THICK), "beyond it");
    }

    #[test]
    fn a_layer_without_thickness_or_region_is_refused() {
        let ring = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(matches!(Layer::new(0.0, vec![ring.clone()]), Err(Error::LayerThickness { .. })));
        assert!(matches!(Layer::new(f64::NAN, vec![ring]), Err(Error::LayerThickness { .. })));
        assert!(matches!(Layer::new(1e-3, Vec::new()), Err(Error::LayerRegion { rings: 0 })));
        let short = vec![[0.0, 0.0], [1.0, 0.0]];
        assert!(matches!(Layer::new(1e-3, vec![short]), Err(Error::LayerRegion { .. })));
    }
}
