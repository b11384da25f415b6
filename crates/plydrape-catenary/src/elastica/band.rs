//! A band matrix and its LU factorization with row exchanges: that of a strip in compression is not positive.

/// A square matrix whose entries are at most `half` places beside the diagonal.
#[derive(Debug, Clone)]
pub(super) struct Band {
    size: usize,
    half: usize,
    /// Rows from `half` before to twice `half` behind the diagonal: exchanges fill the last `half`.
    entries: Vec<f64>,
    exchanged: Vec<usize>,
}

impl Band {
    pub fn new(size: usize, half: usize) -> Band {
        let entries = vec![0.0; size * (3 * half + 1)];
        Band { size, half, entries, exchanged: vec![0; size] }
    }

    fn place(&self, row: usize, column: usize) -> usize {
        row * (3 * self.half + 1) + column + self.half - row
    }

    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    pub fn add(&mut self, row: usize, column: usize, x: f64) {
        let place = self.place(row, column);
        self.entries[place] += x;
    }

    /// Makes a row that of the identity, and the column too.
    pub fn fix(&mut self, n: usize) {
        for k in n.saturating_sub(self.half)..(n + self.half + 1).min(self.size) {
            let (row, column) = (self.place(n, k), self.place(k, n));
            self.entries[row] = 0.0;
            self.entries[column] = 0.0;
        }
        let place = self.place(n, n);
        self.entries[place] = 1.0;
    }

    /// Replaces the matrix by its factors; false where it is singular.
    pub fn factorize(&mut self) -> bool {
        for pivot in 0..self.size {
            // the largest entry of the column becomes the pivot
            let below = (pivot + self.half + 1).min(self.size);
            let end = (pivot + 2 * self.half + 1).min(self.size);
            let size = |row: usize| self.entries[self.place(row, pivot)].abs();
            let best = (pivot..below).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(pivot);
            self.exchanged[pivot] = best;
            if best != pivot {
                for column in pivot..end {
                    let (a, b) = (self.place(pivot, column), self.place(best, column));
                    self.entries.swap(a, b);
                }
            }

            // no pivot: the matrix is singular
            let diagonal = self.entries[self.place(pivot, pivot)];
            if diagonal == 0.0 || !diagonal.is_finite() {
                return false;
            }

            // the column is eliminated from the rows below, and its places keep the factors
            for row in pivot + 1..below {
                let entry = self.place(row, pivot);
                let factor = self.entries[entry] / diagonal;
                self.entries[entry] = factor;
                if factor != 0.0 {
                    for column in pivot + 1..end {
                        let (from, to) = (self.place(pivot, column), self.place(row, column));
                        self.entries[to] -= factor * self.entries[from];
                    }
                }
            }
        }
        true
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, x: &mut [f64]) {
        for pivot in 0..self.size {
            x.swap(pivot, self.exchanged[pivot]);
            for row in pivot + 1..(pivot + self.half + 1).min(self.size) {
                x[row] -= self.entries[self.place(row, pivot)] * x[pivot];
            }
        }
        for row in (0..self.size).rev() {
            let end = (row + 2 * self.half + 1).min(self.size);
            let sum: f64 = (row + 1..end).map(|k| self.entries[self.place(row, k)] * x[k]).sum();
            x[row] = (x[row] - sum) / self.entries[self.place(row, row)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band matrix with a small diagonal times its solution is the right side; a singular one is refused.
    #[test]
    fn the_factors_solve_a_matrix_that_needs_exchanges() {
        let (size, half) = (23, 4);
        let entry = |i: usize, j: usize| {
            ((7 * i + 3 * j * j) % 11) as f64 / 11.0 - if i == j { 0.9 } else { 0.4 }
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
            assert!((found - x).abs() < 1e-11, "{found} {x}");
        }
        let mut singular = Band::new(2, 1);
        (0..4).for_each(|n| singular.add(n / 2, n % 2, 1.0));
        assert!(!singular.factorize());
    }
}
