//! A state of the ply: the shared slopes, and every element's force at the slopes that hold it.
//!
//! Given the shared slopes, every edge's force is the scalar root of its length, eq. (5) of `docs/theory/span.md`, and
//! the diagonals follow by (8). An element is evaluated anew only where what holds it has moved; where it has moved
//! very little, its second-order series does.

use super::force::{Evaluated, Needs, evaluate, evaluate_still, length_residual, meet_length};
use super::problem::{Element, End, PlaneSlope, Problem, SlopeSource};
use super::tuning::EquilibriumTuning;
use crate::catenary::{Profile, SpanState};
use std::ops::Range;

/// An element as it is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation {
    /// Slopes that hold both ends; a free end's is its outcome once lengths are measured. NaN where unknown.
    pub held: [f64; 2],
    /// Force with the derivatives.
    pub found: Evaluated<2>,
    /// What it was evaluated with.
    pub known: Needs,
}

/// The force of the small-sag parabola in place of the span: what forces are compared with.
#[derive(Debug, Clone, Copy)]
struct Parabola {
    /// Buckling force with free ends (N).
    pole: f64,
    /// Height of the parabola's force above it (N).
    height: f64,
}

impl Parabola {
    fn new(element: &Element<f64>, axial_stiffness: f64) -> Parabola {
        let span = element.span(axial_stiffness, &[]);
        let pole = span.buckling_force();
        Parabola { pole, height: span.first_guess() - pole }
    }

    /// Height of a force above buckling, as a multiple of the parabola's.
    fn ratio(&self, force: f64) -> f64 {
        (force - self.pole) / self.height
    }

    fn force(&self, ratio: f64) -> f64 {
        self.pole + ratio * self.height
    }
}

/// The shared slopes of a [`Problem`] and its elements at them.
#[derive(Debug, Clone)]
pub struct State {
    axial_stiffness: f64,
    tuning: EquilibriumTuning,
    slopes: Vec<f64>,
    elements: Vec<Evaluation>,
    needs: Vec<Needs>,
    parabolas: Vec<Parabola>,
    /// Ratio of a force to its parabola's, found last for an element of each variant.
    ratio_by_variant: [Option<f64>; Element::VARIANTS],
}

impl State {
    /// A state of no problem, for spans of an axial stiffness EA (N).
    pub fn new(axial_stiffness: f64, tuning: EquilibriumTuning) -> State {
        State {
            axial_stiffness,
            tuning,
            slopes: Vec::new(),
            elements: Vec::new(),
            needs: Vec::new(),
            parabolas: Vec::new(),
            ratio_by_variant: [None; Element::VARIANTS],
        }
    }

