//! From the text of a formula to its operations, by descent: sums hold products, products hold powers.

use super::operation::{FUNCTIONS, Operation};
use super::{FormulaError, FormulaFault};
use std::ops::Range;

/// Most brackets, signs and powers within each other.
const DEEPEST: usize = 100;

/// The operations of a formula, each behind its operands.
pub(super) fn program(text: &str) -> Result<Vec<Operation>, FormulaError> {
    let mut parser = Parser { text, at: 0, last: 0..0, program: Vec::new(), depth: 0 };
    if parser.next().is_none() {
        return Err(FormulaError { at: 0..text.len(), fault: FormulaFault::Empty });
    }
    parser.sum()?;
    match parser.next() {
        None => Ok(parser.program),
        Some(_) => Err(parser.stray()),
    }
}

struct Parser<'a> {
    text: &'a str,
    /// The next byte to be read.
    at: usize,
    /// The word or sign that was read last.
    last: Range<usize>,
    program: Vec<Operation>,
    /// How deep in brackets, signs and powers.
    depth: usize,
}

impl Parser<'_> {
    /// The next character behind any spaces.
    fn next(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// Takes a sign if it comes next.
    fn take(&mut self, sign: &str) -> bool {
        self.next();
        let found = self.text[self.at..].starts_with(sign);
        if found {
            self.last = self.at..self.at + sign.len();
            self.at += sign.len();
        }
        found
    }

    fn error<T>(&self, at: Range<usize>, fault: FormulaFault) -> Result<T, FormulaError> {
        Err(FormulaError { at, fault })
    }

    /// What is wrong with what stands behind a whole value.
    fn stray(&mut self) -> FormulaError {
        let Some(sign) = self.next() else {
            return FormulaError { at: self.last.clone(), fault: FormulaFault::Bracket };
        };
        let at = self.at..self.at + sign.len_utf8();
        match sign {
            ')' => FormulaError { at, fault: FormulaFault::Bracket },
            '(' => FormulaError { at, fault: FormulaFault::Operator("(".into()) },
            c if c.is_alphanumeric() || c == '_' || c == '.' => {
                let at = self.at..self.at + self.word();
                let word = self.text[at.clone()].to_string();
                FormulaError { at, fault: FormulaFault::Operator(word) }
            }
            c => FormulaError { at, fault: FormulaFault::Character(c) },
        }
    }

    /// Bytes of the letters, digits and points that come next.
    fn word(&self) -> usize {
        let rest = &self.text[self.at..];
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'));
        end.unwrap_or(rest.len())
    }

    fn sum(&mut self) -> Result<(), FormulaError> {
        self.product()?;
        loop {
            let operation = if self.take("+") {
                Operation::Add
            } else if self.take("-") || self.take("−") {
                Operation::Subtract
            } else {
                return Ok(());
            };
            self.product()?;
            self.program.push(operation);
        }
    }

    fn product(&mut self) -> Result<(), FormulaError> {
        self.signed()?;
        loop {
            let operation = if self.take("*") || self.take("·") {
                Operation::Multiply
            } else if self.take("/") {
                Operation::Divide
            } else {
                return Ok(());
            };
            self.signed()?;
            self.program.push(operation);
        }
    }

    /// A power with signs before it: the power comes first.
    fn signed(&mut self) -> Result<(), FormulaError> {
        if self.take("-") || self.take("−") {
            self.deeper(Self::signed)?;
            self.negate();
            return Ok(());
        }
        if self.take("+") {
            return self.deeper(Self::signed);
        }
        self.power()
    }

    fn negate(&mut self) {
        match self.program.last_mut() {
            Some(Operation::Number(value)) => *value = -*value,
            _ => self.program.push(Operation::Negate),
        }
    }

    fn power(&mut self) -> Result<(), FormulaError> {
        self.value()?;
        if !(self.take("**") || self.take("^")) {
            return Ok(());
        }
        let exponent = self.program.len();
        self.deeper(Self::signed)?;
        // an exponent that is just a number needs no logarithm
        match self.program[exponent..] {
            [Operation::Number(n)] => {
                self.program.truncate(exponent);
                self.program.push(if n.fract() == 0.0 && n.abs() <= 1000.0 {
                    Operation::Whole(n as i32)
                } else {
                    Operation::Real(n)
                });
            }
            _ => self.program.push(Operation::Power),
        }
        Ok(())
    }

    /// A number, a name, a function or a bracket.
    fn value(&mut self) -> Result<(), FormulaError> {
        let before = self.text[self.last.clone()].to_string();
        let Some(sign) = self.next() else {
            return self.error(self.last.clone(), FormulaFault::Value(before));
        };
        let start = self.at;
        if self.take("(") {
            return self.bracket();
        }
        if sign.is_ascii_digit() || sign == '.' {
            return self.number();
        }
        if !(sign.is_alphabetic() || sign == '_') {
            let at = start..start + sign.len_utf8();
            return match sign {
                ')' if before.is_empty() => self.error(at, FormulaFault::Bracket),
                '*' | '/' | '^' if before.is_empty() => {
                    self.error(at, FormulaFault::ValueBefore(sign))
                }
                '*' | '/' | '^' | ')' => self.error(self.last.clone(), FormulaFault::Value(before)),
                _ => self.error(at, FormulaFault::Character(sign)),
            };
        }
        let at = start..start + self.word();
        let name = &self.text[at.clone()];
        (self.at, self.last) = (at.end, at.clone());
        match name {
            "x" => self.program.push(Operation::X),
            "y" => self.program.push(Operation::Y),
            "pi" | "π" => self.program.push(Operation::Number(std::f64::consts::PI)),
            _ => {
                let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) else {
                    return self.error(at, FormulaFault::Name(name.to_string()));
                };
                if !self.take("(") {
                    return self.error(at, FormulaFault::Argument(name.to_string()));
                }
                self.bracket()?;
                self.program.push(Operation::Call(*function));
            }
        }
        Ok(())
    }

    /// What stands in a bracket that was just opened.
    fn bracket(&mut self) -> Result<(), FormulaError> {
        let open = self.last.clone();
        self.deeper(Self::sum)?;
        if self.take(")") {
            return Ok(());
        }
        match self.next() {
            None => self.error(open, FormulaFault::Bracket),
            Some(_) => Err(self.stray()),
        }
    }

    fn deeper(
        &mut self,
        part: impl FnOnce(&mut Self) -> Result<(), FormulaError>,
    ) -> Result<(), FormulaError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return self.error(self.last.clone(), FormulaFault::Depth);
        }
        part(self)?;
        self.depth -= 1;
        Ok(())
    }

    fn number(&mut self) -> Result<(), FormulaError> {
        let (start, bytes) = (self.at, self.text.as_bytes());
        let digits = |from: usize| {
            let tail = bytes.get(from..).unwrap_or_default();
            from + tail.iter().take_while(|b| b.is_ascii_digit()).count()
        };
        let mut end = digits(start);
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let exponent = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            if digits(exponent) > exponent {
                end = digits(exponent);
            }
        }
        (self.at, self.last) = (end, start..end);
        match self.text[start..end].parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.program.push(Operation::Number(value));
                Ok(())
            }
            _ => {
                let written = self.text[start..end].to_string();
                self.error(start..end, FormulaFault::Number(written))
            }
        }
    }
}
