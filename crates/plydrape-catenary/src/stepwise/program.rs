//! A quadratic program in moves of grippers: least squares of linear residuals within linear limits, second-order
//! cones and places that are fixed.
//!
//! `min Σ wᵢ(cᵢ + gᵢ·x)²` over the moves x of all grippers, subject to `g·x ≤ c`, `|B x + d| ≤ c` and `x_g = d_g`.
//! Lengths are in hundredths of a cell here, so that all residuals are of a like size in a scene of any scale; solved by the
//! interior point method of Clarabel (Goulart and Chen 2024). All matrices are sparse.

use super::tuning::TUNING;
use crate::ply::Ply;
use crate::sensitivity::Row;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// The program, as it is put together.
pub struct Program {
    /// The program's units of length in a meter.
    pub scale: f64,
    /// Upper triangle of the normal matrix of the least squares, column by column.
    matrix: Vec<Row>,
    linear: Vec<f64>,
    bounds: Vec<Bound>,
    fixed: Vec<(usize, f64)>,
    cones: Vec<Cone>,
}

/// g·x ≤ c.
struct Bound {
    gradient: Row,
    bound: f64,
}

/// |Σ sign·x_gripper + offset| ≤ radius.
struct Cone {
    grippers: Vec<(usize, f64)>,
    offset: [f64; 3],
    radius: f64,
}

impl Program {
    /// An empty program for `grippers` grippers of a ply.
    pub fn new(ply: &Ply, grippers: usize) -> Self {
        let size = 3 * grippers;
        Program {
            scale: 1.0 / (TUNING.program_unit * ply.shorter_side()),
            matrix: vec![Row::default(); size],
            linear: vec![0.0; size],
            bounds: Vec::new(),
            fixed: Vec::new(),
            cones: Vec::new(),
        }
    }

    /// Adds `weight (value + gradient·x)²` to the objective.
    pub fn square(&mut self, weight: f64, value: f64, gradient: &Row) {
        if !(weight > 0.0 && value.is_finite() && gradient.is_finite()) {
            return;
        }
        for (n, (column, g)) in gradient.entries().enumerate() {
            self.linear[column] += 2.0 * weight * value * g;
            self.matrix[column].add_first(n + 1, 2.0 * weight * g, gradient);
        }
    }

    /// Adds `weight (x_n − value)²` to the objective.
    pub fn near(&mut self, weight: f64, n: usize, value: f64) {
        self.linear[n] -= 2.0 * weight * value;
        self.matrix[n].add_at(n, 2.0 * weight);
    }

    /// Demands gradient·x ≤ bound.
    pub fn at_most(&mut self, gradient: &Row, factor: f64, bound: f64) {
        if bound.is_finite() && gradient.is_finite() && gradient.count() > 0 {
            let mut gradient = gradient.clone();
            gradient.scale(factor);
            self.bounds.push(Bound { gradient, bound });
        }
    }

    /// Fixes the move of a gripper (units).
    pub fn fix(&mut self, gripper: usize, value: [f64; 3]) {
        self.fixed.extend((0..3).map(|n| (3 * gripper + n, value[n])));
    }

    /// Demands |Σ sign·x_gripper + offset| ≤ radius.
    pub fn cone(&mut self, grippers: Vec<(usize, f64)>, offset: [f64; 3], radius: f64) {
        self.cones.push(Cone { grippers, offset, radius });
    }

    /// Numbers that its matrices hold.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        let bounds = self.bounds.iter().map(|bound| bound.gradient.count());
        let cones = self.cones.iter().map(|cone| 3 * cone.grippers.len());
        let matrix = self.matrix.iter().map(Row::count);
        matrix.chain(bounds).chain(cones).sum::<usize>() + self.fixed.len()
    }

    /// The best moves (units); `None` if there are none within the limits.
    pub fn solve(&self) -> Option<Vec<f64>> {
        let count = self.fixed.len() + self.bounds.len() + 4 * self.cones.len();
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
        for Bound { gradient, bound } in &self.bounds {
            for (n, g) in gradient.entries() {
                put(b.len(), n, g);
            }
            b.push(*bound);
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
            SupportedConeT::NonnegativeConeT(self.bounds.len()),
        ];
        cones.extend(self.cones.iter().map(|_| SupportedConeT::SecondOrderConeT(4)));
        let a = CscMatrix::new_from_triplets(count, self.linear.len(), i, j, v);
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
        for column in &self.matrix {
            for (row, value) in column.entries() {
                rows.push(row);
                values.push(value);
            }
            starts.push(rows.len());
        }
        CscMatrix::new(self.linear.len(), self.linear.len(), starts, rows, values)
    }
}
