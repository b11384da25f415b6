//! Distance of the ply's boundary from a target boundary.
//!
//! Lengths along the mold follow formula (14) of `docs/theory/net.md`: exact on planes, cylinders and spheres, of fourth
//! order in the distance on other molds. The side follows from the target boundary at its closest point: it runs around the
//! ply in the sense of the ply's own boundary.

use super::boundary::{Boundary, BoundaryLine, PlyPoint};
use super::edge::EdgeRule;
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::vector::{along, between, cross, direction, distance, dot, norm, sub, unit};
use crate::mold::Mold;

/// A target boundary: a closed line on the mold.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetBoundary {
    points: Vec<SurfacePoint>,
    /// Largest distance of its given points from the mold (m).
    pub distance: f64,
}

/// Where the ply ends beside its target boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TrimPlace {
    /// Signed distance along the mold (m), positive where the ply reaches beyond.
    pub error: f64,
    /// Which fabric, and where.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub at: PlyPoint,
}

/// The outer boundary of a ply compared with a target, along the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Trim {
    /// Where the ply reaches farthest beyond; `None` where it does nowhere.
    pub beyond: Option<TrimPlace>,
    /// Where it ends farthest inside; `None` where it does nowhere.
    pub short: Option<TrimPlace>,
    /// Mean of the signed distance over the length of the boundary (m).
    pub mean: f64,
    /// Mean of its magnitude (m).
    pub mean_magnitude: f64,
    /// Length of the ply's boundary that was compared (m).
    pub compared: f64,
    /// Length of fabric of that boundary that has no place on the mold, and so is not compared (m).
    pub not_compared: f64,
    /// The point of the target boundary that is farthest from the ply's, as far as that is on the mold: place (m) and
    /// distance (m). It is larger than the others where the ply has a notch.
    pub farthest_wanted: ([f64; 3], f64),
}

impl TargetBoundary {
    /// A target boundary through points on a mold (m), in turn around the ply in either sense; between them it runs straight
    /// over the mold. `mesh` is a mesh width of the net (m), the scale of all tolerances.
    ///
    /// # Errors
    /// [`Error::BoundaryTooFew`] for fewer than three points, [`Error::BoundaryOffMold`] if one is not on the mold.
    pub fn new(mold: &Mold, points: &[[f64; 3]], mesh: f64) -> Result<Self, Error> {
        let mut points: Vec<(usize, [f64; 3])> = points.iter().copied().enumerate().collect();
        let same = |a: [f64; 3], b: [f64; 3]| distance(a, b) <= TUNING.same_boundary_point * mesh;
        points.dedup_by(|b, a| same(a.1, b.1));
        while points.len() > 1 && same(points[0].1, points[points.len() - 1].1) {
            points.pop();
        }
        if points.len() < 3 {
            return Err(Error::BoundaryTooFew { points: points.len() });
        }
        let surface = ExtendedSurface::new(mold);
        let mut given = Vec::with_capacity(points.len());
        let mut farthest = 0.0_f64;
        for (point, place) in points {
            let closest = surface.under(place);
            let away = distance(place, closest.point).max(closest.beyond);
            // what is no number is on no mold
            if away.is_nan() || away > TUNING.curve_distance * mesh {
                return Err(Error::BoundaryOffMold { point, distance: away });
            }
            farthest = farthest.max(away);
            given.push(closest);
        }
        let mut points = Vec::new();
        for (n, a) in given.iter().enumerate() {
            points.push(*a);
            let b = given[(n + 1) % given.len()];
            follow(&surface, *a, b, mesh, 0, &mut points);
        }
        Ok(TargetBoundary { points, distance: farthest })
    }

    /// Lines, end to end.
    fn lines(&self) -> Vec<[SurfacePoint; 2]> {
        let count = self.points.len();
        (0..count).map(|n| [self.points[n], self.points[(n + 1) % count]]).collect()
    }
}

/// Points between two others, so close that the mold is within a share of the mesh width of the line between neighbors, and
/// no farther apart than a mesh width.
fn follow(
    surface: &ExtendedSurface,
    a: SurfacePoint,
    b: SurfacePoint,
    mesh: f64,
    depth: usize,
    out: &mut Vec<SurfacePoint>,
) {
    let middle = between(a.point, b.point, 0.5);
    let on = surface.under(middle);
    let long = distance(a.point, b.point) > mesh;
    let bent = distance(middle, on.point) > TUNING.boundary_sag * mesh;
    if (long || bent) && depth < TUNING.boundary_end_halvings {
        follow(surface, a, on, mesh, depth + 1, out);
        out.push(on);
        follow(surface, on, b, mesh, depth + 1, out);
    }
}

