//! The boundary of a ply in the flat: a polygon, with holes.
//!
//! A curved boundary is a polygon that follows it; what reads it says how closely. Places are fabric coordinates (m).

use crate::Error;
use crate::geometry::ring::{area, bounds, is_inside, lines};

/// A closed polygon; its first point is not repeated at its end (m).
pub type Ring = Vec<[f64; 2]>;

/// A ply's boundary in the flat. The boundary runs counterclockwise, holes run clockwise.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Outline {
    boundary: Ring,
    holes: Vec<Ring>,
}

impl Outline {
    /// An outline from its boundary and its holes, each in either sense (m).
    ///
    /// # Errors
    /// [`Error::OutlineNotFinite`], [`Error::OutlineTooFew`] or [`Error::OutlineFlat`] for a ring that bounds nothing,
    /// [`Error::OutlineCrosses`] for rings that cross, [`Error::OutlineHoleOutside`] for a hole that is not in the ply.
    pub fn new(boundary: Ring, holes: Vec<Ring>) -> Result<Self, Error> {
        let rings = std::iter::once(boundary).chain(holes).enumerate();
        let mut rings: Vec<Ring> =
            rings.map(|(n, ring)| checked(ring, n)).collect::<Result<_, _>>()?;
        check_crossings(&rings)?;
        for (n, ring) in rings.iter().enumerate() {
            let [low, high] = bounds(ring);
            let size = (high[0] - low[0]).max(high[1] - low[1]);
            if area(ring).abs() <= 1e-9 * size * size {
                return Err(Error::OutlineFlat { ring: n });
            }
        }
        let holes = rings.split_off(1);
        let boundary = rings.swap_remove(0);
        for (hole, ring) in holes.iter().enumerate() {
            let others = holes.iter().enumerate().filter(|(other, _)| *other != hole);
            let apart = others.into_iter().all(|(_, other)| !is_inside(other, ring[0]));
            if !is_inside(&boundary, ring[0]) || !apart {
                return Err(Error::OutlineHoleOutside { ring: hole + 1, at: ring[0] });
            }
        }
        let wound = |ring: Ring, sense: f64| {
            if area(&ring) * sense > 0.0 { ring } else { ring.into_iter().rev().collect() }
        };
        Ok(Outline {
            boundary: wound(boundary, 1.0),
            holes: holes.into_iter().map(|hole| wound(hole, -1.0)).collect(),
        })
    }

    /// A rectangle between two of its corners (m).
    ///
    /// # Errors
    /// The errors of [`Outline::new`] if it bounds nothing.
    pub fn rectangle([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Result<Self, Error> {
        Outline::new(vec![[a, b], [c, b], [c, d], [a, d]], Vec::new())
    }

    /// Boundary (m), counterclockwise.
    #[must_use]
    pub fn boundary(&self) -> &[[f64; 2]] {
        &self.boundary
    }

    /// Holes (m), each clockwise.
    #[must_use]
    pub fn holes(&self) -> &[Ring] {
        &self.holes
    }

    /// Boundary and holes (m).
    pub fn rings(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        std::iter::once(&self.boundary).chain(&self.holes).map(Vec::as_slice)
    }

    /// All of its lines, end to end around each ring; what they bound is to their left (m).
    pub fn lines(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.rings().flat_map(lines)
    }

    /// Area without the holes (m²).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.rings().map(area).sum()
    }

    /// Lowest and highest coordinates (m).
    #[must_use]
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        bounds(&self.boundary)
    }

    /// This outline with all of its points moved by a map that keeps senses, as turns and shifts do.
    #[must_use]
    pub fn moved(&self, map: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let mapped = |ring: &Ring| ring.iter().map(|p| map(*p)).collect();
        Outline { boundary: mapped(&self.boundary), holes: self.holes.iter().map(mapped).collect() }
    }

    /// Whether a point (m) is in the ply, and not in a hole.
    #[must_use]
    pub fn contains(&self, point: [f64; 2]) -> bool {
        // even and odd: holes count once more
        self.rings().filter(|ring| is_inside(ring, point)).count() % 2 == 1
    }

    /// How far inside the boundary and outside the holes a point is (m); negative off the ply.
    #[must_use]
    pub fn depth(&self, point: [f64; 2]) -> f64 {
        let away = self.lines().map(|line| away(line, point)).fold(f64::INFINITY, f64::min);
        if self.contains(point) { away } else { -away }
    }

