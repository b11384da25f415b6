//! The ply's boundary on the mold: where each ring of its outline comes to lie, and what of the ply has no place there.
//!
//! A ring is followed in the flat from net line to net line and from corner to corner; between two points it is halved until
//! the middle of the fabric lies within a share of the mesh width of the straight line between them. Where it leaves the mold
//! it is halved down to that place. Fabric beyond the boundary of the mold lies on the tangent plane there, as the nodes do.

use super::edge::EdgeRule;
use super::placement::Placement;
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use super::{Coverage, Net};
use crate::geometry::vector::distance_from_segment;
use crate::mold::Mold;
use crate::ply::Outline;

/// A point of the ply on the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlyPoint {
    /// Fabric coordinates u, v (m).
    pub fabric: [f64; 2],
    /// Place on the mold (m); beyond its boundary on its tangent plane.
    pub place: [f64; 3],
}

/// A part of the boundary that lies on the mold without a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryLine {
    /// The ring it belongs to: 0 is the outer boundary, holes follow.
    pub ring: usize,
    /// All of its ring: its last point is followed by its first, which is not repeated.
    pub closed: bool,
    /// Points in turn, the ply to the left seen from outside.
    pub points: Vec<PlyPoint>,
    /// Unit normal of the mold at each point, towards the ply.
    pub normals: Vec<[f64; 3]>,
}

/// What of a ply has no place on the mold, measured in the flat.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LeftOut {
    /// Length of its boundary and of its holes (m).
    pub length: f64,
    /// Area (m²).
    pub area: f64,
}

/// Fabric beyond the boundary of the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Farthest {
    /// How far beyond (m).
    pub beyond: f64,
    /// Which fabric, and where.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub at: PlyPoint,
}

/// The boundary of a ply on the mold.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// The parts that lie on the mold.
    pub lines: Vec<BoundaryLine>,
    /// Their length along the mold (m).
    pub length: f64,
    /// Length of fabric of the outer boundary that has no place on the mold (m).
    pub outer_left_out: f64,
    /// What lies beyond the boundary of the mold.
    pub off_mold: LeftOut,
    /// The fabric farthest beyond it; `None` if all is on the mold.
    pub farthest: Option<Farthest>,
    /// What the net has no place for, because the ply folds.
    pub folded: LeftOut,
}

/// Where a fabric point lies.
#[derive(Debug, Clone, Copy)]
enum Lie {
    On(SurfacePoint),
    Off(SurfacePoint),
    /// The net has no nodes around it.
    Folded,
}

impl Lie {
    fn kind(&self) -> u8 {
        match self {
            Lie::On(_) => 0,
            Lie::Off(_) => 1,
            Lie::Folded => 2,
        }
    }
}

type Sample = ([f64; 2], Lie);

impl Net {
    /// The outline of the ply, of one that is not cut the rectangle that the net covers; `None` for a strip without width.
    #[must_use]
    pub fn ply_outline(&self) -> Option<Outline> {
        self.outline.clone().or_else(|| self.placement.outline())
    }

    /// The ply's boundary on the mold, and what of the ply has no place there; `None` for a strip without width.
    #[must_use]
    pub fn boundary(&self, mold: &Mold) -> Option<Boundary> {
        let outline = self.ply_outline()?;
        let mesh = self.placement.mesh[0].min(self.placement.mesh[1]);
        let mut walk = Walk {
            net: self,
            surface: ExtendedSurface::new(mold),
            sag: TUNING.boundary_sag * mesh,
            found: Boundary {
                lines: Vec::new(),
                length: 0.0,
                outer_left_out: 0.0,
                off_mold: LeftOut::default(),
                farthest: None,
                folded: LeftOut::default(),
            },
        };
        for (number, ring) in outline.rings().enumerate() {
            walk.ring(number, &flat(ring, &self.placement));
            if number == 0 {
                walk.found.outer_left_out = walk.found.off_mold.length + walk.found.folded.length;
            }
        }
        walk.areas(&outline);
        Some(walk.found)
    }
}

