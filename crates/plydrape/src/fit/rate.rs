//! What resin adds to the shear force, from bias strips that are pulled at several speeds, or held.
//!
//! The shear force per length is τ∞(γ) + G₁ h with ḣ = γ̇ − h/θ, `docs/theory/fit.md`. Between two points of a record the strip is sheared
//! evenly, and h is known exactly; τ∞ is a polynomial without a constant term. By the power of the machine the force is linear in the
//! coefficients and in G₁, so that for each θ they are found by linear least squares, and θ alone is searched for.

use super::shear::{BiasExtension, ShearTest, table_of};
use super::statistics::Estimate;
use crate::Error;
use crate::error::PointFault;
use nalgebra::{DMatrix, DVector};

/// Powers of the polynomial τ∞.
const POWERS: usize = 3;
/// Unknowns that are linear: the polynomial and G₁.
const LINEAR: usize = POWERS + 1;
/// Relaxation times that are tried in a decade.
const PER_DECADE: f64 = 8.0;
/// Halvings of the way between two that were tried: the rest is below what any test knows.
const HALVINGS: usize = 40;
/// Share of the residuals that resin must explain: what explains less is none that a test shows.
const EXPLAINED: f64 = 0.1;
/// Share of the forces, root mean square, that a curve alone must leave: no machine knows less of them.
const LEFT: f64 = 1e-3;

/// A bias strip in time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedSpecimen {
    /// Name in errors.
    pub name: String,
    /// Measures.
    pub test: BiasExtension,
    /// Record: displacement (m) and force (N).
    pub points: Vec<[f64; 2]>,
    /// Times of the points, one each, rising (s).
    pub times: Vec<f64>,
}

/// What was found of the resin of a ply.
#[derive(Debug, Clone, PartialEq)]
pub struct RateFit {
    /// Stiffness G₁ against fast shear (N/m per rad).
    pub stiffness: Estimate,
    /// Relaxation time θ (s).
    pub relaxation: Estimate,
    /// Shear angles, ascending from 0 (rad).
    pub angle: Vec<f64>,
    /// Shear force per length of very slow shear τ∞ at these angles (N/m).
    pub force: Vec<f64>,
    /// Root mean square of what the law leaves of the force of the machine (N).
    pub residual: f64,
}

/// A point of a record: its row of the linear system without the column of G₁, what multiplies h in that column, and the force it is to
/// give.
struct Row {
    powers: [f64; POWERS],
    lever: f64,
    pulled: f64,
    /// What one newton of the machine makes of `pulled`.
    newton: f64,
}

/// A record as the least squares see it.
struct Record {
    rows: Vec<Row>,
    /// Shear angles (rad) and times (s) of the rows, and those of the rest before them.
    angles: Vec<f64>,
    times: Vec<f64>,
}

