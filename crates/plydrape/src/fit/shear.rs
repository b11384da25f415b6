//! Shear force per length τ(γ) from a bias-extension or a picture-frame test.
//!
//! Both follow from the power of the machine, F δ' = Σ area · τ γ', eq. (21) of `docs/theory/fit.md`. τ is the force that works on
//! the shear angle; the normalized force along the sides of Cao et al. 2008 (Composites Part A 39:1037) is τ/cos γ, and with it the
//! formula here is theirs for the bias extension.

use super::positive;
use super::record::{Remark, loading, peak_before_end};
use super::statistics::{between, line, mean_and_deviation, rising};
use crate::Error;
use crate::material::ShearCurve;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, SQRT_2};

/// Spacing of the table (rad): 5°.
const SPACING: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Largest shear angle of a table (rad): beyond it no weave is a trellis.
const LARGEST: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// How many times steeper the second of two straight lines must be for their corner to be called locking.
const STEEPER: f64 = 2.0;
/// Powers of the polynomial.
const POWERS: usize = 3;

/// A strip cut at 45° to the yarns and pulled along its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BiasExtension {
    /// Width W (m).
    pub width: f64,
    /// Length between the clamps H (m), at least two widths.
    pub length: f64,
}

/// A frame of four hinged sides, pulled at two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureFrame {
    /// Length of a side L (m).
    pub side: f64,
    /// Length of the fabric along a side (m); that of the side unless the arms are longer.
    pub fabric: f64,
}

/// A shear test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShearTest {
    /// Bias extension.
    Bias(BiasExtension),
    /// Picture frame.
    Frame(PictureFrame),
}

/// A specimen of a shear test.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearSpecimen {
    /// Name in errors.
    pub name: String,
    /// How it was tested, with its own measures.
    pub test: ShearTest,
    /// Record in the order of time: displacement (m) and force (N).
    pub points: Vec<[f64; 2]>,
}

/// A fitted shear law.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearFit {
    /// Shear angles, ascending from 0 (rad).
    pub angle: Vec<f64>,
    /// Mean shear force per length τ, never falling (N/m).
    pub force: Vec<f64>,
    /// Standard deviation between specimens (N/m); `None` from one specimen.
    pub deviation: Option<Vec<f64>>,
    /// Scatter between specimens as a share of the force, root mean square over the angles.
    pub scatter: Option<f64>,
    /// Coefficients of γ, γ², γ³ (N/m) by least squares, and their standard errors from the residuals; `None` where fewer than three points
    /// are left.
    pub polynomial: Option<[[f64; 2]; POWERS]>,
    /// Where the curve turns up (rad): the corner of the best two straight lines; `None` where it does not.
    pub locking: Option<f64>,
    /// The largest shear angle of each specimen (rad).
    pub reach: Vec<f64>,
    /// What is to be known of the record of each specimen.
    pub remarks: Vec<Vec<Remark>>,
}

impl ShearTest {
    /// Checks the specimen's measures.
    ///
    /// # Errors
    /// [`Error::FitRange`] if one is not positive, or a bias specimen is shorter than two widths.
    pub fn check(&self) -> Result<(), Error> {
        match self {
            ShearTest::Bias(BiasExtension { width, length }) => {
                positive("the width", *width, "m")?;
                positive("the length", *length, "m")?;
                if *length >= 2.0 * width {
                    return Ok(());
                }
                let (what, range) = (
                    "the length",
                    "two widths or more: shorter strips have no middle that shears alone",
                );
                Err(Error::FitRange { what, value: *length, unit: "m", range })
            }
            ShearTest::Frame(PictureFrame { side, fabric }) => {
                positive("the side", *side, "m")?;
                positive("the side of the fabric", *fabric, "m")?;
                if fabric <= side {
                    return Ok(());
                }
                let (what, range) = ("the side of the fabric", "at most that of the frame");
                Err(Error::FitRange { what, value: *fabric, unit: "m", range })
            }
        }
    }

