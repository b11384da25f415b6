//! Which part of a machine's record is the test.
//!
//! A machine records more than the loading of a specimen: how it runs back, how the specimen slips out of its clamp or tears, and the zero
//! of a load cell that nobody set. A law comes from the loading alone. What ends it is said, and what no specimen does is refused.

use super::statistics::line;
use crate::error::PointFault;
use std::ops::Range;

/// A way back that is noise, as a share of the range of a record.
const TURN: f64 = 0.01;
/// A fall of the force behind its peak that ends a test, as a share of the peak.
const FALL: f64 = 0.05;
/// Windows of the running median in a record.
const WINDOWS: usize = 50;
/// Points of a window that are enough, however many there are.
const WIDEST: usize = 101;
/// Fewest points of a loading.
const FEWEST: usize = 3;
/// What is noise of a force whatever its scatter, as a share of the largest.
const LEAST: f64 = 0.01;
/// How many standard deviations of its scatter a force may be off.
const DEVIATIONS: f64 = 5.0;
/// A few first values may be below zero by this share of the largest force.
const START: (usize, f64) = (3, 0.02);
/// Force that is not zero where the test begins, as a share of the largest: at a displacement of zero, where it is refused, and by the straight
/// line through the first points, where it is reported.
const ZERO: [f64; 2] = [0.1, 0.05];
/// A first displacement that is far from zero: in distances of the points, and as a share of the last one.
const LATE: [f64; 2] = [3.0, 0.1];

/// What is to be known of a record beside its law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remark {
    /// Points from the first to the last index are left out: the force has fallen from its peak.
    AfterPeak {
        /// First and last point.
        points: [usize; 2],
        /// The peak of the force, or of the moment per width (N).
        peak: f64,
    },
    /// Points from the first to the last index are left out: the machine runs back.
    Unloading {
        /// First and last point.
        points: [usize; 2],
    },
    /// Points from the first to the last index are left out: they are beyond the largest shear of a trellis.
    BeyondTrellis {
        /// First and last point.
        points: [usize; 2],
    },
    /// Points from the first to the last index are left out: beyond this shear angle the shear force falls, though the force does not.
    BeyondShear {
        /// First and last point.
        points: [usize; 2],
        /// The shear angle (rad).
        angle: f64,
    },
    /// The mean moment of a loop has fallen from its peak: points beyond this curvature are left out.
    BeyondPeak {
        /// The curvature (1/m).
        curvature: f64,
    },
    /// The record begins far from zero.
    BeginsLate {
        /// The first displacement (m) or curvature (1/m).
        first: f64,
    },
    /// By its first points the record has a load before anything is deformed.
    LoadAtRest {
        /// The force, or the moment per width (N).
        load: f64,
    },
}

/// The loading in a record: its points, and what is to be known of them.
pub(super) struct Loading {
    pub points: Range<usize>,
    pub remarks: Vec<Remark>,
}

/// Finds the loading in a record of displacement and force, or of curvature and moment, in the order of time.
///
/// # Errors
/// What no specimen does, at the index of its point.
pub(super) fn loading(points: &[[f64; 2]]) -> Result<Loading, (usize, PointFault)> {
    if points.is_empty() {
        return Ok(Loading { points: 0..0, remarks: Vec::new() });
    }
    let (end, mut remarks) = forth(points)?;
    let forces: Vec<f64> = points[..end].iter().map(|point| point[1]).collect();
    let below = |n: &usize| forces[*n] < 0.0;
    let first_below = || (0..end).find(below).unwrap_or(0);
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let smallest = forces.iter().copied().fold(0.0, f64::min);
    if -smallest > largest {
        return Err((first_below(), PointFault::BelowZero));
    }

    // up to the first fall that is more than noise, which of many points is seen in their running median
    let deviation = scatter(&forces);
    let noise = DEVIATIONS * deviation;
    let calm = medians(&forces, (forces.len() / WINDOWS).min(WIDEST));
    let (mut peak, mut stop) = (0, end);
    for (n, force) in calm.iter().copied().enumerate() {
        let highest = calm[peak].max(0.0);
        let fall = highest - force;
        if highest > START.1 * largest && fall > noise.max(LEAST * largest).max(FALL * highest) {
            let last = (peak..n).max_by(|a, b| forces[*a].total_cmp(&forces[*b]));
            let last = last.unwrap_or(peak);
            stop = last + 1;
            if stop < FEWEST {
                return Err((n, PointFault::FallsEarly));
            }
            let (points, peak) = ([stop, end - 1], forces[last]);
            remarks.insert(0, Remark::AfterPeak { points, peak });
            break;
        }
        if -force > noise && (n >= START.0 || -force > START.1 * largest) {
            return Err((first_below(), PointFault::BelowZero));
        }
        if force > calm[peak] {
            peak = n;
        }
    }

    let loading = &points[..stop];
    let last = loading.last().map_or(0.0, |point| point[0]);
    let highest = forces[..stop].iter().copied().fold(0.0, f64::max);
    let at_rest = |n: &usize| loading[*n][0].abs() <= 0.1 * TURN * last;
    if let Some(n) = (0..stop).filter(at_rest).find(|n| forces[*n] > (ZERO[0] * highest).max(noise))
    {
        return Err((n, PointFault::NotZero));
    }
    remarks.extend(begins_late(loading));
    remarks.extend(load_at_rest(loading, (ZERO[1] * highest).max(2.0 * deviation)));
    Ok(Loading { points: 0..stop, remarks })
}

