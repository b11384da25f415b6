//! The operations of a formula, each done on heights together with their derivatives. Those of a function of one number
//! are taken by second-order dual numbers.

use crate::mold::height::Height;
use num_dual::{Dual2_64, DualNum};

/// One operation on the stack of heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Operation {
    /// A number.
    Number(f64),
    /// The coordinate x (m).
    X,
    /// The coordinate y (m).
    Y,
    /// A sum of two.
    Add,
    /// The first of two less the second.
    Subtract,
    /// A product of two.
    Multiply,
    /// The first of two divided by the second.
    Divide,
    /// A power whose exponent is a whole number.
    Whole(i32),
    /// A power whose exponent is another number.
    Real(f64),
    /// A power whose exponent is a formula itself.
    Power,
    /// The number with the other sign.
    Negate,
    /// A function of one.
    Call(Function),
}

/// A function of one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// Square root.
    Sqrt,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Logarithm to base 10.
    Log10,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Inverse tangent.
    Atan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
}

/// The functions by name.
pub const FUNCTIONS: [(&str, Function); 13] = [
    ("sqrt", Function::Sqrt),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("log10", Function::Log10),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
];

impl Operation {
    /// Heights that it takes from the stack.
    pub(super) fn operands(self) -> usize {
        match self {
            Operation::Number(_) | Operation::X | Operation::Y => 0,
            Operation::Whole(_) | Operation::Real(_) | Operation::Negate | Operation::Call(_) => 1,
            _ => 2,
        }
    }

    /// Heights on the stack behind the operation, from those before it: it takes its operands and leaves one.
    pub(super) fn top(self, top: usize) -> usize {
        top + 1 - self.operands()
    }

    /// What the operation leaves on the stack, from the height in its place and the one above.
    pub(super) fn result(self, a: Height, above: Option<&Height>, [x, y]: [f64; 2]) -> Height {
        let zero = Height::constant(0.0);
        let b = above.unwrap_or(&zero);
        match self {
            Operation::Number(value) => Height::constant(value),
            Operation::X => Height::coordinate(x, 0),
            Operation::Y => Height::coordinate(y, 1),
            Operation::Add => a.plus(1.0, b),
            Operation::Subtract => a.plus(-1.0, b),
            Operation::Multiply => a.times(b),
            Operation::Divide => a.times(&b.chain(variable(b.z).recip())),
            Operation::Whole(n) => a.chain(whole(a.z, n)),
            Operation::Real(n) => {
                // also at zero, where `DualNum::powf` divides by it
                let power = |shift: f64| a.z.powf(n - shift);
                a.chain(Dual2_64::new(power(0.0), n * power(1.0), n * (n - 1.0) * power(2.0)))
            }
            Operation::Power => Function::Exp.apply(&b.times(&Function::Ln.apply(&a))),
            Operation::Negate => zero.plus(-1.0, &a),
            Operation::Call(function) => function.apply(&a),
        }
    }
}

/// zⁿ with its derivatives; `DualNum::powi` takes twice as long.
fn whole(z: f64, n: i32) -> Dual2_64 {
    match n {
        0 => Dual2_64::new(1.0, 0.0, 0.0),
        1 => variable(z),
        2 => Dual2_64::new(z * z, 2.0 * z, 2.0),
        _ => {
            let (m, base) = (f64::from(n), z.powi(n - 2));
            Dual2_64::new(base * z * z, m * base * z, m * (m - 1.0) * base)
        }
    }
}

/// A number as the variable of second-order dual numbers: what is computed from it has both derivatives.
fn variable(z: f64) -> Dual2_64 {
    Dual2_64::new(z, 1.0, 0.0)
}

impl Function {
    /// The function of a height.
    fn apply(self, a: &Height) -> Height {
        let z = variable(a.z);
        a.chain(match self {
            Function::Sqrt => z.sqrt(),
            Function::Exp => z.exp(),
            Function::Ln => z.ln(),
            Function::Log10 => z.log10(),
            Function::Sin => z.sin(),
            Function::Cos => z.cos(),
            Function::Tan => z.tan(),
            Function::Asin => z.asin(),
            Function::Acos => z.acos(),
            Function::Atan => z.atan(),
            Function::Sinh => z.sinh(),
            Function::Cosh => z.cosh(),
            Function::Tanh => {
                // also where sinh and cosh, of which `DualNum::tanh` is made, are too large for a number
                let tanh = a.z.tanh();
                let rate = 1.0 - tanh * tanh;
                Dual2_64::new(tanh, rate, -2.0 * tanh * rate)
            }
        })
    }
}
