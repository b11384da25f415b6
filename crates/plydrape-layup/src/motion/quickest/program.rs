//! One convex program for the pace: the least time under the bounds, with the bounds of the third derivative as tangents.
//!
//! Unknowns are the control values of b, and for each part a c and a d with `c² ≤ b` and `c d ≥ 1` in its middle, so that d is at
//! least 1/√b. All bounds are second-order cones, solved by Clarabel's interior point method.
//!
//! Grippers of an array move much alike: at each time the bound that is nearest to its limit is in the program, and others once a
//! solution passes them.

use super::super::tuning::TUNING;
use super::Moving;
use super::pace::{Jet, Pace};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

pub(super) struct Program<'a> {
    times: &'a [f64],
    moving: &'a [Moving],
    /// For each time which second and third derivatives are bounded: of whom, and the order.
    met: Vec<Vec<(usize, usize)>>,
}

impl<'a> Program<'a> {
    pub fn new(times: &'a [f64], moving: &'a [Moving]) -> Self {
        Program { times, moving, met: vec![Vec::new(); times.len()] }
    }

    /// Puts in, of each time and order, the bound that is nearest to its limit at a pace, if there is none yet or it is passed.
    pub fn meet(&mut self, pace: &Pace) {
        for (n, t) in self.times.iter().enumerate() {
            let jet = pace.jet_at(*t);
            let shares: Vec<[f64; 3]> = self.moving.iter().map(|one| one.shares(&jet, n)).collect();
            for order in [1, 2] {
                let bounded =
                    (0..shares.len()).filter(|k| self.moving[*k].bounds_at(n)[order].is_finite());
                let by_share =
                    |a: &usize, b: &usize| shares[*a][order].total_cmp(&shares[*b][order]);
                let Some(nearest) = bounded.max_by(by_share) else { continue };
                let met = &mut self.met[n];
                let passed = shares[nearest][order] > 1.0 + TUNING.tolerance;
                let another = !met.contains(&(nearest, order));
                if another && (passed || met.iter().all(|(_, other)| *other != order)) {
                    met.push((nearest, order));
                }
            }
        }
    }

