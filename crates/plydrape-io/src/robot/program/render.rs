//! Fills a template in, in bounds: a user's template is a program, and may be one that does not end or makes more than fits.
//!
//! The library counts the steps of a template and refuses more than [`STEPS`]. It does not count what lists of lists, written out
//! as texts, take; a template that has not ended after [`PATIENCE`] is given up.

use super::template::Robot;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Kwargs, Rest, Value, ValueKind};
use minijinja::{AutoEscape, Environment, Error, ErrorKind, State, UndefinedBehavior};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// Most steps of a template for one file: an instruction is a step, and so are 64 bytes that it makes. 5000 points with six axes take
/// less than 2 million of them in the shipped templates; all of these take some seconds and 640 MB.
const STEPS: u64 = 10_000_000;
/// How long a template may take for one file; a shipped one takes a second for 5000 points.
pub(super) const PATIENCE: Duration = Duration::from_secs(20);
/// Deepest nesting of loops within one another that a template has while it runs, in the units of the library.
const DEPTH: usize = 100;
/// Longest template (bytes); the shipped ones have 5 kB. It is the depth of what a template can nest line by line, too.
pub const LONGEST: u64 = 64 << 10;
/// Stack of the thread that fills a template in (bytes): enough for lists as deep as a template is long.
const STACK: usize = 64 << 20;
/// Most digits behind the point: a double has no more than 17 that say something.
const DIGITS: usize = 17;

/// Radii of ABB's zones z0 to z200 (m), as far as they are larger than the one before; technical reference manual for RAPID
/// instructions (3HAC050917), `zonedata`, predefined data.
pub(super) const ZONES: [f64; 14] = [
    0.0003, 0.001, 0.005, 0.010, 0.015, 0.020, 0.030, 0.040, 0.050, 0.060, 0.080, 0.100, 0.150,
    0.200,
];

/// A template, filled in with the variables of a file.
///
/// # Errors
/// [`crate::Error::NotPossible`] if it has a fault, or goes beyond a bound.
pub(super) fn rendered(
    robot: Robot,
    name: &str,
    text: &str,
    variables: &Value,
    patience: Duration,
) -> Result<String, crate::Error> {
    let fault = |what: String, help: &str| {
        let message = format!("the template {name} cannot be used: {what}");
        Err(crate::Error::not_possible(message, help))
    };
    if text.len() as u64 > LONGEST {
        let what = format!("it has {} bytes, and {LONGEST} are the most", text.len());
        return fault(what, "write what repeats as a loop");
    }
    let (sender, receiver) = mpsc::channel();
    let work = (name.to_owned(), text.to_owned(), variables.clone());
    // a thread that is given up ends with the process
    let begun = thread::Builder::new().stack_size(STACK).spawn(move || {
        let (name, text, variables) = work;
        // nobody listens any more if it took too long
        let _ = sender.send(environment().render_named_str(&name, &text, variables));
    });
    if let Err(why) = begun {
        return fault(format!("no thread for it: {why}"), "end other programs");
    }
    match receiver.recv_timeout(patience) {
        Ok(made) => made.map_err(|error| refused(robot, name, &error)),
        Err(_) => fault(
            format!("it has not ended after {} s", patience.as_secs_f64()),
            "make no lists of lists, and add no list to itself",
        ),
    }
}

/// Why a template was refused, with its line.
fn refused(robot: Robot, name: &str, error: &Error) -> crate::Error {
    let line = error.line().map(|line| format!("line {line}: ")).unwrap_or_default();
    let detail = error.detail().map_or_else(|| error.kind().to_string(), str::to_owned);
    let (what, help) = match error.kind() {
        ErrorKind::OutOfFuel => (
            format!(
                "the file that it makes takes more than {} million steps; an instruction is a step, and so are 64 bytes of text",
                STEPS / 1_000_000
            ),
            "let its loops go over the points, events and axes of the program alone".to_owned(),
        ),
        _ if detail.contains("recursion limit") => (
            format!("it is nested deeper than {DEPTH} loops and conditions"),
            "let its loops go over lists, and call no loop from within itself".to_owned(),
        ),
        _ => {
            let shipped =
                format!("compare it with the shipped one, which `{}` prints", robot.printed());
            (detail, shipped)
        }
    };
    crate::Error::not_possible(format!("the template {name} cannot be used: {line}{what}"), help)
}

fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::None);
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    let lines = SyntaxConfig::builder()
        .trim_blocks(true)
        .lstrip_blocks(true)
        .keep_trailing_newline(true)
        .build();
    if let Ok(lines) = lines {
        environment.set_syntax(lines);
    }
    environment.set_fuel(Some(STEPS));
    environment.set_recursion_limit(DEPTH);
    // with it a loop could nest lists without end
    environment.add_function("namespace", |_: Rest<Value>, _: Kwargs| -> Result<String, Error> {
        let what = "`namespace` is not there: points have a `number`, and loops an `index`";
        Err(Error::new(ErrorKind::UnknownFunction, what))
    });
    // it would print every point and whatever the template has made of them, and no bound would hold while it does
    environment.add_function("debug", |_: Rest<Value>, _: Kwargs| -> Result<String, Error> {
        let what = "`debug` is not there: print one variable, as in {{ name }}";
        Err(Error::new(ErrorKind::UnknownFunction, what))
    });
    for (name, factor, usual) in
        [("fixed", 1.0, 6), ("mm", 1e3, 4), ("degrees", 1.0_f64.to_degrees(), 6)]
    {
        environment.add_filter(name, move |state: &State, value: Value, digits: Option<usize>| {
            match digits.unwrap_or(usual) {
                digits if digits > DIGITS => {
                    let what = format!("{name}({digits}) asks for more than {DIGITS} digits");
                    Err(Error::new(ErrorKind::InvalidOperation, what))
                }
                digits => each(state, &value, factor, digits),
            }
        });
    }
    environment.add_filter("comment", |state: &State, lines: Value, mark: &str| {
        let mut text = String::new();
        for line in lines.try_iter()? {
            let refused =
                || Error::new(ErrorKind::InvalidOperation, "a line of a comment is no text");
            let line = line.as_str().ok_or_else(refused)?;
            state.consume_fuel(1 + line.len() as u64 / 64)?;
            text += format!("{mark} {line}").trim_end();
            text.push('\n');
        }
        Ok::<_, Error>(text)
    });
    environment.add_filter("zone", |radius: f64| {
        let nearest = ZONES.iter().rev().find(|zone| **zone <= radius * (1.0 + 1e-9));
        match nearest {
            Some(zone) if *zone < 0.001 => "z0".to_owned(),
            Some(zone) => format!("z{:.0}", zone * 1e3),
            None => "fine".into(),
        }
    });
    environment
}

/// A number times a factor, or a list of them, with a number of digits; no zero has a sign. Each number is a step.
fn each(state: &State, value: &Value, factor: f64, digits: usize) -> Result<Value, Error> {
    state.consume_fuel(1)?;
    if let Ok(number) = f64::try_from(value.clone()) {
        let text = format!("{:.digits$}", number * factor);
        let zero = text.trim_start_matches('-').chars().all(|c| matches!(c, '0' | '.'));
        return Ok(if zero { text.trim_start_matches('-').into() } else { text.into() });
    }
    // a text would be a list of its letters
    let list = value.try_iter().ok().filter(|_| value.as_str().is_none());
    let number = |item: Value| match item.kind() {
        ValueKind::Number => each(state, &item, factor, digits),
        kind => Err(no_number(kind)),
    };
    list.ok_or_else(|| no_number(value.kind()))?.map(number).collect()
}

fn no_number(kind: ValueKind) -> Error {
    Error::new(ErrorKind::InvalidOperation, format!("a {kind} is no number and no list of them"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A list that is added to itself forty times has 2⁴⁰ items, which the library does not count: the template is given up.
    #[test]
    fn a_template_that_does_not_end_is_given_up() {
        let text =
            "{% set x = [1] %}".to_owned() + &"{% set x = x + x %}".repeat(40) + "{{ x|length }}";
        let patience = Duration::from_millis(100);
        let made = rendered(Robot::Rapid, "a.mod.j2", &text, &Value::UNDEFINED, patience);
        let error = made.unwrap_err();
        assert!(error.to_string().contains("has not ended after 0.1 s"), "{error}");
        assert!(error.help().contains("add no list to itself"));
    }
}
