//! Rigidities and curves of the moment from strips that hang over an edge, and from bending tests.

use super::positive;
use super::record::{Remark, loading};
use super::statistics::{Estimate, between, mean_and_deviation, rising};
use crate::Error;
use crate::elastica::{Bending, Cantilever, Shape};
use crate::error::PointFault;
use crate::material::MomentCurve;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned, Vector2};

/// Rigidity per width (N·m) of a strip whose tip is an angle ϑ (rad) below the edge at an overhang L (m), by the exact elastica,
/// eq. (21a) of `docs/theory/fit.md`: B = f(ϑ) w L³. At 41.5° f is 0.12493, the 1/8 of the standards.
///
/// # Errors
/// [`Error::FitRange`] if the angle is not between 1 and 89°; [`Error::FitNoStrip`] if no strip hangs so.
pub fn rigidity_of_overhang(overhang: f64, weight: f64, angle: f64) -> Result<f64, Error> {
    if !(ANGLES[0]..=ANGLES[1]).contains(&angle) {
        let (what, range) = ("the angle of the chord", "from 1 to 89 degrees");
        return Err(Error::FitRange { what, value: angle, unit: "rad", range });
    }
    let chord = |factor: f64| {
        let bending = Bending::Rigidity(factor);
        let strip = Cantilever { length: 1.0, angle: 0.0, weight: 1.0, bending };
        let [x, z] = strip.solve().ok()?.at(1.0);
        Some((-z).atan2(x))
    };
    // Peirce's formula is within 6 % at usual angles; the chord falls with the factor, all but in proportion to its logarithm
    let mut factor = peirce(angle);
    for _ in 0..40 {
        let ratio = 1.0 + DIFFERENCE;
        let (Some(here), Some(beside)) = (chord(factor), chord(factor * ratio)) else { break };
        let slope = (beside - here) / ratio.ln();
        let step = ((angle - here) / slope).clamp(-1.0, 1.0);
        factor *= step.exp();
        if step.abs() < 1e-9 {
            return Ok(factor * weight * overhang.powi(3));
        }
    }
    let reason = "no heavy strip has this chord".to_string();
    Err(Error::FitNoStrip { what: "the overhang".into(), reason })
}

/// Peirce's factor of w L³ (1930), cos(ϑ/2)/(8 tan ϑ).
fn peirce(angle: f64) -> f64 {
    (0.5 * angle).cos() / (8.0 * angle.tan())
}

/// Smallest and largest angle of a chord (rad).
const ANGLES: [f64; 2] = [0.017, 1.554];

/// A cantilever test: overhangs at one angle of the chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overhang {
    /// Weight per area (N/m²).
    pub weight: f64,
    /// Angle of the chord below the edge (rad), 41.5° in the standards.
    pub angle: f64,
}

impl Overhang {
    /// Rigidity per width (N·m) of each strip by its overhang (m).
    ///
    /// # Errors
    /// The errors of [`rigidity_of_overhang`], and [`Error::FitRange`] if an overhang or the weight is not positive.
    pub fn rigidities(&self, overhangs: &[f64]) -> Result<Vec<f64>, Error> {
        positive("the weight per area", self.weight, "N/m^2")?;
        for overhang in overhangs {
            positive("an overhang", *overhang, "m")?;
        }
        let unit = rigidity_of_overhang(1.0, self.weight, self.angle)?;
        Ok(overhangs.iter().map(|l| unit * l.powi(3)).collect())
    }

    /// Rigidity per width (N·m) from the overhangs (m) of strips.
    ///
    /// # Errors
    /// The errors of [`Self::rigidities`], and [`Error::FitTooFew`] if there is none.
    pub fn fit(&self, overhangs: &[f64]) -> Result<Estimate, Error> {
        if overhangs.is_empty() {
            return Err(Error::FitTooFew { what: "the test".into(), found: 0, expected: 1 });
        }
        Ok(Estimate::of_specimens(&self.rigidities(overhangs)?))
    }
}

