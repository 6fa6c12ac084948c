//! Progress on the standard error if that is a terminal, and nothing otherwise.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar that vanishes when it is dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar of `total` steps.
    pub fn new(what: &str, total: usize) -> Self {
        let style = ProgressStyle::with_template("{msg:28} {bar:40} {percent:>3} % {eta:>4} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        Self(ProgressBar::new(total as u64).with_style(style).with_message(what.to_owned()))
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
