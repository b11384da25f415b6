//! Gap samples: how far a span is from the mold along its run, and where it touches.

use super::bracket::crossing;
use super::sampling::GapCache;
use super::spans::FreeSpan;
use crate::mold::Mold;

/// A run of touching points of a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Where it begins, as a fraction of the span's run.
    pub from: f64,
    /// Where it ends, as a fraction of the span's run.
    pub to: f64,
    /// The deepest point of the gap, as a fraction of the span's run.
    pub deepest: f64,
    /// Distance from the mold there (m), negative below it.
    pub depth: f64,
}

/// Where a span touches the mold, along its run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GapSamples {
    /// Fraction of the run and distance there (m), ascending; empty if the span touches nowhere. The deepest
    /// of each run of touching samples is exact; another distance may be a bound on the same side of the tolerance.
    pub(super) samples: Vec<(f64, f64)>,
    /// Distance that counts as touching (m).
    pub(super) tolerance: f64,
}

impl GapSamples {
    /// The samples of a span of which nothing is known yet; minima that may come closer than `tolerance` (m) are
    /// found exactly.
    #[must_use]
    pub fn new(span: &FreeSpan, mold: &Mold, tolerance: f64) -> Self {
        let span = FreeSpan { catenary: 0, ..span.clone() };
        GapCache::new(Some(mold), 1).samples(&span, mold, tolerance)
    }

    /// Depth of the lowest point below the mold (m), negative if the span only comes close; without bound if it
    /// touches nowhere.
    #[must_use]
    pub fn depth(&self) -> f64 {
        -self.samples.iter().fold(f64::INFINITY, |least, (_, distance)| least.min(*distance))
    }

    /// Fraction of the run at the deepest point and the distance there (m); `None` if it touches nowhere.
    #[must_use]
    pub fn deepest(&self) -> Option<(f64, f64)> {
        self.samples.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Depth (m) of the lowest point of the touch that begins at the first (0) or second (1) end; without bound if
    /// none does.
    #[must_use]
    pub fn depth_from(&self, end: usize) -> f64 {
        let last = self.samples.len().saturating_sub(1);
        let from_end = (0..self.samples.len()).map(|n| if end == 0 { n } else { last - n });
        let touching = from_end.map(|n| self.samples[n].1).take_while(|d| *d < self.tolerance);
        -touching.fold(f64::INFINITY, f64::min)
    }

    /// Whether the span touches nowhere but around one of its ends (0 or 1), where it leaves the mold: it is
    /// nowhere deeper than `depth` (m), and its other end is free.
    #[must_use]
    pub fn only_leaves(&self, end: usize, tolerance: f64, depth: f64) -> bool {
        let mut from_end: Vec<bool> = self.samples.iter().map(|(_, d)| *d < tolerance).collect();
        if end == 1 {
            from_end.reverse();
        }
        let touching = from_end.iter().take_while(|touches| **touches).count();
        let free = &from_end[touching..];
        !free.is_empty() && !free.contains(&true) && self.depth() < depth
    }

    /// Runs of points closer to the mold than `tolerance` (m), ascending.
    #[must_use]
    pub fn runs(&self, span: &FreeSpan, mold: &Mold, tolerance: f64) -> Vec<Run> {
        let distance = |t: f64| mold.signed_distance(span.point(t));
        let samples = &self.samples;
        let mut out: Vec<Run> = Vec::new();
        let mut open: Option<Run> = None;
        for n in 0..samples.len() {
            let (t, d) = samples[n];
            if d < tolerance {
                let run = open.get_or_insert_with(|| {
                    let outside = |n: usize| crossing(&distance, samples[n - 1].0, t, tolerance);
                    let from = if n == 0 { 0.0 } else { outside(n) };
                    Run { from, to: t, deepest: t, depth: d }
                });
                run.to = t;
                if d < run.depth {
                    (run.deepest, run.depth) = (t, d);
                }
            } else if let Some(mut run) = open.take() {
                run.to = crossing(&distance, t, samples[n - 1].0, tolerance);
                out.push(run);
            }
        }
        out.extend(open);
        out
    }
}
