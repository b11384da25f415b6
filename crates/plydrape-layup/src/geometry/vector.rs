//! Vectors in space, as arrays.

/// Distance of two points (m).
#[must_use]
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(sub(a, b))
}

/// Distance of a point from the straight line between two ends (m).
#[must_use]
pub fn distance_from_segment(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let (ab, ap) = (sub(b, a), sub(p, a));
    let square = dot(ab, ab);
    let share = if square > 0.0 { (dot(ap, ab) / square).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, along(a, share, ab))
}

/// The mean of places (m); zero without any.
#[must_use]
pub fn mean(places: &[[f64; 3]]) -> [f64; 3] {
    let count = places.len().max(1) as f64;
    [0, 1, 2].map(|c| places.iter().map(|p| p[c]).sum::<f64>() / count)
}

/// a − b.
#[must_use]
pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + t b.
#[must_use]
pub fn along(a: [f64; 3], t: f64, b: [f64; 3]) -> [f64; 3] {
    [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]]
}

/// The point a share `t` of the way from a to b; at 1 it is b to the last bit.
#[must_use]
pub fn between(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    if t >= 1.0 { b } else { [0, 1, 2].map(|n| a[n] + t * (b[n] - a[n])) }
}

/// a · b.
#[must_use]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
#[must_use]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|.
#[must_use]
pub fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along a vector in any unit; `None` if its length is zero.
#[must_use]
pub fn direction(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = norm(a);
    (length > 0.0).then(|| a.map(|x| x / length))
}

/// The unit vector along a sum or product of unit vectors; `None` if that is zero but for rounding.
#[must_use]
pub fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = norm(a);
    (length > 1e-12).then(|| a.map(|x| x / length))
}

/// The angle between two unit vectors (rad).
#[must_use]
pub fn angle_between(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(a, b).clamp(-1.0, 1.0).acos()
}

/// `v` turned about `w` by its length (rad), after Rodrigues.
#[must_use]
pub fn turned(w: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    let angle = norm(w);
    if angle == 0.0 {
        return v;
    }
    let axis = w.map(|x| x / angle);
    // 1 − cos φ = 2 sin² φ/2 keeps its digits at small angles
    let (sin, versine) = (angle.sin(), 2.0 * (0.5 * angle).sin().powi(2));
    let across = cross(axis, v);
    along(along(v, sin, across), versine, cross(axis, across))
}

/// Two unit vectors at right angles to each other and to a normal.
pub fn tangents(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let axis = if normal[0].abs() < 0.8 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let first = unit(cross(axis, normal)).unwrap_or([0.0, 0.0, 1.0]);
    [first, cross(normal, first)]
}
