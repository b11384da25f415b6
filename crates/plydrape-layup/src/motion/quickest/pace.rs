//! The square of the pace, b(τ): a spline of parabolas over the time of a motion.

/// b with its derivatives at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jet {
    pub value: f64,
    pub slope: f64,
    pub curvature: f64,
}

/// A spline of parabolas with as many control values as parts, and two.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pace {
    /// Ends of the parts (s), ascending.
    ends: Vec<f64>,
    pub values: Vec<f64>,
}

/// Points and weights of Gauss's rule with three points, over a length of one.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

impl Pace {
    /// The pace one between the first and the last of ascending times (s), with parts that end at these times and are from `shortest`
    /// to `longest`; times that are nearer to each other share an end. None without any length.
    pub fn over(times: &[f64], [shortest, longest]: [f64; 2]) -> Option<Self> {
        let (first, last) = (*times.first()?, *times.last()?);
        if !(last > first && longest > 0.0) {
            return None;
        }
        let mut ends = vec![first];
        let mut extend_to = |end: f64| {
            let begin = *ends.last().unwrap_or(&first);
            let count = ((end - begin) / longest).ceil().max(1.0);
            ends.extend((1..count as usize).map(|k| begin + (end - begin) * k as f64 / count));
            ends.push(end);
        };
        let mut before = first;
        for time in times {
            if time - before >= shortest && last - time >= shortest {
                extend_to(*time);
                before = *time;
            }
        }
        extend_to(last);
        let values = vec![1.0; ends.len() + 1];
        Some(Pace { ends, values })
    }

    /// Begin and end of each part (s).
    pub fn parts(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.ends.windows(2).map(|pair| (pair[0], pair[1]))
    }

    /// This spline with other control values.
    pub fn with(&self, values: Vec<f64>) -> Self {
        Pace { ends: self.ends.clone(), values }
    }

    /// The part in which a time is (s); at an end the one that begins there.
    pub fn part(&self, t: f64) -> usize {
        let after = self.ends.partition_point(|end| *end <= t);
        after.saturating_sub(1).min(self.ends.len() - 2)
    }

    /// What the three control values from the number of the part on give b, b' and b'' at a time of that part.
    pub fn weights(&self, part: usize, t: f64) -> [[f64; 3]; 3] {
        let end = |k: usize| self.ends[(part + k).saturating_sub(1).min(self.ends.len() - 1)];
        let [far, begin, end, beyond] = [end(0), end(1), end(2), end(3)];
        let length = end - begin;
        let (left, right) = (end - far, beyond - begin);
        let [early, late] = [(end - t) / length, (t - begin) / length];
        let [first, third] = [early * (end - t) / left, late * (t - begin) / right];
        let [falls, rises] = [-2.0 * early / left, 2.0 * late / right];
        let [before, after] = [2.0 / (length * left), 2.0 / (length * right)];
        [
            [first, 1.0 - first - third, third],
            [falls, -falls - rises, rises],
            [before, -before - after, after],
        ]
    }

    /// b, b' and b'' at a time (s).
    pub fn jet_at(&self, t: f64) -> Jet {
        let part = self.part(t);
        let [value, slope, curvature] = self
            .weights(part, t)
            .map(|weights| (0..3).map(|k| weights[k] * self.values[part + k]).sum());
        Jet { value, slope, curvature }
    }

    /// How long a part takes at this pace (s).
    pub fn time_of(&self, part: usize) -> f64 {
        let (begin, length) = (self.ends[part], self.ends[part + 1] - self.ends[part]);
        let rate = |share: f64| self.jet_at(begin + share * length).value.sqrt();
        GAUSS.iter().map(|(share, weight)| length * weight / rate(*share)).sum()
    }

    /// How long all of it takes (s).
    pub fn time(&self) -> f64 {
        (0..self.ends.len() - 1).map(|part| self.time_of(part)).sum()
    }
}