impl Boundary {
    /// Compares the outer boundary of the ply with a target; `None` if nothing of it is on the mold.
    #[must_use]
    pub fn trim(&self, mold: &Mold, wanted: &TargetBoundary) -> Option<Trim> {
        let surface = ExtendedSurface::new(mold);
        let curve = wanted.lines();
        let outer: Vec<&BoundaryLine> = self.lines.iter().filter(|line| line.ring == 0).collect();
        let own: Vec<[SurfacePoint; 2]> = outer.iter().flat_map(|line| pieces(line)).collect();

        // how far each point of the own boundary is beside the target, on the surface
        let mut found: Vec<Vec<Beside>> = Vec::with_capacity(outer.len());
        for line in &outer {
            let beside = (0..line.points.len()).map(|n| beside(&surface, &point(line, n), &curve));
            found.push(beside.collect::<Option<_>>()?);
        }
        // both boundaries run around the ply in the same sense, or in opposite ones
        let mut sense = 0.0;
        for (line, found) in outer.iter().zip(&found) {
            for ([a, b], n) in pieces(line).into_iter().zip(0..) {
                sense += dot(sub(b.point, a.point), found[n].tangent);
            }
        }
        let sense = if sense < 0.0 { -1.0 } else { 1.0 };

        // fabric beyond the target and short of it, and the mean over the length by the trapezoidal rule
        let (mut compared, mut sum, mut magnitudes) = (0.0, 0.0, 0.0);
        let (mut beyond, mut short) = (None::<TrimPlace>, None::<TrimPlace>);
        for (line, found) in outer.iter().zip(&found) {
            let error = |n: usize| -sense * found[n].left;
            for (n, at) in line.points.iter().enumerate() {
                let place = TrimPlace { error: error(n), at: *at };
                if place.error > beyond.map_or(0.0, |most| most.error) {
                    beyond = Some(place);
                }
                if place.error < short.map_or(0.0, |least| least.error) {
                    short = Some(place);
                }
            }
            for ([a, b], n) in pieces(line).into_iter().zip(0..) {
                let length = EdgeRule::Along.length(&a, &b);
                let [p, q] = [error(n), error((n + 1) % found.len())];
                compared += length;
                sum += 0.5 * length * (p + q);
                magnitudes += 0.5 * length * (p.abs() + q.abs());
            }
        }
        // from the target back to the own boundary: a piece of the target that no fabric comes near to
        let mut farthest_wanted = ([0.0; 3], -1.0);
        for point in &wanted.points {
            let away = beside(&surface, point, &own)?.left.abs();
            if away > farthest_wanted.1 {
                farthest_wanted = (point.point, away);
            }
        }
        let mean = |sum: f64| if compared > 0.0 { sum / compared } else { 0.0 };
        Some(Trim {
            beyond,
            short,
            mean: mean(sum),
            mean_magnitude: mean(magnitudes),
            compared,
            not_compared: self.outer_left_out,
            farthest_wanted,
        })
    }
}

/// What of a curve is beside a point.
struct Beside {
    /// Distance along the mold (m), positive to the left of the curve.
    left: f64,
    /// Unit tangent of the curve there.
    tangent: [f64; 3],
}

fn point(line: &BoundaryLine, n: usize) -> SurfacePoint {
    SurfacePoint { point: line.points[n].place, normal: line.normals[n], beyond: 0.0 }
}

/// The lines between neighboring points.
fn pieces(line: &BoundaryLine) -> Vec<[SurfacePoint; 2]> {
    let count = line.points.len();
    let last = if line.closed { count } else { count - 1 };
    (0..last).map(|n| [point(line, n), point(line, (n + 1) % count)]).collect()
}

/// What of a curve of lines end to end is closest to a point; `None` if it has no lines.
fn beside(
    surface: &ExtendedSurface,
    from: &SurfacePoint,
    curve: &[[SurfacePoint; 2]],
) -> Option<Beside> {
    let mut best: Option<(f64, usize, f64)> = None;
    for (n, [a, b]) in curve.iter().enumerate() {
        let way = sub(b.point, a.point);
        let share = dot(sub(from.point, a.point), way) / dot(way, way).max(f64::MIN_POSITIVE);
        let share = share.clamp(0.0, 1.0);
        let away = sub(from.point, along(a.point, share, way));
        let away = dot(away, away);
        if best.is_none_or(|(closest, ..)| away < closest) {
            best = Some((away, n, share));
        }
    }
    let (_, n, share) = best?;
    let [a, b] = curve[n];
    let near = match share {
        0.0 => a,
        1.0 => b,
        _ => surface.under(between(a.point, b.point, share)),
    };
    // at a corner the two lines decide together which side it is
    let other = match share {
        0.0 => curve[(n + curve.len() - 1) % curve.len()],
        1.0 => curve[(n + 1) % curve.len()],
        _ => curve[n],
    };
    let course = |[a, b]: [SurfacePoint; 2]| direction(sub(b.point, a.point)).unwrap_or([0.0; 3]);
    // an open curve ends here
    let joined = [other[0].point, other[1].point].contains(&near.point) || share.fract() != 0.0;
    let other = if joined { other } else { curve[n] };
    let tangent = along(course(curve[n]), 1.0, course(other));
    let across = cross(near.normal, tangent);
    let length = EdgeRule::Along.length(from, &near);
    let side = dot(sub(from.point, near.point), across);
    let tangent = unit(tangent).unwrap_or([0.0; 3]);
    let rounding = norm(from.point) * f64::EPSILON;
    let left = if length <= rounding { 0.0 } else { length * side.signum() };
    Some(Beside { left, tangent })
}
