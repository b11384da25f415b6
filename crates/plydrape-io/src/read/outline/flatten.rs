//! Curves as polygons whose lines stay within a tolerance of them.
//!
//! A line between two points of a circle of radius R, an angle 2h apart, is at most `s = R (1 − cos h) = 2 R sin²(h/2)` from it;
//! an ellipse is a circle that was stretched, by its longer half axis at most. A rational Bézier curve of positive weights lies
//! in the hull of its control points, and is halved until these are close enough to the line between its ends (Farin, Curves and
//! Surfaces for CAGD, 2002, ch. 13). Ends of curves are exact.

/// Largest angle of a circle that one line may span (rad): a hole that is smaller than the tolerance stays a hole.
const LARGEST_STEP: f64 = std::f64::consts::FRAC_PI_4;
/// A curve of polynomials of a higher degree is refused; programs write 3 and 5.
const MOST_DEGREE: usize = 25;

/// How closely curves are followed, and how many points they may have.
#[derive(Debug, Clone, Copy)]
pub struct Limit {
    /// Largest distance of a line from its curve, in the units of the curve.
    pub tolerance: f64,
    /// Most points.
    pub points: usize,
}

/// There would be too many points.
#[derive(Debug)]
pub struct TooMany;

/// Lines that follow an angle of a circle.
fn lines(sweep: f64, radius: f64, limit: Limit) -> Result<usize, TooMany> {
    let half = (limit.tolerance / (2.0 * radius)).sqrt().min(1.0).asin();
    let lines = (sweep.abs() / (4.0 * half).min(LARGEST_STEP)).ceil().max(1.0);
    if lines <= limit.points as f64 { Ok(lines as usize) } else { Err(TooMany) }
}

/// An arc of an ellipse, of its center, two conjugate half axes p and q and angles: `c + p cos t + q sin t`.
#[derive(Debug, Clone, Copy)]
pub struct Arc {
    /// Center c.
    pub center: [f64; 2],
    /// Half axis p, where t = 0.
    pub p: [f64; 2],
    /// Half axis q, where t = 90°.
    pub q: [f64; 2],
    /// Angle of its beginning (rad).
    pub start: f64,
    /// Angle that it spans (rad).
    pub sweep: f64,
}

impl Arc {
    /// The polygon from its beginning to its end.
    pub fn flatten(&self, limit: Limit) -> Result<Vec<[f64; 2]>, TooMany> {
        let lines = lines(self.sweep, stretch(self.p, self.q), limit)?;
        Ok((0..=lines).map(|n| self.point(self.sweep * (n as f64 / lines as f64))).collect())
    }

    fn point(&self, angle: f64) -> [f64; 2] {
        let (sin, cos) = (self.start + angle).sin_cos();
        [0, 1].map(|n| self.center[n] + self.p[n] * cos + self.q[n] * sin)
    }
}

/// The longest image of a vector of length 1 under the map with the columns p and q.
pub fn stretch(p: [f64; 2], q: [f64; 2]) -> f64 {
    let (sum, difference) = ((p[0] + q[1]).hypot(p[1] - q[0]), (p[0] - q[1]).hypot(p[1] + q[0]));
    0.5 * (sum + difference)
}

/// The points of a bulge, the arc between two points that spans the angle `4 atan(bulge)`, without its two ends.
///
/// They are computed from the chord and not from the center, which is far away where a bulge is almost straight.
pub fn bulge(a: [f64; 2], b: [f64; 2], bulge: f64, limit: Limit) -> Result<Vec<[f64; 2]>, TooMany> {
    let half = 2.0 * bulge.atan();
    let chord = [b[0] - a[0], b[1] - a[1]];
    let length = chord[0].hypot(chord[1]);
    if half == 0.0 || length == 0.0 {
        return Ok(Vec::new());
    }
    let lines = lines(2.0 * half, 0.5 * length / half.sin().abs(), limit)?;
    let point = |n: usize| {
        let s = 2.0 * n as f64 / lines as f64 - 1.0;
        let x = (half * s).sin() / half.sin();
        // cos(half s) − cos(half), without the difference of two numbers that are almost the same
        let rise = 2.0 * (0.5 * half * (1.0 + s)).sin() * (0.5 * half * (1.0 - s)).sin();
        let y = -rise / half.sin();
        [
            0.5 * (a[0] + b[0] + x * chord[0] - y * chord[1]),
            0.5 * (a[1] + b[1] + x * chord[1] + y * chord[0]),
        ]
    };
    Ok((1..lines).map(point).collect())
}

/// A rational B-spline; a point of it in homogeneous coordinates is (w x, w y, w).
#[derive(Debug, Clone)]
pub struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<[f64; 3]>,
}

