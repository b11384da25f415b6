//! Long work under someone's eyes: a bar that shows how far it is, and Ctrl-C.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Ctrl-C, or a request of the system to end (SIGTERM), as a question that work asks now and then, instead of an end in
/// the middle of it. It counts how often that was asked for. Work that has a time ends then, too.
pub struct Interrupt {
    signals: Arc<AtomicUsize>,
    until: Option<Instant>,
}

/// Held while files are written that no signal may cut off.
static WRITING: Mutex<()> = Mutex::new(());

/// Ends the program with exit code 130 on Ctrl-C or SIGTERM, from now on; files that are being written become whole first. It is for commands
/// that keep nothing of what they have begun.
pub fn end_when_asked() {
    // a second handler cannot be set; then Ctrl-C ends the program as it always did
    let _ = ctrlc::set_handler(|| {
        let _whole = WRITING.lock();
        std::process::exit(130);
    });
}

/// Writes files that become whole before a signal ends the program.
pub fn whole<T>(write: impl FnOnce() -> T) -> T {
    let _held = WRITING.lock();
    write()
}

impl Interrupt {
    /// Of work that nobody interrupts, or that ends with the program.
    pub fn never() -> Self {
        Interrupt { signals: Arc::default(), until: None }
    }

    /// Listens from now on.
    pub fn listen() -> Self {
        let interrupt = Interrupt::never();
        let counted = Arc::clone(&interrupt.signals);
        // a second handler cannot be set; then Ctrl-C ends the program as it always did
        let _ = ctrlc::set_handler(move || {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        interrupt
    }

    /// An interrupt that also comes after a time, counted from now.
    pub fn within(&self, time: Option<Duration>) -> Self {
        let until = time.and_then(|time| Instant::now().checked_add(time));
        Interrupt { signals: Arc::clone(&self.signals), until }
    }

    /// Whether to go on.
    pub fn asked(&self) -> ControlFlow<()> {
        match self.is_signaled() || self.is_late() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// Whether there was a signal.
    pub fn is_signaled(&self) -> bool {
        self.signals.load(Ordering::Relaxed) > 0
    }

    /// Whether there was a second signal, which ends what is finished after the first one.
    pub fn is_signaled_again(&self) -> bool {
        self.signals.load(Ordering::Relaxed) > 1
    }

    /// Whether the time is over.
    pub fn is_late(&self) -> bool {
        self.until.is_some_and(|until| Instant::now() >= until)
    }
}

/// A bar on standard error where someone watches it; it appears only if the work takes a while.
pub fn bar(length: usize, template: &str, quiet: bool) -> ProgressBar {
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let target = ProgressDrawTarget::stderr_with_hz(5);
    let bar = ProgressBar::with_draw_target(Some(length as u64), target);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
