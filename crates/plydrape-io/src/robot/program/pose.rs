//! An orientation in the words of each controller, and what is between two poses.

use plydrape::geometry::Pose;
use plydrape::geometry::vector::between;

/// A pose from a place (m) and a quaternion (x, y, z, w) of any length but 0.
pub(crate) fn of_quaternion(position: [f64; 3], quaternion: [f64; 4]) -> Pose {
    let length = quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
    Pose::of_quaternion(position, quaternion.map(|q| q / length))
}

/// The unit quaternion (x, y, z, w) with w ≥ 0.
pub(crate) fn quaternion(pose: &Pose) -> [f64; 4] {
    let quaternion = pose.quaternion();
    if quaternion[3] < 0.0 { quaternion.map(|q| -q) } else { quaternion }
}

/// The angles (rad) A about z, B about the new y and C about the new x, as KRL has them; of the two at a pole that with
/// C = 0.
pub(crate) fn euler_zyx(pose: &Pose) -> [f64; 3] {
    let [[a, b, c], [d, e, f], [.., i]] = pose.axes;
    let level = a.hypot(b);
    let about_y = (-c).atan2(level);
    if level < 1e-9 {
        return [(-d).atan2(e), about_y, 0.0];
    }
    [b.atan2(a), about_y, f.atan2(i)]
}

/// The rotation vector (rad): along the axis, as long as the angle.
pub(crate) fn rotation_vector(pose: &Pose) -> [f64; 3] {
    let [x, y, z, w] = quaternion(pose);
    let sine = (x * x + y * y + z * z).sqrt();
    let stretch = if sine < 1e-12 { 2.0 } else { 2.0 * sine.atan2(w) / sine };
    [x, y, z].map(|q| stretch * q)
}

/// The angle between two orientations (rad).
pub(crate) fn angle(a: &Pose, b: &Pose) -> f64 {
    let [p, q] = [quaternion(a), quaternion(b)];
    let apart = |sign: f64| (0..4).map(|n| (p[n] - sign * q[n]).powi(2)).sum::<f64>().sqrt();
    // the chord between unit quaternions is 2 sin(θ/4)
    4.0 * (0.5 * apart(1.0).min(apart(-1.0))).min(1.0).asin()
}

/// The pose at a share of the way from one to another: the place on the straight line, the orientation on the shortest turn
/// (Shoemake 1985), as controllers go.
pub(crate) fn interpolated(from: &Pose, to: &Pose, share: f64) -> Pose {
    let [p, mut q] = [quaternion(from), quaternion(to)];
    let mut cosine: f64 = (0..4).map(|n| p[n] * q[n]).sum();
    if cosine < 0.0 {
        (cosine, q) = (-cosine, q.map(|c| -c));
    }
    let half = cosine.min(1.0).acos();
    // so near that the chord is the arc
    let [a, b] = if half < 1e-6 {
        [1.0 - share, share]
    } else {
        [((1.0 - share) * half).sin() / half.sin(), (share * half).sin() / half.sin()]
    };
    let mixed = [0, 1, 2, 3].map(|n| a * p[n] + b * q[n]);
    of_quaternion(between(from.position, to.position, share), mixed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn near(a: &Pose, b: &Pose) -> bool {
        let pairs = a.axes.as_flattened().iter().zip(b.axes.as_flattened());
        pairs.into_iter().all(|(p, q)| (p - q).abs() < 1e-9)
    }

    fn about(axis: usize, angle: f64) -> Pose {
        let mut turn = [0.0; 3];
        turn[axis] = angle;
        Pose::new([0.0; 3], turn)
    }

    proptest! {
        /// Each form of an orientation, put together again, is that orientation, poles of the angles among them.
        #[test]
        fn every_form_is_the_same_orientation(
            x in -3.2..3.2_f64, y in -1.6..1.6_f64, z in -3.2..3.2_f64, pole in 0..4,
        ) {
            let y = match pole { 0 => std::f64::consts::FRAC_PI_2, 1 => -std::f64::consts::FRAC_PI_2, _ => y };
            let pose = Pose::new([0.1, -0.2, 0.3], [x, y, z]);
            prop_assert!(near(&of_quaternion(pose.position, quaternion(&pose)), &pose));
            let [a, b, c] = euler_zyx(&pose);
            let turned = about(2, a).compose(&about(1, b)).compose(&about(0, c));
            prop_assert!(near(&turned, &pose), "{turned:?} {pose:?}");
            let vector = rotation_vector(&pose);
            let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
            let turn = |v| plydrape::geometry::vector::turned(vector, v);
            prop_assert!(length <= std::f64::consts::PI + 1e-12);
            let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let again = Pose { axes: unit.map(turn), ..pose };
            prop_assert!(near(&again, &pose), "{again:?}");
        }
    }

    /// Half way between two turns about one axis is the mean angle, and the angle to each of them is half of that between.
    #[test]
    fn half_way_is_half_the_turn() {
        let [from, to] = [about(1, -0.4), about(1, 1.0)];
        let middle = interpolated(&from, &to, 0.5);
        assert!(near(&middle, &about(1, 0.3)));
        assert!(
            (angle(&from, &to) - 1.4).abs() < 1e-12 && (angle(&middle, &to) - 0.7).abs() < 1e-12
        );
        assert!((angle(&from, &about(1, -0.4 - 1e-9)) - 1e-9).abs() < 1e-15);
    }
}