/// The index of the peak of loads that have fallen from it at their end, by more than noise; `None` where they have not.
pub(super) fn peak_before_end(loads: &[f64]) -> Option<usize> {
    let calm = medians(loads, (loads.len() / WINDOWS).min(WIDEST));
    let peak = (0..calm.len()).max_by(|a, b| calm[*a].total_cmp(&calm[*b]))?;
    let fall = calm[peak] - calm.last()?;
    (fall > (FALL * calm[peak]).max(DEVIATIONS * scatter(loads))).then_some(peak)
}

/// The end of the way forth, and that of the points behind it.
fn forth(points: &[[f64; 2]]) -> Result<(usize, Vec<Remark>), (usize, PointFault)> {
    let way: Vec<f64> = points.iter().map(|point| point[0]).collect();
    let most = way.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = way.iter().copied().fold(f64::INFINITY, f64::min);
    // a way that returns by less than this is noise of the machine
    let noise = TURN * (most - least);
    if let Some(n) = way.iter().position(|x| *x < -noise) {
        return Err((n, PointFault::Backwards));
    }
    // the way rises up to its turn …
    let turn = way.iter().position(|x| *x == most).unwrap_or(0);
    if turn == 0 && most > least {
        return Err((1, PointFault::Falls));
    }
    let mut highest = f64::NEG_INFINITY;
    for (n, x) in way[..turn].iter().enumerate() {
        if *x < highest - noise {
            return Err((n, PointFault::Returns));
        }
        highest = highest.max(*x);
    }
    // … and falls behind it, if the specimen was unloaded
    let mut lowest = turn;
    for (n, x) in way.iter().enumerate().skip(turn) {
        if *x > way[lowest] + noise {
            return Err((lowest, PointFault::Returns));
        }
        if *x < way[lowest] {
            lowest = n;
        }
    }
    if way[lowest] < most - noise {
        let points = [turn + 1, way.len() - 1];
        return Ok((turn + 1, vec![Remark::Unloading { points }]));
    }
    Ok((way.len(), Vec::new()))
}

/// Standard deviation of the noise of values, by their third differences, in which a smooth course has no part.
fn scatter(values: &[f64]) -> f64 {
    let mut differences: Vec<f64> =
        values.windows(4).map(|v| (v[3] - 3.0 * v[2] + 3.0 * v[1] - v[0]).abs()).collect();
    if differences.is_empty() {
        return 0.0;
    }
    differences.sort_by(f64::total_cmp);
    // of noise the third difference has 1 + 9 + 9 + 1 times the variance, and the median of its size is 0.6745 of its deviation
    differences[differences.len() / 2] / (0.6745 * 20.0_f64.sqrt())
}

/// The median of the values around each, as many to both sides; the values themselves where the window is of less than three.
fn medians(values: &[f64], window: usize) -> Vec<f64> {
    let half = window / 2;
    let around = |n: usize| {
        let side = half.min(n).min(values.len() - 1 - n);
        let mut near = values[n - side..=n + side].to_vec();
        near.sort_by(f64::total_cmp);
        near[side]
    };
    (0..values.len()).map(around).collect()
}

fn begins_late(points: &[[f64; 2]]) -> Option<Remark> {
    let [first, last] = [points.first()?[0], points.last()?[0]];
    let spacing = (last - first) / (points.len() - 1) as f64;
    (first > LATE[0] * spacing && first > LATE[1] * last).then_some(Remark::BeginsLate { first })
}

/// The load before anything is deformed, by the straight line through the first points.
fn load_at_rest(points: &[[f64; 2]], least: f64) -> Option<Remark> {
    let first = points.get(..FEWEST.max(points.len() / WINDOWS))?;
    let (load, _) = line(first)?;
    let mean = first.iter().map(|point| point[1]).sum::<f64>() / first.len() as f64;
    (load > least && mean > least).then_some(Remark::LoadAtRest { load })
}