/// A ring in the flat, from net line to net line and from corner to corner (m).
fn flat(ring: &[[f64; 2]], placement: &Placement) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (n, a) in ring.iter().enumerate() {
        let b = ring[(n + 1) % ring.len()];
        let mut shares = vec![0.0];
        for axis in 0..2 {
            let net_line = |x: f64| (x - placement.origin[axis]) / placement.mesh[axis];
            let (from, to) = (net_line(a[axis]), net_line(b[axis]));
            let (low, high) = (from.min(to), from.max(to));
            for line in low.ceil() as i64..=high.floor() as i64 {
                let share = (line as f64 - from) / (to - from);
                if share.is_finite() {
                    shares.push(share);
                }
            }
        }
        shares.sort_by(f64::total_cmp);
        // a corner on a net line is one point
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let apart = TUNING.same_boundary_point * placement.mesh[0].min(placement.mesh[1]) / length;
        shares.dedup_by(|next, last| *next - *last <= apart);
        shares.retain(|share| *share <= 1.0 - apart);
        points.extend(shares.iter().map(|t| [0, 1].map(|c| a[c] + t * (b[c] - a[c]))));
    }
    points
}

struct Walk<'a> {
    net: &'a Net,
    surface: ExtendedSurface<'a>,
    /// Largest distance of the fabric from the straight line between two points (m).
    sag: f64,
    found: Boundary,
}

