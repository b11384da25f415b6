//! `plydrape study`: many scenes made of one, by the Python package.
//!
//! Sampling, Parquet and clusters are Python's; this command finds Python, hands its arguments over
//! and passes the exit code on.

use crate::failure::{Done, Failure};
use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

/// Drape many scenes made of one: a grid or a random sample of its numbers.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The rows go to DIR/study.parquet, their distributions to DIR/summary.json. An interrupted study goes \
on with the same command. It runs by the Python package of plydrape and its extra `study`; \
PLYDRAPE_PYTHON names the Python that has it, python3 unless given. Exit codes: 0 done, 2 bad \
input, 4 standard output could not be written, 130 interrupted.")]
pub struct Arguments {
    /// The study file, TOML.
    study: PathBuf,

    /// Folder of the rows; NAME.results beside NAME.toml unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Address of a Dask scheduler, as in tcp://10.0.0.1:8786; processes of this machine unless given.
    #[arg(long, value_name = "ADDRESS")]
    scheduler: Option<String>,

    /// Number of processes on this machine; one a core unless given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    workers: Option<u32>,
}

/// Exit code of [`PROGRAM`] where there is no package.
const MISSING: i32 = 97;

/// What Python runs: the command of the package, by a way that takes no folder named `plydrape` in the
/// current one for it. Its standard input ends with this process, and then it ends as by SIGTERM: nobody would see a study that goes
/// on, and it would keep its folder.
const PROGRAM: &str = "\
import os, signal, sys, threading
def listen():
    # those who hold signals back in the first thread would get them by this one
    if hasattr(signal, 'pthread_sigmask'):
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    os.read(0, 1)
    os.kill(os.getpid(), signal.SIGTERM)
threading.Thread(target=listen, daemon=True).start()
sys.path = [path for path in sys.path if path]
try:
    from plydrape.study.__main__ import main
except ImportError as error:
    if error.name not in ('plydrape', 'plydrape.study'):
        print(error, file=sys.stderr)
    sys.exit(97)
sys.exit(main())
";

/// Runs the study in Python.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let python = env::var_os("PLYDRAPE_PYTHON").filter(|name| !name.is_empty());
    let python = python.unwrap_or_else(|| "python3".into());

    let unknown = |fault| Failure::Refused {
        message: format!("Python cannot be run as `{}`: {fault}", python.display()),
        help: "install Python 3.10 or newer, or name it in PLYDRAPE_PYTHON".into(),
    };
    let mut child = Command::new(&python)
        .args(["-c", PROGRAM])
        .args(arguments_of(arguments, quiet))
        .stdin(Stdio::piped())
        .spawn()
        .map_err(unknown)?;
    // `wait` would close it
    let input = child.stdin.take();
    // Python keeps what is finished and says how to go on; here it is waited for. Ctrl-C reaches both, what is sent to
    // this process alone is passed on.
    let id = child.id();
    let _ = ctrlc::set_handler(move || terminate(id));
    let status = child.wait().map_err(unknown)?;
    drop(input);
    match status.code() {
        Some(MISSING) => Err(Failure::Refused {
            message: format!("the Python `{}` has no package plydrape", python.display()),
            help: "in a clone of plydrape: python3 -m pip install '.[study]'; or name a Python that has \
                   it in PLYDRAPE_PYTHON"
                .into(),
        }),
        // Without a code it was ended by a signal.
        code => Ok(ExitCode::from(code.and_then(|code| u8::try_from(code).ok()).unwrap_or(130))),
    }
}

/// Asks a process to end.
#[cfg(unix)]
fn terminate(id: u32) {
    use rustix::process::{Pid, Signal, kill_process};
    if let Some(process) = i32::try_from(id).ok().and_then(Pid::from_raw) {
        // it may have ended just now
        let _ = kill_process(process, Signal::TERM);
    }
}

/// Asks a process to end; without signals it is just waited for.
#[cfg(not(unix))]
fn terminate(_: u32) {}

/// The arguments once more, for Python.
fn arguments_of(arguments: &Arguments, quiet: bool) -> Vec<OsString> {
    let mut list: Vec<OsString> = Vec::new();
    let options = [
        ("--output", arguments.output.clone().map(OsString::from)),
        ("--scheduler", arguments.scheduler.clone().map(OsString::from)),
        ("--workers", arguments.workers.map(|count| count.to_string().into())),
    ];
    for (name, value) in options {
        if let Some(value) = value {
            // In one argument, so that a value may begin with a dash.
            let mut argument = OsString::from(format!("{name}="));
            argument.push(value);
            list.push(argument);
        }
    }
    if quiet {
        list.push("--quiet".into());
    }
    list.extend(["--".into(), arguments.study.clone().into()]);
    list
}