/// A strip that hangs over an edge, seen from the side.
#[derive(Debug, Clone, PartialEq)]
pub struct Hang {
    /// Points [x, z] of the strip, from the edge (m); x away from it, z up.
    pub points: Vec<[f64; 2]>,
    /// Length of the overhang (m).
    pub length: f64,
    /// Weight per area (N/m²).
    pub weight: f64,
}

/// Fewest points of a strip.
const FEWEST: usize = 4;
/// Straight pieces that a solved strip is compared by.
const PIECES: usize = 200;
/// A place of a point that is noise, as a share of the length of its strip.
const NOISE: f64 = 0.02;
/// Change of a parameter in the differences of the residuals.
const DIFFERENCE: f64 = 1e-5;

/// The distances of points from a strip with a rigidity (logarithm) and an angle at the edge.
struct Residuals<'a> {
    hang: &'a Hang,
    parameters: Vector2<f64>,
}

impl Residuals<'_> {
    /// The distances of the points (m) from a strip with other parameters; `None` if no strip hangs so.
    fn distances(&self, parameters: &Vector2<f64>) -> Option<DVector<f64>> {
        let strip = Cantilever {
            length: self.hang.length,
            angle: parameters[1],
            weight: self.hang.weight,
            bending: Bending::Rigidity(parameters[0].exp()),
        };
        let shape = strip.solve().ok()?;
        Some(distances(&shape, &self.hang.points))
    }
}

/// Signed distances of points from a strip (m), above it positive.
fn distances(shape: &Shape, points: &[[f64; 2]]) -> DVector<f64> {
    let corners = shape.polyline(PIECES);
    let distance_to_shape = |[x, z]: &[f64; 2]| {
        let mut best = f64::INFINITY;
        for pair in corners.windows(2) {
            let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let off = [x - pair[0][0], z - pair[0][1]];
            let squared = along[0] * along[0] + along[1] * along[1];
            let t = ((off[0] * along[0] + off[1] * along[1]) / squared).clamp(0.0, 1.0);
            let distance = (off[0] - t * along[0]).hypot(off[1] - t * along[1]);
            if distance < best.abs() {
                let side = along[0] * off[1] - along[1] * off[0];
                best = distance.copysign(side);
            }
        }
        best
    };
    DVector::from_iterator(points.len(), points.iter().map(distance_to_shape))
}

impl LeastSquaresProblem<f64, Dyn, nalgebra::U2> for Residuals<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, nalgebra::U2>;
    type ParameterStorage = Owned<f64, nalgebra::U2>;

    fn set_params(&mut self, parameters: &Vector2<f64>) {
        self.parameters = *parameters;
    }

    fn params(&self) -> Vector2<f64> {
        self.parameters
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.distances(&self.parameters)
    }

    fn jacobian(&self) -> Option<nalgebra::OMatrix<f64, Dyn, nalgebra::U2>> {
        let mut jacobian =
            nalgebra::OMatrix::<f64, Dyn, nalgebra::U2>::zeros(self.hang.points.len());
        for n in 0..2 {
            let mut step = Vector2::zeros();
            step[n] = DIFFERENCE;
            let plus = self.distances(&(self.parameters + step))?;
            let minus = self.distances(&(self.parameters - step))?;
            jacobian.set_column(n, &((plus - minus) / (2.0 * DIFFERENCE)));
        }
        Some(jacobian)
    }
}