    /// Whether the fabric is there all along a straight line (m): it crosses no boundary and no hole. It may end on the boundary,
    /// or run along it.
    #[must_use]
    pub fn has_line(&self, [a, b]: [[f64; 2]; 2]) -> bool {
        let way = sub(b, a);
        let square = way[0] * way[0] + way[1] * way[1];
        let rounding = 1e-9;
        let crosses = |[c, d]: [[f64; 2]; 2]| {
            let [c, d] = [sub(c, a), sub(d, a)];
            let [left, right] = [cross(way, c), cross(way, d)];
            // a corner on the line counts as being to its right, so that a ring is crossed there once
            let is_left = |side: f64| side > rounding * square;
            if is_left(left) == is_left(right) {
                return false;
            }
            let t = left / (left - right);
            let meets = [c[0] + t * (d[0] - c[0]), c[1] + t * (d[1] - c[1])];
            let share = (meets[0] * way[0] + meets[1] * way[1]) / square;
            share > rounding && share < 1.0 - rounding
        };
        let middle = [0, 1].map(|n| 0.5 * (a[n] + b[n]));
        self.depth(middle) >= -rounding * square.sqrt() && !self.lines().any(crosses)
    }

    /// Area of the ply in a rectangle between two corners (m²): the lowest and the highest coordinates.
    #[must_use]
    pub fn area_in(&self, low: [f64; 2], high: [f64; 2]) -> f64 {
        let clipped = |ring| area(&clip(ring, low, high));
        self.rings().map(clipped).sum::<f64>().max(0.0)
    }

    /// What its rings enclose of a rectangle between two corners (m), the ply on the left of each. Parts of a ring are joined
    /// by lines along the sides of the rectangle.
    #[must_use]
    pub fn rings_in(&self, low: [f64; 2], high: [f64; 2]) -> Vec<Ring> {
        let clipped = self.rings().map(|ring| clip(ring, low, high));
        clipped.filter(|part| area(part) != 0.0).collect()
    }

