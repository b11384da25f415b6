//! Minimum and crossing of a distance along a span, between two stations that bracket it.

/// Most iterations of the search for the closest point of a span between two stations. 20: parabolas contract faster
/// than linearly.
const MINIMUM_ITERATIONS: usize = 20;
/// Width, as a share of the run, at which the search ends. 1e-9: the distance changes by its square.
const MINIMUM_WIDTH: f64 = 1e-9;
/// Most iterations of the search for the place where a touch begins. 60: as many as bisection needs.
const CROSSING_ITERATIONS: usize = 60;
/// Width, as a share of the run, at which the search ends. 1e-12: the distance is linear there.
const CROSSING_WIDTH: f64 = 1e-12;

/// Smallest distance between two stations around a third that is lower, by parabolas through the last
/// three points: (t, distance (m)).
pub fn minimum(
    distance: &impl Fn(f64) -> f64,
    (mut a, mut fa): (f64, f64),
    (mut m, mut fm): (f64, f64),
    (mut b, mut fb): (f64, f64),
) -> (f64, f64) {
    for _ in 0..MINIMUM_ITERATIONS {
        let (p, q) = ((m - a) * (fm - fb), (m - b) * (fm - fa));
        let vertex = m - 0.5 * ((m - a) * p - (m - b) * q) / (p - q);
        // a parabola that degenerates: the wider half is cut instead
        let inside = vertex > a && vertex < b;
        let wider = if b - m > m - a { 0.5 * (m + b) } else { 0.5 * (a + m) };
        let next = if inside { vertex } else { wider };
        if (next - m).abs() < MINIMUM_WIDTH {
            break;
        }
        let value = distance(next);
        if value < fm {
            if next > m {
                (a, fa) = (m, fm)
            } else {
                (b, fb) = (m, fm)
            }
            (m, fm) = (next, value);
        } else if next > m {
            (b, fb) = (next, value);
        } else {
            (a, fa) = (next, value);
        }
    }
    (m, fm)
}

/// Where, as t, the distance falls through `level` (m) between `outside` and `inside`, by false position (Illinois).
pub fn crossing(distance: &impl Fn(f64) -> f64, outside: f64, inside: f64, level: f64) -> f64 {
    let (mut out, mut into) = (outside, inside);
    let (mut f_out, mut f_in) = (distance(out) - level, distance(into) - level);
    if f_out < 0.0 {
        return outside;
    }
    for _ in 0..CROSSING_ITERATIONS {
        if (out - into).abs() < CROSSING_WIDTH || f_in == 0.0 {
            break;
        }
        let middle = out + (into - out) * f_out / (f_out - f_in);
        let value = distance(middle) - level;
        if value < 0.0 {
            (into, f_in) = (middle, value);
            f_out *= 0.5;
        } else {
            (out, f_out) = (middle, value);
            f_in *= 0.5;
        }
    }
    into
}

/// How far one can go from `near` towards `far`, where it no longer fits, so that it still fits: where `excess` comes
/// to zero.
pub fn farthest(near: f64, far: f64, excess: impl Fn(f64) -> f64) -> f64 {
    if excess(near) >= 0.0 { near } else { crossing(&excess, far, near, 0.0) }
}