/// Refuses points of several strips, and a strip that no weight bends so: behind the edge, or below the chord to its tip.
fn signs(hang: &Hang, [x, z]: [f64; 2]) -> Result<(), (usize, PointFault)> {
    let noise = NOISE * hang.length;
    let behind = hang.points.iter().position(|point| point[0] < -noise);
    if let Some(n) = behind {
        return Err((n, PointFault::BehindEdge));
    }
    // points in order, but for a return to the edge
    let fall = |n: &usize| hang.points[n - 1][0] - hang.points[*n][0];
    let falls: Vec<usize> = (1..hang.points.len()).filter(|n| fall(n) > 0.0).collect();
    let again = falls.iter().find(|n| fall(n) > 0.5 * x);
    if let Some(n) = again
        && 4 * falls.len() < hang.points.len()
    {
        return Err((*n, PointFault::Returns));
    }
    // the weight bends every strip to above the chord from edge to tip
    let above = |p: &[f64; 2]| (x * p[1] - z * p[0]) / x.hypot(z);
    let mean = hang.points.iter().map(above).sum::<f64>() / hang.points.len() as f64;
    let lowest = (0..hang.points.len())
        .min_by(|a, b| above(&hang.points[*a]).total_cmp(&above(&hang.points[*b])));
    match lowest {
        Some(n) if mean < -noise => Err((n, PointFault::Upwards)),
        _ => Ok(()),
    }
}

/// Rigidity per width (N·m) and the angle at the edge (rad) of one strip, with standard errors from the residuals.
fn fit_one(hang: &Hang, name: &str) -> Result<[Estimate; 2], Error> {
    positive("the length of the overhang", hang.length, "m")?;
    positive("the weight per area", hang.weight, "N/m^2")?;
    let few = |found| Error::FitTooFew { what: name.to_string(), found, expected: FEWEST };
    // points at the edge say nothing: every strip goes through it
    let far = hang.points.iter().filter(|[x, z]| x.hypot(*z) > 0.02 * hang.length).count();
    if far < FEWEST {
        return Err(few(far));
    }
    let no_fit = |reason: String| Error::FitNoStrip { what: name.to_string(), reason };
    let reach = hang.points.iter().map(|[x, z]| x.hypot(*z)).fold(0.0, f64::max);
    if reach > 1.05 * hang.length {
        return Err(no_fit(format!(
            "a point is {:.1} mm from the edge, and the strip is {:.1} mm long",
            1e3 * reach,
            1e3 * hang.length
        )));
    }

    // from the rigidity that Peirce's formula gives the chord to the farthest point
    let tip = hang.points.iter().max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
    let [x, z] = *tip.ok_or_else(|| few(0))?;
    signs(hang, [x, z]).map_err(|(point, fault)| Error::FitPoint {
        what: name.to_string(),
        point,
        fault,
    })?;
    let chord = (-z).atan2(x).clamp(0.02, 1.5);
    let start = peirce(chord) * hang.weight * hang.length.powi(3);
    let problem = Residuals { hang, parameters: Vector2::new(start.ln(), 0.0) };
    let (problem, report) = LevenbergMarquardt::new().minimize(problem);
    if !report.termination.was_successful() {
        return Err(no_fit(format!("the search ended with {:?}", report.termination)));
    }
    let (Some(jacobian), Some(residuals)) = (problem.jacobian(), problem.residuals()) else {
        return Err(no_fit("no strip of the rigidity that was found hangs".into()));
    };
    let degrees = hang.points.len() - 2;
    let variance = residuals.norm_squared() / degrees as f64;
    let jacobian = DMatrix::from_iterator(jacobian.nrows(), 2, jacobian.iter().copied());
    let normal = jacobian.transpose() * &jacobian;
    let covariance = normal
        .try_inverse()
        .ok_or_else(|| no_fit("rigidity and angle at the edge cannot be told apart".into()))?;
    let error = |n: usize| (variance * covariance[(n, n)]).sqrt();
    let rigidity = problem.parameters[0].exp();
    Ok([
        Estimate::of_residuals(rigidity, rigidity * error(0), degrees),
        Estimate::of_residuals(problem.parameters[1], error(1), degrees),
    ])
}

