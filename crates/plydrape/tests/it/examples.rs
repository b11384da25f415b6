//! The examples of the crate, run as programs.

use std::path::PathBuf;
use std::process::Command;

/// Where cargo puts the examples: beside the folder of this test.
fn example(name: &str) -> PathBuf {
    let mut folder = std::env::current_exe().unwrap();
    folder.pop();
    folder.pop();
    folder.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

/// The front page in a program of its own: the plan is accepted, and every limit is judged, by the numbers that are recorded beside it.
/// They are printed with two digits, which leaves rounding of the last one to the machine.
#[test]
fn the_dome_is_planned_and_accepted() {
    let program = example("dome");
    let output = Command::new(&program).output();
    let output = output.unwrap_or_else(|error| {
        panic!("{} is built by `cargo build --examples`: {error}", program.display())
    });
    assert!(output.status.success(), "{output:?}");
    let found = String::from_utf8(output.stdout).unwrap();
    let recorded = include_str!("../../examples/dome.txt");
    assert_eq!(found.lines().count(), recorded.lines().count(), "{found}");
    for (found, recorded) in found.lines().zip(recorded.lines()) {
        for (a, b) in found.split(' ').zip(recorded.split(' ')) {
            match (a.parse::<f64>(), b.parse::<f64>()) {
                // the duration is printed with one digit
                (Ok(a), Ok(b)) => {
                    let digit = if recorded.contains(" s, ") { 0.1 } else { 0.01 };
                    assert!((a - b).abs() < 1.1 * digit, "{found} for {recorded}");
                }
                _ => assert_eq!(a, b, "{found} for {recorded}"),
            }
        }
    }
}
