//! The sampling of gaps: exact distances from the mold only where they decide.
//!
//! A span is sampled in stations at equal shares of its run; local minima between them that may touch are
//! refined. What follows from the samples (which stations touch, the deepest point of a touch, where it begins and
//! ends) is decided by the exact distance d(p) of a point from the mold. Most stations do not need it, because the distances of two
//! points differ by no more than the points are apart: from one observation at q, with the distance d(q),
//!
//! |d(p)| ≤ |d(q)| + |p − q|,  and  d(p) ≥ r − |p − q|
//!
//! where a ball of radius r around q is known to hold nothing of the mold and to lie outside of it
//! ([`Mold::clear`]). Each station keeps such a q from an earlier step, or takes that of its
//! neighbor, and is evaluated again only where both bounds leave a decision open. The samples that matter are
//! therefore the same with and without the cache.

use super::bracket::minimum;
use super::gap::GapSamples;
use super::spans::{FreeSpan, Point};
use super::tuning::TUNING;
use crate::mold::{Mold, Steepness, distance};

/// Intervals between the stations of a span.
const INTERVALS: usize = 48;
/// Stations of a span.
pub const STATIONS: usize = INTERVALS + 1;

/// What is known from one evaluation of the mold's distance.
#[derive(Debug, Clone, Copy)]
struct Observation {
    /// From where (m).
    from: Point,
    /// Distance of the mold from there (m), without its sign.
    size: f64,
    /// Radius of a ball around that point that is clear of the mold (m); zero if none is known.
    clear: f64,
}

/// Bounds of the distance of a station from the mold (m).
#[derive(Debug, Clone, Copy)]
struct Gap {
    least: f64,
    most: f64,
    /// Both are the exact distance.
    is_exact: bool,
}

/// Nothing is known of a distance.
const UNKNOWN: Gap = Gap::between(f64::NEG_INFINITY, f64::INFINITY);

impl Gap {
    fn exact(distance: f64) -> Self {
        Gap { least: distance, most: distance, is_exact: true }
    }

    const fn between(least: f64, most: f64) -> Self {
        Gap { least, most, is_exact: false }
    }
}

impl Observation {
    /// What is known of the distance of a point `moved` (m) away.
    fn gap(&self, moved: f64) -> Gap {
        let most = self.size + moved;
        // a point that may have come past a boundary or through the mold is no deeper than it is far
        let least = if self.clear > moved { self.clear - moved } else { -most };
        Gap::between(least, most.max(least))
    }
}

/// Observations of the mold from the spans of a drape. They change no sample, only how fast samples are found.
#[derive(Debug, Clone)]
pub struct GapCache {
    /// Bounds of the mold's shape.
    steepness: Steepness,
    /// By catenary and free segment; empty before the first sampling.
    observed: Vec<[Vec<Observation>; 2]>,
}

impl GapCache {
    /// For spans of some catenaries over a mold.
    #[must_use]
    pub fn new(mold: Option<&Mold>, catenaries: usize) -> Self {
        let steepness = mold.map_or(Steepness::UNKNOWN, Mold::steepness);
        GapCache { steepness, observed: vec![[Vec::new(), Vec::new()]; catenaries] }
    }

    /// The samples of a span; minima that may come closer than `tolerance` (m) are found exactly.
    pub fn samples(&mut self, span: &FreeSpan, mold: &Mold, tolerance: f64) -> GapSamples {
        let observed = &mut self.observed[span.catenary][span.segment];
        // the same bound for the whole span, before it comes near
        let ends = || mold.clearance(span.ends[0], span.ends[1], span.curve_length());
        if observed.is_empty() && ends() > tolerance {
            return GapSamples::default();
        }
        let is_known = !observed.is_empty();
        let mut sampling =
            Sampling { span, mold, steepness: self.steepness, gaps: [UNKNOWN; STATIONS], observed };
        let samples = sampling.samples(tolerance);
        // what is deep in a mold that the whole span keeps clear of is below its boundary
        if is_known && samples.depth() > tolerance && ends() > tolerance {
            return GapSamples::default();
        }
        samples
    }
}

/// One span that is being sampled.
struct Sampling<'a> {
    span: &'a FreeSpan,
    mold: &'a Mold,
    steepness: Steepness,
    /// Bounds at each station.
    gaps: [Gap; STATIONS],
    /// The observation from which each station is bounded.
    observed: &'a mut Vec<Observation>,
}

/// A point of a span with its gap; the number of its station if it is one.
#[derive(Debug, Clone, Copy)]
struct Sample {
    t: f64,
    gap: Gap,
    station: Option<usize>,
}

/// Fraction of the run at a station.
pub fn fraction(station: usize) -> f64 {
    station as f64 / INTERVALS as f64
}