/// Rigidity per width (N·m) of strips that hang over an edge, by least squares with the exact elastica; of several strips the mean, and
/// beside it each strip's rigidity and angle at the edge.
///
/// # Errors
/// [`Error::FitTooFew`] if a strip has too few points, [`Error::FitPoint`] if its weight does not bend it so, [`Error::FitNoStrip`] if none
/// of the law goes through them.
pub fn fit_hang(strips: &[(String, Hang)]) -> Result<(Estimate, Vec<[Estimate; 2]>), Error> {
    let each: Result<Vec<_>, _> = strips.iter().map(|(name, hang)| fit_one(hang, name)).collect();
    let each = each?;
    let whole = match each.as_slice() {
        [] => return Err(Error::FitTooFew { what: "the test".into(), found: 0, expected: 1 }),
        [[rigidity, _]] => *rigidity,
        many => {
            let values: Vec<f64> = many.iter().map(|[rigidity, _]| rigidity.value).collect();
            Estimate::of_specimens(&values)
        }
    };
    Ok((whole, each))
}

/// Intervals of a fitted curve of the moment.
const INTERVALS: usize = 10;
/// A mean moment against its curvature, or a fall behind its peak, that is no noise: as a share of the largest, and of the peak.
const AGAINST: f64 = 0.05;
const FALL: f64 = 0.1;

/// A fitted curve of the moment.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentFit {
    /// Moment per width over curvature, never falling.
    pub curve: MomentCurve,
    /// Scatter between specimens as a share of the moment; `None` from one specimen.
    pub scatter: Option<f64>,
    /// The largest curvature of each specimen (1/m).
    pub reach: Vec<f64>,
    /// What is to be known of the record of each specimen.
    pub remarks: Vec<Vec<Remark>>,
}

/// The curve of the moment of bending tests: each specimen's points (curvature in 1/m, moment per width in N), to either side, loading and
/// unloading; the mean of both sides and both ways, never falling.
///
/// # Errors
/// [`Error::FitTooFew`] if a specimen has too few points, [`Error::FitPoint`] if it shows what no specimen does, [`Error::FitNoStrip`] if its
/// moment does not rise.
pub fn fit_moments(specimens: &[(String, Vec<[f64; 2]>)]) -> Result<MomentFit, Error> {
    let mut curves: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut remarks = Vec::new();
    for (name, points) in specimens {
        let Folded { points: folded, remarks: own } = folded(points)
            .map_err(|(point, fault)| Error::FitPoint { what: name.clone(), point, fault })?;
        if folded.len() < 3 {
            let found = folded.len();
            return Err(Error::FitTooFew { what: name.clone(), found, expected: 3 });
        }
        curves.push(folded);
        remarks.push(own);
    }
    let last = |curve: &Vec<[f64; 2]>| curve.last().map_or(0.0, |point| point[0]);
    let reaches: Vec<f64> = curves.iter().map(last).collect();
    let reach = reaches.iter().copied().fold(f64::INFINITY, f64::min);
    if curves.is_empty() {
        return Err(Error::FitTooFew { what: "the test".into(), found: 0, expected: 1 });
    }
    let means: Vec<Vec<[f64; 2]>> = curves.iter().map(|curve| in_intervals(curve, reach)).collect();
    let first = means.first().map(Vec::as_slice).unwrap_or_default();
    let rows: Vec<(f64, f64, Option<f64>)> = first[1..]
        .iter()
        .map(|[kappa, _]| {
            let moment = |curve: &Vec<[f64; 2]>| {
                let [x, y]: [Vec<f64>; 2] = [0, 1].map(|c| curve.iter().map(|p| p[c]).collect());
                between(&x, &y, *kappa)
            };
            let (mean, deviation) =
                mean_and_deviation(&means.iter().map(moment).collect::<Vec<_>>());
            (*kappa, mean, deviation)
        })
        .collect();
    let mut moments = vec![0.0];
    moments.extend(rows.iter().map(|row| row.1));
    let risen = rising(&moments);
    let (mut curvature, mut moment) = (vec![0.0], vec![0.0]);
    for (n, row) in rows.iter().enumerate() {
        // points that were pooled are one point, the last of them
        let pooled = risen.get(n + 2).is_some_and(|next| *next == risen[n + 1]);
        if !pooled && risen[n + 1] > moment[moment.len() - 1] {
            curvature.push(row.0);
            moment.push(risen[n + 1]);
        }
    }
    let curve = MomentCurve { curvature, moment };
    if !curve.is_sound() {
        let reason = "the moment does not rise with the curvature".to_string();
        return Err(Error::FitNoStrip { what: "the bending test".into(), reason });
    }
    // a load cell that shows nothing yet has no scatter
    let shares: Option<Vec<f64>> = rows
        .iter()
        .filter(|(_, mean, _)| *mean != 0.0)
        .map(|(_, mean, deviation)| Some((*deviation.as_ref()? / mean).powi(2)))
        .collect();
    let scatter = shares.map(|s| (s.iter().sum::<f64>() / s.len().max(1) as f64).sqrt());
    Ok(MomentFit { curve, scatter, reach: reaches, remarks })
}