impl Record {
    fn new(specimen: &TimedSpecimen) -> Result<Self, Error> {
        let TimedSpecimen { name, test, points, times } = specimen;
        // refuse what no fit could use: impossible strips, too few points or times, times that do not rise
        let trellis = ShearTest::Bias(*test);
        trellis.check()?;
        let found = points.len().min(times.len());
        let expected = points.len().max(times.len()).max(LINEAR);
        if found < expected {
            return Err(Error::FitTooFew { what: name.clone(), found, expected });
        }
        let fault = |point, fault| Error::FitPoint { what: name.clone(), point, fault };
        if let Some(n) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(fault(n + 1, PointFault::Untimely));
        }
        // the middle of the strip shears by the whole angle, its two triangles by half of it
        let (width, length) = (test.width, test.length);
        let (middle, ratio) = (2.0 * length - 3.0 * width, length / width - 1.0);
        let mut record = Record { rows: Vec::new(), angles: Vec::new(), times: times.clone() };
        for (n, [displacement, force]) in points.iter().enumerate() {
            let angle = trellis.angle(*displacement).filter(|angle| *angle > -1e-9);
            let Some(angle) = angle else {
                return Err(fault(n, PointFault::Backwards));
            };
            // generalized force of one newton of the machine: yarns do not stretch, so its way follows from the shear angle alone
            let newton = ratio * ((0.5 * angle).cos() - (0.5 * angle).sin());
            let power = |k: usize| {
                let degree = k as i32 + 1;
                angle.powi(degree) * (middle + width * 0.5_f64.powi(degree))
            };
            record.rows.push(Row {
                powers: std::array::from_fn(power),
                lever: middle + 0.5 * width,
                pulled: newton * force,
                newton,
            });
            record.angles.push(angle);
        }
        Ok(record)
    }

    /// h at each point (rad) for a relaxation time (s): the strip is at rest before the first one.
    fn memory(&self, relaxation: f64) -> Vec<f64> {
        let mut h = self.angles.first().copied().unwrap_or(0.0);
        let mut found = vec![h];
        for (angle, time) in self.angles.windows(2).zip(self.times.windows(2)) {
            let dt = time[1] - time[0];
            let decay = (-dt / relaxation).exp();
            // θ (1 − e^(−Δt/θ)), also where Δt is much smaller
            let grown = -relaxation * (-dt / relaxation).exp_m1();
            h = h * decay + (angle[1] - angle[0]) / dt * grown;
            found.push(h);
        }
        found
    }
}

/// The matrix and the right-hand side of all records for a relaxation time (s), in newtons of the machine; without resin where there is
/// none.
fn system(records: &[Record], relaxation: Option<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let columns = if relaxation.is_some() { LINEAR } else { POWERS };
    let count = records.iter().map(|record| record.rows.len()).sum();
    let (mut matrix, mut right) = (DMatrix::zeros(count, columns), DVector::zeros(count));
    let mut n = 0;
    for record in records {
        let memory = relaxation.map(|relaxation| record.memory(relaxation));
        for (k, row) in record.rows.iter().enumerate() {
            for (column, power) in row.powers.iter().enumerate() {
                matrix[(n, column)] = power / row.newton;
            }
            if let Some(memory) = &memory {
                matrix[(n, POWERS)] = memory[k] * row.lever / row.newton;
            }
            right[n] = row.pulled / row.newton;
            n += 1;
        }
    }
    (matrix, right)
}

/// The linear unknowns for a relaxation time, and the sum of squares that they leave (N²).
fn solved(records: &[Record], relaxation: Option<f64>) -> Option<(DVector<f64>, f64)> {
    let (matrix, right) = system(records, relaxation);
    let solution = matrix.clone().svd(true, true).solve(&right, 1e-12).ok()?;
    let left = (matrix * &solution - right).norm_squared();
    left.is_finite().then_some((solution, left))
}

