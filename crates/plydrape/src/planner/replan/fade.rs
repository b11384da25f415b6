//! How much of the offset is left in each step.
//!
//! `w = 1 − x³ (10 − 15 x + 6 x²)` over the part x of the path's parameter that is gone: the only polynomial of the fifth degree whose
//! first and second derivative vanish at both ends, so that neither speed nor acceleration jumps there. Its steepest slope is 15/8
//! over the length of the fade. So the fade takes all of the transport that it may take, and no constant chooses where it is.

/// The share of each step of a path with these parameters at the steps (m): 1 up to step `clear`, 0 from the one before `last_free` on (both from
/// 0), so that the path is the planned one from `last_free` on. `None` where there is no step between.
#[must_use]
pub fn weights(parameter: &[f64], clear: usize, last_free: usize) -> Option<Vec<f64>> {
    let end = last_free.checked_sub(1)?;
    if clear >= end || end >= parameter.len() {
        return None;
    }
    let (from, to) = (parameter[clear], parameter[end]);
    let share = |(k, at): (usize, &f64)| match k {
        _ if k <= clear => 1.0,
        _ if k >= end => 0.0,
        _ => {
            let x = ((at - from) / (to - from)).clamp(0.0, 1.0);
            1.0 - x.powi(3) * (10.0 - x * (15.0 - 6.0 * x))
        }
    };
    Some(parameter.iter().enumerate().map(share).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 at the pick-up, 1/2 in the middle, 0 at the end, never rising; even knots make it the mirror image of itself.
    #[test]
    fn the_share_falls_from_one_to_zero() {
        let parameter: Vec<f64> = (0..30).map(|k| 0.04 * f64::from(k)).collect();
        let weights = weights(&parameter, 2, 21).unwrap();
        assert_eq!(weights[..3], [1.0; 3]);
        assert_eq!(weights[20..], [0.0; 10]);
        assert!((weights[11] - 0.5).abs() < 1e-12, "{}", weights[11]);
        assert!(weights.is_sorted_by(|a, b| a >= b));
        for k in 2..=20 {
            assert!((weights[k] + weights[22 - k] - 1.0).abs() < 1e-12);
        }
    }

    /// At both ends the first and the second difference vanish with the third power of the step.
    #[test]
    fn it_begins_and_ends_without_speed_and_acceleration() {
        let parameter: Vec<f64> = (0..1002).map(f64::from).collect();
        let weights = weights(&parameter, 0, 1001).unwrap();
        let h = 1e-3_f64;
        for k in [1, 999] {
            let second = weights[k - 1] - 2.0 * weights[k] + weights[k + 1];
            let first = 0.5 * (weights[k + 1] - weights[k - 1]);
            assert!(first.abs() < 40.0 * h.powi(3) && second.abs() < 100.0 * h.powi(3));
        }
    }

    /// Without a step between pick-up and contact there is no share.
    #[test]
    fn there_is_no_fade_without_a_transport() {
        let parameter = [0.0, 0.1, 0.2, 0.3];
        for (clear, last_free) in [(0, 0), (0, 1), (1, 2), (2, 3), (3, 3)] {
            assert_eq!(weights(&parameter, clear, last_free), None, "{clear} {last_free}");
        }
        assert_eq!(weights(&parameter, 0, 2).unwrap(), [1.0, 0.0, 0.0, 0.0]);
    }
}