/// The points of a specimen folded to one side, its curvature ascending, and what is to be known of them.
struct Folded {
    points: Vec<[f64; 2]>,
    remarks: Vec<Remark>,
}

/// Folds the points of a specimen to one side: of a single way forth the loading alone, of a loop all points up to the peak of its mean.
fn folded(points: &[[f64; 2]]) -> Result<Folded, (usize, PointFault)> {
    let range = points.iter().fold(0.0, |most: f64, point| most.max(point[0].abs()));
    let one_way = points.windows(2).all(|pair| pair[1][0] >= pair[0][0] - NOISE * range)
        && points.iter().all(|point| point[0] >= -NOISE * range);
    let (test, mut remarks) = if one_way {
        let whole = loading(points)?;
        (&points[whole.points], whole.remarks)
    } else {
        (points, Vec::new())
    };
    // M sign(κ): hysteresis, which is as far above as below, goes out in the mean
    let mut folded: Vec<[f64; 2]> = test.iter().map(|[k, m]| [k.abs(), m * k.signum()]).collect();
    folded.retain(|[k, _]| *k > 0.0);
    folded.sort_by(|a, b| a[0].total_cmp(&b[0]));
    if one_way {
        return Ok(Folded { points: folded, remarks });
    }
    let means = in_intervals(&folded, range);
    let largest = means.iter().map(|mean| mean[1]).fold(0.0, f64::max);
    let mut peak = [0.0; 2];
    for (n, [curvature, moment]) in means.iter().copied().enumerate().skip(1) {
        // where no moment rises, the law itself says so
        if largest > 0.0 && moment < -AGAINST * largest {
            let [from, to] = [means[n - 1][0], curvature];
            let against = |p: &[f64; 2]| p[0] * p[1] < 0.0 && (from..=to).contains(&p[0].abs());
            return Err((points.iter().position(against).unwrap_or(0), PointFault::BelowZero));
        }
        if peak[1] - moment > FALL * peak[1] && peak[1] > 0.0 {
            folded.retain(|point| point[0] <= peak[0]);
            remarks.push(Remark::BeyondPeak { curvature: peak[0] });
            break;
        }
        if moment > peak[1] {
            peak = [curvature, moment];
        }
    }
    Ok(Folded { points: folded, remarks })
}

/// Means of curvature and moment in each interval up to a curvature, from 0 on.
fn in_intervals(points: &[[f64; 2]], reach: f64) -> Vec<[f64; 2]> {
    let mut means = vec![[0.0; 2]];
    for n in 0..INTERVALS {
        let bounds = [n, n + 1].map(|k| reach * k as f64 / INTERVALS as f64);
        let inside: Vec<&[f64; 2]> =
            points.iter().filter(|p| p[0] > bounds[0] && p[0] <= bounds[1]).collect();
        if !inside.is_empty() {
            let count = inside.len() as f64;
            means.push([0, 1].map(|c| inside.iter().map(|p| p[c]).sum::<f64>() / count));
        }
    }
    means
}
