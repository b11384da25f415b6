//! Closed lines in a plane, as lists of points: the last point of a ring is joined to its first, which is not repeated (m).

/// The lines of a ring, end to end (m).
pub fn lines(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    (0..ring.len()).map(|n| [ring[n], ring[(n + 1) % ring.len()]])
}

/// Area of a ring (m²), negative of a clockwise one.
#[must_use]
pub fn area(ring: &[[f64; 2]]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    // from its own corner, so that a ring far from the origin keeps its digits
    let off = |p: [f64; 2]| [p[0] - origin[0], p[1] - origin[1]];
    let twice = |line: [[f64; 2]; 2]| {
        let [a, b] = line.map(off);
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * lines(ring).map(twice).sum::<f64>()
}

/// Lowest and highest coordinates of points (m).
#[must_use]
pub fn bounds<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    points.into_iter().fold(start, |[low, high], point| {
        [[0, 1].map(|n| low[n].min(point[n])), [0, 1].map(|n| high[n].max(point[n]))]
    })
}

/// Whether a place (m) is inside a ring.
#[must_use]
pub fn is_inside(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crosses = |[a, b]: &[[f64; 2]; 2]| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
    };
    lines(ring).filter(crosses).count() % 2 == 1
}
