//! Angular velocity and acceleration of sampled orientations, by differences.
//!
//! A planned orientation turns at a constant rate from step to step, so its rate jumps at a step. A robot gets
//! samples of it, at times t₋ < t < t₊, with h = t − t₋ and k = t₊ − t. From the turns θ₋ = ωₕ h and θ₊ = ωₖ k
//! between them (rotation vectors in the fixed frame) follow
//!
//! ```text
//! ω = (θ₋ + θ₊) / (h + k) ,   α = 2 (ωₖ − ωₕ) / (h + k) .
//! ```
//!
//! Between two steps that is the rate itself, and α = 0. At the first and the last sample the grippers rest: both are 0.

type Turn = [f64; 3];

/// Angular velocity (rad/s) and acceleration (rad/s²) at the middle one of three samples, from their unit
/// quaternions (x, y, z, w) and times (s).
pub(super) fn rates(quaternions: [[f64; 4]; 3], [before, now, after]: [f64; 3]) -> [Turn; 2] {
    let [p, q, r] = quaternions;
    let (first, second) = (turn(p, q), turn(q, r));
    let (h, k) = (now - before, after - now);
    let velocity = [0, 1, 2].map(|c| (first[c] + second[c]) / (h + k));
    let acceleration = [0, 1, 2].map(|c| 2.0 * (second[c] / k - first[c] / h) / (h + k));
    [velocity, acceleration]
}

/// The rotation vector (rad) in the fixed frame that takes one orientation to another, at most half a turn.
fn turn(from: [f64; 4], to: [f64; 4]) -> Turn {
    // to · conjugate(from)
    let ([a, b, c, d], [x, y, z, w]) = (from.map(|q| -q), to);
    let vector = [
        w * a - x * d + y * c - z * b,
        w * b - x * c - y * d + z * a,
        w * c + x * b - y * a - z * d,
    ];
    let scalar = -w * d - (x * a + y * b + z * c);
    let sine = vector.iter().map(|q| q * q).sum::<f64>().sqrt();
    // a quaternion and its negative turn alike
    let sign = if scalar < 0.0 { -1.0 } else { 1.0 };
    let stretch = if sine < 1e-12 { 2.0 } else { 2.0 * sine.atan2(sign * scalar) / sine };
    vector.map(|q| sign * stretch * q)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about([x, y, z]: Turn, angle: f64) -> [f64; 4] {
        let (s, c) = (0.5 * angle).sin_cos();
        [x * s, y * s, z * s, c]
    }

    /// Turning about a fixed axis by a quadratic in time has that velocity, and twice its coefficient.
    #[test]
    fn turning_about_one_axis_has_its_closed_form() {
        let axis = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
        let angle = |t: f64| 0.3 + 0.5 * t - 0.2 * t * t;
        let (t, h) = (0.7, 0.01);
        let times = [t - h, t, t + h];
        let [velocity, acceleration] = rates(times.map(|t| about(axis, angle(t))), times);
        for c in 0..3 {
            assert!((velocity[c] - (0.5 - 0.4 * t) * axis[c]).abs() < 1e-13);
            // differences of rounded angles, over h²
            assert!((acceleration[c] + 0.4 * axis[c]).abs() < 1e-10);
        }
    }

    /// The vector stands in the fixed frame: a body turned on its side and then about the vertical turns about z.
    #[test]
    fn the_turn_is_in_the_fixed_frame_and_the_short_way() {
        let side = about([1.0, 0.0, 0.0], 1.5);
        let [x, y, z, w] = side;
        let (s, c) = 0.2_f64.sin_cos();
        // (0, 0, s, c) · side
        let turned = [c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z];
        for to in [turned, turned.map(|q| -q)] {
            let found = turn(side, to);
            assert!(found[0].abs() < 1e-15 && found[1].abs() < 1e-15, "{found:?}");
            assert!((found[2] - 0.4).abs() < 1e-15, "{found:?}");
        }
        assert_eq!(turn(side, side).map(|q| q.abs() < 1e-15), [true; 3]);
    }
}
