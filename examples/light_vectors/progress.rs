//! Progress on a terminal; nothing when the output or the errors are piped.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar that vanishes when it is dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar of `total` steps.
    pub fn new(what: &str, total: usize) -> Self {
        let style = ProgressStyle::with_template("{msg:28} {bar:40} {percent:>3} % {eta:>4} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        // The bar is drawn on the standard error, and hides itself when that is no terminal.
        let target =
            if io::stdout().is_terminal() { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Self(ProgressBar::with_draw_target(Some(total as u64), target).with_style(style).with_message(what.to_owned()))
    }

    /// `steps` more are done.
    pub fn advance(&self, steps: u64) {
        self.0.inc(steps);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
