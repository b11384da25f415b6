//! Between which bounds a formula and its derivatives stay over a rectangle, by interval arithmetic.
//!
//! Every operation is done on intervals that hold all values of its operands (Moore 1966). The result is never too
//! narrow; it is too wide where the same operand comes twice, and shrinks to the true range with the rectangle.

use super::operation::{Function, Operation};
use std::f64::consts::{LOG10_E, PI, TAU};

/// All numbers from the first to the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval(pub f64, pub f64);

/// A height with its first and second derivatives as intervals, in the order of [`crate::mold::height::Height`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    pub z: Interval,
    pub gradient: [Interval; 2],
    pub hessian: [Interval; 3],
}

const ZERO: Interval = Interval(0.0, 0.0);
const ONE: Interval = Interval(1.0, 1.0);
/// Nothing is known.
const ANY: Interval = Interval(f64::NEG_INFINITY, f64::INFINITY);

impl Interval {
    /// The smallest interval around some numbers; all numbers if one of these is none.
    fn hull(values: &[f64]) -> Self {
        if values.iter().any(|value| value.is_nan()) {
            return ANY;
        }
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        Interval(
            values.iter().copied().fold(low, f64::min),
            values.iter().copied().fold(high, f64::max),
        )
    }

    fn plus(self, other: Self) -> Self {
        Interval::hull(&[self.0 + other.0, self.1 + other.1])
    }

    fn times(self, other: Self) -> Self {
        let (Interval(a, b), Interval(c, d)) = (self, other);
        Interval::hull(&[a * c, a * d, b * c, b * d])
    }

    fn scaled(self, by: f64) -> Self {
        self.times(Interval(by, by))
    }

    fn holds(self, value: f64) -> bool {
        self.0 <= value && value <= self.1
    }

    /// A function that only rises or only falls over it.
    fn monotone(self, f: impl Fn(f64) -> f64) -> Self {
        Interval::hull(&[f(self.0), f(self.1)])
    }

    fn inverse(self) -> Self {
        if self.holds(0.0) { ANY } else { self.monotone(|x| 1.0 / x) }
    }

    /// The power with a whole exponent.
    fn power(self, n: i32) -> Self {
        match n {
            0 => ONE,
            _ if !self.holds(0.0) => self.monotone(|x| x.powi(n)),
            1.. => Interval::hull(&[self.0.powi(n), self.1.powi(n), 0.0]),
            _ => ANY,
        }
    }

    /// The power with any exponent; all numbers where the base is not positive.
    fn real_power(self, n: f64) -> Self {
        if self.0 > 0.0 { self.monotone(|x| x.powf(n)) } else { ANY }
    }

    fn sin(self) -> Self {
        let width = self.1 - self.0;
        if width.is_nan() || width >= TAU {
            return Interval(-1.0, 1.0);
        }
        // whether a number π/2 + 2πk or −π/2 + 2πk is in it
        let meets = |at: f64| ((self.0 - at) / TAU).ceil() * TAU + at <= self.1;
        let Interval(low, high) = self.monotone(f64::sin);
        Interval(
            if meets(-0.5 * PI) { -1.0 } else { low },
            if meets(0.5 * PI) { 1.0 } else { high },
        )
    }

    fn cos(self) -> Self {
        self.plus(Interval(0.5 * PI, 0.5 * PI)).sin()
    }

    /// The largest absolute value.
    pub fn size(self) -> f64 {
        self.0.abs().max(self.1.abs())
    }
}

impl Range {
    pub fn constant(z: Interval) -> Self {
        Range { z, gradient: [ZERO; 2], hessian: [ZERO; 3] }
    }

    fn coordinate(z: Interval, axis: usize) -> Self {
        let mut gradient = [ZERO; 2];
        gradient[axis] = ONE;
        Range { gradient, ..Range::constant(z) }
    }

    fn plus(&self, t: f64, g: &Self) -> Self {
        Range {
            z: self.z.plus(g.z.scaled(t)),
            gradient: [0, 1].map(|n| self.gradient[n].plus(g.gradient[n].scaled(t))),
            hessian: [0, 1, 2].map(|n| self.hessian[n].plus(g.hessian[n].scaled(t))),
        }
    }

    fn times(&self, g: &Self) -> Self {
        let ([fx, fy], [gx, gy]) = (self.gradient, g.gradient);
        let mixed =
            [fx.times(gx).scaled(2.0), fx.times(gy).plus(fy.times(gx)), fy.times(gy).scaled(2.0)];
        Range {
            z: self.z.times(g.z),
            gradient: [0, 1].map(|n| self.gradient[n].times(g.z).plus(self.z.times(g.gradient[n]))),
            hessian: [0, 1, 2].map(|n| {
                self.hessian[n].times(g.z).plus(mixed[n]).plus(self.z.times(g.hessian[n]))
            }),
        }
    }

