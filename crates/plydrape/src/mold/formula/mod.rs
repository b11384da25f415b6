//! A mold written as a formula: z = f(x, y), all in metres.
//!
//! The text becomes a list of operations in the order in which a pocket calculator with a stack would
//! do them. Each is done on the height together with its derivatives, so that slope and curvature of the
//! mold are exact.

mod parser;
#[cfg(test)]
mod tests;

use super::height::Height;
use serde::{Serialize, Serializer};
use std::fmt;
use std::ops::Range;

/// A height z = f(x, y) written as a formula.
///
/// Known are numbers, `x`, `y`, `pi`, `+ - * / ^`, brackets and the functions `sqrt`, `exp`, `ln`, `log10`,
/// `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `sinh`, `cosh` and `tanh`. Powers come first and from the right:
/// `-x^2` is −(x²), `2^3^2` is 2⁹. `**` is another way to write `^`.
#[derive(Clone, PartialEq)]
pub struct Formula {
    text: String,
    program: Vec<Operation>,
    /// Most heights that wait on the stack at a time.
    depth: usize,
}

/// One operation on the stack of heights.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Operation {
    Number(f64),
    X,
    Y,
    Add,
    Subtract,
    Multiply,
    Divide,
    /// A power whose exponent is a whole number.
    Whole(i32),
    /// A power whose exponent is another number.
    Real(f64),
    /// A power whose exponent is a formula itself.
    Power,
    Negate,
    Call(Function),
}

/// A function of one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Function {
    Sqrt,
    Exp,
    Ln,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
}

/// The functions by name.
const FUNCTIONS: [(&str, Function); 13] = [
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

/// Most heights on the stack.
const MOST: usize = 64;
/// Heights on the stack of nearly every formula.
const FEW: usize = 8;

/// Why a text is no formula of x and y, and where in it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct FormulaError {
    /// The bytes of the text at fault.
    pub at: Range<usize>,
    /// What is wrong there.
    pub fault: FormulaFault,
}

/// What is wrong with a formula.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FormulaFault {
    /// There is nothing in it.
    #[error("the formula is empty")]
    Empty,
    /// A word that stands for nothing.
    #[error("`{0}` is neither x nor y, nor a function known here")]
    Name(String),
    /// A sign that has no meaning in a formula.
    #[error("`{0}` has no place in a formula")]
    Character(char),
    /// A number that is none.
    #[error("`{0}` is no number")]
    Number(String),
    /// Two values side by side.
    #[error("an operator is missing before `{0}`")]
    Operator(String),
    /// An operator without a value behind it.
    #[error("a value is missing after `{0}`")]
    Value(String),
    /// An operator without a value before it.
    #[error("a value is missing before `{0}`")]
    ValueBefore(char),
    /// A bracket without its partner.
    #[error("this bracket has no partner")]
    Bracket,
    /// A function without brackets behind it.
    #[error("`{0}` has no argument in brackets")]
    Argument(String),
    /// Brackets in brackets in brackets.
    #[error("the formula is nested too deeply")]
    Depth,
}

impl FormulaFault {
    /// What would be right.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            FormulaFault::Empty | FormulaFault::Value(_) | FormulaFault::ValueBefore(_) => {
                "write a height over x and y in metres, as in 0.1*x^2 - y^2".into()
            }
            FormulaFault::Name(name) => {
                let names: Vec<&str> = FUNCTIONS.iter().map(|(name, _)| *name).collect();
                let hint = match name.as_str() {
                    "log" => "write `ln` or `log10`: ",
                    "mm" | "cm" | "m" | "in" => {
                        "a formula holds no units, all of it is in metres: "
                    }
                    "deg" => "a formula holds no units, angles are in radians: ",
                    "abs" | "min" | "max" => "a mold has no kinks: ",
                    "z" => "write only what z is equal to: ",
                    word if word.contains(['²', '³']) => "write powers as in x^2: ",
                    word if word.chars().all(|c| "xy0123456789.".contains(c)) => {
                        "write products with a star, as in x*y: "
                    }
                    _ => "",
                };
                format!("{hint}known are x, y, pi, {}", names.join(", "))
            }
            FormulaFault::Character(',') => "write a decimal point, as in 0.5*x".into(),
            FormulaFault::Character('=') => "write only what z is equal to".into(),
            FormulaFault::Character(_) => {
                "write + - * / ^, round brackets and numbers, as in 0.5*(x - y)^2".into()
            }
            FormulaFault::Number(_) => "write numbers as 0.05 or 5e-2".into(),
            FormulaFault::Operator(_) => "write products with a star, as in 2*x".into(),
            FormulaFault::Bracket => "open and close as many round brackets".into(),
            FormulaFault::Argument(name) => format!("write {name}(…), as in {name}(x)"),
            FormulaFault::Depth => "write it with fewer brackets in brackets".into(),
        }
    }
}

impl Formula {
    /// Reads a formula in x and y.
    ///
    /// # Errors
    /// Where the text is no formula, and why.
    pub fn new(text: &str) -> Result<Self, FormulaError> {
        let program = parser::program(text)?;
        let (mut top, mut depth) = (0_usize, 0);
        for operation in &program {
            top = operation.top(top);
            depth = depth.max(top);
        }
        if depth > MOST {
            return Err(FormulaError { at: 0..text.len(), fault: FormulaFault::Depth });
        }
        Ok(Formula { text: text.to_string(), program, depth })
    }

    /// As it was written.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The height at (x, y) (m); not finite where the formula is not defined.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
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

    /// A place (m) on a grid over ranges of x and y (m) where the height or one of its derivatives is not
    /// finite, if there is one.
    #[must_use]
    pub fn undefined_within(&self, range: [[f64; 2]; 2]) -> Option<[f64; 2]> {
        let place = |n: usize, k: usize| {
            let [low, high] = range[n];
            let t = k as f64 / SAMPLES as f64;
            // the middle and both ends are met to the last bit
            low * (1.0 - t) + high * t
        };
        (0..=SAMPLES)
            .flat_map(|j| (0..=SAMPLES).map(move |i| [i, j]))
            .map(|[i, j]| [place(0, i), place(1, j)])
            .find(|&[x, y]| !self.at(x, y).is_finite())
    }
}

/// Steps along x and along y in which a formula is looked through, an even number.
const SAMPLES: usize = 64;

impl Operation {
    /// Heights on the stack behind the operation, from those before it.
    fn top(self, top: usize) -> usize {
        match self {
            Operation::Number(_) | Operation::X | Operation::Y => top + 1,
            Operation::Whole(_) | Operation::Real(_) | Operation::Negate | Operation::Call(_) => {
                top
            }
            _ => top - 1,
        }
    }

    /// What the operation leaves on the stack, from the height in its place and the one above.
    fn result(self, a: Height, above: Option<&Height>, [x, y]: [f64; 2]) -> Height {
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

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Formula").field(&self.text).finish()
    }
}

impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.text.serialize(to)
    }
}
