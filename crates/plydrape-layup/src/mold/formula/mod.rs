//! A mold given by a formula: z = f(x, y), all in meters.
//!
//! A formula is a list of operations in the order in which a pocket calculator with a stack would
//! do them. Each is done on the height together with its derivatives, so that slope and curvature of the
//! mold are exact.

mod interval;
mod operation;
mod polynomial;

pub use operation::{FUNCTIONS, Function, Operation};

use super::height::{Height, Steepness};
use super::tuning::TUNING;
use interval::{Interval, Range};
use polynomial::Polynomial;
use std::fmt;

/// A height z = f(x, y) as a list of operations, each behind its operands.
#[derive(Clone, PartialEq)]
pub struct Formula {
    text: String,
    program: Vec<Operation>,
    /// Most heights that wait on the stack at a time.
    depth: usize,
    /// The formula as a sum of powers, where it is written as one.
    polynomial: Option<Polynomial>,
}

/// Most heights on the stack.
const MOST: usize = 64;
/// Heights on the stack of nearly every formula.
const FEW: usize = 8;

impl Formula {
    /// A formula of operations, each behind its operands, and the text that stands for it in reports; `None` if they
    /// leave not exactly one height, need one that is not there, or more than 64 at a time.
    #[must_use]
    pub fn new(text: &str, program: Vec<Operation>) -> Option<Self> {
        let (mut top, mut depth) = (0_usize, 0);
        for operation in &program {
            if top < operation.operands() {
                return None;
            }
            top = operation.top(top);
            depth = depth.max(top);
        }
        if top != 1 || depth > MOST {
            return None;
        }
        let polynomial = Polynomial::from_program(&program);
        Some(Formula { text: text.to_string(), program, depth, polynomial })
    }

    /// As it was written.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The height at (x, y) (m); not finite where the formula is not defined.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
        if let Some(polynomial) = &self.polynomial {
            return polynomial.at(x, y);
        }
        if self.depth <= FEW { self.run::<FEW>(x, y) } else { self.run::<MOST>(x, y) }
    }

    fn run<const N: usize>(&self, x: f64, y: f64) -> Height {
        let mut stack = [Height::constant(0.0); N];
        let mut top = 0;
        for operation in &self.program {
            top = operation.top(top);
            let (a, b) = (stack[top - 1], stack.get(top));
            stack[top - 1] = operation.result(a, b, [x, y]);
        }
        stack[0]
    }

    /// Bounds of its slope and bend over ranges of x and y (m); not finite where the formula has none, or where
    /// none are found.
    #[must_use]
    pub fn steepness(&self, range: [[f64; 2]; 2]) -> Steepness {
        let part = |n: usize, k: usize| {
            let [low, high] = range[n];
            let bound = |k: usize| low + (high - low) * k as f64 / TUNING.formula_parts as f64;
            Interval(bound(k), bound(k + 1))
        };
        let parts =
            (0..TUNING.formula_parts).flat_map(|j| (0..TUNING.formula_parts).map(move |i| [i, j]));
        parts.fold(Steepness::default(), |most, [i, j]| {
            let Range { gradient: [fx, fy], hessian, .. } = self.range([part(0, i), part(1, j)]);
            let [xx, xy, yy] = hessian.map(Interval::size);
            most.or(Steepness::new([fx.size(), fy.size()], [xx, xy, yy]))
        })
    }

    /// Between which bounds height and derivatives stay over a rectangle (m).
    fn range(&self, rectangle: [Interval; 2]) -> Range {
        let none = Range::constant(Interval(0.0, 0.0));
        let mut stack = [none; MOST];
        let mut top = 0;
        for operation in &self.program {
            top = operation.top(top);
            let (a, b) = (stack[top - 1], *stack.get(top).unwrap_or(&none));
            stack[top - 1] = operation.range(a, &b, rectangle);
        }
        stack[0]
    }

    /// A place (m) on a grid over ranges of x and y (m) where the height or one of its derivatives is not
    /// finite, if there is one.
    #[must_use]
    pub fn undefined_within(&self, range: [[f64; 2]; 2]) -> Option<[f64; 2]> {
        let place = |n: usize, k: usize| {
            let [low, high] = range[n];
            let t = k as f64 / TUNING.formula_samples as f64;
            // the middle and both ends are met to the last bit
            low * (1.0 - t) + high * t
        };
        (0..=TUNING.formula_samples)
            .flat_map(|j| (0..=TUNING.formula_samples).map(move |i| [i, j]))
            .map(|[i, j]| [place(0, i), place(1, j)])
            .find(|&[x, y]| !self.at(x, y).is_finite())
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Formula").field(&self.text).finish()
    }
}