/// What resin adds to the shear force of a ply, and the curve of very slow shear that goes with it, from bias strips in time.
///
/// # Errors
/// The errors of [`ShearTest::check`]; [`Error::FitTooFew`] and [`Error::FitPoint`] for a record; [`Error::FitNoRate`] if the tests do not
/// show it.
pub fn fit_rate(specimens: &[TimedSpecimen]) -> Result<RateFit, Error> {
    let records: Result<Vec<Record>, Error> = specimens.iter().map(Record::new).collect();
    let records = records?;
    let none = || Error::FitNoRate;
    let pauses = records.iter().flat_map(|record| record.times.windows(2));
    let shortest = pauses.map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let duration = |record: &Record| record.times[record.times.len() - 1] - record.times[0];
    let longest = records.iter().map(duration).fold(0.0, f64::max);
    let (low, high) = (0.1 * shortest, 10.0 * longest);
    if !(low > 0.0 && high > low) {
        return Err(none());
    }

    // the best of times that are tried, then between those beside it
    let left = |log: f64| solved(&records, Some(log.exp())).map_or(f64::INFINITY, |found| found.1);
    let decades = (high / low).log10();
    let steps = (PER_DECADE * decades).ceil().max(2.0) as usize;
    let log_time = |n: usize| low.ln() + (high / low).ln() * n as f64 / steps as f64;
    let tried: Vec<f64> = (0..=steps).map(|n| left(log_time(n))).collect();
    let best = (0..=steps).min_by(|a, b| tried[*a].total_cmp(&tried[*b])).unwrap_or(0);
    if best == 0 || best == steps {
        return Err(none());
    }
    let log = least(log_time(best - 1), log_time(best + 1), left);

    let relaxation = log.exp();
    let (solution, squares) = solved(&records, Some(relaxation)).ok_or_else(none)?;
    let without = solved(&records, None).map_or(f64::INFINITY, |found| found.1);
    let stiffness = solution[POWERS];
    let forces = system(&records, None).1.norm_squared();
    let is_shown = without > LEFT * LEFT * forces && squares < (1.0 - EXPLAINED) * without;
    if stiffness <= 0.0 || !is_shown {
        return Err(none());
    }

    // standard errors by the covariance at the minimum, θ among the unknowns
    let (matrix, _) = system(&records, Some(relaxation));
    let count = matrix.nrows();
    let h = 1e-4;
    let [less, more] = [-h, h].map(|h| system(&records, Some((log + h).exp())).0 * &solution);
    let by_log = (more - less) / (2.0 * h);
    let jacobian = DMatrix::from_fn(count, LINEAR + 1, |i, j| match j {
        LINEAR => by_log[i],
        _ => matrix[(i, j)],
    });
    let degrees = count.saturating_sub(LINEAR + 1).max(1);
    let inverse = (jacobian.transpose() * &jacobian).try_inverse();
    let error = |n: usize| {
        let entry = inverse.as_ref().map_or(f64::INFINITY, |inverse| inverse[(n, n)]);
        (squares / degrees as f64 * entry).sqrt()
    };
    let largest = records.iter().flat_map(|record| &record.angles).copied().fold(0.0, f64::max);
    let polynomial =
        |angle: f64| (0..POWERS).map(|k| solution[k] * angle.powi(k as i32 + 1)).sum::<f64>();
    let (angle, force) = table_of(largest, polynomial);
    Ok(RateFit {
        stiffness: Estimate::of_residuals(stiffness, error(POWERS), degrees),
        relaxation: Estimate::of_residuals(relaxation, relaxation * error(LINEAR), degrees),
        angle,
        force,
        residual: (squares / count as f64).sqrt(),
    })
}