impl Nurbs {
    /// A spline of its degree, knots, control points and weights; without weights all are 1.
    ///
    /// # Errors
    /// What does not fit together, in words.
    pub fn new(
        degree: usize,
        knots: Vec<f64>,
        points: &[[f64; 2]],
        weights: &[f64],
    ) -> Result<Self, String> {
        // there are enough control points and knots for the degree
        if degree == 0 || degree > MOST_DEGREE {
            return Err(format!("its degree is {degree}, expected 1 to {MOST_DEGREE}"));
        }
        if points.len() <= degree {
            let (points, least) = (points.len(), degree + 1);
            return Err(format!(
                "it has {points} control points, expected {least} or more for its degree of {degree}"
            ));
        }
        let expected = points.len() + degree + 1;
        if knots.len() != expected {
            return Err(format!(
                "it has {} knots, expected {expected} for its {} control points",
                knots.len(),
                points.len()
            ));
        }

        // knots never fall, and they span some range of the curve
        let sorted = knots.windows(2).all(|pair| pair[0] <= pair[1]);
        if !sorted || !knots[expected - 1].is_finite() || !knots[0].is_finite() {
            return Err("its knots do not grow from the first to the last".into());
        }
        if knots[degree] >= knots[points.len()] {
            return Err("its knots are all the same".into());
        }

        // weights are positive, one for each control point
        if !weights.is_empty() && weights.len() != points.len() {
            let (weights, points) = (weights.len(), points.len());
            return Err(format!("it has {weights} weights for {points} control points"));
        }
        if let Some(weight) = weights.iter().find(|w| !w.is_finite() || **w <= 0.0) {
            return Err(format!("it has a weight of {weight}, expected numbers above 0"));
        }

        // control points in homogeneous coordinates
        let weight = |n: usize| weights.get(n).copied().unwrap_or(1.0);
        let points = points.iter().enumerate();
        let points = points.map(|(n, p)| [weight(n) * p[0], weight(n) * p[1], weight(n)]).collect();
        Ok(Nurbs { degree, knots, points })
    }

    /// The polygon from its beginning to its end.
    pub fn flatten(&self, limit: Limit) -> Result<Vec<[f64; 2]>, TooMany> {
        let mut out = Vec::new();
        for span in self.degree..self.points.len() {
            if self.knots[span] < self.knots[span + 1] {
                let piece = self.piece(span);
                if out.is_empty() {
                    out.push(plane(piece[0]));
                }
                halve(piece, limit, &mut out)?;
            }
        }
        Ok(out)
    }

    /// The Bézier points between two knots: the blossom at as many of the one and the other.
    fn piece(&self, span: usize) -> Vec<[f64; 3]> {
        let (a, b) = (self.knots[span], self.knots[span + 1]);
        (0..=self.degree).map(|n| self.blossom(span, |r| if r < n { b } else { a })).collect()
    }

    /// The blossom of a span (de Boor's scheme with a parameter for each of its steps).
    fn blossom(&self, span: usize, parameter: impl Fn(usize) -> f64) -> [f64; 3] {
        let first = span - self.degree;
        let mut points = self.points[first..=span].to_vec();
        for step in 0..self.degree {
            for n in (step + 1..=self.degree).rev() {
                let (low, high) =
                    (self.knots[first + n], self.knots[first + n + self.degree - step]);
                let share = (parameter(step) - low) / (high - low);
                points[n] = between(points[n - 1], points[n], share);
            }
        }
        points[self.degree]
    }
}

/// Halves a rational Bézier curve until its control points are close to its chord; adds the ends of its parts, the first apart.
fn halve(curve: Vec<[f64; 3]>, limit: Limit, out: &mut Vec<[f64; 2]>) -> Result<(), TooMany> {
    // a curve is halved to single points before the bound is reached
    const DEPTH: usize = 48;
    let mut open = vec![(curve, 0)];
    while let Some((curve, depth)) = open.pop() {
        let (a, b) = (plane(curve[0]), plane(curve[curve.len() - 1]));
        let close = |p: &[f64; 3]| distance(a, b, plane(*p)) <= limit.tolerance;
        if depth == DEPTH || curve.iter().all(close) {
            if out.len() >= limit.points {
                return Err(TooMany);
            }
            out.push(b);
            continue;
        }
        let (mut left, mut right) = (Vec::with_capacity(curve.len()), curve);
        // de Casteljau: what is left of each step is the right half
        for count in (1..=right.len()).rev() {
            left.push(right[0]);
            for n in 1..count {
                right[n - 1] = between(right[n - 1], right[n], 0.5);
            }
        }
        open.push((right, depth + 1));
        open.push((left, depth + 1));
    }
    Ok(())
}

fn between(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|n| a[n] + share * (b[n] - a[n]))
}

fn plane([x, y, w]: [f64; 3]) -> [f64; 2] {
    [x / w, y / w]
}

/// Distance of a point from the line between two ends.
fn distance(a: [f64; 2], b: [f64; 2], point: [f64; 2]) -> f64 {
    let (line, to) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
    let square = line[0] * line[0] + line[1] * line[1];
    let t = if square > 0.0 {
        ((line[0] * to[0] + line[1] * to[1]) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (to[0] - t * line[0]).hypot(to[1] - t * line[1])
}