    /// Shear angle γ (rad) at a displacement δ of the machine (m); `None` beyond what the kinematics allow.
    #[must_use]
    pub fn angle(&self, displacement: f64) -> Option<f64> {
        let cosine = match self {
            ShearTest::Bias(BiasExtension { width, length }) => {
                let d = length - width;
                (d + displacement) / (SQRT_2 * d)
            }
            ShearTest::Frame(PictureFrame { side, .. }) => {
                FRAC_1_SQRT_2 + displacement / (2.0 * side)
            }
        };
        (cosine.abs() < 1.0).then(|| FRAC_PI_2 - 2.0 * cosine.acos())
    }

    /// Largest displacement (m), at which a trellis is folded flat.
    fn largest(&self) -> f64 {
        match self {
            ShearTest::Bias(BiasExtension { width, length }) => (SQRT_2 - 1.0) * (length - width),
            ShearTest::Frame(PictureFrame { side, .. }) => (2.0 - SQRT_2) * side,
        }
    }

    /// Shear force per length τ (N/m) at a shear angle γ (rad) and a force of the machine (N), after the points before it.
    fn tau(&self, angle: f64, force: f64, [angles, forces]: &[Vec<f64>; 2]) -> f64 {
        match self {
            ShearTest::Frame(PictureFrame { side, fabric }) => {
                let half = 0.5 * (FRAC_PI_2 - angle);
                force * half.sin() * side / (fabric * fabric)
            }
            ShearTest::Bias(BiasExtension { width, length }) => {
                // the corners shear by half the angle; their law is known up to there, or all but so at the first points
                let ratio = length / width - 1.0;
                let pulled = force * ratio * ((0.5 * angle).cos() - (0.5 * angle).sin());
                let middle = 2.0 * length - 3.0 * width;
                let last = angles[angles.len() - 1];
                if angles.len() > 1 && 0.5 * angle <= last {
                    (pulled - width * between(angles, forces, 0.5 * angle)) / middle
                } else {
                    // τ in proportion to γ from 0: τ(γ/2) = τ(γ)/2
                    pulled / (middle + 0.5 * width)
                }
            }
        }
    }
}

impl ShearSpecimen {
    /// The curve τ(γ) of the loading: angles (rad) ascending from 0, forces (N/m); and what is to be known of the record.
    ///
    /// # Errors
    /// The errors of [`ShearTest::check`]; [`Error::FitPoint`] if the record shows what no specimen does; [`Error::FitReach`] if fewer than
    /// three points of it have a shear angle above zero.
    pub fn curve(&self) -> Result<([Vec<f64>; 2], Vec<Remark>), Error> {
        self.test.check()?;
        let reach = || {
            let extreme = |fold: fn(f64, f64) -> f64, from: f64| {
                self.points.iter().map(|point| point[0]).fold(from, fold)
            };
            Error::FitReach {
                what: self.name.clone(),
                found: [extreme(f64::min, f64::INFINITY), extreme(f64::max, f64::NEG_INFINITY)],
                largest: self.test.largest(),
            }
        };
        if self.points.len() < 3 {
            let (what, found) = (self.name.clone(), self.points.len());
            return Err(Error::FitTooFew { what, found, expected: 3 });
        }
        let shears = |displacement: f64| {
            self.test.angle(displacement).is_some_and(|angle| angle > 0.0 && angle <= LARGEST)
        };
        // a record of another specimen, or from another zero, is none of this one, whatever its forces
        if self.points.iter().filter(|point| shears(point[0])).count() < 3 {
            return Err(reach());
        }
        let whole = loading(&self.points).map_err(|(point, fault)| Error::FitPoint {
            what: self.name.clone(),
            point,
            fault,
        })?;
        let (points, mut remarks) = (&self.points[whole.points.clone()], whole.remarks);
        let mut known: Vec<[f64; 2]> = points
            .iter()
            .filter_map(|[displacement, force]| Some([self.test.angle(*displacement)?, *force]))
            .filter(|[angle, _]| *angle > 0.0 && *angle <= LARGEST)
            .collect();
        let beyond = |point: &[f64; 2]| point[0] > 0.0 && !shears(point[0]);
        if let (Some(first), Some(last)) =
            (points.iter().position(beyond), points.iter().rposition(beyond))
        {
            remarks.push(Remark::BeyondTrellis { points: [first, last] });
        }
        known.sort_by(|a, b| a[0].total_cmp(&b[0]));
        known.dedup_by(|b, a| b[0] - a[0] < 1e-12);
        if known.len() < 3 {
            let what = format!("the loading in {}", self.name);
            return Err(Error::FitTooFew { what, found: known.len(), expected: 3 });
        }
        let mut curve = [vec![0.0], vec![0.0]];
        for [angle, force] in known {
            let tau = self.test.tau(angle, force, &curve);
            curve[0].push(angle);
            curve[1].push(tau);
        }
        // a force that stays as the strip gets longer is a shear force that falls: the strip slips
        if let Some(peak) = peak_before_end(&curve[1]) {
            let last = curve[0][peak];
            let behind = |point: &[f64; 2]| self.test.angle(point[0]).is_none_or(|own| own > last);
            let points = [points.iter().position(behind), points.iter().rposition(behind)];
            if let [Some(first), Some(end)] = points {
                remarks.push(Remark::BeyondShear { points: [first, end], angle: last });
            }
            curve.iter_mut().for_each(|values| values.truncate(peak + 1));
        }
        Ok((curve, remarks))
    }
}

