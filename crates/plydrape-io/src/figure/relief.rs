//! A curved mold under the ply: a patch of it in quads, shaded by how they face the light, and what it hides.
//!
//! The patch is the mold's height over a rectangle of the plan, z = h(x, y), sampled at the corners of a
//! grid. A point of the ply is behind the mold if its line of sight runs below that height on the way to
//! the eye. So the picture is painted in three layers, each from far to near: what is behind the mold, the
//! mold, what is in front. Ply that lies on the mold is in front, whatever its quads measure.

use super::FigureError;
use super::canvas::{Canvas, Ink, Px};
use super::colour::{MOLD_DARK, MOLD_EDGE, MOLD_LIGHT};
use super::piece::{Form, Piece, grown, paint};
use super::projection::{Point, View};
use plydrape::mold::Mold;
use plydrape::mold::patch::boundary;

/// Quads along the longer side of the plan.
const QUADS: usize = 30;
/// Quads between the grid lines on the mold.
const APART: usize = 2;
/// What the line of sight may run below the mold, as a share of the width, without being hidden.
const HAIR: f64 = 2e-3;
/// How much the back of a surface covers of what it hides.
pub(super) const BACK: f64 = 0.4;
/// Where the light comes from: from the left, above, a little from the front, as seen on the sheet.
const LIGHT: [f64; 3] = [-0.45, 0.75, 0.48];

/// A patch of a curved mold over a rectangle of the plan.
pub(super) struct Relief {
    low: [f64; 2],
    /// Sides of a quad along x and y (m).
    side: [f64; 2],
    /// Quads along x and y.
    count: [usize; 2],
    /// Points of the mold at the corners, x running fastest; none where there is no mold.
    corners: Vec<Option<Point>>,
    /// The parts of the quads that the mold covers.
    quads: Vec<Quad>,
    /// Height of its highest point (m).
    top: f64,
}

/// What there is of the mold in one quad of the plan.
struct Quad {
    /// Its outline, three to six points (m).
    outline: Vec<Point>,
    /// Pieces of the grid lines on it (m).
    lines: Vec<[Point; 2]>,
}

impl Relief {
    /// The mold over the rectangle between two corners, where it is not lower than `floor` (m) and not
    /// higher than `roof` (m); none if nothing of it is there.
    pub(super) fn of(
        mold: &Mold,
        low: [f64; 2],
        high: [f64; 2],
        [floor, roof]: [f64; 2],
    ) -> Option<Self> {
        let wide = [0, 1].map(|c| high[c] - low[c]);
        let longer = wide[0].max(wide[1]);
        let count = wide.map(|w| ((w / longer * QUADS as f64).round() as usize).clamp(4, QUADS));
        let count = count.map(|n| n.next_multiple_of(APART));
        let side = [0, 1].map(|c| wide[c] / count[c] as f64);
        let on = |x: f64, y: f64| {
            let point = mold.highest_point([x, y])?;
            (point.iter().all(|c| c.is_finite()) && point[2] > floor && point[2] < roof)
                .then_some(point)
        };
        let plan = |k: usize, m: usize| [low[0] + k as f64 * side[0], low[1] + m as f64 * side[1]];
        let mut corners = Vec::with_capacity((count[0] + 1) * (count[1] + 1));
        for m in 0..=count[1] {
            for k in 0..=count[0] {
                let [x, y] = plan(k, m);
                corners.push(on(x, y));
            }
        }
        let mut quads = Vec::new();
        for m in 0..count[1] {
            for k in 0..count[0] {
                let ids = [[k, m], [k + 1, m], [k + 1, m + 1], [k, m + 1]];
                let found = ids.map(|[k, m]| corners[m * (count[0] + 1) + k]);
                let places = ids.map(|[k, m]| plan(k, m));
                // lines along the first and the last sides, and every few quads between
                let ruled = [m % APART == 0, k + 1 == count[0], m + 1 == count[1], k % APART == 0];
                quads.extend(Quad::of(places, found, ruled, &on));
            }
        }
        let top = quads.iter().flat_map(|q| &q.outline).map(|p| p[2]).reduce(f64::max)?;
        Some(Relief { low, side, count, corners, quads, top })
    }

    /// Lowest and highest point of the patch (m).
    pub(super) fn heights(&self) -> [f64; 2] {
        let all = self.quads.iter().flat_map(|q| &q.outline).map(|p| p[2]);
        [all.fold(f64::INFINITY, f64::min), self.top]
    }