impl Sampling<'_> {
    fn distance(&self, t: f64) -> f64 {
        self.mold.signed_distance(self.span.point(t))
    }

    /// Observes the mold from a point (m), which is no farther than `most` (m) from it; also the distance (m).
    fn observe(&self, from: Point, most: f64) -> (Observation, f64) {
        let apart = self.mold.separation(from, most);
        let clear = self.mold.clear(from, apart, self.steepness);
        (Observation { from, size: apart.distance.abs(), clear }, apart.distance)
    }

    /// Makes the gap of a station exact.
    fn evaluate(&mut self, station: usize) {
        if self.gaps[station].is_exact {
            return;
        }
        let most = self.gaps[station].most;
        let (observation, distance) = self.observe(self.span.point(fraction(station)), most);
        self.gaps[station] = Gap::exact(distance);
        if let Some(slot) = self.observed.get_mut(station) {
            *slot = observation;
        }
    }

    /// Bounds the gaps of all stations, so closely that it is known which touch.
    fn bound(&mut self, places: &[Point; STATIONS], tolerance: f64) {
        let margin = TUNING.bound_margin * tolerance;
        let is_open = |gap: Gap| gap.least < tolerance + margin && gap.most > tolerance - margin;
        if let Mold::Plane(plane) = self.mold {
            for n in 0..STATIONS {
                let distance = plane.signed_distance(places[n]);
                self.gaps[n] = Gap::between(distance - margin, distance + margin);
                if is_open(self.gaps[n]) {
                    self.evaluate(n);
                }
            }
            return;
        }
        if self.observed.is_empty() {
            let (middle, _) = self.observe(places[STATIONS / 2], f64::INFINITY);
            self.observed.resize(STATIONS, middle);
        }
        for n in 0..STATIONS {
            let from = |seen: &Observation| seen.gap(distance(places[n], seen.from));
            self.gaps[n] = from(&self.observed[n]);
            if n > 0 && is_open(self.gaps[n]) {
                // the observation of the station before may reach here
                let gap = from(&self.observed[n - 1]);
                if !is_open(gap) {
                    (self.gaps[n], self.observed[n]) = (gap, self.observed[n - 1]);
                }
            }
            if is_open(self.gaps[n]) {
                self.evaluate(n);
            }
        }
    }

    /// Whether a touch may hide around a station, between the stations beside it.
    fn may_hide(&self, n: usize, places: &[Point; STATIONS], tolerance: f64) -> bool {
        let [before, here, after] = [self.gaps[n - 1], self.gaps[n], self.gaps[n + 1]];
        // between stations a curve goes down by no more than its neighbors rise
        let reach = 2.0 * here.least - before.most.max(after.most);
        let is_lowest = here.least <= before.most && here.least <= after.most && reach < tolerance;
        // nor by more than it is long, for which twice the chord is ample
        let chord = || distance(places[n], places[n - 1]).max(distance(places[n], places[n + 1]));
        is_lowest && (here.is_exact || here.least - tolerance < 2.0 * chord())
    }

    /// The minima around stations that may touch.
    fn minima(&mut self, places: &[Point; STATIONS], tolerance: f64) -> Vec<Sample> {
        let mut minima = Vec::new();
        for n in 1..INTERVALS {
            let open = |sampling: &mut Self, station: usize| {
                sampling.evaluate(station);
                sampling.may_hide(n, places, tolerance)
            };
            let hides = self.may_hide(n, places, tolerance)
                && open(self, n)
                && open(self, n - 1)
                && open(self, n + 1);
            if hides {
                let sample = |n: usize| (fraction(n), self.gaps[n].least);
                let distance = |t: f64| self.distance(t);
                let (t, d) = minimum(&distance, sample(n - 1), sample(n), sample(n + 1));
                minima.push(Sample { t, gap: Gap::exact(d), station: None });
            }
        }
        minima
    }

    /// Finds the deepest sample of each run of touching ones.
    fn deepen(&mut self, samples: &mut [Sample], tolerance: f64) {
        let touches = |sample: &Sample| sample.gap.most < tolerance;
        for run in samples.chunk_by_mut(|a, b| touches(a) && touches(b)) {
            if !touches(&run[0]) {
                continue;
            }
            loop {
                let exact = run.iter().filter(|sample| sample.gap.is_exact);
                let deepest = exact.fold(f64::INFINITY, |least, s| least.min(s.gap.least));
                let deeper = (run.iter_mut())
                    .filter(|sample| !sample.gap.is_exact && sample.gap.least <= deepest)
                    .min_by(|a, b| a.gap.least.total_cmp(&b.gap.least));
                let Some((sample, station)) = deeper.and_then(|s| s.station.map(|n| (s, n))) else {
                    break;
                };
                self.evaluate(station);
                sample.gap = self.gaps[station];
            }
        }
    }

    fn samples(&mut self, tolerance: f64) -> GapSamples {
        let places = self.span.stations();
        self.bound(&places, tolerance);
        let mut samples = self.minima(&places, tolerance);
        let touches = |gap: &Gap| gap.most < tolerance;
        if !self.gaps.iter().chain(samples.iter().map(|s| &s.gap)).any(touches) {
            return GapSamples::default();
        }
        let station = |n: usize| Sample { t: fraction(n), gap: self.gaps[n], station: Some(n) };
        samples.splice(0..0, (0..STATIONS).map(station));
        samples.sort_by(|a, b| a.t.total_cmp(&b.t));
        self.deepen(&mut samples, tolerance);
        let sample = |s: Sample| (s.t, if touches(&s.gap) { s.gap.most } else { s.gap.least });
        GapSamples { samples: samples.into_iter().map(sample).collect(), tolerance }
    }
}