    /// The pace of the least time, with the tangents at a pace; none if no solver finds it.
    pub fn solve(&self, pace: &Pace) -> Option<Pace> {
        let values = pace.values.len();
        let parts: Vec<(f64, f64)> = pace.parts().collect();
        let count = values + 2 * parts.len();
        let [c, d] = [values, values + parts.len()];
        let mut rows = Rows::default();

        // steady in the first and in the last part: a motion that begins with a cube of time tells a pace by its third derivative only
        for first in [0, 1, values - 3, values - 2] {
            rows.put(0.0, &[(first, 1.0), (first + 1, -1.0)]);
        }
        let equal = rows.limits.len();
        // the pace is positive, and no first derivative passes its bound
        for value in 0..values {
            rows.at_least(0.0, &[(value, 1.0)]);
        }
        for (n, t) in self.times.iter().enumerate() {
            let part = pace.part(*t);
            let share = |one: &Moving| {
                let [speed, ..] = one.shares(&ONE, n);
                speed * speed
            };
            let most = self.moving.iter().map(share).fold(0.0, f64::max);
            if most > 0.0 {
                let [value, ..] = pace.weights(part, *t);
                rows.at_least(-1.0, &spread(part, value, -most));
            }
        }
        let positive = rows.limits.len() - equal;

        for (part, (begin, end)) in parts.iter().enumerate() {
            let [value, ..] = pace.weights(part, 0.5 * (begin + end));
            // |(b − 1, 2c)| ≤ b + 1 and |(c − d, 2)| ≤ c + d
            rows.put(1.0, &spread(part, value, 1.0));
            rows.put(-1.0, &spread(part, value, 1.0));
            rows.put(0.0, &[(c + part, 2.0)]);
            rows.put(0.0, &[(c + part, 1.0), (d + part, 1.0)]);
            rows.put(0.0, &[(c + part, 1.0), (d + part, -1.0)]);
            rows.put(2.0, &[]);
        }
        let small = (rows.limits.len() - equal - positive) / 3;

        for (n, t) in self.times.iter().enumerate() {
            let part = pace.part(*t);
            let [value, slope, curvature] = pace.weights(part, *t);
            let now = pace.jet_at(*t).value;
            for (k, order) in &self.met[n] {
                let one = &self.moving[*k];
                let [first, second, third] = one.rates[n];
                let bound = one.bounds_at(n)[*order];
                let weights = |axis: usize| match order {
                    1 => [0, 1, 2].map(|m| second[axis] * value[m] + 0.5 * first[axis] * slope[m]),
                    _ => [0, 1, 2].map(|m| {
                        third[axis] * value[m]
                            + 1.5 * second[axis] * slope[m]
                            + 0.5 * first[axis] * curvature[m]
                    }),
                };
                match order {
                    1 => rows.put(1.0, &[]),
                    // the tangent of 1/√b
                    _ => {
                        let root = now.sqrt();
                        rows.put(1.5 / root, &spread(part, value, -0.5 / (now * root)));
                    }
                }
                for axis in 0..3 {
                    rows.put(0.0, &spread(part, weights(axis), 1.0 / bound));
                }
            }
        }

        let mut cones =
            vec![SupportedConeT::ZeroConeT(equal), SupportedConeT::NonnegativeConeT(positive)];
        cones.extend((0..small).map(|_| SupportedConeT::SecondOrderConeT(3)));
        let large = (rows.limits.len() - equal - positive - 3 * small) / 4;
        cones.extend((0..large).map(|_| SupportedConeT::SecondOrderConeT(4)));
        let mut goal = vec![0.0; count];
        let whole: f64 = parts.iter().map(|(begin, end)| end - begin).sum();
        for (part, (begin, end)) in parts.iter().enumerate() {
            goal[d + part] = (end - begin) / whole;
        }
        let Rows { rows, columns, values: entries, limits } = rows;
        let matrix = CscMatrix::new_from_triplets(limits.len(), count, rows, columns, entries);
        let settings = DefaultSettings {
            verbose: false,
            max_iter: TUNING.pace_iterations,
            tol_gap_abs: TUNING.pace_tolerance,
            tol_gap_rel: TUNING.pace_tolerance,
            tol_feas: TUNING.pace_tolerance,
            max_threads: 1,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let none = CscMatrix::zeros((count, count));
        let mut solver =
            DefaultSolver::new(&none, &goal, &matrix, &limits, &cones, settings).ok()?;
        solver.solve();
        let good =
            matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        let found = solver.solution.x.get(..values)?.to_vec();
        let found = pace.with(found);
        let moves =
            self.times.iter().all(|t| found.jet_at(*t).value > 0.0) && found.time().is_finite();
        (good && moves).then_some(found)
    }
}

/// A steady pace.
const ONE: Jet = Jet { value: 1.0, slope: 0.0, curvature: 0.0 };

/// The three control values of a part with their weights.
fn spread(part: usize, weights: [f64; 3], factor: f64) -> [(usize, f64); 3] {
    [0, 1, 2].map(|k| (part + k, factor * weights[k]))
}

/// Rows `s = limit − A x` of cones, as they are put together.
#[derive(Default)]
struct Rows {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    limits: Vec<f64>,
}

impl Rows {
    /// A row with s = constant + Σ weight x.
    fn put(&mut self, constant: f64, weights: &[(usize, f64)]) {
        for (column, weight) in weights {
            self.rows.push(self.limits.len());
            self.columns.push(*column);
            self.values.push(-weight);
        }
        self.limits.push(constant);
    }

    /// A row that demands Σ weight x ≥ least.
    fn at_least(&mut self, least: f64, weights: &[(usize, f64)]) {
        self.put(-least, weights);
    }
}