/// Where a function is least between two places, by the golden section.
fn least(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let place = |low: f64, high: f64, share: f64| low + share * (high - low);
    let mut inner = [place(low, high, 1.0 - golden), place(low, high, golden)];
    let mut values = inner.map(&value);
    for _ in 0..HALVINGS {
        if values[0] < values[1] {
            high = inner[1];
            inner = [place(low, high, 1.0 - golden), inner[0]];
            values = [value(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], place(low, high, golden)];
            values = [values[1], value(inner[1])];
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRIP: BiasExtension = BiasExtension { width: 0.1, length: 0.25 };

    /// The force of the machine (N) on a strip whose shear force is τ∞ = 20 γ + 60 γ³ N/m beside resin of 150 N/m per rad and 0.8 s, by the
    /// power of the machine with small steps of Euler's rule: a computation of its own.
    fn pulled(speed: f64, pull: f64, hold: f64, points: usize) -> TimedSpecimen {
        let (stiffness, relaxation) = (150.0, 0.8);
        let BiasExtension { width, length } = STRIP;
        let d = length - width;
        let angle = |way: f64| {
            let cosine: f64 = (d + way) / (std::f64::consts::SQRT_2 * d);
            std::f64::consts::FRAC_PI_2 - 2.0 * cosine.acos()
        };
        let curve = |gamma: f64| 20.0 * gamma + 60.0 * gamma.powi(3);
        let (end, fine) = (pull + hold, 2000);
        let dt = end / (points * fine) as f64;
        let (mut q, mut half, mut way) = (0.0, 0.0, 0.0_f64);
        let mut found = (vec![[0.0, 0.0]], vec![0.0]);
        for n in 1..=points * fine {
            let next = speed * (n as f64 * dt).min(pull);
            let turn = angle(next) - angle(way);
            q += stiffness * turn - q * dt / relaxation;
            half += stiffness * 0.5 * turn - half * dt / relaxation;
            way = next;
            if n % fine == 0 {
                // areas of the parts that shear by γ and γ/2, times how fast these grow with the way of the machine
                let gamma = angle(way);
                let slope = (angle(way + 1e-7) - angle(way - 1e-7)) / 2e-7;
                let whole = width * (length - 1.5 * width);
                let corners = 0.5 * width * width;
                let force =
                    slope * (whole * (curve(gamma) + q) + corners * (curve(0.5 * gamma) + half));
                found.0.push([way, force]);
                found.1.push(n as f64 * dt);
            }
        }
        let name = format!("{speed} m/s");
        TimedSpecimen { name, test: STRIP, points: found.0, times: found.1 }
    }

    #[test]
    fn two_speeds_and_a_hold_give_stiffness_and_relaxation_back() {
        let slow = pulled(0.5e-3, 60.0, 0.0, 40);
        let fast = pulled(20e-3, 1.5, 6.0, 60);
        let fit = fit_rate(&[slow, fast]).expect("a law");
        let RateFit { stiffness, relaxation, angle, force, residual } = fit;
        assert!((stiffness.value / 150.0 - 1.0).abs() < 0.02, "{stiffness:?}");
        assert!((relaxation.value / 0.8 - 1.0).abs() < 0.02, "{relaxation:?}");
        let near = angle.iter().zip(&force).all(|(gamma, tau)| {
            (tau - 20.0 * gamma - 60.0 * gamma.powi(3)).abs() < 0.02 * (1.0 + tau)
        });
        assert!(near, "{angle:?} {force:?}");
        assert!(residual < 0.02, "{residual}");
        for estimate in [stiffness, relaxation] {
            assert!(estimate.error < 0.05 * estimate.value, "{estimate:?}");
        }
    }

    /// A strip that is pulled so slowly that resin is a spring nowhere says nothing of its stiffness.
    #[test]
    fn tests_that_do_not_show_resin_are_refused() {
        let mut dry = pulled(0.5e-3, 60.0, 0.0, 40);
        // the same strip with no resin at all
        for point in &mut dry.points {
            let gamma = ShearTest::Bias(STRIP).angle(point[0]).expect("a trellis");
            let lever = 1.5 * ((0.5 * gamma).cos() - (0.5 * gamma).sin());
            point[1] = (20.0 * gamma * 0.2 + 20.0 * 0.5 * gamma * 0.1) / lever;
        }
        assert_eq!(fit_rate(&[dry]), Err(Error::FitNoRate));
    }

    #[test]
    fn a_time_that_does_not_rise_is_refused_at_its_point() {
        let mut fast = pulled(20e-3, 1.5, 6.0, 20);
        fast.times[7] = fast.times[6];
        let Err(Error::FitPoint { point, fault, .. }) = fit_rate(&[fast]) else { panic!("a law") };
        assert_eq!((point, fault), (7, PointFault::Untimely));
    }

    /// A point without its time is refused as one that is missing, and so is a time without its point.
    #[test]
    fn points_and_times_are_as_many() {
        let whole = pulled(20e-3, 1.5, 6.0, 20);
        let (mut timeless, mut pointless) = (whole.clone(), whole);
        timeless.times.pop();
        pointless.points.pop();
        for specimen in [timeless, pointless] {
            let found = fit_rate(&[specimen]);
            assert!(matches!(found, Err(Error::FitTooFew { found: 20, expected: 21, .. })));
        }
    }
}
