//! Formulas that are written out as sums of terms c xⁱ yʲ.
//!
//! Such a formula and its derivatives follow from the powers of x and y alone, in a tenth of the time that its
//! operations take. Products and powers of sums are not multiplied out: far from the origin the terms of
//! (x − 10)⁴ would cancel, and digits would be lost that the formula as it is written has.

use super::operation::Operation;
use crate::mold::height::Height;

/// Powers of x and of y up to this one are known.
const DEGREE: usize = 9;
/// A formula of more terms than this is left as it is.
const TERMS: usize = 64;

/// A term c xⁱ yʲ.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    factor: f64,
    powers: [usize; 2],
}

impl Term {
    fn times(&self, other: &Term) -> Term {
        Term {
            factor: self.factor * other.factor,
            powers: [0, 1].map(|n| self.powers[n] + other.powers[n]),
        }
    }
}

/// A sum of terms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Polynomial {
    terms: Vec<Term>,
}

impl Polynomial {
    /// The sum that a list of operations is, if it is written out as one.
    pub fn from_program(program: &[Operation]) -> Option<Self> {
        let mut stack: Vec<Vec<Term>> = Vec::new();
        // the operations in reverse Polish order, with sums of terms in place of numbers
        for operation in program {
            let terms = match *operation {
                Operation::Number(factor) => vec![Term { factor, powers: [0, 0] }],
                Operation::X => vec![Term { factor: 1.0, powers: [1, 0] }],
                Operation::Y => vec![Term { factor: 1.0, powers: [0, 1] }],
                Operation::Negate => scaled(stack.pop()?, -1.0),
                Operation::Whole(n) => {
                    let [term] = stack.pop()?[..] else { return None };
                    let n = usize::try_from(n).ok().filter(|n| *n <= DEGREE)?;
                    let powers = term.powers.map(|power| power * n);
                    vec![Term { factor: term.factor.powi(n as i32), powers }]
                }
                Operation::Add | Operation::Subtract | Operation::Multiply | Operation::Divide => {
                    let (b, a) = (stack.pop()?, stack.pop()?);
                    match (operation, &a[..], &b[..]) {
                        (Operation::Add, ..) => [a, b].concat(),
                        (Operation::Subtract, ..) => [a, scaled(b, -1.0)].concat(),
                        (Operation::Multiply, [term], terms)
                        | (Operation::Multiply, terms, [term]) => {
                            terms.iter().map(|other| term.times(other)).collect()
                        }
                        (Operation::Divide, _, [Term { factor, powers: [0, 0] }]) => {
                            let factor = *factor;
                            a.iter().map(|t| Term { factor: t.factor / factor, ..*t }).collect()
                        }
                        _ => return None,
                    }
                }
                Operation::Real(_) | Operation::Power | Operation::Call(_) => return None,
            };
            // large sums are left to the program itself
            let is_small =
                terms.len() <= TERMS && terms.iter().all(|t| t.powers.iter().all(|p| *p <= DEGREE));
            if !is_small {
                return None;
            }
            stack.push(terms);
        }
        let terms = stack.pop()?;
        terms.iter().all(|term| term.factor.is_finite()).then_some(Polynomial { terms })
    }

    /// The height at (x, y) (m).
    pub fn at(&self, x: f64, y: f64) -> Height {
        let [px, py] = [x, y].map(|x| {
            let mut powers = [1.0; DEGREE + 1];
            for n in 1..=DEGREE {
                powers[n] = powers[n - 1] * x;
            }
            powers
        });
        let mut sum = Height::constant(0.0);
        for Term { factor: c, powers: [i, j] } in &self.terms {
            // value, first and second derivative of a power
            let jet = |p: &[f64; DEGREE + 1], n: usize| {
                let m = n as f64;
                let [first, second] = [1, 2].map(|less| p[n.saturating_sub(less)]);
                [p[n], m * first, m * (m - 1.0) * second]
            };
            let ([f, fx, fxx], [g, gy, gyy]) = (jet(&px, *i), jet(&py, *j));
            sum.z += c * f * g;
            sum.gradient[0] += c * fx * g;
            sum.gradient[1] += c * f * gy;
            sum.hessian[0] += c * fxx * g;
            sum.hessian[1] += c * fx * gy;
            sum.hessian[2] += c * f * gyy;
        }
        sum
    }
}

fn scaled(mut terms: Vec<Term>, by: f64) -> Vec<Term> {
    terms.iter_mut().for_each(|term| term.factor *= by);
    terms
}