    /// The patch in polygons (m).
    pub(super) fn outlines(&self) -> Vec<Vec<Point>> {
        self.quads.iter().map(|quad| quad.outline.clone()).collect()
    }

    /// Height of the mold over a place of the plan (m), between the corners of its quad.
    fn height(&self, x: f64, y: f64) -> Option<f64> {
        let along = [(x - self.low[0]) / self.side[0], (y - self.low[1]) / self.side[1]];
        if !(0..2).all(|c| (0.0..=self.count[c] as f64).contains(&along[c])) {
            return None;
        }
        let [k, m] = [0, 1].map(|c| (along[c] as usize).min(self.count[c] - 1));
        let [s, t] = [along[0] - k as f64, along[1] - m as f64];
        let z = |k: usize, m: usize| self.corners[m * (self.count[0] + 1) + k].map(|p| p[2]);
        let near = (1.0 - s) * z(k, m)? + s * z(k + 1, m)?;
        let far = (1.0 - s) * z(k, m + 1)? + s * z(k + 1, m + 1)?;
        Some((1.0 - t) * near + t * far)
    }

    /// True if the mold stands between a point (m) and the eye. What is inside the mold counts as lying
    /// on it.
    fn hides(&self, view: &View, [x, y, z]: Point) -> bool {
        let [dx, dy, rise] = view.towards();
        let step = 0.5 * self.side[0].min(self.side[1]) / dx.hypot(dy);
        let hair = HAIR * self.side[0] * self.count[0] as f64;
        let start = self.height(x, y).map_or(z, |h| h.max(z));
        let within = |n: usize| {
            let way = step * n as f64;
            let ray = start + way * rise;
            (ray < self.top).then_some((x + way * dx, y + way * dy, ray))
        };
        (1..400)
            .map_while(within)
            .any(|(x, y, ray)| self.height(x, y).is_some_and(|h| h > ray + hair))
    }

    /// Draws what is behind the mold, the mold, and what is in front.
    pub(super) fn paint_among(
        &self,
        canvas: &mut Canvas,
        view: &View,
        pieces: Vec<Piece>,
    ) -> Result<(), FigureError> {
        let (behind, front): (Vec<Piece>, Vec<Piece>) =
            pieces.into_iter().partition(|piece| self.hides(view, piece.place));
        paint(canvas, behind)?;
        self.draw(canvas, view)?;
        paint(canvas, front)
    }

    /// Draws the patch. Where it turns its back to the eye it lets through what it hides.
    fn draw(&self, canvas: &mut Canvas, view: &View) -> Result<(), FigureError> {
        let mut pieces = Vec::new();
        for quad in &self.quads {
            let mean = |of: &dyn Fn(Point) -> f64| {
                quad.outline.iter().map(|p| of(*p)).sum::<f64>() / quad.outline.len() as f64
            };
            let depth = mean(&|p| view.depth(p));
            let place = [0, 1, 2].map(|c| mean(&|p| p[c]));
            let flat: Vec<Px> = quad.outline.iter().map(|p| view.at(*p)).collect();
            let (ink, cover) = shade(view, &quad.outline);
            let points = if cover < 1.0 { flat } else { grown(&flat) };
            pieces.push(Piece { depth, place, points, ink: Ink(ink, cover), form: Form::Area });
            // nearer than the quads on both of its sides
            let all = quad.outline.iter().map(|p| view.depth(*p));
            let spread =
                all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min);
            let depth = depth + spread.max(self.side[0].max(self.side[1]));
            for line in &quad.lines {
                let points = line.map(|p| view.at(p)).to_vec();
                pieces.push(Piece { depth, place, points, ink: MOLD_EDGE, form: Form::Line(0.5) });
            }
        }
        paint(canvas, pieces)
    }
}

