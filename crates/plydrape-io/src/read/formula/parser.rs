//! From the text of a formula to its operations: winnow reads it, by the precedence of its operators.

use super::fault::{self, Misread};
use crate::error::Fault;
use plydrape::mold::formula::{FUNCTIONS, Operation};
use std::ops::Range;
use winnow::ascii::digit1;
use winnow::combinator::{Infix, Prefix, alt, cut_err, delimited, dispatch, eof, expression};
use winnow::combinator::{fail, opt, peek, terminated};
use winnow::error::{ErrMode, ParserError};
use winnow::prelude::*;
use winnow::stream::{LocatingSlice, Location, Stateful};
use winnow::token::{any, one_of, take_while};

/// Most brackets, signs and powers within each other.
const DEEPEST: usize = 64;

// How tightly operators bind. A sign lets the power behind it come first, and may be in an exponent.
const SUM: i64 = 1;
const PRODUCT: i64 = 3;
const SIGN: i64 = 5;
const POWER: i64 = 7;

/// Operations, each behind its operands.
type Program = Vec<Operation>;
type Input<'a> = Stateful<LocatingSlice<&'a str>, ParserState<'a>>;
type Parsed<T> = ModalResult<T, Misread>;

#[derive(Debug)]
struct ParserState<'a> {
    text: &'a str,
    /// How deep in brackets, signs and powers.
    depth: usize,
}

/// The operations of a formula.
pub(super) fn program(text: &str) -> Result<Program, Misread> {
    let input = Input { input: LocatingSlice::new(text), state: ParserState { text, depth: 0 } };
    let end = alt((eof.void(), misplaced));
    delimited(spaces, formula, end).parse(input).map_err(|error| error.into_inner())
}

fn formula(i: &mut Input) -> Parsed<Program> {
    expression(operand).prefix(prefix).infix(infix).parse_next(i)
}

fn infix<'a>(i: &mut Input<'a>) -> Parsed<Infix<Input<'a>, Program, ErrMode<Misread>>> {
    let operator = alt((
        (alt(("**", "^")), deeper).value(Infix::Right(POWER, |i: &mut Input, a, b| {
            i.state.depth -= 1;
            Ok(power(a, b))
        })),
        alt(("*", "·")).value(Infix::Left(PRODUCT, |_, a, b| Ok(join(a, b, Operation::Multiply)))),
        "/".value(Infix::Left(PRODUCT, |_, a, b| Ok(join(a, b, Operation::Divide)))),
        "+".value(Infix::Left(SUM, |_, a, b| Ok(join(a, b, Operation::Add)))),
        alt(("-", "−")).value(Infix::Left(SUM, |_, a, b| Ok(join(a, b, Operation::Subtract)))),
    ));
    terminated(operator, spaces).parse_next(i)
}

fn prefix<'a>(i: &mut Input<'a>) -> Parsed<Prefix<Input<'a>, Program, ErrMode<Misread>>> {
    let sign = alt((
        alt(("-", "−")).value(Prefix(SIGN, |i: &mut Input, a| {
            i.state.depth -= 1;
            Ok(negative(a))
        })),
        "+".value(Prefix(SIGN, |i: &mut Input, a| {
            i.state.depth -= 1;
            Ok(a)
        })),
    ));
    terminated(sign, (deeper, spaces)).parse_next(i)
}

/// A number, a name, a function or a bracket.
fn operand(i: &mut Input) -> Parsed<Program> {
    let value = dispatch! { peek(any);
        '(' => bracket,
        '0'..='9' | '.' => number,
        c if c.is_alphabetic() || c == '_' => named,
        _ => fail,
    };
    terminated(value, spaces).parse_next(i)
}

fn bracket(i: &mut Input) -> Parsed<Program> {
    let open = i.current_token_start();
    ("(", deeper, spaces).parse_next(i)?;
    let inner = cut_err(formula).parse_next(i)?;
    if i.is_empty() {
        return refuse(open..open + 1, fault::bracket());
    }
    alt((")".void(), misplaced)).parse_next(i)?;
    i.state.depth -= 1;
    Ok(inner)
}

fn number(i: &mut Input) -> Parsed<Program> {
    let exponent = (one_of(['e', 'E']), opt(one_of(['+', '-'])), digit1);
    let number = (take_while(1.., ('0'..='9', '.')), opt(exponent)).take();
    let (written, at) = number.with_span().parse_next(i)?;
    match written.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(vec![Operation::Number(value)]),
        _ => refuse(at, fault::number(written)),
    }
}