    /// Center of the ply's area in a rectangle between two corners (m); `None` where there is none.
    #[must_use]
    pub fn center_in(&self, low: [f64; 2], high: [f64; 2]) -> Option<[f64; 2]> {
        let (mut total, mut moment) = (0.0, [0.0; 2]);
        for part in self.rings().map(|ring| clip(ring, low, high)) {
            for [a, b] in lines(&part) {
                // triangles from the lowest corner
                let (p, q) = (sub(a, low), sub(b, low));
                let area = 0.5 * cross(p, q);
                total += area;
                moment = [0, 1].map(|n| moment[n] + area * (p[n] + q[n]) / 3.0);
            }
        }
        let center = [0, 1].map(|n| low[n] + moment[n] / total);
        let within = |n: usize| (low[n]..=high[n]).contains(&center[n]);
        (total > 0.0 && within(0) && within(1)).then_some(center)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Outline {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Rings {
            boundary: Ring,
            holes: Vec<Ring>,
        }
        let Rings { boundary, holes } = Rings::deserialize(from)?;
        Outline::new(boundary, holes).map_err(serde::de::Error::custom)
    }
}

/// Distance of a point from a line between two ends (m).
fn away([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> f64 {
    let (way, to) = (sub(b, a), sub(point, a));
    let t = (dot(way, to) / dot(way, way)).clamp(0.0, 1.0);
    let off = [to[0] - t * way[0], to[1] - t * way[1]];
    off[0].hypot(off[1])
}

/// A ring cut to a rectangle (Sutherland and Hodgman 1974); parts of it are joined by lines along the sides, which bound no
/// area.
fn clip(ring: &[[f64; 2]], low: [f64; 2], high: [f64; 2]) -> Ring {
    let mut out = ring.to_vec();
    for axis in 0..2 {
        for (limit, sense) in [(low[axis], 1.0), (high[axis], -1.0)] {
            let inside = |p: &[f64; 2]| sense * (p[axis] - limit) >= 0.0;
            let from = std::mem::take(&mut out);
            for [a, b] in lines(&from) {
                if inside(&a) {
                    out.push(a);
                }
                if inside(&a) != inside(&b) {
                    let t = (limit - a[axis]) / (b[axis] - a[axis]);
                    let mut cut = [0, 1].map(|n| a[n] + t * (b[n] - a[n]));
                    cut[axis] = limit;
                    out.push(cut);
                }
            }
        }
    }
    out
}

/// The n-th ring, with different points.
fn checked(mut ring: Ring, n: usize) -> Result<Ring, Error> {
    if let Some(point) = ring.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
        return Err(Error::OutlineNotFinite { ring: n, point: point + 1 });
    }
    let [low, high] = bounds(&ring);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let same = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= 1e-9 * size;
    ring.dedup_by(|b, a| same(*a, *b));
    while ring.len() > 1 && same(ring[0], ring[ring.len() - 1]) {
        ring.pop();
    }
    if ring.len() < 3 {
        return Err(Error::OutlineTooFew { ring: n, points: ring.len() });
    }
    Ok(ring)
}

/// Refuses lines that meet other than end to end; lines are taken in the order of their lowest x.
fn check_crossings(rings: &[Ring]) -> Result<(), Error> {
    struct RingSide {
        ring: usize,
        place: usize,
        ends: [[f64; 2]; 2],
    }
    // sweep over x: a side meets only those that begin before it ends
    let sides_of = |(ring, points): (usize, &Ring)| -> Vec<RingSide> {
        let number = |(place, ends)| RingSide { ring, place, ends };
        lines(points).enumerate().map(number).collect()
    };
    let mut all: Vec<RingSide> = rings.iter().enumerate().flat_map(sides_of).collect();
    let span = |line: &RingSide| {
        let [a, b] = line.ends;
        [a[0].min(b[0]), a[0].max(b[0])]
    };
    all.sort_by(|a, b| span(a)[0].total_cmp(&span(b)[0]));
    for (n, a) in all.iter().enumerate() {
        for b in all[n + 1..].iter().take_while(|b| span(b)[0] <= span(a)[1]) {
            // neighbors share an end, and may only not fold back
            let count = rings[a.ring].len();
            let next = |p: usize, q: usize| (p + 1) % count == q;
            let neighbors = a.ring == b.ring && (next(a.place, b.place) || next(b.place, a.place));
            let met = if neighbors { folded_back(a.ends, b.ends) } else { meet(a.ends, b.ends) };
            if let Some(at) = met {
                let (first, second) = (a.ring.min(b.ring), a.ring.max(b.ring));
                return Err(Error::OutlineCrosses { a: first, b: second, at });
            }
        }
    }
    Ok(())
}

/// Where two lines that share no end meet or touch; `None` where they do not.
fn meet([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (p, q) = (sub(b, a), sub(d, c));
    let sides =
        [cross(p, sub(c, a)), cross(p, sub(d, a)), cross(q, sub(a, c)), cross(q, sub(b, c))];
    let within = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
        (0..2).all(|n| p[n] >= a[n].min(b[n]) && p[n] <= a[n].max(b[n]))
    };
    for (side, point, ends) in
        [(sides[0], c, [a, b]), (sides[1], d, [a, b]), (sides[2], a, [c, d]), (sides[3], b, [c, d])]
    {
        if side == 0.0 && within(ends[0], ends[1], point) {
            return Some(point);
        }
    }
    let apart = |s: f64, t: f64| (s > 0.0) == (t > 0.0);
    if apart(sides[0], sides[1]) || apart(sides[2], sides[3]) {
        return None;
    }
    let t = sides[0] / (sides[0] - sides[1]);
    Some([0, 1].map(|n| c[n] + t * q[n]))
}

/// The common end of two neighboring lines of a ring of which one goes back along the other.
fn folded_back([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (p, q, at) = if b == c { (sub(b, a), sub(d, c), b) } else { (sub(d, c), sub(b, a), d) };
    let back = dot(p, q) < 0.0 && cross(p, q).abs() <= 1e-12 * p[0].hypot(p[1]) * q[0].hypot(q[1]);
    back.then_some(at)
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A star around (0.3, −0.2) m with these radii (m), which never crosses itself.
    fn star(radii: &[f64]) -> Ring {
        let point = |(n, r): (usize, &f64)| {
            let (sin, cos) = (std::f64::consts::TAU * n as f64 / radii.len() as f64).sin_cos();
            [0.3 + r * cos, -0.2 + r * sin]
        };
        radii.iter().enumerate().map(point).collect()
    }

    proptest! {
        /// However an outline is cut into a grid of rectangles, their areas add up to its own, holes left out; and no
        /// rectangle holds more than its own.
        #[test]
        fn rectangles_share_all_of_the_area(
            outer in prop::collection::vec(0.5..1.0f64, 3..30),
            inner in prop::collection::vec(0.05..0.2f64, 3..20),
            x in 0.05..0.3f64, y in 0.05..0.3f64,
        ) {
            // the inner star is inside a triangle of circumradius 0.5
            let outline = Outline::new(star(&outer), vec![star(&inner)]).unwrap();
            let expected = area(&star(&outer)) - area(&star(&inner));
            prop_assert!((outline.area() - expected).abs() < 1e-12);
            let [low, high] = outline.bounds();
            let mut sum = 0.0;
            for i in 0..((high[0] - low[0]) / x).ceil() as usize {
                for j in 0..((high[1] - low[1]) / y).ceil() as usize {
                    let corner = [low[0] + i as f64 * x, low[1] + j as f64 * y];
                    let part = outline.area_in(corner, [corner[0] + x, corner[1] + y]);
                    prop_assert!(part <= x * y * (1.0 + 1e-12));
                    sum += part;
                }
            }
            prop_assert!((sum - expected).abs() < 1e-12, "{} {}", sum, expected);
        }

        /// A point is inside exactly if its depth is positive, and a circle of that depth around it meets no boundary.
        #[test]
        fn depth_is_the_distance_to_the_boundary(
            outer in prop::collection::vec(0.5..1.0f64, 3..30), x in -1.0..1.6f64, y in -1.4..1.0f64,
        ) {
            let hole = star(&[0.1; 8]);
            let outline = Outline::new(star(&outer), vec![hole]).unwrap();
            let depth = outline.depth([x, y]);
            prop_assert_eq!(depth > 0.0, outline.contains([x, y]));
            for n in 0..40 {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(n) / 40.0).sin_cos();
                let near = [x + 0.999 * depth.abs() * cos, y + 0.999 * depth.abs() * sin];
                prop_assert_eq!(outline.contains(near), depth > 0.0);
            }
        }
    }

    #[test]
    fn rings_are_wound_so_that_the_ply_is_on_their_left() {
        let square = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let hole = vec![[0.4, 0.4], [0.6, 0.4], [0.5, 0.6]];
        let outline = Outline::new(square, vec![hole]).unwrap();
        assert!(area(outline.boundary()) == 1.0 && area(&outline.holes()[0]) < 0.0);
        assert_eq!(outline.boundary().len(), 4, "a last point at the first is no point of its own");
        assert!(!outline.contains([0.5, 0.5]) && outline.contains([0.1, 0.5]));
    }

    #[test]
    fn what_is_no_outline_is_refused_with_its_place() {
        let refused = |boundary: &[[f64; 2]], holes: &[&[[f64; 2]]]| {
            let holes = holes.iter().map(|hole| hole.to_vec()).collect();
            Outline::new(boundary.to_vec(), holes).unwrap_err().to_string()
        };
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(
            refused(&bow, &[]),
            "the boundary crosses or touches itself at (500.000, 500.000) mm"
        );
        let pinched = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.5, 1.0]];
        assert!(refused(&pinched, &[]).contains("(1000.000, 0.000) mm"));
        assert!(refused(&square[..2], &[]).contains("has 2 different points"));
        let back = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
        assert!(refused(&back, &[]).contains("touches itself at"));
        let sliver = [[0.0, 0.0], [1.0, 0.0], [0.5, 1e-10]];
        assert!(refused(&sliver, &[]).contains("bounds no area"));
        assert!(refused(&[[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]], &[]).contains("point 2"));
        let beside: &[[f64; 2]] = &[[2.0, 2.0], [2.1, 2.0], [2.0, 2.1]];
        assert!(refused(&square, &[beside]).starts_with("hole 1 at (2000.000, 2000.000) mm"));
        let across: &[[f64; 2]] = &[[0.5, 0.5], [1.5, 0.5], [0.5, 0.6]];
        assert!(refused(&square, &[across]).starts_with("the boundary and hole 1 cross"));
        let hole: &[[f64; 2]] = &[[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]];
        let inner: &[[f64; 2]] = &[[0.45, 0.4], [0.55, 0.4], [0.5, 0.5]];
        assert!(refused(&square, &[hole, inner]).starts_with("hole 2 at"));
    }
}
