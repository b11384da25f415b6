//! Shear of a cell: the trellis of sides a, b whose one diagonal is stretched, eqs. (6)–(8) of
//! `docs/theory/ply.md`, after Krogh et al. 2018, section 2.3.

use super::Fibers;
use super::tuning::TUNING;
use num_dual::DualNum;

/// Whether a diagonal whose taut path is `path` (m) is stretched beyond the flat cell's.
#[must_use]
pub fn is_shearing([a, b]: [f64; 2], path: f64) -> bool {
    path > a.hypot(b) * (1.0 + TUNING.shear_rounding)
}

/// Shear angle γ (rad) of a cell with sides a, b (m) and stretched diagonal d₁ (m):
/// sin γ = (d₁² − a² − b²)/2ab, at most a right angle.
#[must_use]
pub fn angle([a, b]: [f64; 2], stretched: f64) -> f64 {
    let sine = (stretched * stretched - a * a - b * b) / (2.0 * a * b);
    sine.clamp(-1.0, 1.0).asin()
}

/// Weight of a shearing cell's plane in the slopes around it, from 0 at the onset of shear to 1 at the shear angle
/// `full` (rad): the smoothstep `x²(3 − 2x)` of x = γ/`full`.
///
/// A dual number gives the weight's derivative too, which is zero at both ends.
#[must_use]
pub fn onset<T: DualNum<Primitive = f64> + Copy>([a, b]: [T; 2], stretched: T, full: f64) -> T {
    let sine = (stretched * stretched - a * a - b * b) / (a * b * 2.0);
    if sine.re() >= full.sin() {
        return T::from(1.0);
    }
    if sine.re() <= 0.0 {
        return T::from(0.0);
    }
    let share = sine.asin() / full;
    share * share * (-share * 2.0 + 3.0)
}

/// How the shear angle (rad) changes with the sides a, b and the stretched diagonal, each changing by a given amount (m);
/// 0 where the cell has folded.
#[must_use]
pub fn angle_tangent(sides: [f64; 2], stretched: f64, change: [f64; 3]) -> f64 {
    let ([a, b], [da, db, dd]) = (sides, change);
    let (sine, cosine) = angle(sides, stretched).sin_cos();
    let rate = (stretched * dd - a * da - b * db) / (a * b) - sine * (da / a + db / b);
    if cosine > TUNING.folded_cosine { rate / cosine } else { 0.0 }
}

/// Set length (m) of the diagonal across the stretched one: √(2(a²+b²) − d₁²).
///
/// A stretched diagonal close to a + b has folded the cell; its partner keeps a millionth of a side.
#[must_use]
pub fn partner_length<T: DualNum<Primitive = f64> + Copy>([a, b]: [T; 2], stretched: T) -> T {
    let square = (a * a + b * b) * 2.0 - stretched * stretched;
    let least = TUNING.folded_diagonal * a.re().min(b.re());
    if square.re() > least * least { square.sqrt() } else { T::from(least) }
}

/// Signed shear angle γ (rad) of a cell with sides a, b (m) whose taut diagonals are `rising` and `falling` (m):
/// positive where the rising one is stretched, negative where the falling one is, 0 where neither is.
#[must_use]
pub fn signed_angle(sides: [f64; 2], rising: f64, falling: f64) -> f64 {
    let (sign, longer) = if falling > rising { (-1.0, falling) } else { (1.0, rising) };
    if is_shearing(sides, longer) { sign * angle(sides, longer) } else { 0.0 }
}

/// Length (m) of the rising (`sign` 1) or falling (−1) diagonal of a cell with sides a, b (m) at the signed shear
/// angle γ (rad): √(a² + b² ± 2ab sin γ). Of a folded cell the shorter one keeps a millionth of a side.
#[must_use]
pub fn diagonal([a, b]: [f64; 2], shear: f64, sign: f64) -> f64 {
    let square = a * a + b * b + sign * 2.0 * a * b * shear.sin();
    square.max(0.0).sqrt().max(TUNING.folded_diagonal * a.min(b))
}

/// By how much a mold of Gaussian curvature K (1/m²) scales the bias lines of a cell that lies on it, with a trellis of sides a, b
/// (m) and shear angle γ (rad): diagonals √(1 + K A²/6(a² + b²)), sides √(1 − K A²/3(a² + b²)), A = ab cos γ. 1 on a plane.
///
/// With half diagonals p, q that cross at φ on a sphere of radius 1, cos a + cos b = 2 cos p cos q; to fourth order
/// d₁² + d₂² = 2(a² + b²) + A²/3. Two half fibers a, b at an angle of π/2 ± γ have s² = a² + b² ± 2ab sin γ − A²/3 between
/// their ends. Ours.
#[must_use]
pub fn curved_scale([a, b]: [f64; 2], fibers: Fibers, shear: f64, gaussian_curvature: f64) -> f64 {
    let area = a * b * shear.cos();
    let squares = match fibers {
        Fibers::Sides => 6.0 * (a * a + b * b),
        Fibers::Diagonals => -3.0 * (a * a + b * b),
    };
    let excess = gaussian_curvature * area * area / squares;
    let most = TUNING.curvature_excess;
    (1.0 + excess.clamp(-most, most)).sqrt()
}

/// Force (N) in the stretched diagonal: τ d₁/cos γ by virtual work, at the shear angle γ (rad), τ (N/m) the
/// picture-frame shear force per length there. Infinite where the cell has folded.
#[must_use]
pub fn force(angle: f64, stretched: f64, shear_force_per_length: f64) -> f64 {
    shear_force_per_length * stretched / angle.cos()
}

/// The path (m) by which the bias lines of a cell in one direction shear it, from the path of each: that of a diagonal, or the mean of
/// two sides by their squares.
pub fn mean_path<T: DualNum<Primitive = f64> + Copy>(mut paths: impl Iterator<Item = T>) -> T {
    match [paths.next(), paths.next()] {
        [Some(first), Some(second)] => ((first * first + second * second) / 2.0).sqrt(),
        [first, _] => first.unwrap_or(T::from(0.0)),
    }
}
