//! How the flat ply is turned that comes nearest to places of its grippers.

use super::Ply;
use crate::geometry::vector::{along, cross, direction, dot, mean, sub, unit};

/// Share of the moments of the fabric coordinates below which they are rounding.
const ROUNDING: f64 = 1e-9;

impl Ply {
    /// Unit vectors of u, v and the normal of the flat ply whose grippers come nearest to places (m).
    #[must_use]
    pub fn flat_axes(&self, places: &[[f64; 3]]) -> [[f64; 3]; 3] {
        let held: Vec<[f64; 2]> = (0..places.len()).map(|n| self.place(n)).collect();
        flat_axes(&held, places)
    }
}

/// As [`Ply::flat_axes`], of grippers at fabric coordinates (m).
#[must_use]
pub fn flat_axes(held: &[[f64; 2]], places: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let (middle, count) = (mean(places), held.len() as f64);
    let origin = [0, 1].map(|n| held.iter().map(|place| place[n]).sum::<f64>() / count);
    let off = |place: &[f64; 2]| [place[0] - origin[0], place[1] - origin[1]];
    let off: Vec<[f64; 2]> = held.iter().map(off).collect();
    let [by_u, by_v] = [0, 1].map(|n| {
        let add = |sum, (off, p): (&[f64; 2], &[f64; 3])| along(sum, off[n], sub(*p, middle));
        off.iter().zip(places).fold([0.0; 3], add)
    });
    let moment = |a: usize, b: usize| off.iter().map(|off| off[a] * off[b]).sum::<f64>();
    let [uu, uv, vv] = [moment(0, 0), moment(0, 1), moment(1, 1)];
    let uv = if uv.abs() > ROUNDING * (uu + vv) { uv } else { 0.0 };
    let level = |u: [f64; 3]| unit(cross([0.0, 0.0, 1.0], u)).unwrap_or([0.0, 1.0, 0.0]);
    // the directions of u and v in space, by least squares
    let [u, v] = if uu * vv - uv * uv > ROUNDING * (uu + vv) * (uu + vv) {
        [direction(along(by_u, -uv / vv, by_v)), direction(along(by_v, -uv / uu, by_u))]
    } else {
        // all grippers are on one line of the fabric: its angle from u is known, and across it the ply is level
        let (line, angle) = if uu >= vv { (by_u, uv.atan2(uu)) } else { (by_v, vv.atan2(uv)) };
        let line = direction(line).unwrap_or([1.0, 0.0, 0.0]);
        let (aside, (sin, cos)) = (level(line), angle.sin_cos());
        [[cos, -sin], [sin, cos]].map(|[a, b]| Some([0, 1, 2].map(|n| a * line[n] + b * aside[n])))
    };
    let u = u.unwrap_or([1.0, 0.0, 0.0]);
    let aside = level(u);
    let v = v.filter(|v| dot(*v, u).abs() < 0.999).unwrap_or(aside);
    // turned alike from both to a right angle
    let sum = unit([0, 1, 2].map(|n| u[n] + v[n])).unwrap_or(u);
    let off = unit(sub(u, v)).unwrap_or(aside);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let u = [0, 1, 2].map(|n| half * (sum[n] + off[n]));
    let v = [0, 1, 2].map(|n| half * (sum[n] - off[n]));
    [u, v, cross(u, v)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose, distance};

    /// A flat ply has the axes of its pose wherever it is held: at places that are not alike along u and v, in an array, and in a
    /// row along u, along v or across the yarns.
    #[test]
    fn the_axes_of_a_flat_ply_are_found_wherever_it_is_held() {
        let (tilted, level) = ([0.2, -0.1, 0.4], [0.0, 0.0, 0.4]);
        let cases = [
            (vec![[0.0, 0.0], [0.1, 0.05], [0.02, 0.06]], tilted),
            (vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]], tilted),
            (vec![[0.0, 0.0], [0.1, 0.0], [0.2, 0.0]], level),
            (vec![[0.0, 0.0], [0.0, 0.1], [0.0, 0.2]], level),
            (vec![[0.0, 0.0], [0.1, 0.05], [0.2, 0.1]], level),
            (vec![[0.0, 0.0], [-0.1, 0.2]], level),
        ];
        for (held, turn) in cases {
            let pose = Pose::new([0.3, -0.2, 0.4], turn);
            let places: Vec<[f64; 3]> =
                held.iter().map(|[u, v]| pose.place([*u, *v, 0.0])).collect();
            let axes = flat_axes(&held, &places);
            assert!((0..3).all(|n| distance(axes[n], pose.axes[n]) < 1e-12), "{held:?}: {axes:?}");
        }
    }
}
