//! Long work under someone's eyes: a bar that shows how far it is, and Ctrl-C.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Ctrl-C, or a request of the system to end (SIGTERM), as a question that work asks now and then, instead of an end in
/// the middle of it. It counts how often that was asked for.
pub struct Interrupt(Arc<AtomicUsize>);

impl Interrupt {
    /// Listens from now on.
    pub fn listen() -> Self {
        let signals = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&signals);
        // a second handler cannot be set; then Ctrl-C ends the program as it always did
        let _ = ctrlc::set_handler(move || {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        Interrupt(signals)
    }

    /// Whether to go on.
    pub fn asked(&self) -> ControlFlow<()> {
        self.asked_times(1)
    }

    /// Whether to go on with what is finished after the first request: whether there was no second one.
    pub fn asked_again(&self) -> ControlFlow<()> {
        self.asked_times(2)
    }

    fn asked_times(&self, times: usize) -> ControlFlow<()> {
        match self.0.load(Ordering::Relaxed) >= times {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
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
