//! One free span of the ply, and what holds its ends.

use crate::catenary::{EndCondition, Span, SpanState};
use crate::equilibrium::Number;
use crate::ply::Kind;

/// One free span of the ply.
#[derive(Debug, Clone, Copy)]
pub struct Element<T> {
    /// Index of its catenary, see [`crate::ply::Lines::catenary`].
    pub catenary: usize,
    /// Kind of its catenary.
    pub kind: Kind,
    /// 0 for a whole catenary or the free segment before the contact segment, 1 for the one after it.
    pub segment: usize,
    /// Horizontal distance of its ends ℓ (m).
    pub run: T,
    /// Height of its second end above its first h (m).
    pub rise: T,
    /// Fabric length L_set (m).
    pub length: T,
    /// Weight per length (N/m).
    pub weight: T,
    /// Flexural rigidity EI (N·m²).
    pub rigidity: T,
    /// What holds its ends.
    pub ends: [End<T>; 2],
    /// How it holds its length.
    pub state: SpanState,
}

/// What holds an end of an element.
#[derive(Debug, Clone, Copy)]
pub enum End<T> {
    /// No moment.
    Free,
    /// A given slope: constrained by a shearing cell, or the mold's.
    Prescribed(T),
    /// A shared slope of the problem.
    Shared(usize),
    /// A diagonal: the plane through two edge slopes.
    Plane(PlaneSlope<T>),
}

/// Slope of the plane through the two edge slopes of a cell at a gripper, along a diagonal.
#[derive(Debug, Clone, Copy)]
pub struct PlaneSlope<T> {
    /// Share of the edge slope along u and along v.
    pub share: [T; 2],
    /// Where the edge slopes along u and along v come from.
    pub source: [SlopeSource<T>; 2],
}

/// Where an edge slope at a gripper comes from.
#[derive(Debug, Clone, Copy)]
pub enum SlopeSource<T> {
    /// Known beforehand.
    Prescribed(T),
    /// A shared slope of the problem.
    Shared(usize),
    /// The free end of an element: (element, end).
    Outcome(usize, usize),
}

/// Which of three numbers (along u, along v, diagonal) is a catenary's.
pub fn class(kind: Kind) -> usize {
    match kind {
        Kind::EdgeU => 0,
        Kind::EdgeV => 1,
        Kind::Rising | Kind::Falling => 2,
    }
}

impl<T: Number> PlaneSlope<T> {
    /// The slope, from those of the edges.
    pub fn slope(&self, edge: impl Fn(SlopeSource<T>) -> T) -> T {
        self.share[0] * edge(self.source[0]) + self.share[1] * edge(self.source[1])
    }
}

impl<T: Number> Element<T> {
    /// The span at given end slopes; an empty list leaves the ends free.
    pub fn span(&self, axial_stiffness: f64, slopes: &[f64]) -> Span {
        let end = |n: usize| match (self.ends[n], slopes.get(n)) {
            (End::Free, _) | (_, None) => EndCondition::Free,
            (_, Some(slope)) => EndCondition::Slope(*slope),
        };
        Span {
            run: self.run.re(),
            rise: self.rise.re(),
            length: self.length.re(),
            ends: [end(0), end(1)],
            weight: self.weight.re(),
            flexural_rigidity: self.rigidity.re(),
            axial_stiffness,
        }
    }

    /// Slope of its chord.
    pub(crate) fn chord_slope(&self) -> T {
        if self.run.re() > 0.0 { self.rise / self.run } else { T::from(0.0) }
    }

    /// Which ends are free.
    pub(crate) fn is_free(&self) -> [bool; 2] {
        self.ends.map(|end| matches!(end, End::Free))
    }
}

impl Element<f64> {
    /// Number of different [`Element::variant`]s.
    pub(crate) const VARIANTS: usize = 12;

    /// Elements of one class with the same ends free are of one variant: their forces are alike.
    pub(crate) fn variant(&self) -> usize {
        let [first, second] = self.is_free().map(usize::from);
        4 * class(self.kind) + 2 * first + second
    }

    /// Whether another element is the same span, whatever slopes hold it.
    pub(crate) fn is_same_span(&self, other: &Element<f64>) -> bool {
        let numbers = |e: &Element<f64>| [e.run, e.rise, e.length, e.weight, e.rigidity];
        numbers(self) == numbers(other)
            && self.is_free() == other.is_free()
            && self.state == other.state
    }
}