fn named(i: &mut Input) -> Parsed<Program> {
    let (name, at) = terminated(word.with_span(), spaces).parse_next(i)?;
    let known = FUNCTIONS.iter().find(|(known, _)| *known == name);
    match (name, known) {
        ("x", _) => Ok(vec![Operation::X]),
        ("y", _) => Ok(vec![Operation::Y]),
        ("pi" | "π", _) => Ok(vec![Operation::Number(std::f64::consts::PI)]),
        (_, Some(_)) if !i.starts_with('(') => refuse(at, fault::argument(name)),
        (_, Some((_, function))) => {
            let mut program = bracket(i)?;
            program.push(Operation::Call(*function));
            Ok(program)
        }
        (_, None) => refuse(at, fault::name(name)),
    }
}

/// Letters, digits and points.
fn word<'a>(i: &mut Input<'a>) -> Parsed<&'a str> {
    take_while(1.., |c: char| c.is_alphanumeric() || c == '_' || c == '.').parse_next(i)
}

fn spaces(i: &mut Input) -> Parsed<()> {
    take_while(0.., char::is_whitespace).void().parse_next(i)
}

/// Counts a bracket, a sign or a power that was just opened; where it ends it is taken off again. A weaker operator is
/// read and put back where a stronger one ends, but nothing is stronger than a power: each is counted once.
fn deeper(i: &mut Input) -> Parsed<()> {
    i.state.depth += 1;
    if i.state.depth > DEEPEST {
        return refuse(before(i), fault::depth());
    }
    Ok(())
}

fn join(mut a: Program, b: Program, operation: Operation) -> Program {
    a.extend(b);
    a.push(operation);
    a
}

fn negative(mut a: Program) -> Program {
    match a[..] {
        [Operation::Number(value)] => a[0] = Operation::Number(-value),
        _ => a.push(Operation::Negate),
    }
    a
}

fn power(mut base: Program, exponent: Program) -> Program {
    // an exponent that is just a number needs no logarithm
    match exponent[..] {
        [Operation::Number(n)] if n.fract() == 0.0 && n.abs() <= 1000.0 => {
            base.push(Operation::Whole(n as i32));
        }
        [Operation::Number(n)] => base.push(Operation::Real(n)),
        _ => return join(base, exponent, Operation::Power),
    }
    base
}

fn refuse<T>(at: Range<usize>, fault: Fault) -> Parsed<T> {
    Err(ErrMode::Cut(Misread { at, fault }))
}

/// Position of the operator or bracket before this place.
fn before(i: &Input) -> Range<usize> {
    let read = i.state.text[..i.current_token_start()].trim_end();
    let power = read.ends_with("**").then_some(2);
    let sign = power.or(read.chars().next_back().map(char::len_utf8));
    read.len() - sign.unwrap_or(0)..read.len()
}

/// Fault of what follows a whole value.
fn misplaced(i: &mut Input) -> Parsed<()> {
    if let Some((word, at)) = opt(alt((word, "(")).with_span()).parse_next(i)? {
        return refuse(at, fault::operator(word));
    }
    let (sign, at) = any.with_span().parse_next(i)?;
    refuse(at, if sign == ')' { fault::bracket() } else { fault::character(sign) })
}

impl ParserError<Input<'_>> for Misread {
    type Inner = Self;

    /// What is wrong where a value is due and none is found; nothing else that is looked for has to be there.
    fn from_input(i: &Input) -> Self {
        let (start, before) = (i.current_token_start(), before(i));
        let operator = &i.state.text[before.clone()];
        let missing = fault::value(&format!("after `{operator}`"));
        let Some(sign) = i.chars().next() else {
            return match operator {
                "" => Misread { at: 0..start, fault: fault::empty() },
                _ => Misread { at: before, fault: missing },
            };
        };
        let at = start..start + sign.len_utf8();
        match (sign, operator) {
            (')', "") => Misread { at, fault: fault::bracket() },
            ('*' | '/' | '^', "") => {
                Misread { at, fault: fault::value(&format!("before `{sign}`")) }
            }
            ('*' | '/' | '^' | ')', _) => Misread { at: before, fault: missing },
            _ => Misread { at, fault: fault::character(sign) },
        }
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}
