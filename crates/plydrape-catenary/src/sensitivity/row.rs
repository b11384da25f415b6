//! A sparse row: the numbers of a long row that are not zero, with their places.

/// Numbers at places, in the order of the places; all others are zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Row {
    entries: Vec<(u32, f64)>,
}

impl Row {
    /// All numbers up to a width.
    #[must_use]
    pub fn dense(&self, width: usize) -> Vec<f64> {
        let mut out = vec![0.0; width];
        self.entries().for_each(|(place, x)| out[place] = x);
        out
    }

    /// What is not zero, each with its place, in ascending order.
    pub fn entries(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.entries.iter().map(|(place, x)| (*place as usize, *x))
    }

    /// How many numbers it holds.
    #[must_use]
    pub fn count(&self) -> usize {
        self.entries.len()
    }

    /// The number at a place.
    #[must_use]
    pub fn value_at(&self, place: usize) -> f64 {
        let found = self.entries.binary_search_by_key(&(place as u32), |(place, _)| *place);
        found.map_or(0.0, |n| self.entries[n].1)
    }

    /// Adds a number at a place.
    pub fn add_at(&mut self, place: usize, x: f64) {
        let place = place as u32;
        match self.entries.binary_search_by_key(&place, |(place, _)| *place) {
            Ok(n) => self.entries[n].1 += x,
            Err(_) if x == 0.0 => {}
            Err(n) => self.entries.insert(n, (place, x)),
        }
    }

    /// Adds the numbers of a vector from a place on.
    pub fn add_from(&mut self, place: usize, factor: f64, x: [f64; 3]) {
        (0..3).for_each(|n| self.add_at(place + n, factor * x[n]));
    }

    /// Adds `factor` times another row.
    pub fn add(&mut self, factor: f64, other: &Row) {
        self.add_first(other.count(), factor, other);
    }

    /// Adds `factor` times the first `count` numbers of another row.
    pub fn add_first(&mut self, count: usize, factor: f64, other: &Row) {
        let others = &other.entries[..count];
        if factor == 0.0 || others.is_empty() {
            return;
        }
        let before = std::mem::take(&mut self.entries);
        self.entries.reserve(before.len() + count);
        let mut left = before.into_iter().peekable();
        for (place, x) in others {
            while let Some(entry) = left.next_if(|(at, _)| at < place) {
                self.entries.push(entry);
            }
            let here = left.next_if(|(at, _)| at == place).map_or(0.0, |(_, here)| here);
            self.entries.push((*place, here + factor * x));
        }
        self.entries.extend(left);
    }

    /// Multiplies all numbers.
    pub fn scale(&mut self, factor: f64) {
        self.entries.iter_mut().for_each(|(_, x)| *x *= factor);
    }

    /// Product with a vector.
    #[must_use]
    pub fn dot(&self, x: &[f64]) -> f64 {
        self.entries().map(|(place, y)| y * x[place]).sum()
    }

    /// The largest size of a number.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.entries.iter().fold(0.0, |most, (_, x)| x.abs().max(most))
    }

    /// Leaves out numbers smaller than a share of the largest.
    pub fn trim(&mut self, share: f64) {
        let least = share * self.largest();
        self.entries.retain(|(_, x)| x.is_nan() || x.abs() >= least && *x != 0.0);
        self.entries.shrink_to_fit();
    }

    /// Whether all numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.entries.iter().all(|(_, x)| x.is_finite())
    }
}

/// From numbers at ascending places.
impl FromIterator<(usize, f64)> for Row {
    fn from_iter<I: IntoIterator<Item = (usize, f64)>>(entries: I) -> Self {
        Row { entries: entries.into_iter().map(|(place, x)| (place as u32, x)).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums and products are those of the same rows with all their zeros.
    #[test]
    fn sparse_rows_add_and_multiply_as_dense_ones() {
        let [a, b] = [[0.0, 2.0, 0.0, -1.0, 0.5], [3.0, 0.0, 0.0, 4.0, 0.0]];
        let sparse = |dense: &[f64]| -> Row {
            dense.iter().copied().enumerate().filter(|(_, x)| *x != 0.0).collect()
        };
        let mut sum = sparse(&a);
        sum.add(0.5, &sparse(&b));
        assert_eq!(sum.dense(5), [1.5, 2.0, 0.0, 1.0, 0.5]);
        assert_eq!((sum.count(), sum.value_at(2), sum.value_at(3)), (4, 0.0, 1.0));
        sum.add_from(1, 2.0, [1.0, 0.0, 1.0]);
        sum.scale(2.0);
        assert_eq!(sum.dense(5), [3.0, 8.0, 0.0, 6.0, 1.0]);
        assert_eq!(sum.dot(&[1.0, 1.0, 9.0, -1.0, 2.0]), 7.0);
        sum.trim(0.5);
        assert_eq!(sum.dense(5), [0.0, 8.0, 0.0, 6.0, 0.0]);
        assert_eq!(sparse(&sum.dense(5)), sum);
    }
}
