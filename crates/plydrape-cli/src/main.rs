//! The command `plydrape`: one file per subcommand, this one only sends to them.

mod argument;
mod check;
mod compare;
mod complete;
mod errors;
mod export;
mod failure;
mod fit;
mod limits;
mod mesh;
mod model;
mod net;
mod new;
mod numbers;
mod outcome;
mod plan;
mod replan;
mod report;
mod results;
mod schema;
mod search;
mod simulate;
mod span;
mod study;
mod template;
mod watch;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// How an array of grippers must move to lay a carbon-fiber ply on a mold without wrinkles.
#[derive(Debug, Parser)]
#[command(name = "plydrape", version, after_help = EXIT_CODES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Print nothing but what was asked for, and errors.
    #[arg(long, short, global = true)]
    quiet: bool,
}

/// What every exit code means.
const EXIT_CODES: &str = "\
Exit codes:
  0    done, and accepted
  1    done, but a limit of the scene is exceeded
  2    bad input: the message names the file, the line and the remedy
  3    no solution was found
  4    standard output could not be written; the message says which files are
  130  interrupted";

#[derive(Debug, Subcommand)]
enum Command {
    Simulate(simulate::Arguments),
    Plan(plan::Arguments),
    Replan(replan::Arguments),
    Net(net::Arguments),
    Study(study::Arguments),
    Check(check::Arguments),
    Report(report::Arguments),
    Export(export::Arguments),
    Compare(compare::Arguments),
    Template(template::Arguments),
    Span(span::Arguments),
    Fit(fit::Arguments),
    New(new::Arguments),
    Limits(limits::Arguments),
    Schema(schema::Arguments),
    Completions(complete::Completions),
    Man(complete::Man),
}

fn main() -> ExitCode {
    let Cli { command, quiet } = Cli::parse();
    // these keep what they have done when a signal ends them
    if !matches!(command, Command::Simulate(_) | Command::Plan(_) | Command::Study(_)) {
        watch::end_when_asked();
    }
    let done = match command {
        Command::Simulate(arguments) => simulate::run(&arguments, quiet),
        Command::Plan(arguments) => plan::run(&arguments, quiet),
        Command::Replan(arguments) => replan::run(&arguments, quiet),
        Command::Net(arguments) => net::run(&arguments, quiet),
        Command::Study(arguments) => study::run(&arguments, quiet),
        Command::Check(arguments) => check::run(&arguments, quiet),
        Command::Report(arguments) => report::run(&arguments, quiet),
        Command::Export(arguments) => export::run(&arguments, quiet),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Template(arguments) => template::run(&arguments),
        Command::Span(arguments) => span::run(&arguments),
        Command::Fit(arguments) => fit::run(&arguments, quiet),
        Command::New(arguments) => new::run(&arguments, quiet),
        Command::Limits(arguments) => limits::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Completions(arguments) => complete::completions(&arguments),
        Command::Man(arguments) => complete::man(&arguments),
    };
    done.unwrap_or_else(|failure| failure.report())
}