    /// Begins at given shared slopes; `force` guesses an element's, as a multiple of the parabola's, and `earlier` is
    /// its evaluation where it is known already.
    pub fn start<'a>(
        &mut self,
        problem: &Problem<f64>,
        slopes: impl Iterator<Item = f64>,
        force: impl Fn(&Element<f64>) -> Option<f64>,
        earlier: impl Fn(&Element<f64>) -> Option<&'a Evaluation>,
    ) {
        self.slopes.clear();
        self.slopes.extend(slopes);
        self.needs.clear();
        self.needs.resize(problem.elements.len(), Needs::default());
        for (n, element) in problem.elements.iter().enumerate() {
            for end in element.ends {
                match end {
                    End::Shared(_) => self.needs[n].derivatives = true,
                    End::Plane(plane) => self.need_edges(n, &plane),
                    End::Free | End::Prescribed(_) => {}
                }
            }
        }
        self.ratio_by_variant = [None; Element::VARIANTS];
        self.parabolas.clear();
        self.elements.clear();
        for element in &problem.elements {
            let parabola = Parabola::new(element, self.axial_stiffness);
            self.parabolas.push(parabola);
            self.elements.push(earlier(element).copied().unwrap_or_else(|| {
                let mut found = Evaluated::default();
                // the force follows the parabola's from step to step; NaN where the span is new
                found.force.value = parabola.force(force(element).unwrap_or(f64::NAN));
                Evaluation { held: [f64::NAN; 2], found, known: Needs::default() }
            }));
        }
    }

    /// Notes what a diagonal's end needs of the edges that it follows.
    fn need_edges(&mut self, diagonal: usize, plane: &PlaneSlope<f64>) {
        for source in plane.source {
            match source {
                SlopeSource::Prescribed(_) => {}
                SlopeSource::Shared(_) => self.needs[diagonal].derivatives = true,
                SlopeSource::Outcome(edge, end) => {
                    self.needs[edge].slope[end] = true;
                    self.needs[diagonal].derivatives |= self.needs[edge].derivatives;
                }
            }
        }
    }

    /// What is needed of an element.
    pub fn needs_mut(&mut self, element: usize) -> &mut Needs {
        &mut self.needs[element]
    }

    /// The shared slopes.
    pub fn slopes(&self) -> &[f64] {
        &self.slopes
    }

    /// Puts the shared slopes elsewhere; elements follow when they are evaluated.
    pub fn put(&mut self, slopes: impl Iterator<Item = f64>) {
        self.slopes.clear();
        self.slopes.extend(slopes);
    }

    /// An element's force, and its ends' slopes and curvatures, with derivatives to the slopes that hold it.
    pub fn element(&self, n: usize) -> &Evaluated<2> {
        &self.elements[n].found
    }

    /// An element's evaluation.
    pub fn evaluation(&self, n: usize) -> &Evaluation {
        &self.elements[n]
    }

    /// Slopes at both ends of an element.
    pub fn end_slopes(&self, n: usize) -> [f64; 2] {
        self.elements[n].held
    }

    /// Slopes at both ends of every element.
    pub fn all_end_slopes(&self) -> impl Iterator<Item = [f64; 2]> {
        self.elements.iter().map(|element| element.held)
    }

    /// ½‖H‖² (N²).
    pub fn half_square(&self) -> f64 {
        0.5 * self.elements.iter().map(|e| e.found.force.value * e.found.force.value).sum::<f64>()
    }

    /// Height of an element's force above buckling, as a multiple of the parabola's.
    pub fn ratio(&self, n: usize) -> f64 {
        self.parabolas[n].ratio(self.elements[n].found.force.value)
    }

    /// Whether no element's derivatives were extrapolated far; if not, the next evaluation renews them.
    pub fn is_exact(&self) -> bool {
        self.elements.iter().all(|element| element.found.extrapolation <= self.tuning.extrapolation)
    }

    /// Evaluates the elements of a range at the present shared slopes.
    pub fn evaluate(&mut self, problem: &Problem<f64>, range: Range<usize>) {
        for n in range {
            let element = &problem.elements[n];
            if element.state == SpanState::Straight {
                let slope = element.chord_slope();
                let own = &mut self.elements[n];
                (own.held, own.found) = ([slope; 2], Evaluated::default());
                own.found.slope.iter_mut().for_each(|s| s.value = slope);
                continue;
            }
            let slopes = [0, 1].map(|end| self.slope_at(element, end));
            let (needs, own) = (self.needs[n], &mut self.elements[n]);
            if own.known.cover(needs) && own.found.extrapolation <= self.tuning.extrapolation {
                let step = [slopes[0] - own.held[0], slopes[1] - own.held[1]];
                // its held slopes have not moved: the evaluation stays
                if slopes == own.held {
                    continue;
                }
                if needs.derivatives && step.iter().all(|x| x.abs() <= self.tuning.series_slope) {
                    own.found.extrapolate(step);
                    own.held = slopes;
                    continue;
                }
            }
            let guess = self.predict(n, element, slopes);
            let span = element.span(self.axial_stiffness, &slopes);
            let found = if needs.derivatives {
                evaluate::<3, 2>(&span, guess, needs, &self.tuning)
            } else {
                evaluate_still(&span, guess, needs, &self.tuning)
            };
            let ratio = self.parabolas[n].ratio(found.force.value);
            self.ratio_by_variant[element.variant()] = Some(ratio).filter(|r| r.is_finite());
            self.elements[n] = Evaluation { held: slopes, found, known: needs };
        }
    }

    /// The slope that holds an end; 0 where nothing does.
    fn slope_at(&self, element: &Element<f64>, end: usize) -> f64 {
        match element.ends[end] {
            End::Free => 0.0,
            End::Prescribed(slope) => slope,
            End::Shared(slope) => self.slopes[slope],
            End::Plane(plane) => plane.slope(|source| match source {
                SlopeSource::Prescribed(slope) => slope,
                SlopeSource::Shared(slope) => self.slopes[slope],
                SlopeSource::Outcome(edge, end) => self.elements[edge].found.slope[end].value,
            }),
        }
    }

    /// Force at new end slopes by the second-order series about the last ones.
    fn predict(&self, n: usize, element: &Element<f64>, slopes: [f64; 2]) -> Option<f64> {
        let Evaluation { held, found, .. } = &self.elements[n];
        if found.force.value.is_nan() {
            return self.ratio_by_variant[element.variant()]
                .map(|ratio| self.parabolas[n].force(ratio));
        }
        if held[0].is_nan() {
            return Some(found.force.value);
        }
        Some(found.force_at([slopes[0] - held[0], slopes[1] - held[1]]))
    }

    /// Largest relative error of a length, measured at the forces that are returned; slopes of free ends are
    /// read off on the way.
    pub fn measure_lengths(&mut self, problem: &Problem<f64>) -> f64 {
        let mut largest: f64 = 0.0;
        let tuning = &self.tuning;
        for (n, element) in problem.elements.iter().enumerate() {
            if element.state == SpanState::Straight {
                continue;
            }
            let Evaluation { held, found, .. } = &mut self.elements[n];
            let span = element.span(self.axial_stiffness, held);
            let near = tuning.length_margin * tuning.length_tolerance;
            if found.length_residual.is_nan() || found.length_residual > near {
                (found.force.value, found.length_residual) =
                    meet_length(&span, Some(found.force.value), tuning);
            }
            // close to buckling the rounding of the force itself moves the length
            let pole = self.parabolas[n].pole;
            if pole.abs() > tuning.buckling_rounding * (found.force.value - pole).abs() {
                found.length_residual = length_residual(&span, found.force.value);
            }
            let residual = found.length_residual;
            largest = largest.max(if residual.is_finite() { residual } else { f64::INFINITY });
            let free = element.is_free();
            if free[0] || free[1] {
                let profile = Profile::new(&span, found.force.value);
                for end in 0..2 {
                    if free[end] {
                        held[end] = profile.end_slope(end);
                    }
                }
            }
        }
        largest
    }

    /// An element with derivatives to everything it depends on.
    pub fn differentiate(&self, problem: &Problem<f64>, n: usize) -> Evaluated<7> {
        let (element, own) = (&problem.elements[n], &self.elements[n]);
        if element.state == SpanState::Straight {
            return Evaluated::default();
        }
        let span = element.span(self.axial_stiffness, &own.held);
        let needs = Needs { slope: [true; 2], curvature: [true; 2], derivatives: true };
        evaluate::<8, 7>(&span, Some(own.found.force.value), needs, &self.tuning)
    }

    /// This state with exact derivatives where the last step was taken by series.
    pub fn refined(&self, jets: &[Evaluated<7>]) -> State {
        let mut out = self.clone();
        for (element, jets) in out.elements.iter_mut().zip(jets) {
            element.found = element.found.refined(jets);
        }
        out
    }
}
