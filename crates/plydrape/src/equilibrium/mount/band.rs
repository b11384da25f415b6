//! A band matrix and its LU factorization without pivots, for the pads' stiffness: nearly symmetric and, where the ply is
//! stable on its mounts, positive.

/// A square matrix whose entries are at most so many places beside the diagonal.
#[derive(Debug, Clone, Default)]
pub(super) struct Band {
    size: usize,
    half: usize,
    entries: Vec<f64>,
}

impl Band {
    pub fn new(size: usize, half: usize) -> Band {
        let half = half.min(size.saturating_sub(1));
        Band { size, half, entries: vec![0.0; size * (2 * half + 1)] }
    }

    fn place(&self, row: usize, column: usize) -> usize {
        row * (2 * self.half + 1) + column + self.half - row
    }

    /// Adds to an entry; those beside the band are left out.
    pub fn add(&mut self, row: usize, column: usize, x: f64) {
        if row.abs_diff(column) <= self.half {
            let place = self.place(row, column);
            self.entries[place] += x;
        }
    }

    /// Sum of the sizes of the entries of each row.
    pub fn row_sums(&self) -> Vec<f64> {
        let rows = self.entries.chunks(2 * self.half + 1);
        rows.map(|row| row.iter().map(|x| x.abs()).sum()).collect()
    }

    /// Largest entry of the diagonal.
    fn largest_diagonal(&self) -> f64 {
        (0..self.size).map(|n| self.entries[self.place(n, n)].abs()).fold(0.0, f64::max)
    }

    /// Replaces the matrix by its factors; false where a pivot is not above zero.
    pub fn factorize(&mut self) -> bool {
        let least = f64::EPSILON * self.largest_diagonal();
        for pivot in 0..self.size {
            let diagonal = self.entries[self.place(pivot, pivot)];
            if diagonal.is_nan() || diagonal <= least {
                return false;
            }
            let end = (pivot + self.half + 1).min(self.size);
            for row in pivot + 1..end {
                let at = self.place(row, pivot);
                let factor = self.entries[at] / diagonal;
                self.entries[at] = factor;
                if factor == 0.0 {
                    continue;
                }
                let (from, to) = (self.place(pivot, pivot + 1), self.place(row, pivot + 1));
                for k in 0..end - pivot - 1 {
                    self.entries[to + k] -= factor * self.entries[from + k];
                }
            }
        }
        true
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, x: &mut [f64]) {
        for row in 0..self.size {
            let first = row.saturating_sub(self.half);
            let sum: f64 = (first..row).map(|k| self.entries[self.place(row, k)] * x[k]).sum();
            x[row] -= sum;
        }
        for row in (0..self.size).rev() {
            let end = (row + self.half + 1).min(self.size);
            let sum: f64 = (row + 1..end).map(|k| self.entries[self.place(row, k)] * x[k]).sum();
            x[row] = (x[row] - sum) / self.entries[self.place(row, row)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band matrix with a heavy diagonal times its solution is the right side; a singular one is refused.
    #[test]
    fn the_factors_solve_the_matrix_that_they_are_of() {
        let (size, half) = (23, 4);
        let entry = |i: usize, j: usize| {
            let x = ((7 * i + 3 * j) % 11) as f64 / 11.0 - 0.4;
            if i == j { 6.0 + x } else { x }
        };
        let mut band = Band::new(size, half);
        let x: Vec<f64> = (0..size).map(|n| (n as f64).sin()).collect();
        let mut right = vec![0.0; size];
        for i in 0..size {
            for j in i.saturating_sub(half)..(i + half + 1).min(size) {
                band.add(i, j, entry(i, j));
                right[i] += entry(i, j) * x[j];
            }
        }
        assert!(band.factorize());
        band.solve(&mut right);
        for (found, x) in right.iter().zip(&x) {
            assert!((found - x).abs() < 1e-13);
        }
        let mut singular = Band::new(2, 1);
        (0..4).for_each(|n| singular.add(n / 2, n % 2, 1.0));
        assert!(!singular.factorize());
    }
}
