//! Gap samples: how far a span is from the mold along its run, and where it touches.
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
//! neighbour, and is evaluated again only where both bounds leave a decision open. The samples that matter are
//! therefore the same with and without the cache.

use super::contact::Bridge;
use super::spans::{FreeSpan, Point};
use crate::mold::{Mold, Steepness, distance};

/// Intervals between the stations of a span.
const INTERVALS: usize = 48;
const STATIONS: usize = INTERVALS + 1;

/// Share by which a bound must clear the tolerance, far above the rounding of distances.
const MARGIN: f64 = 1e-6;

/// A run of touching points of a span, as fractions of its run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Its deepest point.
    pub deepest: f64,
    /// Distance from the mold there (m), negative below it.
    pub depth: f64,
}

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
        // a point that may have come past a border or through the mold is no deeper than it is far
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
        // what is deep in a mold that the whole span keeps clear of is below its border
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

/// The fraction of the run at a station.
fn at(station: usize) -> f64 {
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
        let (observation, distance) = self.observe(self.span.point(at(station)), most);
        self.gaps[station] = Gap::exact(distance);
        if let Some(slot) = self.observed.get_mut(station) {
            *slot = observation;
        }
    }

    /// Bounds the gaps of all stations, so closely that it is known which touch.
    fn bound(&mut self, places: &[Point; STATIONS], tolerance: f64) {
        let margin = MARGIN * tolerance;
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
        // between stations a curve goes down by no more than its neighbours rise
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
                let sample = |n: usize| (at(n), self.gaps[n].least);
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
        let station = |n: usize| Sample { t: at(n), gap: self.gaps[n], station: Some(n) };
        samples.splice(0..0, (0..STATIONS).map(station));
        samples.sort_by(|a, b| a.t.total_cmp(&b.t));
        self.deepen(&mut samples, tolerance);
        let sample = |s: Sample| (s.t, if touches(&s.gap) { s.gap.most } else { s.gap.least });
        GapSamples { samples: samples.into_iter().map(sample).collect(), tolerance }
    }
}

/// Where a span touches the mold, along its run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GapSamples {
    /// Fraction of the run and distance there (m), ascending; empty if the span touches nowhere. The deepest
    /// of each run of touching samples is exact; another distance may be a bound on the same side of the tolerance.
    samples: Vec<(f64, f64)>,
    /// Distance that counts as touching (m).
    tolerance: f64,
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

    /// Fraction of the run at the deepest point and the distance there (m); none if it touches nowhere.
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

/// Smallest distance between two stations around a third that is lower, by parabolas through the last
/// three points: (t, distance).
fn minimum(
    distance: &impl Fn(f64) -> f64,
    (mut a, mut fa): (f64, f64),
    (mut m, mut fm): (f64, f64),
    (mut b, mut fb): (f64, f64),
) -> (f64, f64) {
    for _ in 0..20 {
        let (p, q) = ((m - a) * (fm - fb), (m - b) * (fm - fa));
        let vertex = m - 0.5 * ((m - a) * p - (m - b) * q) / (p - q);
        // a parabola that degenerates: the wider half is cut instead
        let inside = vertex > a && vertex < b;
        let wider = if b - m > m - a { 0.5 * (m + b) } else { 0.5 * (a + m) };
        let next = if inside { vertex } else { wider };
        if (next - m).abs() < 1e-9 {
            break;
        }
        let value = distance(next);
        if value < fm {
            if next > m {
                (a, fa) = (m, fm)
            } else {
                (b, fb) = (m, fm)
            }
            (m, fm) = (next, value);
        } else if next > m {
            (b, fb) = (next, value);
        } else {
            (a, fa) = (next, value);
        }
    }
    (m, fm)
}

/// Where the distance falls through `level` between `outside` and `inside`, by false position (Illinois).
fn crossing(distance: &impl Fn(f64) -> f64, outside: f64, inside: f64, level: f64) -> f64 {
    let (mut out, mut into) = (outside, inside);
    let (mut f_out, mut f_in) = (distance(out) - level, distance(into) - level);
    if f_out < 0.0 {
        return outside;
    }
    for _ in 0..60 {
        if (out - into).abs() < 1e-12 || f_in == 0.0 {
            break;
        }
        let middle = out + (into - out) * f_out / (f_out - f_in);
        let value = distance(middle) - level;
        if value < 0.0 {
            (into, f_in) = (middle, value);
            f_out *= 0.5;
        } else {
            (out, f_out) = (middle, value);
            f_in *= 0.5;
        }
    }
    into
}

/// How far one can go from `near` towards `far`, where it no longer fits, so that it still fits: where `excess` comes
/// to zero.
pub fn farthest(near: f64, far: f64, excess: impl Fn(f64) -> f64) -> f64 {
    if excess(near) >= 0.0 { near } else { crossing(&excess, far, near, 0.0) }
}

/// Largest gap between two fractions of a span.
pub fn largest_gap(span: &FreeSpan, mold: &Mold, from: f64, to: f64) -> Bridge {
    let [a, b] = [from, to].map(|t| span.point(t));
    let mut worst = Bridge { place: a, gap: 0.0, width: distance(a, b) };
    for n in 0..STATIONS {
        let place = span.point(from + (to - from) * at(n));
        let gap = mold.signed_distance(place);
        if gap > worst.gap {
            worst = Bridge { place, gap, ..worst };
        }
    }
    worst
}