impl Walk<'_> {
    fn lie(&self, uv: [f64; 2]) -> Lie {
        match self.net.surface_point(&self.surface, uv) {
            None => Lie::Folded,
            Some(point) if point.beyond == 0.0 => Lie::On(point),
            Some(point) => Lie::Off(point),
        }
    }

    /// Where a point of the ply lies; it may be the farthest beyond the mold.
    fn lie_of_ply(&mut self, uv: [f64; 2]) -> Lie {
        let lie = self.lie(uv);
        if let Lie::Off(point) = lie
            && self.found.farthest.is_none_or(|far| point.beyond > far.beyond)
        {
            let at = PlyPoint { fabric: uv, place: point.point };
            self.found.farthest = Some(Farthest { beyond: point.beyond, at });
        }
        lie
    }

    /// One ring of different points in the flat (m).
    fn ring(&mut self, ring: usize, flat: &[[f64; 2]]) {
        let samples: Vec<Sample> = flat.iter().map(|uv| (*uv, self.lie_of_ply(*uv))).collect();
        let Some(first) = samples.first().copied() else { return };
        let mut lines = vec![Vec::new()];
        push(&mut lines, &first);
        for n in 0..samples.len() {
            self.between(samples[n], samples[(n + 1) % samples.len()], 0, &mut lines);
        }
        // the last point is the first again
        let closed = lines.len() == 1 && matches!(first.1, Lie::On(_));
        if closed {
            lines[0].pop();
        } else if lines.len() > 1 && matches!(first.1, Lie::On(_)) {
            let head = lines.remove(0);
            if let Some(tail) = lines.iter_mut().find(|line| {
                line.last().is_some_and(|(uv, _): &([f64; 2], SurfacePoint)| *uv == first.0)
            }) {
                tail.extend(head.into_iter().skip(1));
            } else {
                lines.push(head);
            }
        }
        for line in lines.into_iter().filter(|line| line.len() > 1) {
            let pairs = (1..line.len() + usize::from(closed)).map(|n| [n - 1, n % line.len()]);
            self.found.length +=
                pairs.map(|[a, b]| EdgeRule::Along.length(&line[a].1, &line[b].1)).sum::<f64>();
            let point =
                |(uv, s): &([f64; 2], SurfacePoint)| PlyPoint { fabric: *uv, place: s.point };
            self.found.lines.push(BoundaryLine {
                ring,
                closed,
                points: line.iter().map(point).collect(),
                normals: line.iter().map(|(_, s)| s.normal).collect(),
            });
        }
    }

    /// The fabric from one point to the next, in as many parts as it bends or leaves the mold.
    fn between(
        &mut self,
        a: Sample,
        b: Sample,
        depth: usize,
        lines: &mut Vec<Vec<([f64; 2], SurfacePoint)>>,
    ) {
        let uv = [0, 1].map(|n| 0.5 * (a.0[n] + b.0[n]));
        let middle = (uv, self.lie_of_ply(uv));
        // halve where the line bends over the mold, and finer where it leaves the mold
        let same = a.1.kind() == b.1.kind() && a.1.kind() == middle.1.kind();
        let most = if same { TUNING.boundary_halvings } else { TUNING.boundary_end_halvings };
        let is_straight = match (&a.1, &middle.1, &b.1) {
            (Lie::On(a), Lie::On(m), Lie::On(b)) => {
                distance_from_segment(m.point, a.point, b.point) <= self.sag
            }
            _ => same,
        };
        if !is_straight && depth < most {
            self.between(a, middle, depth + 1, lines);
            self.between(middle, b, depth + 1, lines);
            return;
        }
        // what has no place on the mold is measured in the fabric
        let length = (b.0[0] - a.0[0]).hypot(b.0[1] - a.0[1]);
        match middle.1 {
            Lie::On(_) => {}
            Lie::Off(_) => self.found.off_mold.length += length,
            Lie::Folded => self.found.folded.length += length,
        }
        push(lines, &b);
    }

    /// Area of the ply that has no place on the mold.
    fn areas(&mut self, outline: &Outline) {
        let placement = self.net.placement;
        let coverage = Coverage::new(&placement, Some(outline));
        let [nu, nv] = placement.nodes;
        for [i, j] in (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| [i, j])) {
            if coverage.share([i, j]) > 0.0 {
                let (low, high) = (placement.fabric([i, j]), placement.fabric([i + 1, j + 1]));
                self.area(outline, low, high, 0);
            }
        }
    }

    /// Adds what of a rectangle of fabric has no place: halved each way where only some of it has one.
    fn area(&mut self, outline: &Outline, low: [f64; 2], high: [f64; 2], depth: usize) {
        let middle = [0, 1].map(|n| 0.5 * (low[n] + high[n]));
        let places = [low, [high[0], low[1]], high, [low[0], high[1]], middle];
        let kinds = places.map(|uv| match self.lie(uv) {
            Lie::Off(_) if outline.contains(uv) => self.lie_of_ply(uv).kind(),
            lie => lie.kind(),
        });
        if kinds == [0; 5] {
            return;
        }
        let alike = kinds.iter().all(|kind| *kind == kinds[0]);
        if !alike && depth < TUNING.area_halvings {
            for [a, b] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let (p, q) = ([low, middle, high], [a, b]);
                let corner = |far: usize| [0, 1].map(|n| p[q[n] + far][n]);
                self.area(outline, corner(0), corner(1), depth + 1);
            }
            return;
        }
        let fabric = outline.area_in(low, high);
        let missing = if alike { 1.0 } else { self.missing_share(&places[..4], &kinds) } * fabric;
        let folded = kinds.iter().filter(|kind| **kind == 2).count() as f64;
        let off = kinds.iter().filter(|kind| **kind == 1).count() as f64;
        self.found.off_mold.area += missing * off / (off + folded);
        self.found.folded.area += missing * folded / (off + folded);
    }

    /// The share of a rectangle of fabric that has no place on the mold, whose corners and middle lie as `kinds` says: what
    /// a straight line cuts off between the ends of the mold on its sides.
    fn missing_share(&self, corners: &[[f64; 2]], kinds: &[u8; 5]) -> f64 {
        if kinds[..4].iter().all(|kind| (*kind == 0) == (kinds[0] == 0)) {
            // only the middle differs: between a diamond and nothing, or all
            return 0.5;
        }
        let mut ring: Vec<[f64; 2]> = Vec::with_capacity(8);
        for n in 0..4 {
            let next = (n + 1) % 4;
            if kinds[n] != 0 {
                ring.push(corners[n]);
            }
            if (kinds[n] == 0) != (kinds[next] == 0) {
                ring.push(self.end_of_mold(corners[n], corners[next], kinds[n] == 0));
            }
        }
        let area = |ring: &[[f64; 2]]| {
            let pairs = (0..ring.len()).map(|n| (ring[n], ring[(n + 1) % ring.len()]));
            pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
        };
        (area(&ring) / area(corners)).clamp(0.0, 1.0)
    }

    /// Where between two fabric points (m) the mold ends, of which the first is on it or the second.
    fn end_of_mold(&self, mut a: [f64; 2], mut b: [f64; 2], first_is_on: bool) -> [f64; 2] {
        for _ in 0..TUNING.area_end_halvings {
            let middle = [0, 1].map(|n| 0.5 * (a[n] + b[n]));
            let is_on = matches!(self.lie(middle), Lie::On(_));
            *(if is_on == first_is_on { &mut a } else { &mut b }) = middle;
        }
        [0, 1].map(|n| 0.5 * (a[n] + b[n]))
    }
}

/// Adds a point to the last line if it is on the mold; otherwise that line ends.
fn push(lines: &mut Vec<Vec<([f64; 2], SurfacePoint)>>, (uv, lie): &Sample) {
    let ended = lines.last().is_none_or(|line| !line.is_empty());
    match (lie, lines.last_mut()) {
        (Lie::On(point), Some(line)) => line.push((*uv, *point)),
        _ if ended => lines.push(Vec::new()),
        _ => {}
    }
}
