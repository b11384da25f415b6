//! How sure a fitted value is.

/// Where a standard error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sure {
    /// The standard deviation between this many specimens, over the root of their number.
    Specimens(usize),
    /// The residuals of one specimen's points, by the covariance of the fit, with this many degrees of freedom. It says nothing of
    /// how specimens differ.
    Residuals(usize),
    /// Nothing says it, because the value is the only one of one specimen.
    Unknown,
}

/// A fitted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The value (SI).
    pub value: f64,
    /// Standard error (SI); infinite where nothing says it.
    pub error: f64,
    /// Where the error comes from.
    pub sure: Sure,
    /// Standard deviation between specimens, as a share of the value; `None` from one specimen.
    pub scatter: Option<f64>,
}

impl Estimate {
    /// The mean of specimens; one alone has no known error.
    #[must_use]
    pub fn of_specimens(values: &[f64]) -> Estimate {
        let (value, deviation) = mean_and_deviation(values);
        match deviation {
            Some(deviation) => Estimate {
                value,
                error: deviation / (values.len() as f64).sqrt(),
                sure: Sure::Specimens(values.len()),
                scatter: Some(deviation / value.abs()),
            },
            None => Estimate { value, error: f64::INFINITY, sure: Sure::Unknown, scatter: None },
        }
    }

    /// A value of one specimen with its standard error by the covariance of the fit, and the degrees of freedom of that.
    pub(super) fn of_residuals(value: f64, error: f64, degrees: usize) -> Estimate {
        Estimate { value, error, sure: Sure::Residuals(degrees), scatter: None }
    }

    /// The interval that holds the true value in 95 of 100 tests, by Student's distribution; `None` where nothing says it.
    #[must_use]
    pub fn interval(&self) -> Option<[f64; 2]> {
        let degrees = match self.sure {
            Sure::Specimens(count) => count - 1,
            Sure::Residuals(degrees) => degrees,
            Sure::Unknown => return None,
        };
        let half = student(degrees) * self.error;
        Some([self.value - half, self.value + half])
    }
}

/// Mean and standard deviation (of n − 1); no deviation of one value.
pub(super) fn mean_and_deviation(values: &[f64]) -> (f64, Option<f64>) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (values.len() > 1).then(|| (squares / (count - 1.0)).sqrt()))
}

/// Student's t of 97.5 %: from the tables up to 10 degrees of freedom, then Cornish and Fisher's expansion (to 1e-3).
pub(super) fn student(degrees: usize) -> f64 {
    const TABLE: [f64; 10] =
        [12.7062, 4.30265, 3.18245, 2.77645, 2.57058, 2.44691, 2.36462, 2.306, 2.26216, 2.22814];
    match degrees {
        0 => f64::INFINITY,
        1..=10 => TABLE[degrees - 1],
        _ => {
            let (z, n): (f64, f64) = (1.959_963_985, degrees as f64);
            let z3 = z * z * z;
            z + (z3 + z) / (4.0 * n) + (5.0 * z3 * z * z + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        }
    }
}

/// The rising values that are nearest to given ones by least squares: those that fall are pooled to their mean.
pub(super) fn rising(values: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::with_capacity(values.len());
    for value in values {
        let mut pool = (*value, 1);
        while let Some((mean, count)) = pools.last().copied().filter(|(mean, _)| *mean > pool.0) {
            let all = count + pool.1;
            pool = ((mean * count as f64 + pool.0 * pool.1 as f64) / all as f64, all);
            pools.pop();
        }
        pools.push(pool);
    }
    pools.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count)).collect()
}

/// The straight lines between points, x ascending; the ends' values beyond them.
pub(super) fn between(x: &[f64], y: &[f64], at: f64) -> f64 {
    let k = x.partition_point(|knot| *knot <= at);
    if k == 0 {
        return y[0];
    }
    if k == x.len() {
        return y[k - 1];
    }
    y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1])
}

/// The straight line nearest to points by least squares: its value at 0 and its slope; `None` where they have one x.
pub(super) fn line(points: &[[f64; 2]]) -> Option<(f64, f64)> {
    let count = points.len() as f64;
    let sum = |f: fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let (x, y) = (sum(|p| p[0]) / count, sum(|p| p[1]) / count);
    let (xx, xy) = (sum(|p| p[0] * p[0]) / count - x * x, sum(|p| p[0] * p[1]) / count - x * y);
    // rounding leaves a variance where there is none
    let differs = points.iter().any(|p| p[0] != points[0][0]);
    (differs && xx > 0.0).then(|| (y - xy / xx * x, xy / xx))
}
