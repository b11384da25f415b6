//! A quadratic program in moves of grippers: least squares of linear residuals within linear limits, second-order
//! cones and places that are fixed.
//!
//! `min Σ wᵢ(cᵢ + gᵢ·x)²` over the moves x of all grippers, subject to `g·x ≤ c`, `|B x + d| ≤ c` and `x_g = d_g`.
//! Lengths are in millimetres here, so that all residuals are of a like size; solved by the interior point
//! method of Clarabel (Goulart and Chen 2024).

use super::tuning::TUNING;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// Millimetres in a metre: the program's unit of length.
pub const MM: f64 = 1e3;

/// The program, as it is put together.
pub struct Program {
    size: usize,
    /// Normal matrix of the least squares, row by row.
    matrix: Vec<f64>,
    linear: Vec<f64>,
    rows: Vec<Row>,
    fixed: Vec<(usize, f64)>,
    cones: Vec<Cone>,
}

/// g·x ≤ c.
struct Row {
    gradient: Vec<(usize, f64)>,
    bound: f64,
}

/// |Σ sign·x_gripper + offset| ≤ radius.
struct Cone {
    grippers: Vec<(usize, f64)>,
    offset: [f64; 3],
    radius: f64,
}

impl Program {
    /// An empty program for `grippers` grippers.
    pub fn new(grippers: usize) -> Self {
        let size = 3 * grippers;
        Program {
            size,
            matrix: vec![0.0; size * size],
            linear: vec![0.0; size],
            rows: Vec::new(),
            fixed: Vec::new(),
            cones: Vec::new(),
        }
    }

    /// Adds `weight (value + gradient·x)²` to the objective.
    pub fn square(&mut self, weight: f64, value: f64, gradient: &[f64]) {
        if !(weight > 0.0 && value.is_finite() && gradient.iter().all(|g| g.is_finite())) {
            return;
        }
        let places: Vec<usize> = (0..self.size).filter(|n| gradient[*n] != 0.0).collect();
        for &i in &places {
            self.linear[i] += 2.0 * weight * value * gradient[i];
            for &j in &places {
                self.matrix[i * self.size + j] += 2.0 * weight * gradient[i] * gradient[j];
            }
        }
    }

    /// Adds `weight (x_n − value)²` to the objective.
    pub fn near(&mut self, weight: f64, n: usize, value: f64) {
        self.linear[n] -= 2.0 * weight * value;
        self.matrix[n * self.size + n] += 2.0 * weight;
    }

    /// Demands gradient·x ≤ bound.
    pub fn at_most(&mut self, gradient: &[f64], factor: f64, bound: f64) {
        let gradient: Vec<(usize, f64)> = gradient
            .iter()
            .enumerate()
            .filter(|(_, g)| **g != 0.0)
            .map(|(n, g)| (n, factor * g))
            .collect();
        if bound.is_finite() && gradient.iter().all(|(_, g)| g.is_finite()) && !gradient.is_empty()
        {
            self.rows.push(Row { gradient, bound });
        }
    }

    /// Fixes the move of a gripper (mm).
    pub fn fix(&mut self, gripper: usize, value: [f64; 3]) {
        self.fixed.extend((0..3).map(|n| (3 * gripper + n, value[n])));
    }

    /// Demands |Σ sign·x_gripper + offset| ≤ radius.
    pub fn cone(&mut self, grippers: Vec<(usize, f64)>, offset: [f64; 3], radius: f64) {
        self.cones.push(Cone { grippers, offset, radius });
    }

    /// The best moves (mm); none if there are none within the limits.
    pub fn solve(&self) -> Option<Vec<f64>> {
        let count = self.fixed.len() + self.rows.len() + 4 * self.cones.len();
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        let mut b = Vec::with_capacity(count);
        let mut put = |row: usize, column: usize, value: f64| {
            i.push(row);
            j.push(column);
            v.push(value);
        };
        for (n, value) in &self.fixed {
            put(b.len(), *n, 1.0);
            b.push(*value);
        }
        for row in &self.rows {
            for (n, g) in &row.gradient {
                put(b.len(), *n, *g);
            }
            b.push(row.bound);
        }
        // s = b − A x must lie in (radius, vector)
        for cone in &self.cones {
            b.push(cone.radius);
            for axis in 0..3 {
                for (gripper, sign) in &cone.grippers {
                    put(b.len(), 3 * gripper + axis, -sign);
                }
                b.push(cone.offset[axis]);
            }
        }
        let mut cones = vec![
            SupportedConeT::ZeroConeT(self.fixed.len()),
            SupportedConeT::NonnegativeConeT(self.rows.len()),
        ];
        cones.extend(self.cones.iter().map(|_| SupportedConeT::SecondOrderConeT(4)));
        let a = CscMatrix::new_from_triplets(count, self.size, i, j, v);
        let settings = DefaultSettings {
            verbose: false,
            max_iter: TUNING.program_iterations,
            max_threads: 1,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let objective = self.objective();
        let mut solver =
            DefaultSolver::new(&objective, &self.linear, &a, &b, &cones, settings).ok()?;
        solver.solve();
        let good =
            matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        (good && solver.solution.x.iter().all(|x| x.is_finite())).then(|| solver.solution.x.clone())
    }

    /// The upper triangle of the normal matrix.
    fn objective(&self) -> CscMatrix<f64> {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for column in 0..self.size {
            for row in 0..=column {
                let value = self.matrix[row * self.size + column];
                if value != 0.0 || row == column {
                    rows.push(row);
                    values.push(value);
                }
            }
            starts.push(rows.len());
        }
        CscMatrix::new(self.size, self.size, starts, rows, values)
    }
}
