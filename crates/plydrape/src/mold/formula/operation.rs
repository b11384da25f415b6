//! The operations of a formula, each done on heights together with their derivatives.

use crate::mold::height::Height;

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
    /// The same with the other sign.
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
    #[must_use]
    pub fn operands(self) -> usize {
        match self {
            Operation::Number(_) | Operation::X | Operation::Y => 0,
            Operation::Whole(_) | Operation::Real(_) | Operation::Negate | Operation::Call(_) => 1,
            _ => 2,
        }
    }

    /// Heights on the stack behind the operation, from those before it.
    #[must_use]
    pub fn top(self, top: usize) -> usize {
        match self {
            Operation::Number(_) | Operation::X | Operation::Y => top + 1,
            Operation::Whole(_) | Operation::Real(_) | Operation::Negate | Operation::Call(_) => {
                top
            }
            _ => top - 1,
        }
    }

    /// What the operation leaves on the stack, from the height in its place and the one above.
    pub fn result(self, a: Height, above: Option<&Height>, [x, y]: [f64; 2]) -> Height {
        let zero = Height::constant(0.0);
        let b = above.unwrap_or(&zero);
        match self {
            Operation::Number(value) => Height::constant(value),
            Operation::X => Height::coordinate(x, 0),
            Operation::Y => Height::coordinate(y, 1),
            Operation::Add => a.plus(1.0, b),
            Operation::Subtract => a.plus(-1.0, b),
            Operation::Multiply => a.times(b),
            Operation::Divide => {
                let inverse = 1.0 / b.z;
                let square = inverse * inverse;
                a.times(&b.chain([inverse, -square, 2.0 * square * inverse]))
            }
            Operation::Whole(n) => whole(&a, n),
            Operation::Real(n) => {
                let power = |shift: f64| a.z.powf(n - shift);
                a.chain([power(0.0), n * power(1.0), n * (n - 1.0) * power(2.0)])
            }
            Operation::Power => Function::Exp.of(&b.times(&Function::Ln.of(&a))),
            Operation::Negate => zero.plus(-1.0, &a),
            Operation::Call(function) => function.of(&a),
        }
    }
}

/// aⁿ.
fn whole(a: &Height, n: i32) -> Height {
    match n {
        0 => Height::constant(1.0),
        1 => *a,
        2 => a.chain([a.z * a.z, 2.0 * a.z, 2.0]),
        _ => {
            let (m, base) = (f64::from(n), a.z.powi(n - 2));
            a.chain([base * a.z * a.z, m * base * a.z, m * (m - 1.0) * base])
        }
    }
}

impl Function {
    /// The function of a height.
    fn of(self, a: &Height) -> Height {
        let z = a.z;
        a.chain(match self {
            Function::Sqrt => {
                let root = z.sqrt();
                [root, 0.5 / root, -0.25 / (z * root)]
            }
            Function::Exp => [z.exp(); 3],
            Function::Ln => [z.ln(), 1.0 / z, -1.0 / (z * z)],
            Function::Log10 => {
                let scale = std::f64::consts::LOG10_E;
                [z.log10(), scale / z, -scale / (z * z)]
            }
            Function::Sin => {
                let (sin, cos) = z.sin_cos();
                [sin, cos, -sin]
            }
            Function::Cos => {
                let (sin, cos) = z.sin_cos();
                [cos, -sin, -cos]
            }
            Function::Tan => {
                let tan = z.tan();
                let rate = 1.0 + tan * tan;
                [tan, rate, 2.0 * tan * rate]
            }
            Function::Asin | Function::Acos => {
                let rest = 1.0 - z * z;
                let rate = 1.0 / rest.sqrt();
                if self == Function::Asin {
                    [z.asin(), rate, z * rate / rest]
                } else {
                    [z.acos(), -rate, -z * rate / rest]
                }
            }
            Function::Atan => {
                let rate = 1.0 / (1.0 + z * z);
                [z.atan(), rate, -2.0 * z * rate * rate]
            }
            Function::Sinh => [z.sinh(), z.cosh(), z.sinh()],
            Function::Cosh => [z.cosh(), z.sinh(), z.cosh()],
            Function::Tanh => {
                let tanh = z.tanh();
                let rate = 1.0 - tanh * tanh;
                [tanh, rate, -2.0 * tanh * rate]
            }
        })
    }
}