    fn chain(&self, [h, h1, h2]: [Interval; 3]) -> Self {
        let [fx, fy] = self.gradient;
        let squares = [fx.power(2), fx.times(fy), fy.power(2)];
        Range {
            z: h,
            gradient: [h1.times(fx), h1.times(fy)],
            hessian: [0, 1, 2].map(|n| h1.times(self.hessian[n]).plus(h2.times(squares[n]))),
        }
    }
}

impl Operation {
    /// As [`Operation::result`], over the rectangle of x and y.
    pub(super) fn range(self, a: Range, b: &Range, [x, y]: [Interval; 2]) -> Range {
        match self {
            Operation::Number(value) => Range::constant(Interval(value, value)),
            Operation::X => Range::coordinate(x, 0),
            Operation::Y => Range::coordinate(y, 1),
            Operation::Add => a.plus(1.0, b),
            Operation::Subtract => a.plus(-1.0, b),
            Operation::Multiply => a.times(b),
            Operation::Divide => a.times(&b.chain([
                b.z.inverse(),
                b.z.power(2).inverse().scaled(-1.0),
                b.z.power(3).inverse().scaled(2.0),
            ])),
            Operation::Whole(0) => Range::constant(ONE),
            Operation::Whole(1) => a,
            Operation::Whole(n) => {
                let m = f64::from(n);
                let (first, second) = (a.z.power(n - 1), a.z.power(n - 2));
                a.chain([a.z.power(n), first.scaled(m), second.scaled(m * (m - 1.0))])
            }
            Operation::Real(n) => {
                let power = |shift: f64| a.z.real_power(n - shift);
                a.chain([power(0.0), power(1.0).scaled(n), power(2.0).scaled(n * (n - 1.0))])
            }
            Operation::Power => Function::Exp.range(&b.times(&Function::Ln.range(&a))),
            Operation::Negate => Range::constant(ZERO).plus(-1.0, &a),
            Operation::Call(function) => function.range(&a),
        }
    }
}

impl Function {
    fn range(self, a: &Range) -> Range {
        let z = a.z;
        let positive = z.0 > 0.0;
        // 1 − z² of arcus sine and cosine
        let rest = ONE.plus(z.power(2).scaled(-1.0));
        a.chain(match self {
            Function::Sqrt | Function::Ln | Function::Log10 if !positive => [ANY; 3],
            Function::Asin | Function::Acos if rest.0 <= 0.0 => [ANY; 3],
            Function::Tan if z.cos().holds(0.0) => [ANY; 3],
            Function::Sqrt => [
                z.real_power(0.5),
                z.real_power(-0.5).scaled(0.5),
                z.real_power(-1.5).scaled(-0.25),
            ],
            Function::Exp => [z.monotone(f64::exp); 3],
            Function::Ln | Function::Log10 => {
                let scale = if self == Function::Ln { 1.0 } else { LOG10_E };
                [z.monotone(f64::ln), z.inverse(), z.power(2).inverse().scaled(-1.0)]
                    .map(|part| part.scaled(scale))
            }
            Function::Sin => [z.sin(), z.cos(), z.sin().scaled(-1.0)],
            Function::Cos => [z.cos(), z.sin().scaled(-1.0), z.cos().scaled(-1.0)],
            Function::Tan => {
                let tan = z.monotone(f64::tan);
                let rate = ONE.plus(tan.power(2));
                [tan, rate, tan.times(rate).scaled(2.0)]
            }
            Function::Asin | Function::Acos => {
                let (rate, bend) = (rest.real_power(-0.5), z.times(rest.real_power(-1.5)));
                if self == Function::Asin {
                    [z.monotone(f64::asin), rate, bend]
                } else {
                    [z.monotone(f64::acos), rate.scaled(-1.0), bend.scaled(-1.0)]
                }
            }
            Function::Atan => {
                let rate = ONE.plus(z.power(2)).inverse();
                [z.monotone(f64::atan), rate, z.times(rate.power(2)).scaled(-2.0)]
            }
            Function::Sinh | Function::Cosh => {
                let sinh = z.monotone(f64::sinh);
                let ends = z.monotone(f64::cosh);
                let cosh = if z.holds(0.0) { Interval(1.0, ends.1) } else { ends };
                if self == Function::Sinh { [sinh, cosh, sinh] } else { [cosh, sinh, cosh] }
            }
            Function::Tanh => {
                let tanh = z.monotone(f64::tanh);
                let rate = ONE.plus(tanh.power(2).scaled(-1.0));
                [tanh, rate, tanh.times(rate).scaled(-2.0)]
            }
        })
    }
}