/// The shear law of all specimens, each with its own measures.
///
/// # Errors
/// The errors of [`ShearSpecimen::curve`], and [`Error::FitTooFew`] if there are no specimens, or these share less than 10° of shear.
pub fn fit_shear(specimens: &[ShearSpecimen]) -> Result<ShearFit, Error> {
    let found: Result<Vec<_>, _> = specimens.iter().map(ShearSpecimen::curve).collect();
    let (curves, remarks): (Vec<[Vec<f64>; 2]>, Vec<_>) = found?.into_iter().unzip();
    if curves.is_empty() {
        return Err(Error::FitTooFew { what: "the test".into(), found: 0, expected: 1 });
    }
    let reach: Vec<f64> =
        curves.iter().map(|[angles, _]| angles.last().copied().unwrap_or(0.0)).collect();
    let shared = reach.iter().copied().fold(f64::INFINITY, f64::min);
    let whole = (shared / SPACING + 1e-9).floor() as usize;
    if whole < 2 {
        let shortest = specimens.iter().zip(&reach).find(|(_, own)| **own == shared);
        let name = shortest.map_or("", |(specimen, _)| &specimen.name);
        let what = format!(
            "the shear that all specimens reach, up to {:.1} deg of {name}, in points every 5 deg,",
            shared.to_degrees()
        );
        return Err(Error::FitTooFew { what, found: whole, expected: 2 });
    }
    let angle = angles_to(shared);
    let forces =
        |n: usize| -> Vec<f64> { curves.iter().map(|[x, y]| smoothed(x, y, angle[n])).collect() };
    let rows: Vec<_> = (1..angle.len()).map(|n| mean_and_deviation(&forces(n))).collect();
    let mut means = vec![0.0];
    // below zero by noise alone: more is refused before
    means.extend(rows.iter().map(|(mean, _)| mean.max(0.0)));
    let force = rising(&means);
    let deviation: Option<Vec<f64>> = rows.iter().map(|(_, deviation)| *deviation).collect();
    let scatter = deviation.as_ref().map(|deviation| {
        let shares = deviation.iter().zip(&force[1..]).filter(|(_, force)| **force > 0.0);
        let squares: Vec<f64> = shares.map(|(d, force)| (d / force).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    });
    let deviation = deviation.map(|mut deviation| {
        deviation.insert(0, 0.0);
        deviation
    });
    let points: Vec<[f64; 2]> = curves
        .iter()
        .flat_map(|[x, y]| x.iter().zip(y).skip(1).map(|(x, y)| [*x, *y]))
        .filter(|[x, _]| *x <= shared)
        .collect();
    Ok(ShearFit {
        polynomial: polynomial(&points),
        locking: corner(&angle, &force),
        angle,
        force,
        deviation,
        scatter,
        reach,
        remarks,
    })
}

impl ShearFit {
    /// The table as a material has it.
    #[must_use]
    pub fn curve(&self) -> ShearCurve {
        ShearCurve::Table { angle: self.angle.clone(), force: self.force.clone() }
    }
}

/// The angles of a table up to a largest one (rad).
fn angles_to(largest: f64) -> Vec<f64> {
    let whole = (largest / SPACING + 1e-9).floor() as usize;
    let mut angle: Vec<f64> = (0..=whole).map(|n| n as f64 * SPACING).collect();
    if largest > angle[whole] + 0.2 * SPACING {
        angle.push(largest);
    }
    angle
}

/// A table of a curve up to a largest angle (rad): angles, and forces that do not fall.
pub(super) fn table_of(largest: f64, curve: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
    let angle = angles_to(largest);
    let force: Vec<f64> = angle.iter().map(|angle| curve(*angle).max(0.0)).collect();
    (angle, rising(&force))
}

/// The value at an angle of a straight line through the points within half a spacing of it, which takes noise out; between the two
/// points beside it where there are fewer than three.
fn smoothed(x: &[f64], y: &[f64], at: f64) -> f64 {
    let near: Vec<[f64; 2]> = x
        .iter()
        .zip(y)
        .filter(|(x, _)| (**x - at).abs() <= 0.5 * SPACING)
        .map(|(x, y)| [*x - at, *y])
        .collect();
    let both = near.iter().any(|p| p[0] <= 0.0) && near.iter().any(|p| p[0] >= 0.0);
    if near.len() < 3 || !both {
        return between(x, y, at);
    }
    line(&near).map_or_else(|| near[0][1], |(value, _)| value)
}

/// Coefficients of γ, γ², γ³ by least squares, and their standard errors; `None` of fewer than three points.
pub(super) fn polynomial(points: &[[f64; 2]]) -> Option<[[f64; 2]; POWERS]> {
    let rows = points.len();
    if rows < POWERS {
        return None;
    }
    let matrix = DMatrix::from_fn(rows, POWERS, |i, j| points[i][0].powi(j as i32 + 1));
    let right = DVector::from_fn(rows, |i, _| points[i][1]);
    let normal = matrix.transpose() * &matrix;
    let inverse = normal.try_inverse()?;
    let solution = &inverse * (matrix.transpose() * &right);
    let residual = (&matrix * &solution - right).norm_squared();
    let variance = residual / (rows.saturating_sub(POWERS).max(1)) as f64;
    Some(std::array::from_fn(|n| [solution[n], (variance * inverse[(n, n)]).sqrt()]))
}

/// The corner of the two straight lines, one from 0, that are nearest to the table; `None` where the second is not much steeper.
fn corner(x: &[f64], y: &[f64]) -> Option<f64> {
    let mut best: Option<(f64, f64, f64)> = None;
    for k in 2..x.len().checked_sub(2)? {
        // y = a x up to the knot, y = a x + b (x − knot) beyond it
        let knot = x[k];
        let beyond = |x: f64| (x - knot).max(0.0);
        let sum =
            |f: &dyn Fn(f64, f64) -> f64| x.iter().zip(y).map(|(x, y)| f(*x, *y)).sum::<f64>();
        let (xx, xb, bb) =
            (sum(&|x, _| x * x), sum(&|x, _| x * beyond(x)), sum(&|x, _| beyond(x).powi(2)));
        let (xy, by) = (sum(&|x, y| x * y), sum(&|x, y| beyond(x) * y));
        let determinant = xx * bb - xb * xb;
        let (a, b) = ((xy * bb - by * xb) / determinant, (by * xx - xy * xb) / determinant);
        let squares = sum(&|x, y| (y - a * x - b * beyond(x)).powi(2));
        if best.is_none_or(|(least, ..)| squares < least) {
            best = Some((squares, knot, (a + b) / a));
        }
    }
    best.filter(|(_, _, steeper)| *steeper >= STEEPER).map(|(_, knot, _)| knot)
}