impl Quad {
    /// The part of a quad that the mold covers: its corners that have a point of the mold, and where the
    /// mold ends on its sides.
    fn of(
        places: [[f64; 2]; 4],
        found: [Option<Point>; 4],
        ruled: [bool; 4],
        on: &dyn Fn(f64, f64) -> Option<Point>,
    ) -> Option<Self> {
        let mut quad = Quad { outline: Vec::new(), lines: Vec::new() };
        for n in 0..4 {
            let next = (n + 1) % 4;
            let side = match (found[n], found[next]) {
                (Some(a), Some(b)) => Some([a, b]),
                (Some(a), None) => Some([a, boundary(a, places[n], places[next], on)]),
                (None, Some(b)) => Some([boundary(b, places[next], places[n], on), b]),
                (None, None) => None,
            };
            let Some(side) = side else { continue };
            quad.outline.extend(side);
            if ruled[n] {
                quad.lines.push(side);
            }
        }
        quad.outline.dedup();
        if quad.outline.first() == quad.outline.last() {
            quad.outline.pop();
        }
        (quad.outline.len() > 2).then_some(quad)
    }
}

/// Gray of a quad and how much it covers: lighter towards the light, thin where its back is seen.
fn shade(view: &View, outline: &[Point]) -> ([u8; 3], f64) {
    let (mut normal, first) = ([0.0; 3], outline[0]);
    for pair in outline[1..].windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| [0, 1, 2].map(|c| p[c] - first[c]));
        let part =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        normal = [0, 1, 2].map(|c| normal[c] + part[c]);
    }
    let on_sheet = view.axes().map(|axis| (0..3).map(|c| axis[c] * normal[c]).sum::<f64>());
    let size = on_sheet.iter().map(|c| c * c).sum::<f64>().sqrt().max(1e-300);
    let facing: f64 = (0..3).map(|c| on_sheet[c] * LIGHT[c]).sum::<f64>() / size;
    let share = (0.5 + 0.5 * facing).clamp(0.0, 1.0).powi(2);
    let ink = [0, 1, 2].map(|c| {
        let (dark, light) = (f64::from(MOLD_DARK.0[c]), f64::from(MOLD_LIGHT.0[c]));
        (dark + share * (light - dark)).round() as u8
    });
    (ink, if on_sheet[2] < 0.0 { BACK } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::mold::{Face, Pose, Sphere};

    fn ball() -> Mold {
        let pose = Pose::new([0.0, 0.0, -0.2], [0.0; 3]);
        Mold::Sphere(Sphere { pose, radius: 0.2, face: Face::Outside })
    }

    /// A sphere seen from the front hides what is at its back, and nothing on its front or its top.
    #[test]
    fn a_sphere_hides_what_lies_on_its_back() {
        let relief = Relief::of(&ball(), [-0.25, -0.2], [0.25, 0.2], [-0.18, 1.0]).unwrap();
        let view = View::of([-0.25, -0.2, -0.2], [0.25, 0.2, 0.1], 1.0);
        let towards = view.towards();
        let on = |share: f64| {
            // along the line of sight as seen from above: −1 the back edge, 1 the front edge
            let run = towards[0].hypot(towards[1]);
            let [x, y] = [towards[0], towards[1]].map(|c| 0.2 * share * c / run);
            ball().highest_point([x, y]).unwrap()
        };
        // the line of sight touches where the slope is that of the view, 32°
        let limit = 32.0_f64.to_radians().sin();
        for (share, hidden) in
            [(0.7, false), (0.0, false), (-limit + 0.1, false), (-limit - 0.2, true)]
        {
            assert_eq!(relief.hides(&view, on(share)), hidden, "{share}");
            let [x, y, z] = on(share);
            assert_eq!(
                relief.hides(&view, [x, y, z - 1e-3]),
                hidden,
                "{share}, a millimeter inside"
            );
        }
        let [x, y, z] = on(-limit - 0.2);
        assert!(!relief.hides(&view, [x, y, z + 0.1]));
    }

    /// Where the mold ends within a quad, its outline ends on the boundary.
    #[test]
    fn a_patch_ends_where_the_mold_does() {
        let relief = Relief::of(&ball(), [-0.3, -0.3], [0.3, 0.3], [-1.0, 1.0]).unwrap();
        let mut reach = 0.0_f64;
        for p in relief.quads.iter().flat_map(|q| &q.outline) {
            let from_axis = p[0].hypot(p[1]);
            assert!(from_axis < 0.2 + 1e-9 && (ball().signed_distance(*p)).abs() < 1e-9);
            reach = reach.max(from_axis);
        }
        assert!(reach > 0.1995, "{reach}");
        assert!(Relief::of(&ball(), [1.0, 1.0], [1.2, 1.2], [-1.0, 1.0]).is_none());
    }
}
